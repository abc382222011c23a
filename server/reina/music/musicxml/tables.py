"""What the signs and words of MusicXML mean in numbers."""

from __future__ import annotations

import re

STEP_NAMES = "CDEFGAB"
STEPS = {"C": 0, "D": 2, "E": 4, "F": 5, "G": 7, "A": 9, "B": 11}

NOTE_TYPES = {
    "maxima": 32.0, "long": 16.0, "breve": 8.0, "whole": 4.0, "half": 2.0, "quarter": 1.0, "eighth": 0.5,
    "16th": 0.25, "32nd": 0.125, "64th": 0.0625, "128th": 1 / 32, "256th": 1 / 64, "512th": 1 / 128,
    "1024th": 1 / 256,
}  # fmt: skip
"""Quarter notes of each value."""

STEP = 16 / 127
"""From one dynamic to the next."""

LEVELS = {
    "pppppp": 1 / 127, "ppppp": 5 / 127, "pppp": 10 / 127, "ppp": 16 / 127, "pp": 33 / 127, "p": 49 / 127,
    "mp": 64 / 127, "mf": 80 / 127, "f": 96 / 127, "ff": 112 / 127, "fff": 126 / 127, "ffff": 1.0,
    "fffff": 1.0, "ffffff": 1.0, "n": 1 / 127,
}  # fmt: skip
"""Velocities of dynamics, as notation programs play them."""
DEFAULT_LEVEL = LEVELS["mf"]

ACCENTS = {
    "sf": 112 / 127, "sfz": 112 / 127, "sffz": 126 / 127, "fz": 112 / 127, "rf": 112 / 127, "rfz": 112 / 127,
}  # fmt: skip
"""Dynamics that are heard in the notes they stand at and change nothing after."""

ACCENT_THEN_LEVEL = {
    "fp": (LEVELS["f"], LEVELS["p"]),
    "pf": (LEVELS["p"], LEVELS["f"]),
    "sfp": (ACCENTS["sf"], LEVELS["p"]),
    "sfpp": (ACCENTS["sf"], LEVELS["pp"]),
    "sfzp": (ACCENTS["sfz"], LEVELS["p"]),
}
"""Dynamics that say a loudness of the notes they stand at, and another one after."""

FULL_DYNAMICS = 90 / 127
"""Velocity of 100 per cent in ``sound``'s and ``note``'s attribute ``dynamics``: MusicXML takes MIDI's 90."""

GATES = {
    "staccato": 0.5,
    "staccatissimo": 1 / 3,
    "spiccato": 1 / 3,
    "detached-legato": 0.75,
    "tenuto": 1.0,
    "strong-accent": 0.85,
}
"""Which share of a note's length sounds under an articulation; of several the least, which staccato with
tenuto is not: that is `PORTATO`."""
PORTATO = 0.75

LOUDER = {"accent": 15 / 127, "strong-accent": 25 / 127, "soft-accent": 8 / 127, "stress": 8 / 127,
          "unstress": -10 / 127}  # fmt: skip
"""What an articulation adds to a note's velocity."""

BENDS = frozenset({"scoop", "plop", "doit", "falloff"})
"""Articulations that bend a pitch."""

GRACE_BEATS = 0.125
"""How long a short grace note lasts."""

BRASS_WITH_MUTES = frozenset({56, 57, 58, 60, 61})
MUTED = 59
"""General MIDI's muted trumpet, which stands for all muted brass."""
MUTE_IN = re.compile(
    r"\b(con sord|with mute|muted\b|mute on|mute in|(straight|cup|harmon|bucket) mute|mit dämpfer|avec sourd)"
)
MUTE_OUT = re.compile(
    r"\b(senza sord|via sord|open\b|mute off|mute out|without mute|ohne dämpfer|sans sourd)"
)

CRESCENDO = re.compile(r"^(cresc|crescendo)\b")
DIMINUENDO = re.compile(r"^(dim|dimin|diminuendo|decresc|decrescendo)\b")
SLOWER = re.compile(
    r"\b(rit|ritard|ritardando|rall|rallent|rallentando|allarg|allargando|slarg|slargando|calando|morendo|"
    r"smorz|smorzando|slentando)\b"
)
HELD_BACK = re.compile(r"\b(riten|ritenuto)\b")
FASTER = re.compile(r"\b(accel|accelerando|string(?=\.)|stringendo|affrett|affrettando)\b")
NO_CHANGE = re.compile(r"\b(non|senza|no|without|ohne|sans)\b")
"""Words that say that no such change is made."""
MUCH = re.compile(r"\b(molto|assai)\b")
LITTLE = re.compile(r"\b(poco|un poco|slight)\b(?! a poco)(?<!a poco)")
SLOWER_RATIOS = 0.85, 0.75, 0.6
"""What a *poco rit.*, a *rit.* and a *molto rit.* end with, as a share of the tempo before."""
FASTER_RATIOS = 1.12, 1.25, 1.5
A_TEMPO = re.compile(r"\b(a tempo|in tempo|tempo ordinario)\b")
TEMPO_PRIMO = re.compile(r"\btempo (primo|i|1|1mo|imo)\b")

FERMATAS = {
    "": 0.5, "normal": 0.5, "angled": 0.25, "double-angled": 0.125, "square": 1.0, "double-square": 1.5,
}  # fmt: skip
"""How much longer each sign makes a note, as a share of its length."""
BREATH_BEATS = 0.25
"""How much earlier a note ends before a breath; of a short note a third."""
CAESURA_BEATS = 0.5
"""How much earlier it ends before a caesura, and by how much that silence is longer than it is written."""

ACCIDENTALS = {
    "sharp": 1, "flat": -1, "natural": 0, "double-sharp": 2, "sharp-sharp": 2, "flat-flat": -2,
    "natural-sharp": 1, "natural-flat": -1,
}  # fmt: skip

DA_CAPO = re.compile(r"\s*(d\. ?c\b|dc\b|da capo\b)", re.IGNORECASE)
DAL_SEGNO = re.compile(r"\s*(d\. ?s\b|ds\b|dal segno\b)", re.IGNORECASE)
TO_CODA = re.compile(r"\s*(to coda|al coda)\b", re.IGNORECASE)
FINE = re.compile(r"^\s*fine\s*[.𝄐]?\s*$", re.IGNORECASE)

INSTRUMENT_SOUNDS = (
    ("brass.trumpet", 56), ("brass.cornet", 56), ("brass.flugelhorn", 56), ("brass.bugle", 56),
    ("brass.trombone", 57), ("brass.tuba", 58), ("brass.euphonium", 58), ("brass.baritone", 58),
    ("brass.sousaphone", 58), ("brass.french-horn", 60), ("brass.natural-horn", 60), ("brass.alto-horn", 60),
    ("brass.mellophone", 60), ("brass.group", 61), ("wind.sax.soprano", 64), ("wind.sax.alto", 65),
    ("wind.sax.tenor", 66), ("wind.sax.baritone", 67), ("wind.reed.oboe", 68),
    ("wind.reed.english-horn", 69), ("wind.reed.bassoon", 70), ("wind.reed.contrabassoon", 70),
    ("wind.reed.clarinet", 71), ("wind.flutes.flute.piccolo", 72), ("wind.flutes.flute", 73),
    ("wind.flutes.recorder", 74), ("strings.violin", 40), ("strings.viola", 41), ("strings.cello", 42),
    ("strings.contrabass", 43), ("strings.group", 48), ("strings.harp", 46), ("drum.timpani", 47),
    ("keyboard.piano", 0), ("keyboard.harpsichord", 6), ("keyboard.celesta", 8), ("keyboard.organ", 19),
    ("pitched-percussion.glockenspiel", 9), ("pitched-percussion.vibraphone", 11),
    ("pitched-percussion.marimba", 12), ("pitched-percussion.xylophone", 13),
    ("pluck.guitar.electric", 27), ("pluck.guitar", 24), ("pluck.bass.electric", 33), ("pluck.bass", 32),
    ("voice", 52),
)  # fmt: skip
"""Beginnings of MusicXML's standard sounds and the General MIDI program, counted from 0, of each."""

DRUM_NAMES = (
    ("bass drum", 36), ("kick", 36), ("side stick", 37), ("rim", 37), ("snare", 38), ("side drum", 38),
    ("clap", 39), ("pedal hi-hat", 44), ("open hi-hat", 46), ("hi-hat", 42), ("hi hat", 42), ("hihat", 42),
    ("floor tom", 43), ("low tom", 45), ("high tom", 50), ("tom", 47), ("crash", 49), ("ride", 51),
    ("splash", 55), ("china", 52), ("cymbal", 49), ("tambourine", 54), ("cowbell", 56), ("triangle", 81),
    ("wood block", 76), ("woodblock", 76), ("bongo", 60), ("conga", 63), ("timbale", 65), ("agogo", 67),
    ("maraca", 70), ("guiro", 73), ("claves", 75), ("castanet", 85),
)  # fmt: skip
"""Words in the names of drums and the key of General MIDI's percussion map."""
SNARE = 38

SLOWEST, FASTEST = 1.0, 10_000.0
"""Quarter notes a minute that are a tempo."""
