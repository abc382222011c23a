"""What is being sent: where it is put, and how large it may be, of all senders together and of one."""

from __future__ import annotations

import asyncio
import shutil
import threading
from contextlib import asynccontextmanager
from typing import TYPE_CHECKING

from reina.sessions.limit_errors import NoRoomError, SenderLimitError
from reina.system.room import NoRoomLeftError, Room

if TYPE_CHECKING:
    from collections.abc import AsyncGenerator, Callable
    from pathlib import Path

MEGABYTE = 1_000_000
STAGING_BYTES = 2_000 * MEGABYTE
"""How large the files that are being sent or worked at may be together; one sender has half of it."""
RETRY_S = 30


class StagingRoom:
    """Counts the bytes of folders that are being filled. For several threads.

    Args:
        most_bytes: How large all may be together; one sender's half as much.
    """

    def __init__(self, most_bytes: int = STAGING_BYTES) -> None:
        self._room = Room(most_bytes, most_bytes // 2)
        self._counting = threading.Lock()
        self._folders: dict[Path, tuple[str, int]] = {}

    @property
    def held(self) -> int:
        """Bytes that are being sent or worked at."""
        return self._room.held

    def of(self, sender: str) -> int:
        """How many of them one sends."""
        with self._counting:
            return self._room.of(sender)

    def begin(self, folder: Path, sender: str) -> None:
        """A folder that is going to be filled."""
        with self._counting:
            self._folders[folder] = (sender, 0)

    def size(self, folder: Path) -> int:
        """How many bytes have come for a folder."""
        with self._counting:
            return self._folders[folder][1]

    def grow(self, folder: Path, count: int) -> None:
        """So many bytes more come for a folder.

        Raises:
            SenderLimitError: The sender sends too much at the same time.
            NoRoomError: All together do.
        """
        with self._counting:
            sender, size = self._folders[folder]
            try:
                self._room.take(sender, count)
            except NoRoomLeftError as error:
                raise self._refusal(sender, to_sender=error.to_owner) from error
            self._folders[folder] = (sender, size + count)

    def end(self, folder: Path) -> None:
        """A folder is gone, or has become a session's."""
        with self._counting:
            sender, size = self._folders.pop(folder, ("", 0))
            if size:
                self._room.give_back(sender, size)

    def _refusal(self, sender: str, *, to_sender: bool) -> SenderLimitError | NoRoomError:
        most = self._room.most_of_one if to_sender else self._room.most
        held = self._room.of(sender) if to_sender else self._room.held
        figures = f"{held / MEGABYTE:.1f} of {(most or 0) / MEGABYTE:.1f} MB are taken"
        if to_sender:
            return SenderLimitError(
                f"too much is being sent from your address at the same time: {figures}; send one file after "
                "another",
                retry_after_s=RETRY_S,
            )
        return NoRoomError(
            f"too much is being sent to the server at the same time: {figures}; try again soon",
            retry_after_s=RETRY_S,
        )


class Staging:
    """Folders that are being filled with what is sent.

    Args:
        make: Makes a new one; takes a moment.
        most_bytes: How large all may be together; one sender's half as much.
    """

    def __init__(self, make: Callable[[], Path], most_bytes: int = STAGING_BYTES) -> None:
        self._make = make
        self.room = StagingRoom(most_bytes)
        """Counts what comes for them."""

    @asynccontextmanager
    async def folder(self, sender: str = "") -> AsyncGenerator[Path]:
        """A new folder; what is not made a session of is removed at the end.

        Args:
            sender: Who fills it; `room` counts them.
        """
        folder = await self.begin(sender)
        try:
            yield folder
        finally:
            await self.discard(folder)

    async def begin(self, sender: str = "") -> Path:
        """A new folder; whoever asked for it has it discarded."""
        folder = await asyncio.to_thread(self._make)
        self.room.begin(folder, sender)
        return folder

    async def discard(self, folder: Path) -> None:
        """Remove a folder of `begin`, if it is still there."""
        await asyncio.to_thread(shutil.rmtree, folder, ignore_errors=True)
        self.room.end(folder)
