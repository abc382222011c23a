"""`reina align`."""

import json
import re
from pathlib import Path

import pytest
import soundfile
from tests.unit.sound.alignment.renditions import RATE, SCORES, Rendition, record

from reina.cli import main

TAPS = SCORES / "taps.mid"
MOVED = Rendition("taps", (0.85, 0.1), transposition=-3, cents=35, lead_in_s=2, cut=(8.0, 6.0), seed=7)


@pytest.fixture(scope="module")
def recording(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("recording") / "taps.flac"
    with soundfile.SoundFile(path, "w", samplerate=RATE, channels=1, format="FLAC") as file:
        file.write(record(MOVED).samples)
    return path


def test_it_says_what_was_found(recording: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]):
    written = tmp_path / "map.json"
    assert main(["align", str(TAPS), str(recording), "-o", str(written)]) == 0
    text = capsys.readouterr().out
    assert text.startswith("Taps  0:32 of score")
    assert re.search(r"The music begins at (2\.0|1\.9)\d s", text)
    assert "3 semitones below the score" in text
    assert "cents above A = 440 Hz" in text
    assert "the recording leaves out" in text
    assert "left out" in text
    assert json.loads(written.read_text())["transposition"] == -3


def test_other_music(recording: Path, capsys: pytest.CaptureFixture[str]):
    assert main(["align", str(SCORES / "chromatic-scale.mid"), str(recording)]) == 0
    assert "is not the music of this score" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("score", "song", "says"),
    [
        (TAPS, Path("nowhere.wav"), "nowhere.wav: No such file"),
        (TAPS, TAPS, "taps.mid: the song is no audio file"),
        (Path(__file__), TAPS, "test_align.py: "),
    ],
)
def test_what_cannot_be_read(score: Path, song: Path, says: str, capsys: pytest.CaptureFixture[str]):
    assert main(["align", str(score), str(song)]) == 1
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err.startswith("reina align: ")
    assert says in printed.err
