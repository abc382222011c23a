"""Scores made of a few notes."""

from collections.abc import Sequence

from reina.music import MetreMap, Notes, Part, Score, TempoMap

NoteSpec = tuple[float, float, int]
"""Onset and end in seconds, sounding pitch."""


def score_of(
    *parts: Sequence[NoteSpec],
    names: Sequence[str] = (),
    programs: Sequence[int | None] = (),
    drums: int | None = None,
) -> Score:
    """A score at 120 beats a minute; part i has the name and the program i, if given."""
    notes = [(part, onset, end, pitch) for part, specs in enumerate(parts) for onset, end, pitch in specs]
    part, onset, end, pitch = zip(*notes, strict=True)
    table = Notes.from_columns(
        part=part,
        channel=part,
        onset_s=onset,
        duration_s=[e - o for o, e in zip(onset, end, strict=True)],
        onset_beats=[2 * o for o in onset],
        duration_beats=[2 * (e - o) for o, e in zip(onset, end, strict=True)],
        sounding_pitch=pitch,
        velocity=[0.7] * len(notes),
    )
    known = tuple(
        Part(
            index,
            names[index] if index < len(names) else f"Track {index + 1}",
            programs[index] if index < len(programs) else None,
            is_drums=index == drums,
            named=index < len(names),
        )
        for index in range(len(parts))
    )
    return Score("Test", known, table, TempoMap(), MetreMap(), (), (), max(end))


def melody(
    pitches: Sequence[int], interval_s: float = 0.5, hold: float = 0.95, start: float = 0.0
) -> list[NoteSpec]:
    """Notes one after the other."""
    return [
        (start + index * interval_s, start + (index + hold) * interval_s, pitch)
        for index, pitch in enumerate(pitches)
    ]


def written(*pitches: int) -> list[int]:
    """Sounding pitches of what is written for a B♭ trumpet."""
    return [pitch - 2 for pitch in pitches]
