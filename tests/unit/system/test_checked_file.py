"""What a disk refuses is raised, though the library that writes says nothing of it."""

from __future__ import annotations

import errno
from pathlib import Path

import numpy as np
import pytest
import soundfile

from reina.sound.encode import write_flac
from reina.system.checked_file import checked_file

FULL = Path("/dev/full")
"""Refuses every byte for lack of room."""


def test_what_is_written_is_there(tmp_path: Path) -> None:
    samples = np.arange(-20_000, 20_000, dtype=np.int16).reshape(-1, 2)
    write_flac(tmp_path / "song.flac", [samples[:5000], samples[5000:]])
    read, rate = soundfile.read(tmp_path / "song.flac", dtype="int16")
    assert rate == 48_000
    assert np.array_equal(read, samples)


def test_a_full_disk_is_told_where_the_library_is_silent() -> None:
    with pytest.raises(OSError, match="No space left") as refused, checked_file(FULL) as file:
        # A library's callback hears of no error, only of no bytes.
        assert file.write(b"x" * 100_000) == 0
    assert refused.value.errno == errno.ENOSPC


def test_a_full_disk_is_told_in_the_place_of_what_the_library_says() -> None:
    with pytest.raises(OSError, match="No space left"):
        write_flac(FULL, [np.ones((48_000, 2), dtype=np.int16)] * 3)


def test_another_error_is_raised_as_it_is(tmp_path: Path) -> None:
    with pytest.raises(ZeroDivisionError), checked_file(tmp_path / "file"):
        raise ZeroDivisionError
