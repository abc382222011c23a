"""The bus between servers on Redis: a channel a session, and its clock as a hash that is changed by turns."""

from __future__ import annotations

import asyncio
import contextlib
import logging
import secrets
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any

from pydantic import ValidationError

from reina.errors import InputError
from reina.sessions.bus.bus import BusAwayError
from reina.sessions.bus.notices import ClockSet, SharedClock, notice
from reina.sessions.kept_clock import KeptClock

if TYPE_CHECKING:
    from collections.abc import Awaitable, Callable

    from reina.sessions.bus.notices import Notice

KEPT_S = 86_400
"""So long after its last change a clock is held; the database has it for ever."""
PATIENCE_S = 2.0
"""What has not answered by then is away."""
LISTENING_S = 5.0
"""Where nothing is told for so long, it is asked whether the bus is still there."""
FIRST_RETRY_S, LAST_RETRY_S = 0.05, 1.0
CHANNEL = "reina:{%s}"
"""What is in braces decides, in a cluster of Redis, where a key is."""
SERVER = "reina:server:"
"""Begins the name of the channel of one server alone, on which nobody talks: a subscription to begin with."""

SET_CLOCK = """
local turn = tonumber(redis.call('HGET', KEYS[1], 'turn') or ARGV[1])
if turn ~= tonumber(ARGV[1]) then return {turn, redis.call('HGET', KEYS[1], 'clock')} end
redis.call('HSET', KEYS[1], 'turn', turn + 1, 'clock', ARGV[2])
redis.call('EXPIRE', KEYS[1], ARGV[4])
redis.call('PUBLISH', KEYS[2], ARGV[3])
return false
"""
"""Changes a clock if its turn is the one that is known, and tells of it: nobody comes in between."""
CLAIM = """
local by = redis.call('GET', KEYS[1])
if by and by ~= ARGV[1] then return 0 end
redis.call('SET', KEYS[1], ARGV[1], 'PX', ARGV[2])
return 1
"""

_log = logging.getLogger(__name__)


class RedisBus:
    """A `Bus` on Redis; it may go and come back at any time.

    Args:
        url: ``redis://[user:password@]host[:port][/database]``, ``rediss://`` by TLS, or ``unix:///path``.

    Raises:
        InputError: It is no such address, or what speaks to Redis is not installed.
    """

    def __init__(self, url: str) -> None:
        if find_spec("redis") is None:
            raise InputError(
                'a bus on Redis needs a client that is not installed: pip install "reina[redis]"'
            )
        # What servers of their own never need is loaded by those alone that have a bus.
        from redis import asyncio as redis
        from redis.exceptions import RedisError

        self._failures = (RedisError, OSError, TimeoutError)
        try:
            self._redis: Any = redis.Redis.from_url(  # pyright: ignore[reportUnknownMemberType] - its options
                url, socket_timeout=PATIENCE_S, socket_connect_timeout=PATIENCE_S, decode_responses=True
            )
        except ValueError as error:
            raise InputError(
                f"the bus's address cannot be read: {error}; it is as redis://:password@host:6379/0"
            ) from None
        self.server_id = secrets.token_hex(8)
        """Tells this server's notices from the others'."""
        self._set_clock: Any = self._redis.register_script(SET_CLOCK)
        self._claim: Any = self._redis.register_script(CLAIM)
        self._followed: set[str] = set()
        self._subscriptions: Any = None
        self._confirmed: dict[str, asyncio.Future[None]] = {}
        self._telling: asyncio.Queue[tuple[str, Notice]] = asyncio.Queue()
        self._tasks: list[asyncio.Task[None]] = []
        self._away = False

    async def start(self, heard: Callable[[str, Notice], None], back: Callable[[], None]) -> None:
        """Listen from now on; see `Bus.start`."""
        self._tasks = [asyncio.create_task(self._listen(heard, back)), asyncio.create_task(self._tell())]

    async def aclose(self) -> None:
        """Listen no more; what is still to be told is told first, where that is soon."""
        with contextlib.suppress(TimeoutError):
            async with asyncio.timeout(PATIENCE_S):
                await self._telling.join()
        for task in self._tasks:
            task.cancel()
        if self._tasks:
            await asyncio.wait(self._tasks)
        await self._redis.aclose()

    async def check(self) -> None:
        """See that it answers."""
        await self._asked(self._redis.ping())

    async def follow(self, session_id: str) -> None:
        """Hear of a session; where the bus is away, from when it is back."""
        self._followed.add(session_id)
        subscriptions = self._subscriptions
        if subscriptions is None:
            return
        channel = CHANNEL % session_id
        confirmed = self._confirmed.setdefault(channel, asyncio.get_running_loop().create_future())
        try:
            async with asyncio.timeout(PATIENCE_S):
                await subscriptions.subscribe(channel)
                await asyncio.shield(confirmed)
        except self._failures:
            # Who listens finds it broken as well, and subscribes to all anew.
            pass

    def unfollow(self, session_id: str) -> None:
        """Hear no more of it."""
        self._followed.discard(session_id)
        if self._subscriptions is not None and self._tasks:
            leaving = asyncio.create_task(self._unsubscribe(CHANNEL % session_id))
            self._tasks.append(leaving)
            leaving.add_done_callback(self._tasks.remove)

    def tell(self, session_id: str, notice: Notice) -> None:
        """Tell of a session, in the order of these calls."""
        self._telling.put_nowait((session_id, notice))

    async def clock(self, session_id: str) -> SharedClock | None:
        """A session's clock as all have it."""
        turn, clock = await self._asked(self._redis.hmget(_clock_key(session_id), "turn", "clock"))
        return None if turn is None else _shared(turn, clock)

    async def set_clock(self, session_id: str, clock: KeptClock, turn: int) -> SharedClock | None:
        """Change a session's clock for all, and tell them; see `Bus.set_clock`."""
        told = ClockSet(sender=self.server_id, shared=SharedClock(turn=turn + 1, clock=clock))
        other = await self._asked(
            self._set_clock(
                keys=[_clock_key(session_id), CHANNEL % session_id],
                args=[turn, clock.model_dump_json(), told.model_dump_json(), KEPT_S],
            )
        )
        return None if other is None else _shared(*other)

    async def claim(self, work: str, for_s: float) -> bool:
        """Whether this server is the one to do something."""
        args = [self.server_id, int(for_s * 1000)]
        return bool(await self._asked(self._claim(keys=[f"reina:{work}"], args=args)))

    async def _asked(self, answer: Awaitable[Any]) -> Any:
        try:
            return await answer
        except self._failures as error:
            raise BusAwayError(f"the bus between the servers does not answer: {error}") from error

    async def _unsubscribe(self, channel: str) -> None:
        with contextlib.suppress(*self._failures):
            await self._subscriptions.unsubscribe(channel)

    async def _tell(self) -> None:
        """Tell one thing after another; what cannot be told is not: the others ask when the bus is back."""
        while True:
            session_id, told = await self._telling.get()
            try:
                await self._redis.publish(CHANNEL % session_id, notice.dump_json(told))
            except self._failures as error:
                self._note_away(error)
            finally:
                self._telling.task_done()

    async def _listen(self, heard: Callable[[str, Notice], None], back: Callable[[], None]) -> None:
        retry_s = FIRST_RETRY_S
        while True:
            subscriptions = self._redis.pubsub()
            try:
                own = f"{SERVER}{self.server_id}"
                await subscriptions.subscribe(own, *(CHANNEL % each for each in self._followed))
                self._subscriptions = subscriptions
                if self._away:
                    self._away = False
                    _log.info("the bus between the servers is back")
                retry_s = FIRST_RETRY_S
                back()
                silent = False
                while True:
                    message = await subscriptions.get_message(timeout=LISTENING_S)
                    if message is not None:
                        silent = False
                        self._take(message, heard)
                    elif silent:
                        raise ConnectionError("it answers no ping")
                    else:
                        silent = True
                        await subscriptions.ping()
            except self._failures as error:
                self._note_away(error)
            finally:
                self._subscriptions = None
                with contextlib.suppress(*self._failures):
                    await subscriptions.aclose()
            await asyncio.sleep(retry_s)
            retry_s = min(2 * retry_s, LAST_RETRY_S)

    def _note_away(self, error: Exception) -> None:
        if not self._away:
            self._away = True
            _log.warning("the bus between the servers is away: %s", error)

    def _take(self, message: dict[str, Any], heard: Callable[[str, Notice], None]) -> None:
        channel: str = message["channel"]
        if message["type"] == "subscribe":
            confirmed = self._confirmed.pop(channel, None)
            if confirmed is not None and not confirmed.done():
                confirmed.set_result(None)
        elif message["type"] == "message" and not channel.startswith(SERVER):
            try:
                told = notice.validate_json(message["data"])
            except ValidationError as error:
                # Of another version, say: what is kept has another one too, and says more.
                _log.warning("a notice on the bus cannot be read: %s", error.errors()[0]["msg"])
                return
            if told.sender != self.server_id:
                heard(channel[len("reina:{") : -1], told)


def _clock_key(session_id: str) -> str:
    return f"{CHANNEL % session_id}:clock"


def _shared(turn: object, clock: str) -> SharedClock:
    return SharedClock(turn=int(str(turn)), clock=KeptClock.model_validate_json(clock))
