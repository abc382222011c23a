"""The form of a piece as plain numbers, and the passages into which a show divides it."""

from dataclasses import dataclass, field

import numpy as np

from reina.curves.arrays import FloatArray

SHORTEST_S = 3.0
"""No passage is shorter: cuts that follow faster are felt as haste."""
LONGEST_S = 11.0
"""A longer passage is divided at bar lines, in slow music."""
LONGEST_FAST_S = 5.0
"""The same in fast music, which wants quicker cuts."""
SLOW, FAST = 1.5, 5.0
"""Notes a second of slow and of fast music."""


def _no_phrases() -> FloatArray:
    return np.zeros((0, 2))


@dataclass(frozen=True, eq=False)
class MusicForm:
    """What a default show is written from: the line that is played, and its form; all in seconds.

    Attributes:
        onset_s: ``(N,)``, increasing.
        end_s: ``(N,)``.
        pitch: ``(N,)`` MIDI numbers.
        velocity: ``(N,)`` 0..1.
        bar_lines_s: ``(B,)``, increasing.
        phrases_s: ``(P, 2)`` beginning and end of each phrase, increasing; may be empty.
        duration_s: Where the piece ends.
    """

    onset_s: FloatArray
    end_s: FloatArray
    pitch: FloatArray
    velocity: FloatArray
    bar_lines_s: FloatArray
    duration_s: float
    phrases_s: FloatArray = field(default_factory=_no_phrases)

    def __post_init__(self) -> None:
        columns = (self.onset_s, self.end_s, self.pitch, self.velocity)
        if len({column.shape for column in columns}) != 1:
            raise ValueError("a form's notes are columns of one length")
        if np.any(np.diff(self.bar_lines_s) <= 0.0):
            raise ValueError("bar lines increase")


@dataclass(frozen=True)
class Passage:
    """A stretch from bar line to bar line, and how it sounds.

    Attributes:
        start_bar: Bars gone by at its beginning.
        end_bar: Bars gone by at its end.
        notes_per_second: How fast it goes.
        loudness: Mean velocity; the piece's where it is silent.
        height: Mean pitch; the piece's where it is silent.
        sounding: Share of its time in which a note sounds, 0..1.
        phrase: How many phrases have begun by its beginning.
    """

    start_bar: int
    end_bar: int
    notes_per_second: float
    loudness: float
    height: float
    sounding: float
    phrase: int


def passages(form: MusicForm) -> tuple[Passage, ...]:
    """Divide a piece at the bar lines nearest to its phrases, so that no passage is too short or too long."""
    lines = form.bar_lines_s[form.bar_lines_s < max(form.duration_s, 1e-9)]
    if lines.size == 0:
        lines = np.zeros(1)
    ends = np.append(lines, max(form.duration_s, float(lines[-1]) + 1e-3))
    nearest: list[int] = np.abs(form.phrases_s[:, :1] - lines[None, :]).argmin(axis=1).tolist()
    cuts = [0]
    for bar in sorted(set(nearest)):
        if ends[bar] - ends[cuts[-1]] >= SHORTEST_S and ends[-1] - ends[bar] >= SHORTEST_S:
            cuts.append(bar)
    divided: list[int] = []
    for first, last in zip(cuts, [*cuts[1:], lines.size], strict=True):
        divided += _divided(form, ends, first, last)
    return tuple(
        _passage(form, ends, first, last)
        for first, last in zip(divided, [*divided[1:], lines.size], strict=True)
    )


def _divided(form: MusicForm, ends: FloatArray, first: int, last: int) -> list[int]:
    """The bars at which the parts of a passage begin: as many as its pace asks for, none too short."""
    start_s, end_s = float(ends[first]), float(ends[last])
    notes = int(((form.onset_s >= start_s) & (form.onset_s < end_s)).sum())
    pace = notes / (end_s - start_s)
    longest_s = float(np.interp(pace, [SLOW, FAST], [LONGEST_S, LONGEST_FAST_S]))
    for count in range(int(np.ceil((end_s - start_s) / longest_s)), 1, -1):
        parts = np.rint(np.linspace(first, last, count + 1)).astype(int)
        if float(np.diff(ends[parts]).min()) >= SHORTEST_S:
            return parts[:-1].tolist()
    return [first]


def _passage(form: MusicForm, ends: FloatArray, first: int, last: int) -> Passage:
    start_s, end_s = float(ends[first]), float(ends[last])
    inside = (form.onset_s >= start_s - 1e-6) & (form.onset_s < end_s - 1e-6)
    notes = inside if inside.any() else np.ones(form.onset_s.size, dtype=np.bool_)
    overlap = np.minimum(form.end_s, end_s) - np.maximum(form.onset_s, start_s)
    begun = form.phrases_s[:, 0] < start_s + 0.5 * (float(ends[first + 1]) - start_s)
    return Passage(
        start_bar=first,
        end_bar=last,
        notes_per_second=float(inside.sum()) / (end_s - start_s),
        loudness=float(form.velocity[notes].mean()) if notes.any() else 0.5,
        height=float(form.pitch[notes].mean()) if notes.any() else 60.0,
        sounding=min(1.0, float(np.maximum(overlap, 0.0).sum()) / (end_s - start_s)),
        phrase=int(begun.sum()),
    )
