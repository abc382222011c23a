"""Headers that keep browsers from doing what nobody means with an answer."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from tests.integration.scores import scale, song
from tests.integration.server import upload

from reina.api.http.content_policy import inline_hashes
from reina.api.http.headers import PROTECTING

if TYPE_CHECKING:
    import httpx
    from tests.integration.server import Owned

PAGES = ("/", "/s/anything", "/lab", "/docs", "/index.html", "/lab.html", "/docs/index.html")
HTML = b"<!doctype html><script>document.title = 'ran'</script>"


def policy(answer: httpx.Response) -> dict[str, list[str]]:
    directives = answer.headers["content-security-policy"].split("; ")
    return {name: sources for name, *sources in (directive.split() for directive in directives)}


def test_every_answer_protects_itself(client: httpx.Client, owned: Owned) -> None:
    answers = [
        *(client.get(path) for path in PAGES),
        client.get("/icon.svg"),
        client.get("/openapi.json"),
        client.get("/api/v1/health"),
        client.head("/api/v1/health"),
        client.options("/api/v1/health"),
        client.get(f"{owned.path}/score"),
        client.get("/nothing"),
        client.put("/api/v1/health"),
        client.delete(owned.path),
        client.get("/", headers={"Host": "evil.example"}),
        client.post("/api/v1/sessions", headers={"Origin": "http://evil.example"}),
        client.get(f"{owned.path}/stream"),
    ]
    for answer in answers:
        for name, value in PROTECTING.items():
            is_page = answer.request.url.path in PAGES and answer.status_code == 200
            if is_page and name == "Content-Security-Policy":
                continue
            assert answer.headers[name] == value, (answer.request.method, answer.request.url, name)


@pytest.mark.parametrize("path", PAGES)
def test_pages_admit_their_own_scripts_alone(client: httpx.Client, path: str) -> None:
    answer = client.get(path)
    told = policy(answer)
    scripts, styles = inline_hashes(answer.text)
    assert told["default-src"] == ["'self'"]
    assert told["script-src"] == ["'self'", "'wasm-unsafe-eval'", *scripts]
    assert told["style-src"] == ["'self'", *styles]
    assert len(scripts) == len(re.findall(r"<script>", answer.text))
    for name in ("object-src", "base-uri", "frame-src"):
        assert told[name] == ["'none'"]
    del told["style-src-attr"]
    every = {source for sources in told.values() for source in sources}
    assert not every & {"'unsafe-inline'", "'unsafe-eval'", "*", "http:", "https:"}
    # 304 says the same, lest a page that was kept goes by another policy.
    again = client.get(path, headers={"If-None-Match": answer.headers["etag"]})
    assert again.status_code == 304
    assert again.headers["content-security-policy"] == answer.headers["content-security-policy"]


def test_a_policy_names_the_server_as_it_was_asked_for(client: httpx.Client) -> None:
    told = policy(client.get("/", headers={"Host": "localhost:1234"}))
    assert {"ws://localhost:1234", "wss://localhost:1234"} <= set(told["connect-src"])


def test_only_the_stage_alone_may_be_framed(client: httpx.Client) -> None:
    for path in (*PAGES, "/?clean=1", "/api/v1/health"):
        assert policy(client.get(path))["frame-ancestors"] == ["'none'"], path
    stage = client.get("/s/anything?clean=1")
    assert policy(stage)["frame-ancestors"] == ["*"]
    assert stage.headers["cross-origin-resource-policy"] == "cross-origin"


def test_what_was_uploaded_never_runs(client: httpx.Client) -> None:
    """Whatever a sender calls it: names and types of an upload decide nothing."""
    session = upload(client, scale(2), name="score.html", song=("song.svg", song(0.2), "text/html"))
    # What stands in a show is JSON; a page in it is text.
    show: dict[str, object] = {"version": 1, "tracks": [], "title": HTML.decode()}
    assert session.change("PUT", "/show", json=show).status_code == 200
    types = {
        "/score/file": "application/octet-stream",
        "/song": "audio/wav",
        "/song?format=original": "audio/wav",
        "/show": "application/json",
        "/export.mid": "audio/midi",
        "": "application/json",
    }
    for below, media_type in types.items():
        answer = client.get(f"{session.path}{below}")
        assert answer.status_code == 200, below
        assert answer.headers["content-type"].partition(";")[0] == media_type, below
        assert answer.headers["x-content-type-options"] == "nosniff", below
        assert "sandbox" in policy(answer), below
        assert policy(answer)["default-src"] == ["'none'"], below
        if media_type != "application/json":
            assert answer.headers["content-disposition"].startswith("attachment"), below
    session.change("DELETE")


def test_the_viewer_of_the_api_comes_from_here(client: httpx.Client) -> None:
    page = client.get("/docs").text
    for address in re.findall(r'(?:src|href)="([^"]+)"', page):
        assert address.startswith("/"), address
        assert client.get(address).status_code == 200, address
    assert (Path(__file__).parents[2] / "web/dist/docs/viewer/LICENSE").is_file()
