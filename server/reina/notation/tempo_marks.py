"""Which tempos are printed: those that hold, and a word where many small steps slow down or speed up."""

from dataclasses import dataclass

from reina.music.tempo import Tempo, TempoMap

HELD_BEATS = 4.0
"""A tempo that lasts so long is printed."""
TOLD_SHARE = 0.03
"""So is none that differs from the one printed last by less."""
STEP_BEATS = 2.5
MIN_STEPS = 3
"""So many tempos in a row, each as short as a step and all slower or all faster, are a ritardando."""


@dataclass(frozen=True)
class TempoMark:
    """What is printed above a place.

    Attributes:
        onset_beats: Where, quarter notes.
        beats_per_minute: Quarter notes a minute; None where a word stands.
        word: ``rit.`` or ``accel.``; "" where a number stands.
    """

    onset_beats: float
    beats_per_minute: float | None
    word: str = ""


def tempo_marks(tempo_map: TempoMap, until_beats: float) -> tuple[TempoMark, ...]:
    """Return what is printed of a tempo map up to a beat."""
    tempos = [tempo for tempo in tempo_map.tempos if tempo.onset_beats < until_beats]
    ends = [*(tempo.onset_beats for tempo in tempos[1:]), until_beats]
    marks = [TempoMark(0.0, tempos[0].beats_per_minute)]
    printed = tempos[0].beats_per_minute
    index = 1
    while index < len(tempos):
        last = _ramp(tempos, ends, index)
        if last - index + 1 >= MIN_STEPS:
            slower = tempos[last].beats_per_minute < tempos[index - 1].beats_per_minute
            marks.append(TempoMark(tempos[index].onset_beats, None, "rit." if slower else "accel."))
            printed = 0.0
            index = last + (0 if ends[last] - tempos[last].onset_beats >= HELD_BEATS else 1)
            if index == last:
                marks.append(TempoMark(tempos[last].onset_beats, tempos[last].beats_per_minute))
                printed = tempos[last].beats_per_minute
                index += 1
            continue
        tempo = tempos[index]
        held = ends[index] - tempo.onset_beats >= HELD_BEATS
        if held and abs(tempo.beats_per_minute - printed) > TOLD_SHARE * tempo.beats_per_minute:
            marks.append(TempoMark(tempo.onset_beats, tempo.beats_per_minute))
            printed = tempo.beats_per_minute
        index += 1
    return tuple(marks)


def _ramp(tempos: list[Tempo], ends: list[float], first: int) -> int:
    """Return the last tempo of a row of steps in one direction that begins with `first`."""
    direction = tempos[first].beats_per_minute - tempos[first - 1].beats_per_minute
    last = first
    while (
        last + 1 < len(tempos)
        and ends[last] - tempos[last].onset_beats <= STEP_BEATS
        and (tempos[last + 1].beats_per_minute - tempos[last].beats_per_minute) * direction > 0
    ):
        last += 1
    return last
