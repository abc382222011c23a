"""The drum kit: which piece a note strikes, with which hand or foot, and how sticks, feet and kit then move.

Its parts: `drum_map` (keys to pieces), `sticking` and `feet` (which limb), `motion` (where sticks and feet
are at a time, and what cymbals, heads and pedals do), `drum_kit` (the instrument).
"""
