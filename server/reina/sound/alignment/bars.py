"""The bars of a score where they are heard in a recording, to be told and put right by."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from reina.protocol.alignment import AlignedBar, AlignedBeat

if TYPE_CHECKING:
    from reina.music import Score
    from reina.music.metre import TimeSignature
    from reina.sound.alignment.alignment import Alignment

SAME_BEAT = 1e-6


def aligned_bars(score: Score, alignment: Alignment | None) -> list[AlignedBar]:
    """Say of each bar where it and its beats are heard, and how surely.

    Args:
        score: As it is written, in its own seconds.
        alignment: Where it is heard; where it is written, and nothing is sure, when None.
    """
    lines = score.metre_map.bar_lines(score.duration_beats + SAME_BEAT)
    if not len(lines):
        return []
    ends = np.append(lines[1:], max(score.duration_beats, lines[-1]))
    signatures = score.metre_map.signatures
    begin = np.array([signature.onset_beats for signature in signatures])
    holds: list[int] = (np.searchsorted(begin, lines + SAME_BEAT, side="right") - 1).tolist()
    beats = [
        np.append(line, np.arange(line + step, end - SAME_BEAT, step))
        for line, end, step in (
            (line, end, _beat(signatures[index]))
            for line, end, index in zip(lines.tolist(), ends.tolist(), holds, strict=True)
        )
    ]
    first_s = score.tempo_map.seconds(lines)
    heard = np.ones(len(lines), bool) if alignment is None else alignment.is_heard(first_s)
    sure = np.zeros(len(lines)) if alignment is None else alignment.confidence_at(first_s)
    counts = [len(each) for each in beats]
    score_s = score.tempo_map.seconds(np.concatenate(beats))
    song_s = score_s if alignment is None else alignment.song_times(score_s)
    places = [
        AlignedBeat(score_s=place, song_s=song)
        for place, song in zip(np.round(score_s, 4).tolist(), np.round(song_s, 4).tolist(), strict=True)
    ]
    begins = np.cumsum([0, *counts]).tolist()
    positions = score.metre_map.positions(lines)
    return [
        AlignedBar(
            number=position.bar,
            confidence=round(float(sure[index]), 3),
            is_heard=bool(heard[index]),
            beats=places[begins[index] : begins[index + 1]],
        )
        for index, position in enumerate(positions)
    ]


def _beat(signature: TimeSignature) -> float:
    """A beat as it is conducted, quarter notes: a dotted quarter in 6/8."""
    is_compound = signature.denominator >= 8 and signature.numerator > 3 and signature.numerator % 3 == 0
    return (3 if is_compound else 1) * 4.0 / signature.denominator
