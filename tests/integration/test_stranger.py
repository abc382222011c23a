"""One stranger stops nobody: what is refused unread, how little is told and kept, and that no frame is lost.

`tests/benchmarks/bench_stranger.py` measures the same with the largest of everything.
"""

from __future__ import annotations

import re
import time
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING, Any

import pytest
from tests.integration.intake import (
    frame_times,
    large_score,
    memory_peak,
    now,
    unknown_fields,
)
from tests.integration.scores import scale, song
from tests.integration.server import Owned, serve, upload
from tests.integration.test_intake import refusal

if TYPE_CHECKING:
    from pathlib import Path

    import httpx
    from tests.integration.server import Running

MEGABYTE = 1_000_000
IDLE_S = 2.0
ALLOWED = 0.02
"""Share of lost frames beyond that of the idle stream: what a machine with other work does by itself."""
JSON = {"Content-Type": "application/json"}


@pytest.mark.parametrize(
    ("method", "below", "limit", "route"),
    [
        ("POST", "/transport", "16 kB", "/transport"),
        ("PATCH", "", "16 kB", "/sessions/{session_id} takes"),
        ("PUT", "/cast", "16 kB", "/cast"),
        ("PUT", "/alignment", "1 MB", "/alignment"),
        ("POST", "/show/tracks/camera/fov/keyframes", "16 kB", "/keyframes"),
        ("PATCH", "/show/tracks/camera/fov/keyframes/k1", "16 kB", "/keyframes/{key}"),
        ("PUT", "/show/tracks/camera/fov", "1 MB", "/show/tracks/{path}"),
        ("POST", "/show/curves?start_s=0&end_s=1", "1 MB", "/show/curves"),
        ("POST", "/show/edits", "4 MB", "/show/edits"),
    ],
)
def test_what_is_too_large_is_refused_unread_with_limit_and_route(
    server: Running, owned: Owned, method: str, below: str, limit: str, route: str
) -> None:
    status, problem = refusal(server, method, owned.path + below, owned.headers)
    assert (status, problem["status"]) == (413, 413)
    assert f"larger than {limit}, the most that {method} " in problem["detail"]
    assert route in problem["detail"]


@pytest.mark.parametrize("call", ["interpolations", "forward", "inverse", "reach"])
def test_the_laboratory_reads_little(server: Running, call: str) -> None:
    status, problem = refusal(server, "POST", f"/api/v1/lab/{call}", {})
    assert status == 413
    assert f"larger than 16 kB, the most that POST /api/v1/lab/{call} takes" in problem["detail"]


def sent(owned: Owned, method: str, path: str, body: bytes | str) -> httpx.Response:
    """What is answered to JSON, with the token."""
    return owned.client.request(method, path, content=body, headers=owned.headers | JSON, timeout=120)


@pytest.mark.parametrize(
    ("method", "below", "head", "count"),
    [
        ("PATCH", "", b"", 1500),
        ("PUT", "/cast", b'"castings":[{}],', 1500),
        ("POST", "/transport", b'"action":"play",', 1500),
        ("PUT", "/show", b'"version":1,"tracks":[],', 30_000),
        ("PUT", "/show/tracks/camera/fov", b'"keyframes":[{"time":0,"value":1}],', 30_000),
        ("POST", "/show/edits", b'"edit":"change_show","changes":{},', 30_000),
    ],
)
def test_of_very_many_faults_few_are_told_and_the_rest_counted(
    owned: Owned, method: str, below: str, head: bytes, count: int
) -> None:
    body = b"{" + head + unknown_fields(count)[1:]
    if below == "/show/edits":
        body = b"[" + body + b"]"
    answer = sent(owned, method, owned.path + below, body)
    problem: dict[str, Any] = answer.json()
    assert answer.status_code == 422
    assert len(answer.content) < 8000
    assert len(problem["errors"]) <= 20
    assert " more" in problem["detail"]
    assert int(re.findall(r"(\d+) more", problem["detail"])[0]) >= count - 20


def test_batches_of_very_many_faults(owned: Owned) -> None:
    for body in (
        b"[" + b"1," * 100_000 + b"1]",
        b"[" + b",".join([b'{"edit":"change_show","changes":{"x":1,"y":2}}'] * 3000) + b"]",
    ):
        answer = sent(owned, "POST", f"{owned.path}/show/edits", body)
        assert answer.status_code == 422
        assert len(answer.json()["errors"]) <= 20
        assert len(answer.content) < 10_000


def test_a_preview_of_very_many_fields(owned: Owned) -> None:
    for body in (unknown_fields(30_000), b'{"track":' + unknown_fields(30_000) + b"}"):
        answer = sent(owned, "POST", f"{owned.path}/show/curves?start_s=0&end_s=1", body)
        assert answer.status_code == 422
        assert len(answer.json()["errors"]) <= 20
        assert len(answer.content) < 2000


@pytest.mark.parametrize(
    ("method", "below", "body"),
    [
        ("PATCH", "", '{"%s": 1}'),
        ("POST", "/transport", '{"action": "%s"}'),
        ("PUT", "/cast", '{"castings": [{"handedness": "%s"}]}'),
        ("PUT", "/show", '{"version": 1, "tracks": [], "%s": 1}'),
        ("POST", "/show/edits", '[{"edit": "%s"}]'),
        ("POST", "/show/tracks/%s/keyframes", "{}"),
    ],
)
def test_what_was_sent_is_repeated_in_part(owned: Owned, method: str, below: str, body: str) -> None:
    long = "x" * 12_000
    answer = sent(owned, method, owned.path + below.replace("%s", long), body.replace("%s", long))
    assert 400 <= answer.status_code < 500
    assert len(answer.content) < 4000
    assert "x" * 2000 not in answer.text


def test_a_history_holds_few_large_steps(owned: Owned) -> None:
    words = "1" * (3 * MEGABYTE)
    for number in range(12):
        show = f'{{"version":1,"tracks":[{{"parameter":"x/{number}","words":"{words}"}}]}}'
        answer = owned.change("PUT", "/show", content=show, timeout=120)
        assert answer.status_code == 200, answer.text
    steps = owned.client.get(f"{owned.path}/show/history").json()
    assert steps["revision"] == 12
    assert 1 <= steps["undo"] <= 5, "16 MB, 3 MB each"
    back = owned.change("POST", "/show/undo", timeout=120).json()
    assert back["tracks"][0]["parameter"] == "x/10"
    warnings = owned.client.get(f"{owned.path}/show/warnings").json()["warnings"]
    assert [warning["place"] for warning in warnings] == ["x/10"]


def test_of_very_many_unknown_tracks_few_are_told(owned: Owned) -> None:
    tracks = ",".join(f'{{"parameter":"x/{number}"}}' for number in range(3000))
    answer = owned.change("PUT", "/show", content=f'{{"version":1,"tracks":[{tracks}]}}', timeout=120)
    assert answer.status_code == 200
    warnings = owned.client.get(f"{owned.path}/show/warnings").json()["warnings"]
    assert len(warnings) == 21
    assert warnings[-1]["message"].startswith("2980 more tracks")


def test_no_frame_is_lost_while_strangers_are_answered(server: Running, client: httpx.Client) -> None:
    """The share of frames that never come, compared with that of the idle stream just before."""
    watched = upload(client, scale(240), song=("s.wav", song()))
    files = {"score": ("s.json", large_score(12_000)), "song": ("s.wav", song())}
    long = Owned(client, client.post("/api/v1/sessions", files=files, timeout=300).json())
    numbers = b"[" + b"1," * (4 * MEGABYTE) + b"1]"
    asked: list[tuple[str, str, bytes | None, int]] = [
        *[("PATCH", "/api/v1/sessions/nobody", numbers, 404)] * 2,
        *[("PUT", f"{long.path}/show", numbers, 401)] * 2,
        *[("POST", "/api/v1/lab/forward", numbers, 413)] * 2,
        *[("GET", f"{long.path}/score", None, 200)] * 6,
        *[("GET", f"{long.path}/time", None, 200)] * 4,
        *[("GET", f"{long.path}/frames?end_s=1&fps={fps}", None, 200) for fps in range(61, 69)],
    ]

    def ask(one: tuple[str, str, bytes | None, int]) -> tuple[int, int, bytes]:
        method, path, body, expected = one
        answer = client.request(method, path, content=body, headers=JSON, timeout=120)
        return answer.status_code, expected, answer.content

    with frame_times(server, watched.id) as times:
        watched.control("loop", start_s=0.0, end_s=50.0)
        watched.control("play")
        time.sleep(1.0)
        begin = now()
        time.sleep(IDLE_S)
        middle = now()
        with memory_peak(server) as memory, ThreadPoolExecutor(8) as threads:
            answers = list(threads.map(ask, asked))
        end = now()
    watched.control("pause")
    for session in (watched, long):
        session.change("DELETE")
    assert [status for status, _, _ in answers] == [expected for _, expected, _ in answers]
    scores = [
        content
        for (_, path, _, _), (_, _, content) in zip(asked, answers, strict=True)
        if path.endswith("/score")
    ]
    assert len(set(scores)) == 1
    assert memory.server_above < 300 * MEGABYTE
    idle, busy = (
        times.lost(*span) / max(1, len(times.late_s(*span))) for span in ((begin, middle), (middle, end))
    )
    assert busy <= idle + ALLOWED, f"{busy:.1%} of the frames lost; idle {idle:.1%}"


def test_the_laboratory_is_not_there_for_other_machines(tmp_path: Path) -> None:
    for options, there in (((), True), (("--no-lab",), False)):
        with serve(tmp_path / str(there), "--no-page", *options) as server:
            assert (refusal(server, "POST", "/api/v1/lab/forward", {})[0] == 413) is there
            assert (refusal(server, "POST", "/api/v1/lab/forward", {})[0] == 404) is not there
