"""The notes of a recording alone, over HTTP: looked for, taken as MIDI, played with the recording."""

from __future__ import annotations

import io
import time
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
import soundfile
from tests.integration.server import Owned
from tests.unit.sound.alignment.renditions import RATE, Rendition, record
from tests.unit.sound.transcription.solos import solo

from reina.music import read_score

if TYPE_CHECKING:
    import httpx
    from numpy.typing import NDArray

PATIENCE_S = 120.0
ADDRESS = "/api/v1/transcriptions"


def wav(samples: NDArray[np.float32]) -> bytes:
    data = io.BytesIO()
    soundfile.write(data, 0.9 * samples / np.abs(samples).max(), RATE, format="WAV")
    return data.getvalue()


def begin(client: httpx.Client, song: bytes, **query: str) -> dict[str, Any]:
    answer = client.post(ADDRESS, files={"song": ("a solo.wav", song)}, params=query)
    assert answer.status_code == 202, answer.text
    state: dict[str, Any] = answer.json()
    assert answer.headers["location"] == state["links"]["self"]
    return state


def ended(client: httpx.Client, state: dict[str, Any]) -> dict[str, Any]:
    until = time.monotonic() + PATIENCE_S
    while state["status"] == "searching" and time.monotonic() < until:
        state = client.get(state["links"]["self"]).json()
    return state


def test_a_solo_is_played_with_the_notes_that_are_heard_in_it(client: httpx.Client) -> None:
    recording = solo("taps", 0, lead_in_s=1.0)
    song = wav(recording.samples)
    state = ended(client, begin(client, song, instrument="cornet"))
    assert (state["status"], state["title"], state["fault"]) == ("found", "a solo", None)
    assert abs(state["notes"] - len(recording.pitch)) <= 1
    file = client.get(state["links"]["midi"])
    assert file.headers["content-type"] == "audio/midi"
    assert "a%20solo.mid" in file.headers["content-disposition"]
    score = read_score(file.content, filename="solo.mid")
    assert abs(float(score.notes.onset_s[0]) - float(recording.onset_s[0])) < 0.03

    answer = client.post(
        "/api/v1/sessions",
        files={"score": ("solo.mid", file.content), "song": ("solo.wav", song)},
        data={"in_time": "true"},
    )
    assert answer.status_code == 201, answer.text
    session = Owned(client, answer.json())
    assert answer.json()["alignment"] == {
        "status": "found",
        "progress": 1.0,
        "confidence": 1.0,
        "detail": None,
    }
    # Nothing is moved: every note is performed where it was heard.
    notes = client.get(f"{session.path}/score").json()["notes"]
    np.testing.assert_allclose([note["onset_s"] for note in notes], score.notes.onset_s, atol=1e-3)
    session.change("DELETE")

    assert client.delete(state["links"]["self"]).status_code == 204
    assert client.get(state["links"]["self"]).status_code == 404


def test_of_a_mix_it_says_that_it_cannot(client: httpx.Client) -> None:
    song = wav(record(Rendition("ode-to-joy")).samples[: 12 * RATE])
    state = ended(client, begin(client, song))
    assert (state["status"], state["fault"]) == ("failed", "mix")
    assert "those of a mix cannot" in state["detail"]
    refusal = client.get(state["links"]["midi"])
    assert (refusal.status_code, refusal.json()["type"]) == (409, "urn:reina:problem:no-notes")


def test_what_is_no_recording_is_told(client: httpx.Client) -> None:
    state = ended(client, begin(client, b"no sound at all"))
    assert (state["status"], state["fault"]) == ("failed", "other")
    assert "expected" in state["detail"]


def test_a_search_can_be_given_up(client: httpx.Client) -> None:
    state = begin(client, wav(solo("taps", 0).samples))
    assert client.delete(state["links"]["self"]).status_code == 204
    assert client.get(state["links"]["midi"]).status_code == 404


@pytest.mark.parametrize(
    ("form", "query", "kind"),
    [
        ({}, {}, "not-a-form"),
        ({"files": {"score": ("a.mid", b"x")}}, {}, "unknown-part"),
        ({"files": {"song": ("a.wav", b"x")}, "data": {"title": "x"}}, {}, "unknown-part"),
        ({"files": {"song": ("a.wav", b"x")}}, {"instrument": "kazoo"}, "unknown-instrument"),
    ],
)
def test_refusals(client: httpx.Client, form: dict[str, Any], query: dict[str, str], kind: str) -> None:
    answer = client.post(ADDRESS, params=query, **form)
    assert 400 <= answer.status_code < 500
    assert answer.json()["type"] == f"urn:reina:problem:{kind}"
