"""The drum kit: which piece a note strikes, with which hand or foot, and how sticks, feet and kit then move.

Its parts: `drum_map` (keys to pieces), `sticking` and `feet` (which limb), `stick_paths` (where the sticks are at a
time), `kit_answers` (what cymbals, heads and pedals do), `drum_kit` (the instrument).
"""
