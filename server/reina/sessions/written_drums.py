"""A drummer's part as the wire tells it."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, get_args

from reina.notation.drums import write_drums
from reina.protocol import written_part as wire
from reina.sessions.part_measures import TICKS_PER_QUARTER, joined, tempi

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reina.music import Score
    from reina.notation.drums import DrumEntry, DrumMeasure, DrumStroke, Struck

LONGEST_LIT_S = 0.4
"""How long a hit counts as sounding, for what lights up with it."""
TOGETHER_S = 1e-3
SPOKEN = {
    "kick": "bass drum",
    "hi_hat": "hi-hat",
    "tom_high": "high tom",
    "tom_mid": "middle tom",
    "tom_floor": "floor tom",
    "crash_left": "left crash",
    "crash_right": "right crash",
}
"""Pieces whose name is not what they are called."""
LIMBS: tuple[wire.Limb, ...] = get_args(wire.Limb)


def written_drum_part(
    score: Score,
    hits: Sequence[Struck],
    *,
    note_index: Sequence[int],
    reasons: Sequence[str],
    title: str,
    part_name: str,
    player: int,
    instrument: str,
    instrument_title: str,
) -> wire.WrittenPart:
    """Return what a drummer plays, as notation.

    Args:
        score: Its tempo and metre.
        hits: N hits by their onset.
        note_index: (N,) the place of each in the score's table of notes.
        reasons: (N,) why each is struck so.
        title: Of the piece.
        part_name: As the score names it.
        player: A place in the cast.
        instrument: The instrument's name.
        instrument_title: Its name in words.
    """
    part = write_drums(score, hits)
    measures = joined([_measure(score, one, hits) for one in part.measures])
    ends = _ends(hits)
    return wire.WrittenPart(
        title=title,
        part_name=part_name,
        player=player,
        instrument=instrument,
        instrument_title=instrument_title,
        clef="percussion",
        written_above_sounding=0,
        swing=part.swing,
        keys=[],
        tempi=tempi([measure.bar for measure in part.measures], part.tempo_marks, measures),
        notes=[
            wire.PartNote(
                index=note_index[number],
                onset_s=hit.onset_s,
                end_s=ends[number],
                sounding_name=_spoken(hit.piece),
                written_name=_spoken(hit.piece),
                valves=None,
                usual_valves=None,
                reason=reasons[number],
                piece=hit.piece,
                limb=next((limb for limb in LIMBS if limb == hit.limb), None),
            )
            for number, hit in enumerate(hits)
        ],
        measures=measures,
    )


def _spoken(piece: str) -> str:
    return SPOKEN.get(piece, piece.replace("_", " "))


def _ends(hits: Sequence[Struck]) -> list[float]:
    """Return until when each hit counts as sounding: until the next that is not together with it."""
    ends: list[float] = []
    following = float("inf")
    for hit, later in reversed(list(pairwise([*hits, None]))):
        if hit is None:
            continue
        if later is not None and later.onset_s - hit.onset_s > TOGETHER_S:
            following = later.onset_s
        ends.append(min(hit.onset_s + LONGEST_LIT_S, following))
    return ends[::-1]


def _measure(score: Score, measure: DrumMeasure, hits: Sequence[Struck]) -> wire.PartMeasure:
    bar = measure.bar
    begin, end = (
        score.tempo_map.seconds(beats)
        for beats in (bar.begin_beats, bar.begin_beats + bar.shape.ticks / TICKS_PER_QUARTER)
    )
    return wire.PartMeasure(
        number=bar.number,
        bars=1,
        begin_s=begin,
        end_s=end,
        ticks=bar.shape.ticks,
        numerator=bar.numerator,
        denominator=bar.denominator,
        fifths=0,
        written_fifths=0,
        entries=[
            *(_entry(entry, "hands", hits) for entry in measure.hands),
            *(_entry(entry, "feet", hits) for entry in measure.feet),
        ],
    )


def _entry(entry: DrumEntry, voice: wire.Voice, hits: Sequence[Struck]) -> wire.PartEntry:
    heads = [_head(stroke) for stroke in entry.strokes]
    top = entry.strokes[-1] if entry.strokes else None
    pitch = None if top is None else _pitch(top, hits)
    return wire.PartEntry(
        begin_ticks=entry.begin,
        ticks=entry.ticks,
        value=entry.value.fraction,
        dots=entry.value.dots,
        note=None if top is None else top.hit,
        is_bar_rest=entry.is_bar_rest,
        written=pitch,
        sounding=pitch,
        tied_from=False,
        tied_to=False,
        beam=entry.beam,
        tuplet=entry.tuplet,
        is_staccato=False,
        graces=[
            wire.PartGrace(
                note=grace.hit, written=_pitch(grace, hits), sounding=_pitch(grace, hits), head=_head(grace)
            )
            for grace in entry.graces
        ],
        trill=None,
        voice=voice,
        heads=heads,
    )


def _head(stroke: DrumStroke) -> wire.PartHead:
    return wire.PartHead(
        note=stroke.hit,
        letter=stroke.place.letter,
        octave=stroke.place.octave,
        shape=stroke.head,
        mark=stroke.mark,
        is_ghost=stroke.is_ghost,
        hand=stroke.hand,
    )


def _pitch(stroke: DrumStroke, hits: Sequence[Struck]) -> wire.PartPitch:
    return wire.PartPitch(
        name=_spoken(hits[stroke.hit].piece),
        letter=stroke.place.letter,
        octave=stroke.place.octave,
        accidental=None,
    )
