"""One viewer's outbox: bounded, so that whoever reads slowly loses frames and costs nobody anything."""

from __future__ import annotations

import asyncio
import contextlib
import math
from collections import deque
from typing import TYPE_CHECKING, Protocol

from reina.performance import BLOCK_FRAMES
from reina.sessions.broadcast import LEAD_S
from reina.system.metrics import limit_hit, tally

if TYPE_CHECKING:
    from reina.sessions.packed_blocks import Form

GOING_AWAY = 1001
INTERNAL_ERROR = 1011
TRY_AGAIN_LATER = 1013
FRAMES_WAITING = 12
"""Most frames that wait for a viewer, beside what a greater lead brings; of more the oldest are dropped."""
BLOCKS_WAITING = 16
"""Most packed blocks that wait; one that is dropped the viewer fetches."""
FRAMES_A_SECOND = 60
"""As many frames are due in a second at most."""
MESSAGES_WAITING = 256
"""Most control messages that wait; when more come, the viewer is closed with 1013 and may come again."""
CLOSING_GRACE_S = 10.0
"""How long a viewer that is closed for being too slow is waited for."""


class Connection(Protocol):
    """What a viewer is reached by; each call returns once more may be sent."""

    async def send_bytes(self, data: bytes) -> None:
        """Send a binary message."""
        ...

    async def send_text(self, data: str) -> None:
        """Send a text message."""
        ...

    async def close(self, code: int, reason: str) -> None:
        """End the connection."""
        ...


class Viewer:
    """Somebody who watches a session.

    `post_text` and `post_frames` never wait; `run` sends what was posted, as fast as the connection takes it.

    Args:
        connection: Where it goes.
        frames_per_message: How many frames the viewer wants in a binary message.
        form: The form of the packed blocks that it wants in place of frames; None for frames.
    """

    def __init__(
        self, connection: Connection, *, frames_per_message: int = 1, form: Form | None = None
    ) -> None:
        self.form: Form | None = form
        """The form of the packed blocks that it is sent; None where it is sent frames."""
        self.frames_per_message = frames_per_message if form is None else BLOCK_FRAMES
        self.lead_s = LEAD_S
        """How long before they are due its frames are sent, seconds."""
        self.dropped = 0
        """Binary messages that it was too slow for."""
        self._connection = connection
        self._texts: deque[str] = deque()
        self._frames: deque[bytes] = deque(maxlen=self._most_waiting())
        self._posted = asyncio.Event()
        self._ended = asyncio.Event()
        self._ending = (TRY_AGAIN_LATER, "")

    def post_text(self, text: str) -> None:
        """Queue a control message; it goes out before any frames that wait."""
        if len(self._texts) >= MESSAGES_WAITING:
            limit_hit("viewer-messages")
            self.end(TRY_AGAIN_LATER, "too many messages wait; connect again")
            return
        self._texts.append(text)
        self._posted.set()

    def take_lead(self, lead_s: float) -> None:
        """From now on frames are posted so long before they are due, seconds, rounded up to a tenth.

        Viewers of the same lead share what is encoded.
        """
        self.lead_s = math.ceil(round(lead_s * 10, 6)) / 10
        self._frames = deque(self._frames, maxlen=self._most_waiting())

    def post_frames(self, message: bytes) -> None:
        """Queue a binary message, in place of the oldest when too many wait."""
        if len(self._frames) == self._frames.maxlen:
            self.dropped += 1
            tally.frames_lost += self.frames_per_message
        self._frames.append(message)
        self._posted.set()

    def end(self, code: int, reason: str) -> None:
        """Have `run` close the connection."""
        self._ending = (code, reason)
        self._ended.set()

    def drop_frames(self) -> None:
        """Forget the frames that wait: a new epoch has made them worthless."""
        self._frames.clear()

    @property
    def waiting(self) -> int:
        """Messages that wait to be sent."""
        return len(self._texts) + len(self._frames)

    async def run(self) -> None:
        """Send what is posted until cancelled, or until the viewer is to be closed, and close it then."""
        sending = asyncio.create_task(self._send())
        ended = asyncio.create_task(self._ended.wait())
        try:
            await asyncio.wait({sending, ended}, return_when=asyncio.FIRST_COMPLETED)
            if sending.done():
                await sending  # raises what ended it
            sending.cancel()
            # A viewer that does not read is told so when it reads again, if it does so soon.
            with contextlib.suppress(TimeoutError):
                async with asyncio.timeout(CLOSING_GRACE_S):
                    await self._connection.close(*self._ending)
        finally:
            sending.cancel()
            ended.cancel()

    def _most_waiting(self) -> int:
        if self.form is not None:
            return BLOCKS_WAITING
        frames = FRAMES_WAITING + math.ceil((self.lead_s - LEAD_S) * FRAMES_A_SECOND)
        return max(2, frames // self.frames_per_message)

    async def _send(self) -> None:
        while True:
            await self._posted.wait()
            self._posted.clear()
            while self._texts or self._frames:
                if self._texts:
                    await self._connection.send_text(self._texts.popleft())
                else:
                    message = self._frames.popleft()
                    await self._connection.send_bytes(message)
                    tally.frames_sent += self.frames_per_message
                    tally.stream_bytes += len(message)
