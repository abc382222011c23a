"""One viewer: sent to at once, and by a bounded queue while it lags, so that it costs nobody anything."""

from __future__ import annotations

import asyncio
import math
from collections import deque
from typing import TYPE_CHECKING, Protocol

from reina.performance import BLOCK_FRAMES
from reina.sessions.broadcast import LEAD_S
from reina.system.metrics import limit_hit, tally

if TYPE_CHECKING:
    from collections.abc import Callable

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


def count_sent(frame: bytes, frames: int, viewers: int) -> None:
    """Count a binary message that so many viewers were sent.

    Args:
        frame: The message as a WebSocket frame.
        frames: How many frames of the stage are in it.
        viewers: How many.
    """
    tally.frames_sent += frames * viewers
    tally.stream_bytes += len(frame) * viewers


class Connection(Protocol):
    """What a viewer is reached by: whole WebSocket frames are written into it."""

    is_full: bool
    """Whether what was written is still on its way, so that nothing more is to be written."""
    on_free: Callable[[], None] | None
    """Called when it is full no more."""

    def write(self, frame: bytes) -> None:
        """Send a frame on its way; into a connection that ends it goes unsaid."""
        ...

    async def close(self, code: int, reason: str) -> None:
        """End the connection, though nobody reads at the other end."""
        ...


class Viewer:
    """Somebody who watches a session.

    What is posted is written at once, as long as the viewer takes it: it costs no task, no queue and no copy.
    For who lags it waits, in bounds, until there is room again.

    Args:
        connection: Where it goes.
        frames_per_message: How many frames the viewer wants in a binary message.
        form: The form of the packed blocks that it wants in place of frames; None for frames.
        hears_notes: Whether it is told of notes as they begin and end.
    """

    def __init__(
        self,
        connection: Connection,
        *,
        frames_per_message: int = 1,
        form: Form | None = None,
        hears_notes: bool = True,
    ) -> None:
        self.hears_notes = hears_notes
        """Whether it is told of notes as they begin and end."""
        self.form: Form | None = form
        """The form of the packed blocks that it is sent; None where it is sent frames."""
        self.frames_per_message = frames_per_message if form is None else BLOCK_FRAMES
        self.lead_s = LEAD_S
        """How long before they are due its frames are sent, seconds."""
        self.dropped = 0
        """Binary messages that it was too slow for."""
        self._connection = connection
        connection.on_free = self._send_waiting
        self._texts: deque[bytes] | None = None
        self._frames: deque[bytes] | None = None
        self._ending: asyncio.Task[None] | None = None

    def post_text(self, frame: bytes) -> None:
        """Send a control message; where it has to wait, it goes out before any frames that wait.

        Args:
            frame: The message as a WebSocket frame.
        """
        if self._ending is not None:
            return
        if not self._connection.is_full:
            self._connection.write(frame)
            return
        if self._texts is None:
            self._texts = deque()
        if len(self._texts) >= MESSAGES_WAITING:
            limit_hit("viewer-messages")
            self.end(TRY_AGAIN_LATER, "too many messages wait; connect again")
            return
        self._texts.append(frame)

    def take_lead(self, lead_s: float) -> None:
        """From now on frames are posted so long before they are due, seconds, rounded up to a tenth.

        Viewers of the same lead share what is encoded.
        """
        self.lead_s = math.ceil(round(lead_s * 10, 6)) / 10
        if self._frames is not None:
            self._frames = deque(self._frames, maxlen=self._most_waiting())

    def post_frames(self, frame: bytes) -> bool:
        """Send a binary message; where it has to wait, in place of the oldest when too many do.

        Args:
            frame: The message as a WebSocket frame.

        Returns:
            Whether it went out at once, for who counts what all viewers were sent (`count_sent`).
        """
        if not self._connection.is_full and self._ending is None:
            self._connection.write(frame)
            return True
        if self._ending is None:
            self._queue(frame)
        return False

    def end(self, code: int, reason: str) -> None:
        """Close the connection; what waits is not sent any more."""
        if self._ending is None:
            self._texts = self._frames = None
            self._ending = asyncio.create_task(self._connection.close(code, reason))

    def let_go(self) -> None:
        """It has gone: nothing is waited for any more."""
        self._connection.on_free = None

    def drop_frames(self) -> None:
        """Forget the frames that wait: a new epoch has made them worthless."""
        self._frames = None

    @property
    def waiting(self) -> int:
        """Messages that wait to be sent."""
        return len(self._texts or ()) + len(self._frames or ())

    def _queue(self, frame: bytes) -> None:
        if self._frames is None:
            self._frames = deque(maxlen=self._most_waiting())
        if len(self._frames) == self._frames.maxlen:
            self.dropped += 1
            tally.frames_lost += self.frames_per_message
        self._frames.append(frame)

    def _most_waiting(self) -> int:
        if self.form is not None:
            return BLOCKS_WAITING
        frames = FRAMES_WAITING + math.ceil((self.lead_s - LEAD_S) * FRAMES_A_SECOND)
        return max(2, frames // self.frames_per_message)

    def _send_waiting(self) -> None:
        texts, frames = self._texts, self._frames
        while texts and not self._connection.is_full:
            self._connection.write(texts.popleft())
        while frames and not self._connection.is_full:
            frame = frames.popleft()
            self._connection.write(frame)
            count_sent(frame, self.frames_per_message, 1)
        # Who keeps up again has no queue.
        if not texts:
            self._texts = None
        if not frames:
            self._frames = None
