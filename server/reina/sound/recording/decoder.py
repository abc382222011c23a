"""Has recordings probed by a process of their own, whose crash or endless work is not the server's."""

import asyncio
import contextlib
import json
import logging
import os
import sys
from asyncio.subprocess import PIPE, Process
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from reina.errors import InputError
from reina.music import ScoreWarning
from reina.sound.recording.peaks import Peaks, peaks_path, read_peaks
from reina.sound.recording.probe import AudioInfo, Conversion
from reina.system.metrics import in_queue

PROGRAM = (sys.executable, "-m", "reina.sound.recording.worker")
TIMEOUT_S = 300.0
"""Twice what four hours of Opus, the slowest to decode, take on a core that nobody else uses."""
MAX_AT_ONCE = 2
STDERR_TOLD = 400
"""How many bytes at the end of a crashed worker's complaint its last line is looked for in."""
ADVICE = "if it plays elsewhere, convert it to WAV, MP3 or FLAC"

log = logging.getLogger(__name__)


class SongDecoder:
    """Probes recordings, a few at a time.

    Args:
        program: What is started, with the song and the file for its peaks as arguments.
        timeout_s: How long it may take before it is stopped.
        most_at_once: How many run at once; others wait for their turn.
    """

    def __init__(
        self,
        *,
        program: Sequence[str] = PROGRAM,
        timeout_s: float = TIMEOUT_S,
        most_at_once: int = MAX_AT_ONCE,
    ) -> None:
        self._program = tuple(program)
        self._timeout_s = timeout_s
        self._turns = asyncio.Semaphore(most_at_once)

    async def probe(self, song: Path, conversion: Conversion | None = None) -> AudioInfo:
        """Tell what a recording is; its peaks stand beside it then, if it was decoded.

        Args:
            song: Its file.
            conversion: Where what most browsers do not play is written as FLAC; None: it is not.

        Raises:
            InputError: It cannot be used, takes too long to decode, or makes the decoder crash.
            OSError: There is no room for what is written.
        """
        with in_queue("recordings"):
            async with self._turns:
                message = await self._run(song, conversion)
        if "error" in message:
            raise InputError(message["error"])
        if "errno" in message:
            raise OSError(message["errno"], os.strerror(message["errno"]))
        warnings = tuple(ScoreWarning(**warning) for warning in message.pop("warnings"))
        return AudioInfo(**message, warnings=warnings)

    async def peaks(self, song: Path) -> Peaks | None:
        """A song's peaks, decoded where they are not kept yet; None of a format that is not decoded here.

        Raises:
            InputError: As of `probe`.
        """
        peaks = await asyncio.to_thread(read_peaks, peaks_path(song))
        if peaks is None:
            await self.probe(song)
            peaks = await asyncio.to_thread(read_peaks, peaks_path(song))
        return peaks

    async def _run(self, song: Path, conversion: Conversion | None) -> dict[str, Any]:
        files = [song, peaks_path(song)]
        options: list[str] = []
        if conversion is not None:
            files.append(conversion.path)
            options += ["--forced"] if conversion.is_forced else []
        process = await asyncio.create_subprocess_exec(
            *self._program, *map(str, files), *options, stdin=PIPE, stdout=PIPE, stderr=PIPE
        )
        try:
            async with asyncio.timeout(self._timeout_s):
                told, complaint = await asyncio.gather(_read(process.stdout), _read(process.stderr))
                status = await process.wait()
        except TimeoutError as error:
            detail = f"decoding the song took over {self._timeout_s:.0f} s and was stopped; {ADVICE}"
            raise InputError(detail) from error
        finally:
            await _end(process)
        if status != 0:
            lines = complaint[-STDERR_TOLD:].decode(errors="replace").strip().splitlines()
            log.warning("the decoder ended with status %d: %s", status, lines[-1] if lines else "")
            raise InputError(f"the song makes the decoder fail, so that it seems to be broken; {ADVICE}")
        message: dict[str, Any] = json.loads(told)
        return message


async def _read(stream: asyncio.StreamReader | None) -> bytes:
    return b"" if stream is None else await stream.read()


async def _end(process: Process) -> None:
    """Stop it if it runs, and wait until its pipes are closed too, which else outlive the loop."""
    if process.returncode is None:
        process.kill()
    if process.stdin is not None:
        process.stdin.close()
        with contextlib.suppress(ConnectionError):
            await process.stdin.wait_closed()
    await asyncio.gather(_read(process.stdout), _read(process.stderr))
    await process.wait()
