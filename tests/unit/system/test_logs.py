"""One event a line, without secrets, without tracebacks, and not too many of them."""

from __future__ import annotations

import asyncio
import contextlib
import io
import json
import logging
import pickle
import sys
import threading
import traceback
from typing import TYPE_CHECKING, Any

import pytest
import structlog

from reina.errors import InputError
from reina.sessions.record import new_id
from reina.system import logs
from reina.system.failure import ProcessFailure, failure_of
from reina.system.tokens import new_token

if TYPE_CHECKING:
    from collections.abc import Generator, Iterator


class Log:
    """What is logged, and the clock that the once a minute goes by."""

    def __init__(self) -> None:
        self.stream = io.StringIO()
        self.now = 1000.0

    @property
    def text(self) -> str:
        return self.stream.getvalue()

    @property
    def events(self) -> list[dict[str, Any]]:
        return [json.loads(line) for line in self.text.splitlines()]


@contextlib.contextmanager
def configured(**options: Any) -> Generator[Log]:
    root = logging.getLogger()
    before = root.handlers, root.level, sys.excepthook, threading.excepthook
    log = Log()
    try:
        logs.configure(log.stream, now=lambda: log.now, **options)
        yield log
    finally:
        root.handlers, sys.excepthook, threading.excepthook = before[0], before[2], before[3]
        root.setLevel(before[1])
        logging.captureWarnings(capture=False)


def fail(error: Exception) -> None:
    raise error


@pytest.fixture
def log() -> Iterator[Log]:
    with configured(form="json") as log:
        yield log


def test_both_kinds_of_loggers_write_one_object_a_line(log: Log) -> None:
    logging.getLogger("reina.sessions").warning("a worker ended with status %s", 3)
    logs.logger("reina.api").info("request", method="GET", status=200)
    first, second = log.events
    assert first.pop("timestamp").endswith("Z")
    assert first == {
        "level": "warning",
        "event": "a worker ended with status 3",
        "logger": "reina.sessions",
    }
    assert (second["event"], second["method"], second["status"]) == ("request", "GET", 200)


def test_on_a_terminal_it_is_read_by_people() -> None:
    with configured(form="text") as log:
        logging.getLogger("reina").warning("a worker ended\nwith status %s", 3)
    [line] = log.text.splitlines()
    assert "a worker ended with status 3" in line
    assert not line.startswith("{")


def test_an_unexpected_error_is_one_event_with_its_frames(log: Log) -> None:
    try:
        try:
            fail(OSError("no room"))
        except OSError as error:
            raise ValueError("of two\nlines") from error
    except ValueError:
        logging.getLogger("reina").exception("it failed")
    [event] = log.events
    assert (event["error_type"], event["error"]) == ("ValueError", "of two lines")
    assert event["cause"] == "OSError: no room"
    assert event["frames"][-1].endswith(" test_an_unexpected_error_is_one_event_with_its_frames")
    assert "Traceback" not in log.text


def test_a_traceback_that_somebody_has_written_out_is_told_by_its_frames(log: Log) -> None:
    written = ""
    try:
        fail(KeyError("x"))
    except KeyError:
        written = traceback.format_exc()
    logging.getLogger("uvicorn.error").error(f"Exception in lifespan:\n{written}")
    [event] = log.events
    assert event["event"] == "Exception in lifespan"
    assert (event["error_type"], event["error"]) == ("KeyError", "'x'")
    assert event["frames"][-1].endswith(" fail")
    assert "Traceback" not in log.text


def test_an_error_is_told_once_whoever_tells_of_it(log: Log) -> None:
    error = ValueError("x")
    logs.logger("reina.api").error("a request failed", exc_info=error)
    logging.getLogger("uvicorn.error").error("Exception in ASGI application", exc_info=error)
    assert [event["event"] for event in log.events] == ["a request failed"]


def test_what_repeats_is_told_once_a_minute_and_counted(log: Log) -> None:
    for number in range(50):
        logging.getLogger("reina").warning("the viewer %s is gone", number)
        logs.logger("reina").warning("limit", kind="connections" if number % 2 else "bytes")
    log.now += 61
    logging.getLogger("reina").warning("the viewer %s is gone", 50)
    told = [(event["event"], event.get("kind"), event.get("repeated")) for event in log.events]
    assert told == [
        ("the viewer 0 is gone", None, None),
        ("limit", "bytes", None),
        ("limit", "connections", None),
        ("the viewer 50 is gone", None, 49),
    ]


def test_other_errors_at_the_same_line_are_told_too(log: Log) -> None:
    for kind in (ValueError, KeyError, ValueError):
        logging.getLogger("reina").error("it failed", exc_info=kind("x"))
    assert [event["error_type"] for event in log.events] == ["ValueError", "KeyError"]


TOKEN, SESSION = new_token(), new_id()


@pytest.mark.parametrize(
    "text",
    [
        f"refused {TOKEN}",
        f"GET /api/v1/sessions?control_token={TOKEN}&x=1",
        f"Authorization: Bearer {TOKEN}",
        f"authorization: basic {TOKEN[:20]}",
        f"postgresql://reina:{TOKEN[:9]}@db.local/reina",
        f"/data/sessions/{SESSION}/score",
        f"password={TOKEN[:12]}",
    ],
    # Tokens are another each time, and the tests' names are not to be.
    ids=["refused", "query", "bearer", "basic", "address", "path", "password"],
)
def test_no_secret_is_written(log: Log, text: str) -> None:
    logging.getLogger("reina").warning("%s", text)
    logs.logger("reina").warning("field", field=text, several=[text])
    try:
        fail(ValueError(text))
    except ValueError:
        logging.getLogger("reina").exception("error")
    assert len(log.events) == 3
    for secret in (TOKEN, TOKEN[:20], TOKEN[:12], TOKEN[:9], SESSION):
        assert secret not in log.text


def test_what_is_no_secret_stays() -> None:
    for text in (
        "rendering 9f86d081884c7d659a2feaa0c55ad015a3bf4f1b2b0b822cd15d6c15b0f00a08 failed",
        "the example prince-of-denmarks-march.mid is left out: it is empty",
        "the_name_of_a_long_function_of_python is fine",
    ):
        assert logs.without_secrets(text) == text
    assert logs.without_secrets(f"session {SESSION}") == f"session #{logs.shown_session(SESSION)}"


def test_no_line_is_made_by_what_somebody_sends(log: Log) -> None:
    logging.getLogger("reina").warning("the file %s", 'a\n{"level": "error"}\r\n\u2028b\x1b[31m')
    assert len(log.text.splitlines()) == 1
    assert "\x1b" not in log.text


def test_the_context_goes_with_tasks_and_threads(log: Log) -> None:
    async def scenario() -> None:
        with structlog.contextvars.bound_contextvars(request_id="r1", session="s1"):
            task = asyncio.create_task(asyncio.to_thread(logging.getLogger("reina").warning, "in a thread"))
        await task
        logging.getLogger("reina").warning("outside")

    asyncio.run(scenario())
    inside, outside = log.events
    assert (inside["request_id"], inside["session"]) == ("r1", "s1")
    assert "request_id" not in outside


def test_a_thread_that_fails_is_told(log: Log) -> None:
    thread = threading.Thread(target=lambda: 1 / 0)
    thread.start()
    thread.join()
    [event] = log.events
    assert (event["event"], event["error_type"]) == ("a thread failed", "ZeroDivisionError")


def test_what_failed_in_another_process_is_told_as_it_was_there(log: Log) -> None:
    def deep() -> None:
        raise ValueError("there")

    sent = b""
    try:
        deep()
    except ValueError as error:
        sent = pickle.dumps(ProcessFailure(failure_of(error)))
    logging.getLogger("reina").error("it failed", exc_info=pickle.loads(sent))
    [event] = log.events
    assert (event["error_type"], event["error"]) == ("ValueError", "there")
    assert event["frames"][-1].endswith(" deep")


@pytest.mark.parametrize(("variable", "given"), [("REINA_LOG", "xml"), ("REINA_LOG_LEVEL", "loud")])
def test_an_unknown_form_or_level_is_refused(
    monkeypatch: pytest.MonkeyPatch, variable: str, given: str
) -> None:
    monkeypatch.setenv(variable, given)
    with pytest.raises(InputError, match=variable), configured():
        pass


def test_the_level_is_chosen(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("REINA_LOG_LEVEL", "warning")
    with configured(form="json") as log:
        logging.getLogger("reina").info("no")
        logging.getLogger("reina").warning("yes")
    assert [event["event"] for event in log.events] == ["yes"]
