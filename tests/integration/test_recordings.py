"""Songs of every kind of fault, uploaded: what counts is what can be decoded."""

from __future__ import annotations

import threading
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

import httpx
import pytest
from tests.integration.scores import scale
from tests.integration.server import Owned, serve, upload
from tests.unit.sound.recording.recordings import mp4, recording, wav

from reina.sound.recording.probe import probe_recording

if TYPE_CHECKING:
    from collections.abc import Iterator

CASES = Path(__file__).parents[1] / "cases"

KNOWN: dict[str, tuple[str, float, float]] = {
    "aud-flacid3.flac": ("audio/flac", 8.0, 1.0),
    "aud-ogghour.ogg": ("audio/ogg", 8.0, 1.0),
    "aud-vbrlong.mp3": ("audio/mpeg", 12.069, 12.069),
    "aud-wavrate.wav": ("audio/wav", 12.0, 12.0),
}
"""Media type, length of the session (of the score where that is longer), and of the song."""


@pytest.fixture
def with_song(client: httpx.Client) -> Iterator[Any]:
    """Uploads a song with the cases' score; what it made is ended afterwards."""
    made: list[Owned] = []

    def make(name: str, data: bytes) -> Owned:
        made.append(upload(client, (CASES / "base.mid").read_bytes(), song=(name, data)))
        return made[-1]

    yield make
    for session in made:
        session.change("DELETE")


@pytest.mark.parametrize("name", KNOWN)
def test_the_decoded_length_wins_and_peaks_are_there(with_song: Any, client: httpx.Client, name: str) -> None:
    media_type, session_s, song_s = KNOWN[name]
    data = (CASES / name).read_bytes()
    session = with_song(name, data)
    assert session.body["duration_s"] == pytest.approx(session_s, abs=0.01)
    song = client.get(f"{session.path}/song")
    assert song.headers["content-type"] == media_type
    assert song.content == data
    peaks = client.get(f"{session.path}/song/peaks", params={"points": 4})
    assert peaks.status_code == 200
    assert peaks.json()["duration_s"] == pytest.approx(song_s, abs=0.01)
    assert max(peaks.json()["highest"]) > 0.05


def test_what_the_file_says_amiss_is_told_and_outlives_the_server(tmp_path: Path) -> None:
    broken_off = wav(seconds=30.0, rate=8000)[: 44 + 8000 * 4 * 12]
    with serve(tmp_path) as server, httpx.Client(base_url=server.address, timeout=60) as client:
        session = upload(client, scale(2), song=("song.wav", broken_off))
        told = [warning for warning in session.body["warnings"] if warning["place"] == "song"]
        assert [warning["kind"] for warning in told] == ["song_length"]
        assert "30.00 s" in told[0]["message"]
        assert "12.00 s" in told[0]["message"]
        assert session.body["duration_s"] == pytest.approx(12.0)
    with serve(tmp_path) as server, httpx.Client(base_url=server.address, timeout=60) as client:
        again = client.get(session.path).raise_for_status().json()
        assert [warning for warning in again["warnings"] if warning["place"] == "song"] == told
        assert client.get(f"{session.path}/song/peaks").status_code == 200


def test_of_what_is_not_decoded_there_are_no_peaks(with_song: Any, client: httpx.Client) -> None:
    session = with_song("song.m4a", mp4())
    answer = client.get(f"{session.path}/song/peaks")
    assert (answer.status_code, answer.content) == (204, b"")


@pytest.mark.parametrize(
    ("data", "told"),
    [
        (b"", "empty"),
        (b"no song at all", "no audio file"),
        (recording("AU", "PCM_16"), "no audio file"),
        (recording("AIFF", "PCM_16")[:30], "looks like AIFF"),
        (recording("FLAC", "PCM_16")[:60], "looks like FLAC"),
    ],
    ids=["empty", "text", "AU", "AIFF", "broken"],
)
def test_what_is_no_song_is_refused(client: httpx.Client, data: bytes, told: str) -> None:
    files = {"score": ("base.mid", (CASES / "base.mid").read_bytes()), "song": ("song", data)}
    answer = client.post("/api/v1/sessions", files=files)
    assert answer.status_code == 422
    assert answer.headers["content-type"] == "application/problem+json"
    assert told in answer.json()["detail"]
    assert "MP3" in answer.json()["detail"], "what would be right"


def test_the_server_answers_while_a_long_song_is_decoded(with_song: Any, client: httpx.Client) -> None:
    long = recording("OGG", "OPUS", seconds=60.0, rate=48_000)
    ended = threading.Event()

    def send() -> None:
        with_song("song.opus", long)
        ended.set()

    sending = threading.Thread(target=send)
    sending.start()
    answered = 0
    while not ended.is_set():
        assert client.get("/api/v1/sessions").status_code == 200
        answered += 1
        time.sleep(0.02)
    sending.join()
    assert answered >= 3


@pytest.mark.parametrize(
    ("name", "data", "media_type"),
    [
        ("song.aiff", recording("AIFF", "PCM_24"), "audio/aiff"),
        ("song.aifc", recording("AIFF", "FLOAT", rate=48_000), "audio/aiff"),
        ("song.wav", recording("WAV", "DOUBLE"), "audio/wav"),
    ],
)
def test_what_browsers_do_not_play_is_served_as_flac_and_kept_as_it_came(
    with_song: Any, client: httpx.Client, name: str, data: bytes, media_type: str
) -> None:
    session = with_song(name, data)
    assert session.body["song"]["media_type"] == "audio/flac"
    assert [each for each in session.body["warnings"] if each["place"] == "song"] == []
    served = client.get(f"{session.path}/song")
    assert served.headers["content-type"] == "audio/flac"
    info, _ = probe_recording(served.content)
    assert (info.format, info.duration_s) == ("FLAC", pytest.approx(1.0))
    original = client.get(f"{session.path}/song", params={"format": "original"})
    assert (original.headers["content-type"], original.content) == (media_type, data)
    assert client.get(f"{session.path}/song/peaks").json()["duration_s"] == pytest.approx(1.0)


def test_the_original_of_what_is_played_is_what_is_served(with_song: Any, client: httpx.Client) -> None:
    session = with_song("song.wav", wav())
    assert client.get(f"{session.path}/song", params={"format": "original"}).content == wav()
