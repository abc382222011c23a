"""Recordings are probed in a process of their own: what becomes of one that hangs, crashes or complains."""

from __future__ import annotations

import asyncio
import errno
import json
import os
import subprocess
import sys
from typing import TYPE_CHECKING

import pytest
from tests.unit.sound.recording.recordings import mp4, recording, wav

from reina.errors import InputError
from reina.sound.recording.decoder import PROGRAM, SongDecoder
from reina.sound.recording.peaks import peaks_path

if TYPE_CHECKING:
    from pathlib import Path

    from reina.sound.recording.peaks import Peaks
    from reina.sound.recording.probe import AudioInfo


def fake(code: str) -> tuple[str, ...]:
    """A decoder program of a few lines."""
    return (sys.executable, "-S", "-c", code)


def probe(decoder: SongDecoder, song: Path) -> AudioInfo:
    return asyncio.run(decoder.probe(song))


def kept(folder: Path, data: bytes) -> Path:
    song = folder / "song"
    song.write_bytes(data)
    return song


def test_tells_and_keeps_the_peaks(tmp_path: Path) -> None:
    song = kept(tmp_path, recording("OGG", "VORBIS"))

    async def use() -> tuple[AudioInfo, Peaks | None]:
        decoder = SongDecoder()
        return await decoder.probe(song), await decoder.peaks(song)

    info, peaks = asyncio.run(use())
    assert (info.format, info.duration_s, info.warnings) == ("Ogg", 1.0, ())
    assert peaks is not None
    assert peaks.duration_s == 1.0
    assert sorted(path.name for path in tmp_path.iterdir()) == ["song", "song.peaks"]


def test_peaks_are_decoded_once_and_not_of_every_format(tmp_path: Path) -> None:
    song = kept(tmp_path, wav(seconds=0.1))
    first = asyncio.run(SongDecoder().peaks(song))
    song.write_bytes(b"another song")
    again = asyncio.run(SongDecoder(program=fake("raise SystemExit(3)")).peaks(song))
    assert first is not None
    assert again is not None
    assert again.lowest.tolist() == first.lowest.tolist()
    peaks_path(song).unlink()
    song.write_bytes(mp4())
    assert asyncio.run(SongDecoder().peaks(song)) is None


def test_warnings_come_along(tmp_path: Path) -> None:
    info = probe(SongDecoder(), kept(tmp_path, wav(rate=2000)))
    assert [warning.kind for warning in info.warnings] == ["song_not_played"]


@pytest.mark.parametrize("data", [b"", b"no song"])
def test_what_is_no_recording_is_refused(tmp_path: Path, data: bytes) -> None:
    with pytest.raises(InputError, match="is expected"):
        probe(SongDecoder(), kept(tmp_path, data))


def test_a_decoder_that_does_not_end_is_stopped(tmp_path: Path) -> None:
    decoder = SongDecoder(program=fake("import sys; sys.stdin.read()"), timeout_s=0.3)
    with pytest.raises(InputError, match="over 0 s and was stopped"):
        probe(decoder, kept(tmp_path, b"any"))


@pytest.mark.parametrize(
    "code",
    ["import os, signal; os.kill(os.getpid(), signal.SIGSEGV)", "raise MemoryError"],
    ids=["crash", "error"],
)
def test_a_decoder_that_crashes_is_told_in_the_sender_s_terms(
    tmp_path: Path, code: str, caplog: pytest.LogCaptureFixture
) -> None:
    with pytest.raises(InputError, match="makes the decoder fail") as refused:
        probe(SongDecoder(program=fake(code)), kept(tmp_path, b"any"))
    assert "Traceback" not in str(refused.value)
    assert "the decoder ended with status" in caplog.text


def test_a_full_disk_is_no_fault_of_the_song(tmp_path: Path) -> None:
    full = SongDecoder(program=fake("print('{\"errno\": 28}')"))
    with pytest.raises(OSError, match="No space left") as refused:
        probe(full, kept(tmp_path, b"RIFF"))
    assert refused.value.errno == errno.ENOSPC


def test_the_worker_tells_that_the_disk_is_full(tmp_path: Path) -> None:
    song = kept(tmp_path, wav())
    worker = [*PROGRAM, str(song), str(tmp_path / "peaks"), "/dev/full", "--forced"]
    with subprocess.Popen(worker, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as process:
        assert process.stdout is not None
        assert json.loads(process.stdout.read()) == {"errno": errno.ENOSPC}
    assert process.returncode == 0


def test_no_more_than_its_number_run_at_once(tmp_path: Path) -> None:
    running = tmp_path / "running"
    running.mkdir()
    code = (
        "import json, os, sys, time, pathlib\n"
        f"folder = pathlib.Path({str(running)!r})\n"
        "mine = folder / str(os.getpid()); mine.touch()\n"
        "time.sleep(0.05); count = len(list(folder.iterdir())); mine.unlink()\n"
        "told = {'format': 'WAV', 'media_type': '', 'suffix': '', 'channels': count, 'warnings': []}\n"
        "print(json.dumps(told))"
    )
    song = kept(tmp_path, b"any")

    async def use() -> list[int | None]:
        decoder = SongDecoder(program=fake(code), most_at_once=2)
        infos = await asyncio.gather(*(decoder.probe(song) for _ in range(8)))
        return [info.channels for info in infos]

    counts = asyncio.run(use())
    assert all(count is not None and count <= 2 for count in counts)


def test_the_worker_ends_with_the_one_who_asked(tmp_path: Path) -> None:
    code = "from reina.system.own_process import end_with_parent; end_with_parent()"
    process = subprocess.Popen([sys.executable, "-c", code], stdin=subprocess.PIPE)
    assert process.poll() is None
    assert process.stdin is not None
    process.stdin.close()
    assert process.wait(30) == 2


def test_libraries_complaints_go_nowhere(tmp_path: Path) -> None:
    mp3 = recording("MP3", "MPEG_LAYER_III", seconds=3.0)
    song = kept(tmp_path, mp3[:9000] + b"\xff\xfb" * 3000 + mp3[9000:])
    reading_end, writing_end = os.pipe()
    ended = subprocess.run(
        [*PROGRAM, str(song), str(peaks_path(song))], stdin=reading_end, capture_output=True, check=True
    )
    os.close(reading_end)
    os.close(writing_end)
    assert ended.stderr == b""
    assert ended.stdout.startswith(b'{"format": "MP3"')


def test_the_worker_starts_with_no_more_than_it_needs() -> None:
    """Each song of an upload waits for its start."""
    program = "import sys, reina.sound.recording.worker; print(*sys.modules)"
    told = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    layers = {name.split(".")[1] for name in told.stdout.split() if name.startswith("reina.")}
    assert layers == {"errors", "music", "sound", "system"}
