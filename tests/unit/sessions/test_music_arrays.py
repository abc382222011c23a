"""What keyframes are told of the music."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from tests.integration.scores import duet, relay, scale

from reina.instruments import INSTRUMENTS, PlayedPart, ValvesFingering
from reina.music import Score, read_score
from reina.sessions.music_arrays import music_form, time_map, triggers
from reina.show import EventResponse, NoteFilter
from reina.stage import MusicForm

SAINTS = Path(__file__).parents[3] / "examples" / "scores" / "when-the-saints.mid"


def played(
    data: bytes, part: int = 0, transposition: int = 0, joined_parts: tuple[int, ...] = ()
) -> tuple[Score, PlayedPart]:
    score = read_score(data)
    return score, INSTRUMENTS["trumpet"].play(score, part, transposition, joined_parts=joined_parts)


def onsets(score: Score, line: PlayedPart, where: NoteFilter) -> list[float]:
    times, _ = EventResponse(on="notes", where=where, amount=1.0, hold=1.0).events(
        triggers(score, [line]), time_map(score), "seconds"
    )
    return times.tolist()


def test_notes_of_every_part_are_events() -> None:
    score, line = played(duet(), part=1)
    found = triggers(score, [line])
    assert found.onset_s.tolist() == score.notes.onset_s.tolist()
    assert found.end_s == score.duration_s
    assert (
        onsets(score, line, NoteFilter(part=0)) == onsets(score, line, NoteFilter(part=1)) == [0, 0.5, 1, 1.5]
    )


def test_the_players_notes_are_at_the_pitch_that_sounds() -> None:
    score, line = played(duet(), part=1, transposition=-2)
    found = triggers(score, [line])
    assert found.pitch[found.part == 1].tolist() == [63, 65, 67, 68]
    assert found.pitch[found.part == 0].tolist() == [84, 86, 88, 89]


def test_open_notes_are_those_that_are_fingered_open() -> None:
    # B♭3, written C4, is open; the flute above is not fingered at all.
    score, line = played(duet(), part=1)
    fingered = [
        list(note.valves) if isinstance(note, ValvesFingering) else None for note in line.fingering.notes
    ]
    open_onsets = [line.line.onset_s[note] for note, valves in enumerate(fingered) if valves == []]
    assert onsets(score, line, NoteFilter(valves=())) == open_onsets
    assert onsets(score, line, NoteFilter(valves=(4,))) == [], "notes of other parts press no valve 4"
    for valves in ((1,), (1, 2), (1, 3)):
        expected = [line.line.onset_s[n] for n, pressed in enumerate(fingered) if pressed == list(valves)]
        assert onsets(score, line, NoteFilter(valves=valves)) == expected


def test_strokes_are_told_apart_by_piece_and_limb() -> None:
    score = read_score(SAINTS.read_bytes())
    (part,) = (part.index for part in score.parts if part.is_drums)
    line = INSTRUMENTS["drums"].play(score, part)
    strokes = line.strokes
    assert strokes is not None
    for where, kept in (
        (NoteFilter(pieces=("snare",)), {hit.onset_s for hit in strokes.hits if hit.piece == "snare"}),
        (NoteFilter(limbs=("left_foot",)), {hit.onset_s for hit in strokes.hits if hit.limb == "left_foot"}),
        (
            NoteFilter(pieces=("snare",), limbs=("right_hand",)),
            {hit.onset_s for hit in strokes.hits if (hit.piece, hit.limb) == ("snare", "right_hand")},
        ),
    ):
        assert len(kept) > 10
        assert onsets(score, line, where) == sorted(kept)
    assert onsets(score, line, NoteFilter(limbs=("left_hand",), pieces=("kick",))) == []
    assert onsets(score, line, NoteFilter(valves=())) == [], "a stroke is no open note"


def test_notes_of_joined_parts_are_the_players_and_stay_their_own_parts() -> None:
    alone, joined = played(relay(), part=0), played(relay(), part=0, joined_parts=(1,))
    assert onsets(*alone, NoteFilter(part=0)) == [0.0, 0.5]
    assert onsets(*joined, NoteFilter(part=0)) == [0.0, 0.5, 1.0, 1.5]
    for line in (alone, joined):
        assert onsets(*line, NoteFilter(part=1)) == [1.0, 1.5]
        assert onsets(*line, NoteFilter(part=2)) == [0.0, 1.0]
    assert onsets(*joined, NoteFilter(part=0, valves=(2,))) == [1.0], "A4, B4 on paper, is a joined note"
    assert music_form(*joined).onset_s.tolist() == [0.0, 0.5, 1.0, 1.5]


def test_the_form_is_the_line_in_phrases() -> None:
    score, line = played(scale(16))
    form = music_form(score, line)
    assert isinstance(form, MusicForm)
    assert form.onset_s.tolist() == line.line.onset_s.tolist()
    assert form.bar_lines_s.tolist() == [0.0, 2.0]
    np.testing.assert_allclose(form.phrases_s, [[0.0, 4.0]])
    assert len(music_form(score, INSTRUMENTS["trumpet"].play(score, 0, 48)).phrases_s) == 1
