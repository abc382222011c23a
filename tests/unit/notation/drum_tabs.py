"""Drum parts as tablature, to and from hits."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from reina.music import MetreMap, Notes, Part, Score, TempoMap, TimeSignature
from reina.notation.drums import DrumEntry, DrumStroke, WrittenDrums, write_drums

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

SIGNS = {1: "w", 2: "h", 4: "q", 8: "e", 16: "s", 32: "t", 64: "x"}
TECHNIQUES = {
    "x": None, "X": "accent", "g": "ghost", "o": "open", "O": "half_open", "r": "cross_stick",
    "R": "rim_shot", "f": "flam_grace", "d": "drag_grace", "c": "choke",
}  # fmt: skip
"""What a letter of a tab says."""


@dataclass(frozen=True)
class Hit:
    """As the drums' part gives them."""

    onset_s: float
    onset_beats: float
    piece: str
    zone: str
    limb: str
    velocity: float = 0.7
    technique: str | None = None


LIMBS = {"R": "right_hand", "L": "left_hand", "k": "right_foot", "p": "left_foot"}


def tab(rows: Mapping[str, str], *, step: float = 0.25, bpm: float = 120.0) -> list[Hit]:
    """Hits of rows such as ``{"hi_hat R": "x-x-x-x-"}``, each letter `step` quarter notes; `|` is skipped."""
    hits: list[Hit] = []
    for name, row in rows.items():
        piece, limb, *zone = name.split()
        for at, letter in enumerate(row.replace("|", "").replace(" ", "")):
            if letter != "-":
                beat = at * step
                hits.append(
                    Hit(
                        beat * 60 / bpm, beat, piece, zone[0] if zone else "centre", LIMBS[limb],
                        technique=TECHNIQUES[letter],
                    )
                )  # fmt: skip
    return sorted(hits, key=lambda hit: hit.onset_s)


def drum_score(
    *, metre: tuple[int, int] = (4, 4), bpm: float = 120.0, pickup: float = 0.0, beats: float = 16.0
) -> Score:
    """A score that holds one drum note; its tempo and metre are all that counts."""
    tempo_map = TempoMap([0.0], [60.0 / bpm])
    notes = Notes.from_columns(
        part=[0], channel=[9], onset_s=[0.0], duration_s=[tempo_map.seconds(beats)], onset_beats=[0.0],
        duration_beats=[beats], sounding_pitch=[38], velocity=[0.7],
    )  # fmt: skip
    metre_map = MetreMap([TimeSignature(0.0, *metre)], pickup_beats=pickup)
    return Score("Test", (Part(0, "Drums", None, is_drums=True),), notes, tempo_map, metre_map, (), (), 8.0)


def written(hits: Sequence[Hit], **of_score: object) -> list[str]:
    """Each bar as ``hands / feet``."""
    return texts(write_drums(drum_score(**of_score), hits))  # pyright: ignore[reportArgumentType]


def texts(part: WrittenDrums) -> list[str]:
    return [
        " / ".join(" ".join(map(text, voice)) for voice in (measure.hands, measure.feet))
        for measure in part.measures
    ]


def text(entry: DrumEntry) -> str:
    """``e_0[C5 Gx]``: value, dot, tuplet, beam, and what is struck; `r` is a rest, `W` a bar's rest."""
    value = "W" if entry.is_bar_rest else SIGNS[entry.value.fraction]
    shown = value + "." * entry.value.dots + "3" * (entry.tuplet is not None)
    shown += "" if entry.beam is None else f"_{entry.beam}"
    if not entry.strokes:
        return f"r{shown}"
    graces = "".join(f"g{stroke_text(grace)}" for grace in entry.graces)
    return f"{shown}[{graces}{'+'.join(map(stroke_text, entry.strokes))}]"


HEAD_SIGNS = {
    "plain": "",
    "cross": "x",
    "circled_cross": "@",
    "diamond": "^",
    "triangle": "v",
    "slashed": "/",
}
MARKS = {None: "", "accent": ">", "open": "o", "half_open": "ø", "closed": "+", "choke": "!"}


def stroke_text(stroke: DrumStroke) -> str:
    """``(C5)L``: place, head, sign, hand; brackets are a ghost note's."""
    place = f"{stroke.place.letter}{stroke.place.octave}{HEAD_SIGNS[stroke.head]}{MARKS[stroke.mark]}"
    return (f"({place})" if stroke.is_ghost else place) + (stroke.hand or "")
