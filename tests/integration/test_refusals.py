"""What cannot be used is refused with its reason; nothing of it stays, and the server goes on."""

from __future__ import annotations

import gzip
import http.client
import json
from typing import TYPE_CHECKING, Any

import httpx
import pytest
from tests.integration.scores import scale, show, song
from tests.integration.server import serve
from tests.kept import kept

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from tests.integration.server import Owned


@pytest.fixture(scope="module")
def data_dir(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("refusals")


@pytest.fixture(scope="module")
def own(data_dir: Path) -> Iterator[httpx.Client]:
    """A server whose folder can be looked into."""
    with serve(data_dir) as running, httpx.Client(base_url=running.address, timeout=60.0) as client:
        yield client


def problem(answer: httpx.Response, status: int, kind: str) -> dict[str, Any]:
    """Check that an answer is a problem of a kind, and give it back."""
    assert answer.status_code == status, answer.text
    assert answer.headers["content-type"] == "application/problem+json"
    body: dict[str, Any] = answer.json()
    assert body["status"] == status
    assert body["type"] == f"urn:reina:problem:{kind}"
    assert body["title"]
    assert len(body["detail"]) > 10
    return body


MIDI = scale(8)
NO_NOTES = scale(0)
BROKEN: dict[str, tuple[dict[str, Any], int, str, str]] = {
    "not MIDI": ({"score": ("a.mid", b"Hello, world, this is text.")}, 422, "score-unreadable", "MThd"),
    "empty": ({"score": ("a.mid", b"")}, 422, "score-unreadable", "empty"),
    "truncated": ({"score": ("a.mid", MIDI[:16])}, 422, "score-unreadable", "byte"),
    "no notes": ({"score": ("a.mid", NO_NOTES)}, 422, "score-unreadable", "no note"),
    "JSON of the wrong shape": ({"score": ("a.json", b'{"hello": 1}')}, 422, "score-unreadable", ""),
    "broken JSON": ({"score": ("a.json", b'{"notes": [')}, 422, "score-unreadable", "JSON"),
    "no tracks": ({"score": ("a.json", b'{"tracks": null}')}, 422, "score-unreadable", "tracks: is null"),
    "broken MusicXML": ({"score": ("a.xml", b"<score-partwise>")}, 422, "score-unreadable", "breaks off"),
    "MuseScore": ({"score": ("a.mscx", b"<museScore>")}, 422, "score-unreadable", "export it as MusicXML"),
    "a recording as the score": ({"score": ("a.mp3", b"ID3\4")}, 422, "score-unreadable", "MP3 recording"),
    "a damaged gzip'd score": (
        {"score": ("a.mid.gz", gzip.compress(MIDI)[:-9])},
        422,
        "score-unreadable",
        "breaks off",
    ),
    "a bomb": (
        {"score": ("a.gz", gzip.compress(bytes(40_000_000)))},
        413,
        "score-too-large",
        "unpacks to more",
    ),
    "audio that is none": (
        {"score": ("a.mid", MIDI), "song": ("a.mp3", b"no audio at all")},
        422,
        "input-unusable",
        "WAV, AIFF, MP3",
    ),
    "empty audio": ({"score": ("a.mid", MIDI), "song": ("a.mp3", b"")}, 422, "input-unusable", "empty"),
    "show that is no JSON": (
        {"score": ("a.mid", MIDI), "show": ("s.json", b"{")},
        422,
        "show-unusable",
        "JSON",
    ),
    "show of another version": (
        {"score": ("a.mid", MIDI), "show": ("s.json", b'{"version": 9, "tracks": []}')},
        422,
        "show-unusable",
        "version",
    ),
    "no score": ({"song": ("a.wav", song())}, 422, "no-score", "score"),
    "a part nobody knows": (
        {"score": ("a.mid", MIDI), "lyrics": ("a.txt", b"la")},
        422,
        "unknown-part",
        "lyrics",
    ),
    "too large a score": ({"score": ("a.mid", MIDI + bytes(20_000_000))}, 413, "score-too-large", "20 MB"),
    "too large a show": (
        {"score": ("a.mid", MIDI), "show": ("s.json", bytes(20_000_001))},
        413,
        "show-too-large",
        "20 MB",
    ),
}


@pytest.mark.parametrize("case", BROKEN)
def test_broken_files_are_refused(own: httpx.Client, data_dir: Path, case: str) -> None:
    files, status, kind, told = BROKEN[case]
    body = problem(own.post("/api/v1/sessions", files=files), status, kind)
    assert told in body["detail"]
    assert kept(data_dir) == []
    assert own.get("/api/v1/health").json()["ready"] is True


def test_too_large_a_song_is_refused_while_it_comes(own: httpx.Client, data_dir: Path) -> None:
    def chunks() -> Iterator[bytes]:
        head = b'--x\r\nContent-Disposition: form-data; name="song"; filename="s.wav"\r\n\r\n'
        yield head + song()
        for _ in range(201):
            yield bytes(1_000_000)
        yield b"\r\n--x--\r\n"

    answer = own.post(
        "/api/v1/sessions", content=chunks(), headers={"Content-Type": "multipart/form-data; boundary=x"}
    )
    assert "200 MB" in problem(answer, 413, "song-too-large")["detail"]
    assert kept(data_dir) == []


def test_an_upload_that_says_it_is_huge_is_refused_before_it_comes(own: httpx.Client) -> None:
    connection = http.client.HTTPConnection(own.base_url.host, own.base_url.port or 80, timeout=10)
    connection.putrequest("POST", "/api/v1/sessions")
    connection.putheader("Content-Type", "multipart/form-data; boundary=x")
    connection.putheader("Content-Length", "9000000000")
    connection.endheaders()
    answer = connection.getresponse()
    assert answer.status == 413
    assert json.loads(answer.read())["type"] == "urn:reina:problem:upload-too-large"
    connection.close()


@pytest.mark.parametrize(
    ("content_type", "content", "status", "kind"),
    [
        ("application/json", b"{}", 415, "not-a-form"),
        ("multipart/form-data", b"", 415, "not-a-form"),
        ("multipart/form-data; boundary=x", b"garbage", 400, "form-malformed"),
        (
            "multipart/form-data; boundary=x",
            b'--x\r\nContent-Disposition: form-data; name="score"\r\n\r\nMThd',
            400,
            "form-malformed",
        ),
    ],
)
def test_what_is_no_form_is_refused(
    own: httpx.Client, data_dir: Path, content_type: str, content: bytes, status: int, kind: str
) -> None:
    answer = own.post("/api/v1/sessions", content=content, headers={"Content-Type": content_type})
    problem(answer, status, kind)
    assert kept(data_dir) == []


def test_a_field_that_does_not_fit_is_named(own: httpx.Client, data_dir: Path) -> None:
    answer = own.post("/api/v1/sessions", files={"score": ("a.mid", MIDI)}, data={"transposition": "up"})
    body = problem(answer, 422, "request-invalid")
    assert body["errors"][0]["location"] == "transposition"
    answer = own.post("/api/v1/sessions", files={"score": ("a.mid", MIDI)}, data={"part": "7"})
    problem(answer, 422, "not-in-score")
    assert kept(data_dir) == []


@pytest.mark.parametrize(
    "path", ["", "/score", "/song", "/show", "/transport", "/frames", "/manifest", "/show/tracks/a/keyframes"]
)
@pytest.mark.parametrize("session", ["nobody", "x" * 22, "..%2Fsessions", "%00"])
def test_an_unknown_session_is_not_found(own: httpx.Client, session: str, path: str) -> None:
    answer = own.get(f"/api/v1/sessions/{session}{path}")
    assert answer.status_code == 404
    assert answer.headers["content-type"] == "application/problem+json"


WRITES: list[tuple[str, str, object]] = [
    ("POST", "/transport", {"action": "play"}),
    ("PATCH", "", {"title": "Mine now"}),
    ("PUT", "/show", {"version": 1, "tracks": []}),
    ("POST", "/show/tracks/lights/key/intensity/keyframes", {"time": 0, "value": 1}),
    ("PATCH", "/show/tracks/lights/key/intensity/keyframes/k1", {"value": 1}),
    ("DELETE", "/show/tracks/lights/key/intensity/keyframes/k1", None),
    ("DELETE", "", None),
]


@pytest.mark.parametrize(("method", "below", "body"), WRITES)
def test_changing_needs_the_sessions_token(
    client: httpx.Client, owned: Owned, method: str, below: str, body: object
) -> None:
    path = f"{owned.path}{below}"
    answer = client.request(method, path, json=body)
    problem(answer, 401, "no-token")
    assert answer.headers["www-authenticate"] == "Bearer"
    problem(
        client.request(method, path, json=body, headers={"Authorization": "Bearer no"}), 403, "wrong-token"
    )
    assert client.get(owned.path).json()["title"] == owned.body["title"]


def test_transport_commands_that_do_not_fit_are_refused(owned: Owned) -> None:
    for command, told in (
        ({"action": "rate", "rate": 9}, "4"),
        ({"action": "rate", "rate": 0}, "0.1"),
        ({"action": "seek", "song_time_s": -1}, "song_time_s"),
        ({"action": "loop", "start_s": 2.0, "end_s": 1.0}, "begins before it ends"),
        ({"action": "loop", "start_s": 1.0, "end_s": 2.0, "count_in_s": -1}, "count_in_s"),
        ({"action": "play", "count_in_s": 1000}, "count_in_s"),
        ({"action": "loop", "start_s": 2.0, "end_s": None}, "null both"),
        ({"action": "rewind"}, "action"),
        ({"action": "seek", "song_time_s": "soon"}, "song_time_s"),
    ):
        answer = owned.change("POST", "/transport", json=command)
        assert answer.status_code == 422, command
        assert told in answer.json()["detail"]
    broken = owned.change("POST", "/transport", content=b'{"action": "seek", "song_time_s": NaN}')
    assert broken.status_code == 422


def test_addresses_and_methods_that_are_not_there(client: httpx.Client, owned: Owned) -> None:
    problem(client.get("/api/v1/nothing"), 404, "not-found")
    problem(client.put("/api/v1/nothing"), 404, "not-found")
    problem(client.get("/nothing.html"), 404, "unknown-address")
    problem(client.delete("/api/v1/health"), 405, "method-not-allowed")
    problem(client.get(f"{owned.path}/score", params={"part": 5}), 404, "unknown-part")
    problem(client.get(f"{owned.path}/score", params={"part": "x"}), 422, "request-invalid")
    problem(client.get("/api/v1/rigs/nobody"), 404, "unknown-rig")
    problem(client.get("/api/v1/rigs/trumpet/..%2F..%2Fpyproject.toml"), 404, "unknown-file")
    problem(client.get("/api/v1/examples/scores/..%2F..%2FREADME.md"), 404, "not-found")
    problem(client.get("/api/v1/examples/scores/README.md"), 404, "unknown-example")


def test_the_server_answers_only_to_names_it_was_told(client: httpx.Client) -> None:
    problem(client.get("/api/v1/health", headers={"Host": "evil.example"}), 421, "unknown-host")
    problem(client.get("/", headers={"Host": "evil.example:8000"}), 421, "unknown-host")
    assert client.get("/api/v1/health", headers={"Host": "localhost:8000"}).status_code == 200


def test_writes_from_other_origins_are_refused(client: httpx.Client) -> None:
    for origin in ("http://evil.example", "null", "http://localhost:1", "nonsense"):
        answer = client.post("/api/v1/sessions", files={"score": ("a.mid", MIDI)}, headers={"Origin": origin})
        problem(answer, 403, "foreign-origin")
    own = f"http://{client.base_url.host}:{client.base_url.port}"
    answer = client.post("/api/v1/sessions", files={"score": ("a.mid", b"?")}, headers={"Origin": own})
    problem(answer, 422, "score-unreadable")


def test_names_and_origins_can_be_allowed(tmp_path: Path) -> None:
    allowed = ("--allow-host", "Studio.example", "--allow-origin", "http://localhost:5173")
    with serve(tmp_path, *allowed) as running, httpx.Client(base_url=running.address, timeout=30) as client:
        assert client.get("/api/v1/health", headers={"Host": "studio.example"}).status_code == 200
        origin = {"Origin": "http://localhost:5173"}
        answer = client.post("/api/v1/sessions", files={"score": ("a.mid", b"?")}, headers=origin)
        problem(answer, 422, "score-unreadable")


def test_too_large_a_show_is_refused_when_it_is_put(owned: Owned) -> None:
    padded = json.loads(show()) | {"description": "x" * 20_000_000}
    problem(owned.change("PUT", "/show", json=padded), 413, "show-too-large")
