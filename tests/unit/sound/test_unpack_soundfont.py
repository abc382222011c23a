"""An SF3 made here, unpacked, against what it was made of."""

import io
import struct
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import soundfile
from tests.unit.sound.material import riff_list, write_click_soundfont

from reina.sound import font as sound_font
from reina.sound import provide_soundfont as provided
from reina.sound.font import MissingSoundfontError
from reina.sound.provide_soundfont import provide_soundfont
from reina.sound.unpack_soundfont import unpack_soundfont

RATE = 44100
LENGTH = 8820
NAMES = ("one", "marching", "left", "right")
DRUMS = 128


def wave(number: int, *, peak: float = 0.5) -> np.ndarray[Any, np.dtype[np.float64]]:
    return peak * np.sin(2 * np.pi * 200 * (number + 1) * np.arange(LENGTH) / RATE)


def packed_soundfont(*, peak: float = 0.5) -> bytes:
    """Three presets, a marching drumline the second, an instrument each; the last sample is one of two."""
    smpl, samples = b"", b""
    for number, name in enumerate(NAMES):
        file = io.BytesIO()
        soundfile.write(
            file, wave(number, peak=peak).astype(np.float32), RATE, format="OGG", subtype="VORBIS"
        )
        start, smpl = len(smpl), smpl + file.getvalue()
        link, kind = {"left": (3, 4), "right": (2, 2)}.get(name, (0, 1))
        samples += struct.pack(
            "<20sIIIIIBbHH",
            name.encode(),
            start,
            len(smpl),
            10,
            8000,
            RATE,
            60 + number,
            -3,
            link,
            kind | 0x10,
        )
    samples += struct.pack("<20sIIIIIBbHH", b"EOS", 0, 0, 0, 0, 0, 0, 0, 0, 0)
    presets = ((b"A", 0, 0), (b"Drumline", 56, DRUMS), (b"Kit", 0, DRUMS))
    hydra = [
        (
            b"phdr",
            b"".join(
                struct.pack("<20sHHHIII", name, program, bank, bag, 0, 0, 0)
                for bag, (name, program, bank) in enumerate((*presets, (b"EOP", 0, 0)))
            ),
        ),
        # The drumline's zone sets two more things, one of them by a modulator.
        (b"pbag", struct.pack("<8H", 0, 0, 1, 0, 3, 1, 4, 1)),
        (b"pmod", bytes(range(10)) + b"\0" * 10),
        (b"pgen", struct.pack("<10H", 41, 0, 9, 7, 41, 1, 41, 2, 0, 0)),
        (
            b"inst",
            b"".join(
                struct.pack("<20sH", name, bag) for bag, name in enumerate((b"a", b"march", b"kit", b"EOI"))
            ),
        ),
        (b"ibag", struct.pack("<8H", 0, 0, 1, 1, 2, 1, 3, 1)),
        (b"imod", b"m" * 10 + b"\0" * 10),
        (b"igen", struct.pack("<8H", 53, 0, 53, 1, 53, 2, 0, 0)),
        (b"shdr", samples),
    ]
    body = b"sfbk" + riff_list(b"INFO", [(b"ifil", struct.pack("<HH", 3, 1)), (b"ICOP", b"Somebody\0\0")])
    body += riff_list(b"sdta", [(b"smpl", smpl)]) + riff_list(b"pdta", hydra)
    return struct.pack("<4sI", b"RIFF", len(body)) + body


def chunks(font: bytes) -> dict[bytes, bytes]:
    """What is in a soundfont's lists, by name."""
    assert struct.unpack_from("<4sI4s", font) == (b"RIFF", len(font) - 8, b"sfbk")
    found: dict[bytes, bytes] = {}
    at = 12
    while at < len(font):
        name, size = struct.unpack_from("<4sI", font, at)
        if name == b"LIST":
            at += 12
            continue
        found[name] = font[at + 8 : at + 8 + size]
        at += 8 + size + size % 2
    return found


def test_presets_stay_but_for_marching_drumlines() -> None:
    there = chunks(unpack_soundfont(packed_soundfont()))
    presets = list(struct.iter_unpack("<20sHHHIII", there[b"phdr"]))
    assert [row[0].rstrip(b"\0") for row in presets] == [b"A", b"Kit", b"EOP"]
    assert [row[3] for row in presets] == [0, 1, 2]
    assert struct.unpack("<6H", there[b"pbag"]) == (0, 0, 1, 0, 2, 0)
    assert struct.unpack("<6H", there[b"pgen"]) == (41, 0, 41, 1, 0, 0)
    assert there[b"pmod"] == b"\0" * 10
    instruments = [row[0].rstrip(b"\0") for row in struct.iter_unpack("<20sH", there[b"inst"])]
    assert instruments == [b"a", b"kit", b"EOI"]
    assert struct.unpack("<6H", there[b"ibag"]) == (0, 0, 1, 1, 2, 1)
    assert there[b"imod"] == b"m" * 10 + b"\0" * 10
    assert struct.unpack("<6H", there[b"igen"]) == (53, 0, 53, 1, 0, 0)
    assert there[b"ifil"] == struct.pack("<HH", 2, 4)
    assert there[b"ICOP"] == b"Somebody\0\0"


def test_samples_are_what_was_packed_and_stand_where_their_headers_say() -> None:
    there = chunks(unpack_soundfont(packed_soundfont()))
    samples = list(struct.iter_unpack("<20sIIIIIBbHH", there[b"shdr"]))
    assert [row[0].rstrip(b"\0") for row in samples] == [b"one", b"left", b"right", b"EOS"]
    sound = np.frombuffer(there[b"smpl"], "<i2")
    for row, number in zip(samples, (0, 2, 3), strict=False):
        _, start, end, loop_start, loop_end, rate, key, correction, _, _ = row
        assert (end - start, loop_start - start, loop_end - start) == (LENGTH, 10, 8000)
        assert (rate, key, correction) == (RATE, 60 + number, -3)
        difference = sound[start:end] / 32767 - wave(number)
        assert np.sqrt((difference**2).mean()) < 0.01
        assert not sound[end : end + 46].any()
    # The two sides still name each other, by their new numbers.
    assert [row[8:] for row in samples[:3]] == [(0, 1), (2, 4), (1, 2)]


def test_what_overshoots_is_held_at_full_scale() -> None:
    sound = np.frombuffer(chunks(unpack_soundfont(packed_soundfont(peak=1.2)))[b"smpl"], "<i2")
    first = sound[:LENGTH].astype(int)
    assert first.max() == 32767
    # Nowhere does it leap from one end to the other.
    assert np.abs(np.diff(first)).max() < 3000


@pytest.mark.parametrize(
    "damaged",
    [
        b"",
        b"RIFF\0\0\0\0WAVE",
        packed_soundfont()[:-200],
        packed_soundfont().replace(b"smpl", b"xxxx", 1),
        packed_soundfont().replace(b"OggS", b"oggs"),
        packed_soundfont().replace(struct.pack("<HH", 53, 2), struct.pack("<HH", 53, 200)),
    ],
    ids=["empty", "a wave", "cut off", "without samples", "another codec", "a sample that is not there"],
)
def test_what_is_damaged_is_told(damaged: bytes) -> None:
    with pytest.raises(MissingSoundfontError, match="damaged"):
        unpack_soundfont(damaged)


@pytest.fixture
def data_dir(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty data folder, beside the one packed soundfont that there is."""
    packed = tmp_path / "packed.sf3"
    packed.write_bytes(packed_soundfont())

    def the_packed_one(_: str) -> Path:
        return packed

    monkeypatch.setattr(provided, "bundled", the_packed_one)
    monkeypatch.setattr(sound_font, "default_data_dir", lambda: tmp_path / "usual")
    (tmp_path / "data").mkdir()
    return tmp_path / "data"


def test_it_is_unpacked_once_where_there_is_none(data_dir: Path) -> None:
    told: list[str] = []
    found = provide_soundfont(data_dir, environment={}, tell=told.append)
    assert found == data_dir / "soundfont.sf2"
    assert found.read_bytes() == unpack_soundfont(packed_soundfont())
    assert len(told) == 1
    written_ns = found.stat().st_mtime_ns
    assert provide_soundfont(data_dir, environment={}, tell=told.append) == found
    assert (found.stat().st_mtime_ns, len(told)) == (written_ns, 1)


def test_one_that_is_named_or_there_is_taken(data_dir: Path) -> None:
    named = write_click_soundfont(data_dir.parent / "named.sf2")
    assert provide_soundfont(data_dir, environment={"REINA_SOUNDFONT": str(named)}) == named
    (data_dir.parent / "usual").mkdir()
    usual = write_click_soundfont(data_dir.parent / "usual" / "soundfont.sf2")
    assert provide_soundfont(data_dir, environment={}) == usual
    assert not (data_dir / "soundfont.sf2").exists()


def test_why_it_cannot_be_unpacked_is_told(data_dir: Path) -> None:
    (data_dir.parent / "packed.sf3").write_bytes(b"nothing of the kind")
    with pytest.raises(
        MissingSoundfontError, match=r"could not be unpacked.*it does not begin as a soundfont does"
    ):
        provide_soundfont(data_dir, environment={})
    assert list(data_dir.iterdir()) == []


def test_without_a_packed_one_the_message_says_where_was_looked(data_dir: Path) -> None:
    (data_dir.parent / "packed.sf3").unlink()
    with pytest.raises(MissingSoundfontError, match="REINA_SOUNDFONT"):
        provide_soundfont(data_dir, environment={})


def test_the_command_says_how_it_is_called() -> None:
    command = [sys.executable, "-m", "reina.sound.unpack_soundfont", "one"]
    answer = subprocess.run(command, capture_output=True, text=True, check=False)
    assert answer.returncode == 2
    assert "IN.sf3 OUT.sf2" in answer.stderr
