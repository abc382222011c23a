"""Rhythms as short texts, to and from scores."""

from collections.abc import Sequence

import numpy as np

from reina.music import MetreMap, Notes, Part, Score, TempoMap, TimeSignature
from reina.notation import Measure, WrittenPart, write_part

SIGNS = {1: "w", 2: "h", 4: "q", 8: "e", 16: "s", 32: "t", 64: "x"}


def score_of_beats(
    onsets: Sequence[float],
    ends: Sequence[float],
    *,
    metres: Sequence[tuple[float, int, int]] = ((0.0, 4, 4),),
    pickup: float = 0.0,
    bpm: float = 120.0,
    pitches: Sequence[int] = (),
) -> Score:
    """A score of one part; its notes go up and down a fourth unless told otherwise."""
    tempo_map = TempoMap([0.0], [60.0 / bpm])
    onset_s, end_s = tempo_map.seconds(onsets), tempo_map.seconds(ends)
    notes = Notes.from_columns(
        part=[0] * len(onsets),
        channel=[0] * len(onsets),
        onset_s=onset_s,
        duration_s=end_s - onset_s,
        onset_beats=onsets,
        duration_beats=np.asarray(ends) - np.asarray(onsets),
        sounding_pitch=pitches or [60 + 5 * (at % 2) for at in range(len(onsets))],
        velocity=[0.7] * len(onsets),
    )
    metre_map = MetreMap([TimeSignature(*metre) for metre in metres], pickup_beats=pickup)
    return Score(
        "Test", (Part(0, "Part", 56, is_drums=False),), notes, tempo_map, metre_map, (), (), max(end_s)
    )


def write(score: Score) -> WrittenPart:
    """The part of a score whose notes are a line already."""
    notes = score.notes
    return write_part(score, notes.onset_s, notes.end_s, notes.sounding_pitch.astype(np.int64))


def written(
    onsets: Sequence[float], *, hold: float = 0.95, last: float = 1.0, **of_score: object
) -> list[str]:
    """What is written of onsets in quarter notes, each held for a share of the time to the next."""
    lengths = [*np.diff(onsets), last]
    ends = [onset + hold * length for onset, length in zip(onsets, lengths, strict=True)]
    return [text(measure) for measure in write(score_of_beats(onsets, ends, **of_score)).measures]  # pyright: ignore[reportArgumentType]


def text(measure: Measure) -> str:
    """A bar as ``q e_0 e_0 rh``: r a rest, . a dot, 3 a tuplet, _0 a beam, ~ a tie, ' staccato, g a grace."""
    return " ".join(
        ("" if entry.placed else "r")
        + ("W" if entry.is_bar_rest else SIGNS[entry.value.fraction])
        + "." * entry.value.dots
        + ("3" if entry.tuplet is not None else "")
        + (f"_{entry.beam}" if entry.beam is not None else "")
        + ("'" if entry.placed and entry.placed.is_staccato and not entry.tied_from else "")
        + ("g" * len(entry.placed.graces) if entry.placed and not entry.tied_from else "")
        + ("~" if entry.tied_to else "")
        for entry in measure.entries
    )
