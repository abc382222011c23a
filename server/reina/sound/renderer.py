"""Makes the sound of scores that come without a song: rendered once, kept, shared.

The rendering runs in a process of its own (`reina.sound.render`), so that neither its time nor its
memory is the server's. docs/sound.md says how it sounds and why the result is WAV.
"""

import asyncio
import contextlib
import functools
import json
import logging
import os
import sys
from asyncio.subprocess import PIPE, Process
from collections.abc import Collection, Sequence
from pathlib import Path

from reina.music.score import Score
from reina.sound.events import SoundPlan
from reina.sound.font import MissingSoundfontError, SoundError, find_soundfont, soundfont_id
from reina.sound.plan import PlayedParts, plan_sound
from reina.sound.recording.peaks import peaks_path

__all__ = [
    "SONG_MEDIA_TYPE",
    "MissingSoundfontError",
    "SongRenderer",
    "SongRequest",
    "SoundError",
    "find_soundfont",
]

SONG_MEDIA_TYPE = "audio/wav"
RENDERING_VERSION = "1"
"""Raised with every change of how a plan becomes sound, so that songs rendered before are not taken for new
ones."""

TIMEOUT_S = 900.0
STDERR_TOLD = 400
"""How many characters of a crashed renderer's complaint are passed on, from its end."""

log = logging.getLogger(__name__)


class SongRequest:
    """One asker's share in the rendering of a song.

    Attributes:
        path: Where the song lies once it is ready.
    """

    def __init__(self, path: Path, rendering: "_Rendering | None" = None) -> None:
        self.path = path
        self._rendering = rendering
        self._cancelled = False

    @property
    def progress(self) -> float:
        """Share of the work that is done, 0..1; 1 only when the song is ready."""
        return 1.0 if self._rendering is None or self.ready else self._rendering.progress

    @property
    def ready(self) -> bool:
        """Whether the song lies at `path`."""
        return self._rendering is None or (self._rendering.task.done() and self.error is None)

    @property
    def error(self) -> SoundError | None:
        """Why there will be no song, once that is known."""
        if self._rendering is None or not self._rendering.task.done():
            return None
        if self._rendering.task.cancelled():
            return SoundError("the rendering was cancelled")
        error = self._rendering.task.exception()
        return error if error is None or isinstance(error, SoundError) else SoundError(str(error))

    async def wait(self) -> Path:
        """Wait until the song is ready and return its path.

        Raises:
            SoundError: It could not be rendered, or everybody who asked for it has cancelled.
        """
        if self._rendering is not None:
            await asyncio.wait([self._rendering.task])
            if self.error is not None:
                raise self.error
        return self.path

    def cancel(self) -> None:
        """Give the song up; the rendering stops when nobody else waits for it.

        A song that is ready stays.
        """
        if self._rendering is None or self._cancelled:
            return
        self._cancelled = True
        self._rendering.askers -= 1
        if self._rendering.askers == 0:
            self._rendering.task.cancel()


class _Rendering:
    """A rendering that is under way or waits for its turn."""

    def __init__(self) -> None:
        self.progress = 0.0
        self.askers = 0
        self.task: asyncio.Task[None]


class SongRenderer:
    """Renders scores into `<data_dir>/songs/<digest>.wav`; the same score is rendered once.

    Args:
        data_dir: The server's data folder.
        soundfont: An SF2 file; by default what `find_soundfont` finds at the first request.
        most_at_once: How many renderings run at once; others wait for their turn.
        timeout_s: How long one may take before it is stopped.
    """

    def __init__(
        self,
        data_dir: Path,
        *,
        soundfont: Path | None = None,
        most_at_once: int = 1,
        timeout_s: float = TIMEOUT_S,
    ) -> None:
        self._data_dir = data_dir
        self._songs = data_dir / "songs"
        self._soundfont = soundfont
        self._timeout_s = timeout_s
        self._turns = asyncio.Semaphore(most_at_once)
        self._renderings: dict[Path, _Rendering] = {}
        self._tasks: set[asyncio.Task[None]] = set()

    async def request(self, score: Score, played: Sequence[PlayedParts] = ()) -> SongRequest:
        """Ask for a score's song, which is then made in the background unless it is there already.

        Args:
            score: The score; time 0 of the song is its time 0.
            played: What the players play.

        Raises:
            InputError: The score is longer than an hour.
            MissingSoundfontError: There is nothing to render with.
        """
        plan = await asyncio.to_thread(plan_sound, score, played)
        soundfont = self._soundfont or find_soundfont(self._data_dir)
        identity = await asyncio.to_thread(soundfont_id, soundfont)
        path = self._songs / f"{plan.digest(RENDERING_VERSION, identity)}.wav"
        if await asyncio.to_thread(path.is_file):
            # The time of the last use is what `prune` goes by.
            os.utime(path)
            return SongRequest(path)
        rendering = self._renderings.get(path)
        if rendering is None or rendering.task.cancelling():
            rendering = self._renderings[path] = _Rendering()
            rendering.task = asyncio.create_task(self._render(rendering, plan, soundfont, path))
            self._tasks.add(rendering.task)
            rendering.task.add_done_callback(functools.partial(self._ended, path))
        rendering.askers += 1
        return SongRequest(path, rendering)

    async def aclose(self) -> None:
        """Stop every rendering and wait until its process is gone."""
        for task in self._tasks:
            # One that is being cancelled waits for its process to end, which a second time would cut short.
            if not task.cancelling():
                task.cancel()
        if self._tasks:
            await asyncio.wait(self._tasks)

    def prune(self, most_bytes: int, *, in_use: Collection[Path] = ()) -> int:
        """Remove the songs that were not asked for the longest until the rest fits; return the bytes freed.

        Args:
            most_bytes: How large the rendered songs may be together.
            in_use: Songs that stay in any case.
        """
        songs: list[tuple[Path, os.stat_result]] = []
        for song in self._songs.glob("*.wav"):
            with contextlib.suppress(FileNotFoundError):  # removed meanwhile
                songs.append((song, song.stat()))
        total = freed = sum(stat.st_size for _, stat in songs)
        for song, stat in sorted(songs, key=lambda entry: entry[1].st_mtime):
            if total > most_bytes and song not in in_use:
                self.discard(song)
                total -= stat.st_size
        return freed - total

    def discard(self, path: Path | None) -> None:
        """Remove a song that nobody needs any more; None, and one that is gone already, are no error."""
        if path is not None:
            path.unlink(missing_ok=True)
            peaks_path(path).unlink(missing_ok=True)

    def _ended(self, path: Path, task: asyncio.Task[None]) -> None:
        self._tasks.discard(task)
        rendering = self._renderings.get(path)
        if rendering is not None and rendering.task is task:
            del self._renderings[path]
        if not task.cancelled() and (error := task.exception()) is not None:
            log.error("rendering %s failed: %s", path.name, error)

    async def _render(self, rendering: _Rendering, plan: SoundPlan, soundfont: Path, path: Path) -> None:
        async with self._turns:
            self._songs.mkdir(parents=True, exist_ok=True)
            try:
                async with asyncio.timeout(self._timeout_s):
                    await self._run(rendering, plan, soundfont, path)
            except TimeoutError as error:
                took = f"took over {self._timeout_s:.0f} s"
                raise SoundError(
                    f"rendering {plan.duration_s:.0f} s of sound {took} and was stopped"
                ) from error

    async def _run(self, rendering: _Rendering, plan: SoundPlan, soundfont: Path, path: Path) -> None:
        counts = (str(len(plan.notes)), str(len(plan.controls)))
        process = await asyncio.create_subprocess_exec(
            sys.executable,
            "-m",
            "reina.sound.render",
            str(soundfont),
            str(path),
            *counts,
            stdin=PIPE,
            stdout=PIPE,
            stderr=PIPE,
        )
        try:
            _, complaint, error = await asyncio.gather(
                _send(process, plan.notes.tobytes() + plan.controls.tobytes()),
                _read(process),
                _follow(process, rendering),
            )
            status = await process.wait()
        finally:
            if process.returncode is None:
                process.kill()
            # Until its pipes are read to their ends the loop keeps them open.
            await process.communicate()
            # What a process that was killed leaves behind; its own clean-up does not run.
            for partial in self._songs.glob(f"{path.name}.{process.pid}.*partial"):
                partial.unlink(missing_ok=True)
        if error is not None:
            raise SoundError(f"the score could not be rendered: {error}")
        if status != 0:
            raise SoundError(f"the renderer ended with status {status}: {complaint[-STDERR_TOLD:].strip()}")


async def _send(process: Process, data: bytes) -> None:
    """Write the plan; standard input stays open, whose end would tell the process that the server is gone."""
    if process.stdin is not None:
        with contextlib.suppress(ConnectionError):
            process.stdin.write(data)
            await process.stdin.drain()


async def _read(process: Process) -> str:
    return "" if process.stderr is None else (await process.stderr.read()).decode(errors="replace")


async def _follow(process: Process, rendering: _Rendering) -> str | None:
    """Keep the progress until the process is done; return its complaint if it has one."""
    error: str | None = None
    while process.stdout is not None and (line := await process.stdout.readline()):
        message: dict[str, object] = json.loads(line)
        if isinstance(share := message.get("progress"), float | int):
            # Only when the file is in its place is all of it done.
            rendering.progress = min(float(share), 0.99)
        if isinstance(complaint := message.get("error"), str):
            error = complaint
    return error
