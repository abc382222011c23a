"""The log: one event a line, for people on a terminal and as JSON elsewhere, without secrets and tracebacks.

What is logged by `structlog` and by the standard library's `logging`, of Reina and of what it stands on, goes
the same way. docs/operating.md says what an event holds.
"""

from __future__ import annotations

import hashlib
import logging
import os
import re
import sys
import threading
import time
from functools import cached_property
from typing import TYPE_CHECKING, Any, TextIO, cast

from reina.errors import InputError
from reina.system.failure import MOST_FRAMES, Failure, failure_of, shown_file
from reina.system.json_text import json_text
from reina.system.log_rate import Seldom

if TYPE_CHECKING:
    from collections.abc import Callable, MutableMapping
    from types import TracebackType

    import structlog

    EventDict = MutableMapping[str, Any]

FORM_VARIABLE, LEVEL_VARIABLE = "REINA_LOG", "REINA_LOG_LEVEL"
FORMS = ("json", "text")
LEVELS = ("debug", "info", "warning", "error")
LONGEST_TEXT = 500
"""Characters of an event and of each of its fields."""
HASH_DIGITS = 8
EACH = {"_each": True}
"""The field of events that are all written, however often they happen."""
PLAIN_FIELDS = frozenset({"timestamp", "level", "logger", "request_id", "session", "frames", "error_type"})
"""Fields that Reina itself makes: nothing in them comes from outside but a request's id, which is checked."""

_WORDS = re.compile(r"(?<![\w-])[\w-]{22,}(?![\w-])", re.ASCII)
_SESSION_ID_LENGTH, _SHORTEST_SECRET = 22, 32
_PLAIN_WORD = re.compile(r"[a-z_-]+|[0-9a-f]+")
"""Names and digests: nothing of these is a token."""
_BEARER = re.compile(r"(?i)\b(bearer|basic)\s+\S+")
_NAMED_SECRET = re.compile(r"(?i)(\b\w*(?:token|secret|password|key|code)\w*=)[^&\s\"']+")
_USER_IN_ADDRESS = re.compile(r"(\w://)[^/\s@]+@")
_UNPRINTABLE = re.compile(r"[\x00-\x1f\x7f-\x9f\u2028\u2029]+")
_WRITTEN_FRAME = re.compile(r'File "([^"]+)", line (\d+), in (\S+)')
_WRITTEN_TRACEBACK = "Traceback (most recent call last)"


def logger(name: str) -> structlog.stdlib.BoundLogger:
    """A logger of events with fields, by the name of its module."""
    import structlog

    structlog.configure(
        processors=[structlog.stdlib.ProcessorFormatter.wrap_for_formatter],
        wrapper_class=structlog.stdlib.BoundLogger,
        logger_factory=structlog.stdlib.LoggerFactory(),
    )
    made: structlog.stdlib.BoundLogger = structlog.get_logger(name)
    return made


def shown_session(session_id: str) -> str:
    """What a log says of a session: who has its id may watch it, who has this may not.

    An id has 128 random bits, so that it cannot be searched for by a part of its digest.
    """
    return hashlib.sha256(session_id.encode()).hexdigest()[:HASH_DIGITS]


def without_secrets(text: str) -> str:
    """A text on one line, in part where it is long, with nothing in it that would let somebody in.

    What stands as a value of a token or password, in an address too, is left out; so is every word that is
    long and random enough to be one. Ids of sessions become what `shown_session` says.
    """
    line = _UNPRINTABLE.sub(" ", text)
    line = _USER_IN_ADDRESS.sub(r"\1[secret]@", line)
    line = _BEARER.sub(r"\1 [secret]", line)
    line = _NAMED_SECRET.sub(r"\1[secret]", line)
    line = _WORDS.sub(_shown_word, line)
    return line if len(line) <= LONGEST_TEXT else f"{line[: LONGEST_TEXT - 1]}…"


def configure(
    stream: TextIO | None = None,
    *,
    form: str | None = None,
    level: str | None = None,
    now: Callable[[], float] = time.monotonic,
) -> None:
    """Have everything logged to a stream, in place of what was configured before.

    Args:
        stream: Standard error when None.
        form: ``"json"`` or ``"text"``; when None REINA_LOG says it, else JSON where it is no
            terminal.
        level: From which level on; when None REINA_LOG_LEVEL says it, else ``"info"``.
        now: Seconds; of one kind a line is written once a minute of these.

    Raises:
        InputError: There is no such form or level.
    """
    to = stream or sys.stderr
    chosen = _one_of(FORM_VARIABLE, form, FORMS, "text" if to.isatty() else "json")
    lowest = _one_of(LEVEL_VARIABLE, level, LEVELS, "info")
    handler = logging.StreamHandler(to)
    handler.addFilter(_OnceAMinute(now))
    handler.setFormatter(_Lines(as_json=chosen == "json", colors=to.isatty()))
    root = logging.getLogger()
    root.handlers = [handler]
    root.setLevel(lowest.upper())
    # A viewer that goes in the middle of some frames is no news.
    logging.getLogger("asyncio").setLevel(logging.ERROR)
    # Which tables are made is told where it goes wrong.
    logging.getLogger("alembic").setLevel(logging.WARNING)
    logging.captureWarnings(capture=True)
    sys.excepthook = _fell
    threading.excepthook = _thread_fell


def _one_of(variable: str, given: str | None, known: tuple[str, ...], otherwise: str) -> str:
    named = given or os.environ.get(variable, "").strip().lower() or otherwise
    if named not in known:
        raise InputError(f"{variable} is {' or '.join(known)}, not {named!r}")
    return named


class _Lines(logging.Formatter):
    """Lines as structlog writes them, which is imported with the first: most processes of long work log none.

    Args:
        as_json: Whether each line is an object in JSON.
        colors: Whether a line that is not has colours.
    """

    def __init__(self, *, as_json: bool, colors: bool) -> None:
        super().__init__()
        self._as_json, self._colors = as_json, colors

    def format(self, record: logging.LogRecord) -> str:
        """The line of a record."""
        return self._written.format(record)

    @cached_property
    def _written(self) -> logging.Formatter:
        import structlog

        render: Any = _json if self._as_json else structlog.dev.ConsoleRenderer(colors=self._colors)
        return structlog.stdlib.ProcessorFormatter(
            processors=[
                _described,
                structlog.contextvars.merge_contextvars,
                _failed,
                structlog.stdlib.ProcessorFormatter.remove_processors_meta,
                _cleaned,
                render,
            ]
        )


class _OnceAMinute(logging.Filter):
    """Lets a line of each kind through once a minute, and of each error once, whoever tells of it."""

    def __init__(self, now: Callable[[], float]) -> None:
        super().__init__()
        self._seldom = Seldom(now=now)

    def filter(self, record: logging.LogRecord) -> bool:
        """Whether a record is written; how many like it were not is noted in it."""
        error = _error_of(record)
        if error is not None and getattr(error, "__reina_logged__", False):
            return False
        message: object = record.msg
        fields = cast("dict[str, Any]", message) if isinstance(message, dict) else {}
        if fields.keys() & EACH.keys():
            return True
        failure = failure_of(error) if error is not None else None
        kind = (
            record.name,
            record.levelno,
            fields.get(
                "event", message if isinstance(message, str) else type(cast("object", message)).__name__
            ),
            fields.get("kind"),
            (failure.kind, failure.place) if failure else None,
        )
        count = self._seldom.count(kind)
        if error is not None:
            error.__reina_logged__ = True  # type: ignore[attr-defined]
        if count is None:
            return False
        record.repeated = count
        return True


def _error_of(record: logging.LogRecord) -> BaseException | None:
    message: object = record.msg
    told: object = record.exc_info
    if isinstance(message, dict):
        told = cast("dict[str, Any]", message).get("exc_info")
    return _exception(told)


def _exception(told: object) -> BaseException | None:
    if told is True:
        return sys.exc_info()[1]
    if isinstance(told, tuple):
        return cast("tuple[Any, BaseException | None, Any]", told)[1]
    return told if isinstance(told, BaseException) else None


def _described(_logger: object, _method: str, event: EventDict) -> EventDict:
    record: logging.LogRecord = event["_record"]
    described: EventDict = {
        "timestamp": _time(record.created),
        "level": record.levelname.lower(),
        "event": event.pop("event"),
        "logger": record.name,
        **event,
    }
    if repeated := getattr(record, "repeated", 0):
        described["repeated"] = repeated
    return described


def _time(created_s: float) -> str:
    milliseconds = int(created_s * 1000) % 1000
    return f"{time.strftime('%Y-%m-%dT%H:%M:%S', time.gmtime(created_s))}.{milliseconds:03d}Z"


def _failed(_logger: object, _method: str, event: EventDict) -> EventDict:
    """Tell an exception by fields, and no traceback that somebody has written out."""
    for name in ("stack_info", *EACH):
        event.pop(name, None)
    error = _exception(event.pop("exc_info", None))
    failure = failure_of(error) if error is not None else None
    if _WRITTEN_TRACEBACK in str(event["event"]):
        before, failure = _read_traceback(str(event["event"]))
        event["event"] = before or "an unexpected error"
    if failure is not None:
        event["error_type"], event["error"] = failure.kind, failure.message
        if failure.cause:
            event["cause"] = failure.cause
        event["frames"] = list(failure.frames)
    return event


def _read_traceback(text: str) -> tuple[str, Failure]:
    """What stands before a traceback that was written out, and what it tells."""
    before, _, written = text.partition(_WRITTEN_TRACEBACK)
    last = written.strip().splitlines()[-1] if written.strip() else ""
    kind, _, message = last.partition(": ")
    frames = tuple(
        f"{shown_file(file)}:{line} {name}"
        for file, line, name in _WRITTEN_FRAME.findall(written)[-MOST_FRAMES:]
    )
    return before.strip().rstrip(":"), Failure(kind.strip(), message, frames)


def _cleaned(_logger: object, _method: str, event: EventDict) -> EventDict:
    for name, value in event.items():
        if name not in PLAIN_FIELDS and not isinstance(value, int | float | None):
            event[name] = without_secrets(str(value))
    return event


def _json(_logger: object, _method: str, event: EventDict) -> str:
    return json_text(dict(event)).decode()


def _shown_word(found: re.Match[str]) -> str:
    word = found.group()
    if _PLAIN_WORD.fullmatch(word):
        return word
    if len(word) == _SESSION_ID_LENGTH:
        return f"#{shown_session(word)}"
    return "[secret]" if len(word) >= _SHORTEST_SECRET else word


def _fell(kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> None:
    if issubclass(kind, KeyboardInterrupt):
        return
    logging.getLogger("reina").error("the program failed", exc_info=(kind, error, trace))


def _thread_fell(what: threading.ExceptHookArgs) -> None:
    if what.exc_value is not None:
        logging.getLogger("reina").error("a thread failed", exc_info=what.exc_value)
