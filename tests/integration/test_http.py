"""What holds of every address: validators and conditions, HEAD, ranges, methods, names of files."""

from __future__ import annotations

import json
import re
import socket
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from tests.integration.scores import scale, song
from tests.integration.server import Owned, upload

if TYPE_CHECKING:
    from collections.abc import Iterator

    import httpx
    from tests.integration.server import Running

CASES = Path(__file__).parents[1] / "cases"
PAGE = Path(__file__).parents[2] / "web" / "dist"
ASSET = next((PAGE / "assets").glob("index-*.js")).name
KEPT = {"cache-control", "etag", "vary"}
OF_ONE_ANSWER = {"date", "x-request-id"}


@pytest.fixture(scope="module")
def played(client: httpx.Client) -> Iterator[Owned]:
    session = upload(client, scale(), song=("song.wav", song()), in_time="true")
    yield session
    session.change("DELETE")


def validated(session: Owned) -> list[str]:
    """Addresses of every kind whose answers stay as they are."""
    below = ("", "/song", "/song/peaks", "/show", "/show/tracks/camera%2Ffov/keyframes", "/show/history")
    return [
        "/",
        "/s/anything",
        "/lab",
        "/icon.svg",
        f"/assets/{ASSET}",
        "/fonts/instrument-sans-latin-wght-normal.woff2",
        "/docs",
        "/openapi.json",
        "/api/v1/parameters",
        "/api/v1/shows",
        "/api/v1/shows/schema",
        "/api/v1/rigs",
        "/api/v1/rigs/trumpet",
        "/api/v1/rigs/trumpet/rig.json",
        "/api/v1/examples",
        "/api/v1/examples/scores/taps.mid",
        "/api/v1/lab/clips",
        *(f"{session.path}{path}" for path in below),
        f"{session.path}/score",
        f"{session.path}/score?part=0",
        f"{session.path}/show/curves?parameter=camera/fov&start_s=0&end_s=1",
        f"{session.path}/time",
    ]


def sent(client: httpx.Client, name: str) -> Owned:
    """A case's score, with a song so that nothing is rendered."""
    return upload(client, (CASES / f"{name}.mid").read_bytes(), song=("s.wav", song()))


def right(name: str) -> dict[str, object]:
    value: dict[str, object] = json.loads((CASES / f"{name}.json").read_text())["right"]
    return value


def test_a_song_that_is_known_is_not_sent_again(client: httpx.Client) -> None:
    href = f"{sent(client, 'http-304').path}/song"
    first = client.get(href)
    again = client.get(href, headers={"If-None-Match": first.headers["etag"]})
    assert again.status_code == right("http-304")["status"]
    assert again.content == b""


def test_head_is_answered(client: httpx.Client) -> None:
    for path in (f"{sent(client, 'http-head').path}/song", "/api/v1/health"):
        assert client.head(path).status_code == right("http-head")["status"]


def test_a_unit_that_nobody_knows_is_ignored(client: httpx.Client) -> None:
    href = f"{sent(client, 'http-range').path}/song"
    answer = client.get(href, headers={"Range": "items=0-9"})
    assert answer.status_code == right("http-range")["status"]
    assert answer.content == client.get(href).content


def test_a_title_is_read_as_browsers_send_it(client: httpx.Client) -> None:
    form = (
        b'--x\r\nContent-Disposition: form-data; name="score"; filename="My %22song%22.mid"\r\n\r\n'
        + (CASES / "http-filename.mid").read_bytes()
        + b'\r\n--x\r\nContent-Disposition: form-data; name="song"; filename="s.wav"\r\n\r\n'
        + song()
        + b"\r\n--x--\r\n"
    )
    headers = {"Content-Type": "multipart/form-data; boundary=x"}
    answer = client.post("/api/v1/sessions", content=form, headers=headers)
    assert answer.status_code == 201, answer.text
    assert answer.json()["title"] == right("http-filename")["title"]


@pytest.mark.parametrize("encoding", ["gzip", "identity"])
def test_every_answer_has_a_validator_and_is_sent_once(
    client: httpx.Client, played: Owned, encoding: str
) -> None:
    accepts = {"Accept-Encoding": encoding}
    for path in validated(played):
        first = client.get(path, headers=accepts)
        assert first.status_code == 200, path
        etag = first.headers["etag"]
        for known in (etag, f'"other", W/{etag}', "*"):
            again = client.get(path, headers=accepts | {"If-None-Match": known})
            assert (again.status_code, again.content) == (304, b""), (path, known)
            assert again.headers["etag"] == etag, path
            for name in KEPT & first.headers.keys():
                assert again.headers[name] == first.headers[name], (path, name)
            assert "content-length" not in again.headers, path
            assert "content-encoding" not in again.headers, path
        other = client.get(path, headers=accepts | {"If-None-Match": '"other"'})
        assert (other.status_code, other.content) == (200, first.content), path
        refused = client.get(path, headers=accepts | {"If-Match": '"other"', "If-None-Match": etag})
        assert refused.status_code == 412, path
        assert refused.headers["content-type"] == "application/problem+json"
        caching = "public, max-age=31536000, immutable" if path.startswith("/assets/") else "no-cache"
        assert first.headers["cache-control"] == caching, path


def test_files_that_have_not_been_written_since_are_not_sent_again(
    client: httpx.Client, played: Owned
) -> None:
    for path in (f"{played.path}/song", "/", "/api/v1/rigs/trumpet/rig.json"):
        written = client.get(path).headers["last-modified"]
        assert client.get(path, headers={"If-Modified-Since": written}).status_code == 304
        early = {"If-Modified-Since": "Thu, 01 Jan 1970 00:00:00 GMT"}
        assert client.get(path, headers=early).status_code == 200
        late = {"If-None-Match": '"other"', "If-Modified-Since": written}
        assert client.get(path, headers=late).status_code == 200


def test_a_validator_tells_the_encodings_apart(client: httpx.Client) -> None:
    for path in (f"/assets/{ASSET}", "/openapi.json"):
        plain, packed = (client.get(path, headers={"Accept-Encoding": way}) for way in ("identity", "gzip"))
        assert packed.headers["content-encoding"] == "gzip"
        assert "content-encoding" not in plain.headers
        assert plain.headers["vary"] == packed.headers["vary"] == "Accept-Encoding"
        assert plain.headers["etag"] != packed.headers["etag"]
        known = {"Accept-Encoding": "identity", "If-None-Match": packed.headers["etag"]}
        assert client.get(path, headers=known).status_code == 200
    refused = client.get("/openapi.json", headers={"Accept-Encoding": "br, gzip;q=0"})
    assert "content-encoding" not in refused.headers


def test_head_says_what_get_says(client: httpx.Client, played: Owned) -> None:
    unsteady = [f"{played.path}/frames?end_s=0.5", f"{played.path}/export.bvh?end_s=0.5"]
    for path in [*validated(played), *unsteady, "/nothing.html", "/api/v1/nothing", "/api/v1/rigs/nobody"]:
        with client.stream("GET", path) as got:
            expected = {name: value for name, value in got.headers.items() if name not in OF_ONE_ANSWER}
            status = got.status_code
        answer = client.head(path)
        told = {name: value for name, value in answer.headers.items() if name not in OF_ONE_ANSWER}
        assert (answer.status_code, told, answer.content) == (status, expected, b""), path
    known = {"If-None-Match": client.get("/").headers["etag"]}
    assert client.head("/", headers=known).status_code == 304
    assert client.head(f"{played.path}/song", headers={"Range": "bytes=0-9"}).status_code == 200


def test_head_of_a_long_span_computes_none_of_it(client: httpx.Client, played: Owned) -> None:
    # Minutes of computing, each: none would be over before the client gives up.
    for _ in range(20):
        answer = client.head(f"{played.path}/frames?end_s=600&fps=240")
        assert int(answer.headers["content-length"]) > 200_000_000
        assert client.head(f"{played.path}/export.bvh?end_s=600&fps=240").status_code == 200
    assert client.get(f"{played.path}/frames?end_s=1").status_code == 200


def test_ranges_are_read_by_the_rules(client: httpx.Client, played: Owned) -> None:
    href = f"{played.path}/song"
    whole = client.get(href)
    data, size = whole.content, len(whole.content)
    for asked, part in (("0-9", data[:10]), (f"{size - 3}-99999999", data[-3:]), ("-5", data[-5:])):
        answer = client.get(href, headers={"Range": f"bytes={asked}"})
        assert (answer.status_code, answer.content) == (206, part), asked
    for asked in ("bytes=5-2", "bytes=x-y", "bytes", "bytes=" + ",".join(["0-"] * 500)):
        answer = client.get(href, headers={"Range": asked})
        assert (answer.status_code, answer.content) == (200, data), asked
    for asked in (f"bytes={size}-", "bytes=-0"):
        answer = client.get(href, headers={"Range": asked})
        assert answer.status_code == 416
        assert answer.headers["content-range"] == f"bytes */{size}"
        assert answer.headers["content-type"] == "application/problem+json"
        assert answer.json()["type"] == "urn:reina:problem:range-not-satisfiable"
    beyond = {"Range": f"bytes={size}-", "If-None-Match": whole.headers["etag"]}
    assert client.get(href, headers=beyond).status_code == 304
    for condition, status in (
        (whole.headers["etag"], 206),
        (whole.headers["last-modified"], 206),
        (f"W/{whole.headers['etag']}", 200),
        ('"other"', 200),
        ("*", 200),
        ("Thu, 01 Jan 1970 00:00:00 GMT", 200),
    ):
        answer = client.get(href, headers={"Range": "bytes=0-9", "If-Range": condition})
        assert answer.status_code == status, condition


def test_several_ranges_come_in_parts(client: httpx.Client, played: Owned) -> None:
    href = f"{played.path}/song"
    data = client.get(href).content
    answer = client.get(href, headers={"Range": "bytes=0-9,20-29,25-34,99999999-"})
    assert answer.status_code == 206
    boundary = answer.headers["content-type"].removeprefix("multipart/byteranges; boundary=")
    parts = answer.content.split(f"--{boundary}".encode())
    assert (parts[0], parts[-1]) == (b"", b"--")
    for part, first, end in zip(parts[1:-1], (0, 20), (10, 35), strict=True):
        head, body = part.split(b"\r\n\r\n", 1)
        assert f"Content-Range: bytes {first}-{end - 1}/{len(data)}".encode() in head
        assert b"Content-Type: audio/wav" in head
        assert body == data[first:end] + b"\r\n"


def test_methods_that_an_address_has_not_are_told_which_it_has(client: httpx.Client, played: Owned) -> None:
    for path, allowed in (
        (played.path, "DELETE, GET, HEAD, OPTIONS, PATCH"),
        (f"{played.path}/show", "GET, HEAD, OPTIONS, PUT"),
        ("/api/v1/sessions", "GET, HEAD, OPTIONS, POST"),
        ("/api/v1/lab/bvh", "OPTIONS, POST"),
        ("/api/v1/health", "GET, HEAD, OPTIONS"),
        ("/openapi.json", "GET, HEAD, OPTIONS"),
        ("/", "GET, HEAD, OPTIONS"),
    ):
        options = client.options(path)
        assert (options.status_code, options.headers["allow"], options.content) == (204, allowed, b"")
        answer = client.request("PROPFIND", path)
        assert (answer.status_code, answer.headers["allow"]) == (405, allowed)
        assert answer.headers["content-type"] == "application/problem+json"
    assert client.options("/api/v1/nothing").status_code == 404
    with client.stream("OPTIONS", client.base_url, extensions={"target": b"*"}) as whole:
        assert (whole.status_code, whole.headers["allow"]) == (
            204,
            "DELETE, GET, HEAD, OPTIONS, PATCH, POST, PUT",
        )
    assert client.head("/api/v1/lab/bvh").status_code == 405


@pytest.mark.parametrize(
    ("below", "told"),
    [
        ("", "nothing can be asked here"),
        ("/frames", "it may ask start_s, end_s, fps"),
        ("/score", "it may ask part"),
        ("/song", "format"),
        ("/show/history", "nothing can be asked here"),
    ],
)
def test_what_an_address_cannot_be_asked_is_refused(
    client: httpx.Client, played: Owned, below: str, told: str
) -> None:
    answer = client.get(f"{played.path}{below}", params={"packed": "maybe"})
    assert answer.status_code == 422
    assert answer.json()["type"] == "urn:reina:problem:request-invalid"
    assert "'packed'" in answer.json()["detail"]
    assert told in answer.json()["detail"]
    assert answer.json()["errors"][0]["location"] == "query/packed"


@pytest.mark.parametrize(
    "asked",
    ["fps=true", "fps=1.5", "fps=", "start_s=now", "start_s=nan", "end_s=inf", "fps=0x10", "fps=sixty"],
)
def test_numbers_that_an_address_asks_are_numbers(client: httpx.Client, played: Owned, asked: str) -> None:
    answer = client.get(f"{played.path}/frames?{asked}")
    assert answer.status_code == 422
    assert answer.json()["errors"][0]["location"] == f"query/{asked.partition('=')[0]}"


def filled(path: str, session: str) -> str:
    """An address of a route's kind; of it nothing need be there."""
    known = {"session_id": session, "path": "camera/fov", "folder": "scores", "name": "trumpet"}
    return re.sub(r"\{(\w+)\}", lambda match: known.get(match[1], "x"), path)


def test_every_address_tells_all_its_methods(client: httpx.Client, played: Owned) -> None:
    paths: dict[str, dict[str, object]] = client.get("/openapi.json").json()["paths"]
    assert len(paths) > 50
    for path, operations in paths.items():
        methods = {name.upper() for name in operations if name in {"get", "post", "put", "patch", "delete"}}
        allowed = ", ".join(sorted(methods | {"OPTIONS"} | ({"HEAD"} if "GET" in methods else set())))
        for method in ("GET", "POST", "PUT", "PATCH", "DELETE", "TRACE"):
            if method in methods:
                continue
            answer = client.request(method, filled(path, played.id))
            assert (answer.status_code, answer.headers.get("allow")) == (405, allowed), (method, path)
    for method in ("GET", "POST", "PUT", "PATCH", "DELETE"):
        assert client.request(method, "/api/v1/nothing").status_code == 404, method
        assert client.request(method, f"{played.path}/nothing/at/all").status_code == 404, method


HANDSHAKE = b"GET %b HTTP/1.1\r\nHost: localhost\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n%b\r\n"
KEY = b"Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
VERSION = b"Sec-WebSocket-Version: 13\r\n"
STREAM = b"/api/v1/sessions/nobody/stream"


@pytest.mark.parametrize(
    ("request_", "status", "kind"),
    [
        (b"GARBAGE\r\n\r\n", 400, "not-http"),
        (b"GET /api/v1/health HTTP/1.1\r\n\r\n", 400, "not-http"),
        (b"GET /\xff HTTP/1.1\r\nHost: localhost\r\n\r\n", 400, "not-http"),
        (HANDSHAKE % (STREAM, VERSION), 400, "not-a-handshake"),
        (HANDSHAKE % (STREAM, VERSION + b"Sec-WebSocket-Key: \xff\r\n"), 400, "not-a-handshake"),
        (HANDSHAKE % (STREAM, KEY + b"Sec-WebSocket-Version: \xff\r\n"), 426, "other-websocket"),
        (HANDSHAKE % (STREAM, KEY + VERSION), 404, "unknown-session"),
        (HANDSHAKE % (b"/api/v1/health", KEY + VERSION), 404, "not-found"),
    ],
)
def test_what_never_comes_to_a_route_is_a_problem_too(
    server: Running, request_: bytes, status: int, kind: str
) -> None:
    host, port = server.address.removeprefix("http://").split(":")
    answer = b""
    with socket.create_connection((host, int(port)), timeout=10) as connection:
        connection.sendall(request_)
        while received := connection.recv(65536):
            answer += received
    head, body = answer.split(b"\r\n\r\n", 1)
    assert head.startswith(f"HTTP/1.1 {status} ".encode())
    assert b"content-type: application/problem+json" in head.lower()
    problem = json.loads(body)
    assert (problem["status"], problem["type"]) == (status, f"urn:reina:problem:{kind}")
