"""Makes the sound of scores that come without a song: rendered once, kept, shared.

The rendering runs in a process of its own (`reina.sound.render`), so that neither its time nor its
memory is the server's. Segments can be had while the rest is rendered. docs/sound.md says how it sounds.
"""

import asyncio
import contextlib
import functools
import hashlib
import json
import logging
import os
import sys
from asyncio.subprocess import PIPE, Process
from collections.abc import Awaitable, Callable, Collection, Hashable, Sequence
from contextlib import nullcontext
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from reina.music.score import Score
from reina.sound.events import SoundPlan
from reina.sound.font import MissingSoundfontError, SoundError, find_soundfont, soundfont_id
from reina.sound.growing_peaks import GrowingPeaks
from reina.sound.hearing import AS_WRITTEN, Hearing, heard_notes
from reina.sound.passages import cut_into_passages
from reina.sound.plan import PlayedParts, plan_sound
from reina.sound.recording.peaks import Peaks
from reina.sound.rendered import SONG, RenderedFiles, segment_path
from reina.sound.segments import SEGMENT, Segments, cut_into_segments
from reina.sound.song_cache import SONG_CACHE_BYTES, SongCache, most_bytes_of, remove_song
from reina.system.cluster import AwayError, LostError
from reina.system.disk_room import has_room, is_disk_full
from reina.system.elsewhere import Elsewhere
from reina.system.metrics import in_queue
from reina.system.turns import Turns

__all__ = [
    "MissingSoundfontError",
    "NoRoomError",
    "SongRenderer",
    "SongRequest",
    "SoundError",
    "find_soundfont",
]

NO_ROOM = "there is no room on the server's disk for the sound; it is made as soon as there is"
RENDERING_VERSION = "2"
"""Raised with every change of how a plan becomes sound, so that songs rendered before are not taken for new
ones."""

RENDERING_ID_LENGTH = 16
TIMEOUT_S = 900.0
LONG_S = 600.0
"""Longer music is rendered one piece at a time, whoever it is for."""
STDERR_TOLD = 400
"""How many characters at the end of a crashed renderer's complaint its last line is looked for in."""

log = logging.getLogger(__name__)


class NoRoomError(SoundError):
    """There is no room for a song now; there may be later."""

    def __init__(self) -> None:
        super().__init__(NO_ROOM)


class SongRequest:
    """One asker's share in the rendering of a song.

    Attributes:
        path: Where the whole song lies once it is ready, as FLAC.
        segments: How it is cut into segments.
    """

    def __init__(self, path: Path, segments: Segments, rendering: "_Rendering | None" = None) -> None:
        self.path = path
        self.segments = segments
        self._rendering = rendering
        self._cancelled = False

    @property
    def rendering_id(self) -> str:
        """What names this rendering: another sound has another name."""
        return self.path.parent.name[:RENDERING_ID_LENGTH]

    @property
    def peaks(self) -> Peaks | None:
        """The peaks of what is there so far; None once the song is ready, whose peaks lie beside it."""
        return None if self._rendering is None or self.ready else self._rendering.peaks.peaks()

    async def segment(self, number: int, *, within_s: float) -> Path | None:
        """A segment's file, Ogg Opus; where it is missing it is made next. None if it is not there in time.

        Args:
            number: Which, 0 to `segments.count` - 1.
            within_s: How long to wait for it.
        """
        path = segment_path(self.path, number)
        if self._rendering is None or self.ready:
            return path
        self._rendering.want(number)
        with contextlib.suppress(TimeoutError):
            async with asyncio.timeout(within_s):
                while number not in self._rendering.there and not self._rendering.task.done():
                    await self._rendering.news.wait()
        return path if self.ready or number in self._rendering.there else None

    @property
    def progress(self) -> float:
        """Share of the work that is done, 0..1; 1 only when the song is ready."""
        return 1.0 if self._rendering is None or self.ready else self._rendering.progress

    @property
    def ready(self) -> bool:
        """Whether the song lies at `path`."""
        return self._rendering is None or (self._rendering.task.done() and self.error is None)

    @property
    def given_up(self) -> bool:
        """Whether it ended because nobody wants it any more: something else is to be heard."""
        return self._rendering is not None and self._rendering.task.cancelled()

    @property
    def error(self) -> SoundError | None:
        """Why there will be no song, once that is known."""
        if self._rendering is None or not self._rendering.task.done():
            return None
        if self._rendering.task.cancelled():
            return SoundError("the rendering was cancelled")
        error = self._rendering.task.exception()
        if error is not None and is_disk_full(error):
            return NoRoomError()
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
    """A rendering that is under way or waits for its turn.

    Attributes:
        there: The segments that can be had.
        news: Set, and replaced, when there are more of them, and at the end.
    """

    def __init__(self, segments: Segments) -> None:
        self.frames = segments.frames
        self.progress = 0.0
        self.askers = 0
        self.there: set[int] = set()
        self.peaks = GrowingPeaks(segments.frames)
        self.news = asyncio.Event()
        self.task: asyncio.Task[None]
        self._wanted: int | None = None
        self._process: Process | None = None

    def want(self, number: int) -> None:
        """Have a segment made next, unless it is there or was wanted last."""
        if number not in self.there and number != self._wanted:
            self._wanted = number
            self._pass_on()

    def begun_by(self, process: Process) -> None:
        """What is wanted goes to this process from now on: the plan has been sent."""
        self._process = process
        self._pass_on()

    def add(self, number: int, peaks: str) -> None:
        """A segment can be had."""
        self.peaks.put(number * SEGMENT, peaks)
        self.there.add(number)
        self.tell()

    def tell(self) -> None:
        """Wake those who wait for news."""
        news, self.news = self.news, asyncio.Event()
        news.set()

    def _pass_on(self) -> None:
        process, wanted = self._process, self._wanted
        if process is not None and process.stdin is not None and wanted is not None:
            # A few bytes, which the pipe takes at once; one that has ended needs none.
            with contextlib.suppress(ConnectionError, RuntimeError):
                process.stdin.write(b"%d\n" % wanted)


class SongRenderer:
    """Renders scores into `<data_dir>/songs/<digest>/`; the same score is rendered once.

    Args:
        data_dir: The server's data folder.
        soundfont: An SF2 file; by default what `find_soundfont` finds at the first request.
        most_at_once: How many renderings run at once; others wait for their turn, which goes round by owner,
            and long ones go one at a time, so that there is always one that a short one soon gets.
        most_bytes: How large the songs may be together, those that are being made with all that this takes.
        timeout_s: How long one may take before it is stopped.
        elsewhere: Where it is done while somebody is there; in processes of this machine when None.
    """

    def __init__(
        self,
        data_dir: Path,
        *,
        soundfont: Path | None = None,
        most_at_once: int = 2,
        most_bytes: int = SONG_CACHE_BYTES,
        timeout_s: float = TIMEOUT_S,
        elsewhere: Elsewhere | None = None,
    ) -> None:
        self._elsewhere = elsewhere
        self._data_dir = data_dir
        self._songs = data_dir / "songs"
        self._soundfont = soundfont
        self._timeout_s = timeout_s
        self._turns = Turns(most_at_once)
        self._long_turns = Turns(max(1, most_at_once - 1))
        self.cache = SongCache(self._songs, most_bytes, is_made=self._is_made)
        """The songs that are there."""
        self._renderings: dict[Path, _Rendering] = {}
        self._tasks: set[asyncio.Task[None]] = set()

    async def request(
        self,
        score: Score,
        played: Sequence[PlayedParts] = (),
        hearing: Hearing = AS_WRITTEN,
        *,
        owner: Hashable = None,
    ) -> SongRequest:
        """Ask for a score's song, which is then made in the background unless it is there already.

        Args:
            score: The score; time 0 of the song is its time 0.
            played: What the players play.
            hearing: What of it is to be heard.
            owner: For whom; renderings that wait go round by owner, the short ones of each first.

        Raises:
            InputError: The score is longer than an hour, or nothing of it is a pitch.
            MissingSoundfontError: There is nothing to render with.
        """
        plan, segments, heard = await asyncio.to_thread(_plan, score, played, hearing)
        soundfont = self._soundfont or find_soundfont(self._data_dir)
        identity = await asyncio.to_thread(soundfont_id, soundfont)
        about = () if hearing.stem == "all" else (hashlib.sha256(heard.tobytes()).hexdigest(),)
        path = self._songs / plan.digest(RENDERING_VERSION, identity, *about) / SONG
        if await asyncio.to_thread(path.is_file):
            # The time of the last use is what `prune` goes by.
            os.utime(path)
            return SongRequest(path, segments)
        rendering = self._renderings.get(path)
        if rendering is None or rendering.task.cancelling():
            before = rendering.task if rendering else None
            rendering = self._renderings[path] = _Rendering(segments)
            rendering.task = asyncio.create_task(
                self._render(rendering, plan, heard, soundfont, path, before, owner)
            )
            self._tasks.add(rendering.task)
            rendering.task.add_done_callback(functools.partial(self._ended, path, rendering))
        rendering.askers += 1
        return SongRequest(path, segments, rendering)

    def has_room(self) -> bool:
        """Whether there is room on the disk for a song to be begun; blocks as long as the disk takes."""
        return has_room(self._data_dir)

    async def aclose(self) -> None:
        """Stop every rendering and wait until its process is gone."""
        for task in self._tasks:
            # One that is being cancelled waits for its process to end, which a second time would cut short.
            if not task.cancelling():
                task.cancel()
        if self._tasks:
            await asyncio.wait(self._tasks)

    def prune(self, *, in_use: Collection[Path] = ()) -> int:
        """Remove songs until the rest fits; see `SongCache.prune`."""
        return self.cache.prune(in_use=in_use)

    def discard(self, path: Path | None) -> None:
        """Remove a song that nobody needs any more; None, and one that is gone already, are no error."""
        if path is not None:
            remove_song(path.parent)

    def _is_made(self, path: Path) -> bool:
        return path in self._renderings

    def _ended(self, path: Path, rendering: _Rendering, task: asyncio.Task[None]) -> None:
        self._tasks.discard(task)
        rendering.tell()
        if self._renderings.get(path) is rendering:
            del self._renderings[path]
        # To ask one that was cancelled takes from it where it was, which holds this and the plan.
        with contextlib.suppress(asyncio.CancelledError):
            if (error := task.exception()) is not None:
                log.error("rendering %s failed: %s", path.parent.name, error)

    async def _render(
        self,
        rendering: _Rendering,
        plan: SoundPlan,
        heard: NDArray[np.bool_],
        soundfont: Path,
        path: Path,
        before: asyncio.Task[None] | None,
        owner: Hashable,
    ) -> None:
        with in_queue("renderings"):
            if before is not None:
                # One that was given up still has the folder.
                await asyncio.wait([before])
            if self._elsewhere is not None:
                away = functools.partial(
                    self._run_elsewhere, self._elsewhere, rendering, plan, heard, soundfont, path
                )
                with contextlib.suppress(AwayError):
                    await self._made(rendering, plan, path, away)
                    return
            here = functools.partial(self._run, rendering, plan, heard, soundfont, path)
            length_s = plan.duration_s
            long = self._long_turns.of(owner, length_s) if length_s > LONG_S else nullcontext()
            async with long, self._turns.of(owner, length_s):
                await self._made(rendering, plan, path, here)

    async def _made(
        self, rendering: _Rendering, plan: SoundPlan, path: Path, make: Callable[[], Awaitable[None]]
    ) -> None:
        """Have a song made in room of its own; where that fails, nothing is left."""
        async with self.cache.room(most_bytes_of(rendering.frames)):
            path.parent.mkdir(parents=True, exist_ok=True)
            try:
                async with asyncio.timeout(self._timeout_s):
                    await make()
            except TimeoutError as error:
                took = f"took over {self._timeout_s:.0f} s"
                raise SoundError(
                    f"rendering {plan.duration_s:.0f} s of sound {took} and was stopped"
                ) from error
            finally:
                _remove_unfinished(path)

    async def _run_elsewhere(
        self,
        elsewhere: Elsewhere,
        rendering: _Rendering,
        plan: SoundPlan,
        heard: NDArray[np.bool_],
        soundfont: Path,
        path: Path,
    ) -> None:
        def tell(share: float) -> None:
            rendering.progress = min(share, 0.99)

        identity = await asyncio.to_thread(soundfont_id, soundfont)
        try:
            files: RenderedFiles = await elsewhere.run(
                "reina.sound.render_elsewhere:render_files",
                plan,
                heard,
                identity,
                tell=tell,
                timeout_s=self._timeout_s,
            )
        except LostError as error:
            raise SoundError(f"the score could not be rendered: {error}") from error
        await asyncio.to_thread(files.write, path)

    async def _run(
        self, rendering: _Rendering, plan: SoundPlan, heard: NDArray[np.bool_], soundfont: Path, path: Path
    ) -> None:
        counts = (str(len(plan.notes)), str(len(plan.controls)))
        process = await asyncio.create_subprocess_exec(
            sys.executable,
            "-m",
            "reina.sound.render",
            str(soundfont),
            str(path.parent),
            *counts,
            stdin=PIPE,
            stdout=PIPE,
            stderr=PIPE,
        )
        data = plan.notes.tobytes() + plan.controls.tobytes() + heard.tobytes()
        try:
            _, complaint, error = await asyncio.gather(
                _send(process, rendering, data),
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
            for partial in path.parent.glob(f"*.{process.pid}.partial"):
                partial.unlink(missing_ok=True)
        if error is not None:
            raise error
        if status != 0:
            lines = complaint[-STDERR_TOLD:].strip().splitlines()
            log.warning("the renderer ended with status %d: %s", status, lines[-1] if lines else "")
            raise SoundError(f"the renderer ended with status {status}; the server has noted why")


def _plan(
    score: Score, played: Sequence[PlayedParts], hearing: Hearing
) -> tuple[SoundPlan, Segments, NDArray[np.bool_]]:
    """Return the plan of a score, its segments, and (N,) which of its notes are heard."""
    plan = plan_sound(score, played, transposition=hearing.transposition)
    parts = () if hearing.stem == "all" else played[hearing.player].parts
    return plan, cut_into_segments(cut_into_passages(plan)), heard_notes(plan, parts, hearing.stem)


def _remove_unfinished(song: Path) -> None:
    if not song.is_file():
        remove_song(song.parent)


async def _send(process: Process, rendering: _Rendering, data: bytes) -> None:
    """Write the plan; standard input stays open, whose end would tell the process that the server is gone."""
    if process.stdin is not None:
        with contextlib.suppress(ConnectionError):
            process.stdin.write(data)
            rendering.begun_by(process)
            await process.stdin.drain()


async def _read(process: Process) -> str:
    return "" if process.stderr is None else (await process.stderr.read()).decode(errors="replace")


async def _follow(process: Process, rendering: _Rendering) -> SoundError | None:
    """Keep what is there until the process is done; return its complaint if it has one."""
    error: SoundError | None = None
    while process.stdout is not None and (line := await process.stdout.readline()):
        message: dict[str, object] = json.loads(line)
        match message:
            case {"progress": float(share)}:
                # Only when the file is in its place is all of it done.
                rendering.progress = min(share, 0.99)
            case {"segment": int(number), "peaks": str(peaks)}:
                rendering.add(number, peaks)
            case {"is_disk_full": True}:
                error = NoRoomError()
            case {"error": str(complaint)}:
                error = SoundError(f"the score could not be rendered: {complaint}")
            case _:
                pass
    return error
