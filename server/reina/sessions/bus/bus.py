"""Between servers that serve the same sessions: what one changes, the others hear of."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

from reina.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Callable

    from reina.sessions.bus.notices import Notice, SharedClock
    from reina.sessions.kept_clock import KeptClock


class BusAwayError(InputError):
    """What connects the servers does not answer now; it may later."""


class Bus(Protocol):
    """What connects servers: it carries notices, and holds the clocks that they share.

    Its methods are called on the event loop. Those that ask raise `BusAwayError` where it does not answer;
    what is told then is not: whoever listens is called `back` once it answers again, and asks anew.

    Attributes:
        server_id: Tells this server's notices from the others'.
    """

    server_id: str

    async def start(self, heard: Callable[[str, Notice], None], back: Callable[[], None]) -> None:
        """Listen from now on.

        Args:
            heard: Called with a session's id and what was told of it.
            back: Called when notices may have been missed.
        """
        ...

    async def aclose(self) -> None:
        """Listen no more."""
        ...

    async def check(self) -> None:
        """See that it answers."""
        ...

    async def follow(self, session_id: str) -> None:
        """Hear of a session; when this returns, nothing that is told from now on is missed."""
        ...

    def unfollow(self, session_id: str) -> None:
        """Hear no more of it."""
        ...

    def tell(self, session_id: str, notice: Notice) -> None:
        """Tell of a session, in the order of these calls."""
        ...

    async def clock(self, session_id: str) -> SharedClock | None:
        """A session's clock as all have it; None where nobody has changed it for long."""
        ...

    async def set_clock(self, session_id: str, clock: KeptClock, turn: int) -> SharedClock | None:
        """Change a session's clock for all, and tell them.

        Args:
            session_id: Whose.
            clock: Where it is to stand.
            turn: The turn that is known here.

        Returns:
            None when it is done; where another server was first, what the clock is instead.
        """
        ...

    async def claim(self, work: str, for_s: float) -> bool:
        """Whether this server is the one to do something; what it has claimed it claims again to keep it.

        Args:
            work: What, by a name of its own.
            for_s: For how long.
        """
        ...
