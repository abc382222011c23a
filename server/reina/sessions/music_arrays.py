"""The music as the arrays that keyframes work on: they know no scores."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from reina.show import TimeMap, Triggers
from reina.stage import MusicForm

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reina.instruments import PlayedPart
    from reina.music import Score
    from reina.music.arrays import FloatArray


def bar_lines_beats(score: Score) -> FloatArray:
    """(B,) where the bars begin, quarter notes, up to the score's end."""
    return score.metre_map.bar_lines(score.duration_beats + 1e-9)


def time_map(score: Score) -> TimeMap:
    """The score's beats and bars, as keyframes count them."""
    return TimeMap(
        beats=score.tempo_map.beats,
        seconds=score.tempo_map.seconds,
        bar_lines_beats=bar_lines_beats(score),
    )


def triggers(score: Score, played: Sequence[PlayedPart]) -> Triggers:
    """All notes of a score as events that tracks may answer, those of the players' lines as they sound.

    After the valves' columns stands one more, which is down for notes that nobody fingers, so that they are
    not taken for open ones.
    """
    notes = score.notes
    part = notes.part.astype(np.int64)
    joined_to = part.copy()
    pitch = notes.sounding_pitch.astype(np.int64)
    columns = max(one.fingering.valves.shape[1] for one in played)
    valves = np.zeros((len(notes), columns + 1), dtype=np.bool_)
    valves[:, -1] = True
    for one in played:
        line, fingering = one.line, one.fingering
        pitch[line.note_index] = line.sounding_pitch
        fingered = line.note_index[fingering.playable]
        valves[fingered, : fingering.valves.shape[1]] = fingering.valves[fingering.playable]
        valves[fingered, -1] = False
        joined_to[np.isin(part, one.joined_parts)] = one.part
    return Triggers(
        onset_s=notes.onset_s,
        part=part,
        pitch=pitch,
        velocity=notes.velocity,
        valves=valves,
        end_s=score.duration_s,
        joined_to=joined_to,
    )


def music_form(score: Score, played: PlayedPart) -> MusicForm:
    """What the player's line is like, and where its phrases and the bars begin."""
    line = played.line
    first = np.flatnonzero(np.diff(line.phrase, prepend=-1))
    last = np.append(first[1:], len(line))[: len(first)] - 1
    return MusicForm(
        onset_s=line.onset_s,
        end_s=line.end_s,
        pitch=line.sounding_pitch.astype(np.float64),
        velocity=line.velocity,
        bar_lines_s=score.tempo_map.seconds(bar_lines_beats(score)),
        duration_s=score.duration_s,
        phrases_s=np.stack([line.onset_s[first], line.end_s[last]], axis=1),
    )
