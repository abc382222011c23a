"""Scores of drums, from a few strokes."""

from collections.abc import Sequence

from reina.instruments.drums.drum_kit import Drums
from reina.instruments.drums.drum_part import DrumPart, Handedness
from reina.music import MetreMap, Notes, Part, Score, TempoMap
from reina.music.controls import Control
from reina.music.texts import ScoreText

Stroke = tuple[float, int] | tuple[float, int, float] | tuple[float, int, float, float]
"""Onset in seconds, key; velocity 0.7 and length 0.1 s if they are not given."""


def drum_score(
    strokes: Sequence[Stroke],
    *,
    tempo: float = 120.0,
    name: str = "Drums",
    program: int | None = None,
    controls: Sequence[Control] = (),
    texts: Sequence[ScoreText] = (),
) -> Score:
    """A score of one part of drums."""
    rows = [(*stroke, *(0.7, 0.1)[len(stroke) - 2 :]) for stroke in strokes]
    onset, key, velocity, length = zip(*rows, strict=True)
    beats = tempo / 60.0
    notes = Notes.from_columns(
        part=[0] * len(rows),
        channel=[9] * len(rows),
        onset_s=onset,
        duration_s=length,
        onset_beats=[beats * at for at in onset],
        duration_beats=[beats * span for span in length],
        sounding_pitch=key,
        velocity=velocity,
    )
    part = Part(0, name, program, is_drums=True, channel=9)
    tempos = TempoMap([0.0], [60.0 / tempo])
    end_s = max(at + span for at, span in zip(onset, length, strict=True))
    return Score("Test", (part,), notes, tempos, MetreMap(), tuple(controls), (), end_s, texts=tuple(texts))


def played(score: Score, handedness: Handedness = "right") -> DrumPart:
    """The part of drums as it is played."""
    return Drums().play_with(score, 0, handedness=handedness)


def hands(part: DrumPart) -> str:
    """R, L and lower case of the feet, of each note; a dash where nobody plays it."""
    signs = {"right_hand": "R", "left_hand": "L", "right_foot": "r", "left_foot": "l"}
    hits = iter(part.fingering.hits)
    return "".join(signs[next(hits).limb] if there else "-" for there in part.fingering.playable.tolist())
