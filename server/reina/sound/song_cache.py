"""The rendered songs on disk: so many bytes of them, those that are being made included."""

import asyncio
import contextlib
import shutil
from collections.abc import AsyncGenerator, Callable, Collection
from contextlib import asynccontextmanager
from pathlib import Path

from reina.sound.font import SoundError
from reina.sound.mix import FRAME_BYTES
from reina.sound.rendered import SONG

SONG_CACHE_BYTES = 2_000_000_000
"""How large the rendered songs may be together; beyond that, those that were asked for least recently go."""
SEGMENT_FRAME_BYTES = 0.5
"""What a sample takes in the segments, at most; they have some 100 kB a 10 seconds."""
BESIDE_BYTES = 1_000_000
"""Peaks, and what is written before something else is removed."""
MEGABYTE = 1_000_000


def most_bytes_of(frames: int) -> int:
    """What a song of so many samples takes at most while it is made: its mix, and its segments.

    The whole is written while the mix is taken away, and is half as large at most.
    """
    return int(frames * (FRAME_BYTES + SEGMENT_FRAME_BYTES)) + BESIDE_BYTES


class SongCache:
    """The folder of the rendered songs.

    Args:
        folder: Holds a folder a song.
        most_bytes: How large all may be together.
        is_made: Whether a song is being made.
    """

    def __init__(self, folder: Path, most_bytes: int, *, is_made: Callable[[Path], bool]) -> None:
        self._folder = folder
        self.most_bytes = most_bytes
        """How large all may be together."""
        self._is_made = is_made
        self._promised = 0
        self._given_back = asyncio.Event()
        self.in_use: Callable[[], Collection[Path]] = set[Path]
        """Songs that go last: somebody is listening to them."""

    @asynccontextmanager
    async def room(self, needed: int) -> AsyncGenerator[None]:
        """Room for a song while it is made: others are removed for it, or waited for.

        Args:
            needed: How many bytes it takes at most.

        Raises:
            SoundError: It does not fit though there were no other.
        """
        if needed > self.most_bytes:
            raise SoundError(
                f"while it is made the sound takes up to {needed / MEGABYTE:.0f} MB, and all songs together "
                f"have {self.most_bytes / MEGABYTE:.0f} MB (REINA_SONG_CACHE_MB)"
            )
        while self._promised + needed > self.most_bytes:
            await self._given_back.wait()
        self._promised += needed
        try:
            await asyncio.to_thread(self.prune, in_use=self.in_use())
            yield
        finally:
            self._promised -= needed
            given_back, self._given_back = self._given_back, asyncio.Event()
            given_back.set()

    def prune(self, *, in_use: Collection[Path] = ()) -> int:
        """Remove songs until the rest fits beside those that are being made; return the bytes freed.

        Those that were asked for the longest ago go first, and those in use last. What is no whole song and
        is not being rendered goes in any case: what a server that was killed, or an earlier version, has
        left.

        Args:
            in_use: Songs that somebody listens to.
        """
        songs: list[tuple[bool, float, int, Path]] = []
        freed = 0
        for entry in self._folder.iterdir() if self._folder.is_dir() else ():
            with contextlib.suppress(FileNotFoundError, NotADirectoryError):  # removed meanwhile
                song = entry / SONG
                if song.is_file():
                    songs.append((song in in_use, song.stat().st_mtime, _size(entry), song))
                elif not self._is_made(song):
                    freed += _size(entry)
                    remove_song(entry)
        total = sum(size for _, _, size, _ in songs)
        for _, _, size, song in sorted(songs):
            if total > self.most_bytes - self._promised:
                remove_song(song.parent)
                total -= size
                freed += size
        return freed


def remove_song(folder: Path) -> None:
    """Remove a song's folder, or what stands in its place."""
    if folder.is_dir():
        shutil.rmtree(folder, ignore_errors=True)
    else:
        folder.unlink(missing_ok=True)


def _size(entry: Path) -> int:
    files = entry.iterdir() if entry.is_dir() else (entry,)
    return sum(file.stat().st_size for file in files)
