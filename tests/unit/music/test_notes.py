from typing import Any

import numpy as np
import pytest

from reina.music import Note, Notes


def columns(**changed: Any) -> dict[str, Any]:
    return {
        "part": [0, 1],
        "channel": [0, 9],
        "onset_s": [1.0, 0.0],
        "duration_s": [0.5, 2.0],
        "onset_beats": [2.0, 0.0],
        "duration_beats": [1.0, 4.0],
        "sounding_pitch": [60, 36],
        "velocity": [0.5, 1.0],
        **changed,
    }


def test_notes_are_a_sorted_table():
    notes = Notes.from_columns(**columns())
    assert len(notes) == 2
    assert notes[0] == Note(1, 9, 0.0, 2.0, 0.0, 4.0, 36, 1.0, None)
    assert [note.end_s for note in notes] == notes.end_s.tolist() == [2.0, 1.5]
    dtypes = {name: str(column.dtype) for name, column in vars(notes).items()}
    assert dtypes["part"] == "int32"
    assert dtypes["channel"] == dtypes["sounding_pitch"] == "int16"
    assert set(dtypes.values()) == {"int32", "int16", "int8", "float64"}
    assert not any(column.flags.writeable for column in vars(notes).values())


def test_notes_have_the_program_that_the_file_says():
    notes = Notes.from_columns(**columns(program=[56, -1]))
    assert [note.program for note in notes] == [None, 56]


def test_a_table_does_not_change_with_the_arrays_it_was_made_from():
    onset = np.array([0.0, 1.0])
    notes = Notes.from_columns(**columns(onset_s=onset))
    onset[:] = 7.0
    assert notes.onset_s.tolist() == [0.0, 1.0]


@pytest.mark.parametrize(
    "wrong",
    [
        {"velocity": [0.5]},
        {"part": [[0, 1]]},
        {"onset_s": [0.0, np.nan]},
        {"duration_s": [0.0, 1.0]},
        {"duration_beats": [1.0, -1.0]},
    ],
)
def test_what_is_no_table_of_notes_is_refused(wrong: dict[str, Any]):
    with pytest.raises(ValueError, match="notes"):
        Notes.from_columns(**columns(**wrong))
