"""How often one address may ask for what costs much."""

from __future__ import annotations

import logging
import math
from collections import OrderedDict, deque
from dataclasses import dataclass
from typing import TYPE_CHECKING

from starlette.routing import compile_path

from reina.api.http.problems import ProblemError
from reina.api.http.proxies import client_address, counted_as
from reina.errors import InputError
from reina.protocol.links import API

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from starlette.types import ASGIApp, Receive, Scope, Send

WINDOW_S = 60.0
MOST_A_MINUTE = {"uploads": 60, "transcriptions": 20, "frames": 600, "exports": 60}
"""By kind: enough for a classroom behind one address. A film is made of 15 spans of frames for a minute."""
KINDS = {
    ("POST", "/sessions"): "uploads",
    ("PUT", "/sessions/{session_id}/song/analysis"): "uploads",
    ("POST", "/transcriptions"): "transcriptions",
    ("GET", "/sessions/{session_id}/frames"): "frames",
    ("GET", "/sessions/{session_id}/export.bvh"): "exports",
    ("GET", "/sessions/{session_id}/export.mid"): "exports",
}
"""What is counted, by method and address."""
_PATTERNS = [(method, compile_path(path)[0], kind) for (method, path), kind in KINDS.items()]
MOST_ADDRESSES = 10_000
"""Of more, the one that asked longest ago is forgotten."""

_log = logging.getLogger(__name__)


@dataclass(frozen=True)
class Rates:
    """How many requests of a kind one address has in a minute.

    Attributes:
        most: By kind; 0 is any number.
    """

    most: Mapping[str, int]

    @classmethod
    def named(cls, text: str) -> Rates:
        """Rates as they are set: ``uploads=120 frames=0``; what is not named is as by default.

        Raises:
            InputError: A kind or a number is none.
        """
        most = dict(MOST_A_MINUTE)
        for entry in text.split():
            kind, _, number = entry.partition("=")
            if kind not in most or not (number.isascii() and number.isdecimal()):
                usual = " ".join(f"{name}={count}" for name, count in MOST_A_MINUTE.items())
                raise InputError(
                    f"REINA_RATES says how many of a kind one address has in a minute, such as {usual} "
                    f"(0 is any number), not {entry!r}"
                )
            most[kind] = int(number)
        return cls(most)


class Counter:
    """Counts what each does in a window that slides.

    Args:
        now: A clock, seconds, that never goes back.
    """

    def __init__(self, now: Callable[[], float]) -> None:
        self._now = now
        self._times: OrderedDict[tuple[str, str], deque[float]] = OrderedDict()

    def take(self, kind: str, who: str, most: int) -> float:
        """Count one, unless there were enough.

        Args:
            kind: What is done.
            who: By whom.
            most: How many are enough in a window.

        Returns:
            0, or how long it is until there may be one more, seconds.
        """
        now = self._now()
        times = self._times.setdefault((kind, who), deque())
        self._times.move_to_end((kind, who))
        while len(self._times) > MOST_ADDRESSES:
            self._times.popitem(last=False)
        while times and now - times[0] >= WINDOW_S:
            times.popleft()
        if len(times) >= most:
            return times[-most] + WINDOW_S - now
        times.append(now)
        return 0.0


class BoundedRates:
    """ASGI middleware: who asks too often for what costs much has 429. This machine's own are not counted.

    Args:
        app: What answers.
        rates: How often.
        now: A clock, seconds, that never goes back.
    """

    def __init__(self, app: ASGIApp, rates: Rates, now: Callable[[], float]) -> None:
        self._app = app
        self._rates = rates
        self._counter = Counter(now)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass on, or refuse."""
        if scope["type"] == "http" and (problem := self._objection(scope)):
            await problem.response()(scope, receive, send)
            return
        await self._app(scope, receive, send)

    def _objection(self, scope: Scope) -> ProblemError | None:
        kind = _kind_of(scope["method"], scope["path"])
        most = self._rates.most[kind] if kind else 0
        who = counted_as(client_address(scope))
        if not kind or not most or who is None:
            return None
        wait_s = math.ceil(self._counter.take(kind, who, most))
        if not wait_s:
            return None
        _log.warning("an address has asked for more than %s %s in a minute", most, kind)
        return ProblemError(
            429,
            "too-often",
            "Too Many Requests",
            f"one address has {most} {kind} in a minute; the next is taken in {wait_s} s",
            headers={"Retry-After": str(wait_s)},
        )


def _kind_of(method: str, path: str) -> str | None:
    below = path.removeprefix(API)
    return next(
        (kind for wanted, pattern, kind in _PATTERNS if wanted == method and pattern.match(below)), None
    )
