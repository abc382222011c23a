"""A score with its players' parts as they are played."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from reina.music.notes import Notes

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reina.instruments.played import PlayedPart
    from reina.music.score import Score


def score_as_played(score: Score, played: Sequence[PlayedPart]) -> Score:
    """Put what players play in the place of their parts.

    A player's notes are the playable line, moved by its transposition, as long as it holds them, in the first
    of the parts that it is made of; notes that nobody can play are gone. All other parts stay.

    Args:
        score: The score.
        played: What each player makes of its part; no part is played twice.

    Returns:
        A score with those notes; parts that are left without a note are gone, the others are counted anew.
    """
    notes = score.notes
    columns: dict[str, Any] = {name: column.copy() for name, column in vars(notes).items()}
    kept = np.ones(len(notes), dtype=np.bool_)
    for one in played:
        kept[np.isin(notes.part, one.parts)] = False
        line = one.line
        index = line.note_index[one.fingering.playable]
        kept[index] = True
        columns["part"][index] = one.part
        columns["sounding_pitch"][index] = line.sounding_pitch[one.fingering.playable]
        columns["velocity"][index] = line.velocity[one.fingering.playable]
        onset_s = columns["onset_s"][index] = line.onset_s[one.fingering.playable]
        end_s = line.end_s[one.fingering.playable]
        columns["duration_s"][index] = end_s - onset_s
        onset_beats = columns["onset_beats"][index] = score.tempo_map.beats(onset_s)
        columns["duration_beats"][index] = score.tempo_map.beats(end_s) - onset_beats
    left = {name: column[kept] for name, column in columns.items()}
    parts = [part for part in score.parts if part.index in left["part"]]
    of_parts = np.array([part.index for part in parts], dtype=np.int64)
    left["part"] = np.searchsorted(of_parts, left["part"])
    return replace(
        score,
        parts=tuple(replace(part, index=index) for index, part in enumerate(parts)),
        notes=Notes.from_columns(**left),
    )
