"""Whether more than one line sounds: then a single line is no score of it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from reina.sound.transcription.posteriors import FRAME_RATE, LOWEST_PITCH, PITCHES

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from reina.sound.transcription.line import FoundLine
    from reina.sound.transcription.posteriors import Posteriors

SOUNDS = 0.3
"""From which likelihood on a pitch counts as sounding beside the line."""
MOST_SHARE = 0.06
"""Single lines, rendered in all kinds of rooms, by winds, brass, strings and voice, have a second voice by
this measure for 3 % of the time at most; duets, piano, accompanied and drummed lines for 9 % and more."""
PARTIALS = (-1, 0, 1, 12, 19, 24, 28, 31, 34, 36, 38, 40)
BELOW = (-12, -19, -24, -36, -40)
"""Semitones from a note to what is heard with it: overtones, and tones whose overtones it and its own are."""
ATTACK_FRAMES, RELEASE_FRAMES = 5, 2
RINGING_FRAMES = round(FRAME_RATE)
"""What was played within the last second may still ring."""
BEFORE, AFTER = 8, 1
"""How many notes before and after one are looked at for that."""


def second_voice_share(heard: Posteriors, line: FoundLine) -> float:
    """The share of a line's time in which something sounds that is not it, its overtones or its echo."""
    beside = sounding = 0
    for note in range(len(line.pitch)):
        begin = int(line.begin[note]) + ATTACK_FRAMES
        end = int(line.end[note]) - RELEASE_FRAMES
        if begin < end:
            foreign = heard.note[begin:end, _foreign(line, note, begin, end)].max(axis=1, initial=0.0)
            beside += int(np.count_nonzero(foreign > SOUNDS))
            sounding += end - begin
    return beside / max(1, sounding)


def _foreign(line: FoundLine, note: int, begin: int, end: int) -> NDArray[np.bool_]:
    """(88,): the pitches that a note and its neighbours do not explain."""
    foreign = np.ones(PITCHES, dtype=bool)
    own = int(line.pitch[note]) - LOWEST_PITCH
    explained = [own + step for step in (*PARTIALS, *BELOW)]
    for other in range(max(0, note - BEFORE), min(len(line.pitch), note + AFTER + 1)):
        if line.begin[other] < end + ATTACK_FRAMES and line.end[other] > begin - RINGING_FRAMES:
            key = int(line.pitch[other]) - LOWEST_PITCH
            explained += (key - 1, key, key + 1)
    foreign[[key for key in explained if 0 <= key < PITCHES]] = False
    return foreign
