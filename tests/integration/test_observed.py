"""A server seen from outside: its log, its metrics, whether it is ready."""

from __future__ import annotations

import asyncio
import contextlib
import json
import re
import signal
import time
from typing import TYPE_CHECKING, Any

import httpx
import pytest
from prometheus_client.parser import text_string_to_metric_families
from tests.integration.scores import scale, show, song
from tests.integration.server import PATIENCE_S, Running, serve, upload
from tests.integration.watching import watch

if TYPE_CHECKING:
    from collections.abc import Generator, Iterator
    from pathlib import Path

PLAIN_ID = re.compile(r"[A-Za-z0-9._-]{8,36}")
SECRET = "Zq7-tell-nobody-0kXvB3mPw9rT2yUeHs5aJd"
"""What stands wherever somebody could send a secret."""


class Observed:
    """A server with its log and its metrics."""

    def __init__(self, running: Running, log: Path) -> None:
        self.running = running
        self.log = log

    @property
    def events(self) -> list[dict[str, Any]]:
        return [json.loads(line) for line in self.log.read_text().splitlines()]

    def request(self, known_by: str) -> dict[str, Any]:
        """The line of a request, which is written when its answer is over: a moment after it is heard."""
        until = time.monotonic() + PATIENCE_S
        while time.monotonic() < until:
            for event in self.events:
                if event["event"] == "request" and event["request_id"] == known_by:
                    return event
        raise AssertionError(f"the log has no request {known_by}")

    def metrics(self) -> dict[tuple[str, frozenset[tuple[str, str]]], float]:
        """Each sample by its name and labels."""
        [address] = {event["address"] for event in self.events if event["event"] == "metrics"}
        answer = httpx.get(address, timeout=30)
        return {
            (sample.name, frozenset(sample.labels.items())): sample.value
            for family in text_string_to_metric_families(answer.text)
            for sample in family.samples
        }

    def metric(self, name: str, **labels: str) -> float:
        return self.metrics()[name, frozenset(labels.items())]


@contextlib.contextmanager
def observed(folder: Path, *arguments: str) -> Generator[Observed]:
    log = folder / "log"
    with serve(folder / "data", "--metrics-port", "0", "--log-requests", *arguments, log=log) as running:
        yield Observed(running, log)


@pytest.fixture(scope="module")
def seen(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Observed]:
    with observed(tmp_path_factory.mktemp("observed")) as seen:
        yield seen


@pytest.fixture(scope="module")
def asking(seen: Observed) -> Iterator[httpx.Client]:
    with httpx.Client(base_url=seen.running.address, timeout=30) as client:
        yield client


def test_every_answer_has_an_id_which_the_log_has_too(seen: Observed, asking: httpx.Client) -> None:
    session = upload(asking, scale(), song=("s.wav", song()))
    for answer in (
        asking.get("/api/v1/health"),
        asking.get(session.path),
        asking.get("/api/v1/nowhere"),
        asking.put(f"{session.path}/show", json={}),
    ):
        known_by = answer.headers["X-Request-ID"]
        assert PLAIN_ID.fullmatch(known_by)
        event = seen.request(known_by)
        assert event["status"] == answer.status_code
        if answer.status_code >= 400:
            assert answer.json()["instance"] == f"urn:reina:request:{known_by}"
    assert session.id not in seen.log.read_text()
    session.change("DELETE")


@pytest.mark.parametrize(
    ("sent", "is_taken"),
    [
        ("7c3f9a2e-0b1d-4c6e-9a57-1f0e2d3c4b5a", True),
        ("proxy.0001", True),
        ("short", False),
        ("x" * 37, False),
        ("with spaces and so on", False),
        ('"><script>', False),
    ],
)
def test_a_proxys_id_is_taken_where_it_is_short_and_plain(
    asking: httpx.Client, sent: str, is_taken: bool
) -> None:
    answer = asking.get("/api/v1/health", headers={"X-Request-ID": sent})
    assert (answer.headers["X-Request-ID"] == sent) is is_taken
    assert PLAIN_ID.fullmatch(answer.headers["X-Request-ID"])


def test_no_secret_is_in_the_log(seen: Observed, asking: httpx.Client) -> None:
    """Whatever is asked, right and wrong, with tokens, ids and names that would be seen."""
    session = upload(
        asking,
        scale(),
        f"{SECRET}.mid",
        song=(f"{SECRET}.wav", song()),
        show=("s.json", show()),
        title=SECRET,
    )
    broken = asking.post("/api/v1/sessions", files={"score": (f"{SECRET}.mid", SECRET.encode())})
    assert broken.status_code == 422
    wrong = {"Authorization": f"Bearer {SECRET}"}
    requests: tuple[tuple[str, str, dict[str, Any]], ...] = (
        ("GET", f"/api/v1/sessions/{SECRET}", {}),
        ("GET", f"/api/v1/sessions?token={SECRET}&after={SECRET}", {}),
        ("GET", f"/{SECRET}?control_token={SECRET}", {}),
        ("PATCH", session.path, {"headers": wrong, "json": {"title": SECRET}}),
        ("PATCH", session.path, {"headers": session.headers, "json": {"title": SECRET, SECRET: SECRET}}),
        ("PATCH", session.path, {"headers": session.headers, "json": {"title": f"{SECRET}2"}}),
        ("PUT", f"{session.path}/show", {"headers": session.headers, "content": SECRET}),
        ("POST", f"{session.path}/show/tracks/{SECRET}/keyframes", {"headers": session.headers, "json": {}}),
        ("GET", f"{session.path}/frames?end_s={SECRET}", {}),
        (
            "GET",
            "/api/v1/health",
            {"headers": {"X-Request-ID": SECRET, "User-Agent": SECRET, "Cookie": SECRET}},
        ),
        ("DELETE", session.path, {"headers": session.headers}),
    )
    for method, path, options in requests:
        assert asking.request(method, path, **options).status_code < 500
    seen.request(asking.get("/api/v1/health").headers["X-Request-ID"])
    said = seen.log.read_text()
    assert len(seen.events) > 10
    for secret in (SECRET, session.body["control_token"], session.id):
        assert secret not in said
    assert "Traceback" not in said


def test_what_is_sent_is_counted(seen: Observed, asking: httpx.Client) -> None:
    session = upload(asking, scale(), song=("s.wav", song()))
    before = seen.metrics()

    async def watched() -> int:
        async with watch(seen.running, session.id) as watcher:
            await asyncio.to_thread(session.control, "play")
            await watcher.frame(20, epoch=1)
            viewers = await asyncio.to_thread(seen.metric, "reina_viewers")
            assert viewers == 1
        return len(watcher.frames)

    frames = asyncio.run(watched())
    after = seen.metrics()

    def more(name: str, **labels: str) -> float:
        key = name, frozenset(labels.items())
        return after[key] - before.get(key, 0.0)

    assert more("reina_frames_sent_total") >= frames > 20
    assert more("reina_sent_bytes_total", by="stream") > 20 * 1000
    assert more("reina_block_evaluation_seconds_count") >= 1
    assert more("reina_loop_delay_seconds_count") >= 1
    transport = {"route": "/sessions/{session_id}/transport", "method": "POST", "status": "200"}
    assert more("reina_requests_total", **transport) == 1
    assert after["reina_sessions_loaded", frozenset()] >= 1
    assert after["reina_work_seconds_count", frozenset({("queue", "recordings")})] >= 1
    assert after["process_resident_memory_bytes", frozenset()] > 20e6
    assert session.id not in str(sorted(map(str, after)))
    session.change("DELETE")


def test_a_limit_that_refuses_is_counted(seen: Observed, asking: httpx.Client) -> None:
    before = seen.metrics().get(("reina_limits_hit_total", frozenset({("limit", "file-too-large")})), 0.0)
    assert asking.post("/api/v1/files/role", content=bytes(1_000_001)).status_code == 413
    assert seen.metric("reina_limits_hit_total", limit="file-too-large") == before + 1


def test_the_number_of_series_does_not_follow_what_is_asked(seen: Observed, asking: httpx.Client) -> None:
    asking.get("/api/v1/nowhere")
    asking.request("BREW", "/api/v1/health")
    before = len(seen.metrics())
    for number in range(20):
        asking.get(f"/api/v1/nowhere/{number}")
        asking.get(f"/api/v1/sessions/{number:022}")
        asking.request(f"BREW{number}", "/api/v1/health")
    # The session's route with its 404 comes once.
    assert len(seen.metrics()) - before <= 10


def test_strangers_are_told_no_metrics(asking: httpx.Client) -> None:
    assert asking.get("/metrics").status_code == 404
    assert asking.get("/api/v1/metrics").status_code == 404


def test_without_being_asked_to_no_metrics_are_served(tmp_path: Path) -> None:
    log = tmp_path / "log"
    with serve(tmp_path / "data", log=log) as running:
        assert httpx.get(f"{running.api}/health/ready", timeout=30).status_code == 200
    assert "metrics" not in log.read_text()


def test_a_signal_takes_readiness_away_first(tmp_path: Path) -> None:
    with observed(tmp_path, "--drain", "60") as seen:
        api = seen.running.api
        assert httpx.get(f"{api}/health/ready", timeout=30).status_code == 200
        seen.running.process.send_signal(signal.SIGINT)
        until = time.monotonic() + PATIENCE_S
        answer = httpx.get(f"{api}/health/ready", timeout=30)
        while answer.status_code == 200 and time.monotonic() < until:
            answer = httpx.get(f"{api}/health/ready", timeout=30)
        assert answer.status_code == 503
        assert [fault["location"] for fault in answer.json()["errors"]] == ["ending"]
        # It lives, and does what it is asked for.
        assert httpx.get(f"{api}/health", timeout=30).json()["status"] == "not-ready"
        seen.running.process.send_signal(signal.SIGINT)
        assert seen.running.process.wait(30) == 0


def test_a_missing_page_is_told_while_it_is_missing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    page = tmp_path / "page"
    page.mkdir()
    (page / "index.html").write_text("<!doctype html>")
    monkeypatch.setenv("REINA_PAGE", str(page))

    def reasons(api: str, wanted: list[str]) -> list[str]:
        until = time.monotonic() + PATIENCE_S
        told: list[str] = ["not asked"]
        while told != wanted and time.monotonic() < until:
            health = httpx.get(f"{api}/health", timeout=30).json()
            told = [one["reason"] for one in health["not_ready"]]
        return told

    with observed(tmp_path) as seen:
        assert reasons(seen.running.api, []) == []
        (page / "index.html").unlink()
        assert reasons(seen.running.api, ["page"]) == ["page"]
        assert seen.metric("reina_ready") == 0
        (page / "index.html").write_text("<!doctype html>")
        assert reasons(seen.running.api, []) == []
        assert [event["kind"] for event in seen.events if event["event"] == "not ready"] == ["page"]
