"""What comes in holds up nobody's frames, and who may not send is told before it is read."""

from __future__ import annotations

import http.client
import json
import time
from typing import TYPE_CHECKING, Any

import pytest
from tests.integration.intake import (
    LATE_S,
    frame_times,
    large_batch,
    large_score,
    large_show,
    large_song,
    now,
)
from tests.integration.scores import scale, song
from tests.integration.server import Owned, upload

if TYPE_CHECKING:
    from collections.abc import Callable

    import httpx
    from tests.integration.server import Running

IDLE_S = 3.0
ALLOWED = 0.02
"""Share of late frames beyond that of the idle stream: what a machine with other work does by itself. Where
the event loop waits for what comes in, it is a tenth and more."""


def late_share(late_s: list[float]) -> float:
    return sum(value > LATE_S for value in late_s) / max(1, len(late_s))


def test_frames_are_not_late_while_large_files_come_in(server: Running, client: httpx.Client) -> None:
    """The share of frames later than 50 ms, compared with that of the idle stream just before."""
    watched = upload(client, scale(240), song=("s.wav", song()))
    other = upload(client, scale(16), song=("s.wav", song()))
    watched.control("loop", start_s=0.0, end_s=50.0)
    score, show, batch, recording = (
        large_score(60_000),
        large_show(90_000),
        large_batch(20_000),
        large_song(60),
    )
    headers = {**other.headers, "Content-Type": "application/json"}
    work: list[Callable[[], httpx.Response]] = [
        lambda: client.post(
            "/api/v1/sessions", files={"score": ("s.json", score), "song": ("s.wav", song())}, timeout=120
        ),
        lambda: client.put(f"{other.path}/show", content=show, headers=headers, timeout=120),
        lambda: client.post(f"{other.path}/show/edits", content=batch, headers=headers, timeout=120),
        lambda: client.post(
            "/api/v1/sessions",
            files={"score": ("s.mid", scale(4)), "song": ("s.wav", recording)},
            timeout=120,
        ),
    ]
    made: list[httpx.Response] = []
    with frame_times(server, watched.id) as times:
        watched.control("play")
        time.sleep(1.0)
        begin = now()
        time.sleep(IDLE_S)
        middle = now()
        for send in work:
            made.append(send())
            assert made[-1].is_success, made[-1].text
        end = now()
    watched.control("pause")
    for answer in (made[0], made[3]):
        Owned(client, answer.json()).change("DELETE")
    for session in (watched, other):
        session.change("DELETE")
    idle, busy = times.late_s(begin, middle), times.late_s(middle, end)
    assert len(idle) > 100
    assert late_share(busy) <= late_share(idle) + ALLOWED, (
        f"{late_share(busy):.1%} of {len(busy)} frames late, the latest by {max(busy):.3f} s; "
        f"idle {late_share(idle):.1%}"
    )


def refusal(server: Running, method: str, path: str, headers: dict[str, str]) -> tuple[int, dict[str, Any]]:
    """What is answered to headers that say 20 MB will follow, none of which do."""
    host, port = server.address.removeprefix("http://").split(":")
    connection = http.client.HTTPConnection(host, int(port), timeout=8)
    connection.putrequest(method, path)
    for name, value in {"Content-Type": "application/json", "Content-Length": "20000000", **headers}.items():
        connection.putheader(name, value)
    connection.endheaders(b"[")
    answer = connection.getresponse()
    assert answer.headers["Connection"] == "close"
    problem = json.loads(answer.read())
    connection.close()
    return answer.status, problem


WRITES = [
    ("PUT", "/show"),
    ("POST", "/show/edits"),
    ("PUT", "/show/tracks/lights/key/intensity"),
    ("POST", "/show/tracks/lights/key/intensity/keyframes"),
    ("POST", "/show/curves?start_s=0&end_s=1"),
    ("POST", "/transport"),
    ("PATCH", ""),
]


@pytest.mark.parametrize(("method", "below"), WRITES)
def test_session_and_token_are_asked_for_before_a_body_is_read(
    server: Running, owned: Owned, method: str, below: str
) -> None:
    nobody = f"/api/v1/sessions/{'x' * 22}{below}"
    assert refusal(server, method, nobody, {})[0] == 404
    assert refusal(server, method, owned.path + below, {})[0] == 401
    wrong = {"Authorization": "Bearer nonsense"}
    assert refusal(server, method, owned.path + below, wrong)[0] == 403


def test_what_is_said_to_be_too_large_is_refused_before_it_comes(server: Running, owned: Owned) -> None:
    for method, below, most in (("POST", "/transport", "16 kB"), ("POST", "/show/edits", "4 MB")):
        status, problem = refusal(server, method, owned.path + below, owned.headers)
        assert status == 413
        assert most in problem["detail"]


def test_who_sends_everything_first_hears_the_refusal_too(owned: Owned, client: httpx.Client) -> None:
    body = b"[" + b"0," * 4_000_000 + b"0]"
    answer = client.patch(owned.path, content=body, headers={"Content-Type": "application/json"})
    assert answer.status_code == 401
    assert client.get(owned.path).status_code == 200


def test_the_list_of_sessions_is_told_in_pages(client: httpx.Client) -> None:
    made = [upload(client, scale(4), song=("s.wav", song()), public="true") for _ in range(3)]
    seen: list[str] = []
    asked: dict[str, Any] = {"limit": 2}
    while True:
        page = client.get("/api/v1/sessions", params=asked).raise_for_status().json()
        assert len(page["sessions"]) <= 2
        seen.extend(session["id"] for session in page["sessions"])
        if page["next"] is None:
            break
        asked["after"] = page["next"]
    assert len(seen) == len(set(seen))
    assert {session.id for session in made} <= set(seen)
    for wrong in ({"limit": 0}, {"limit": 1001}):
        assert client.get("/api/v1/sessions", params=wrong).status_code == 422
    for session in made:
        session.change("DELETE")
