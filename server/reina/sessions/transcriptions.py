"""Recordings whose notes are being found, or were: kept for a while, until somebody has taken the score."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING

from reina.errors import InputError
from reina.protocol.links import transcription_href
from reina.protocol.resources import Transcription, TranscriptionLinks, TranscriptionStatus
from reina.sessions.record import new_id
from reina.sound.transcription.posteriors import NoRuntimeError, is_installed
from reina.sound.transcription.score import NO_BEAT
from reina.sound.transcription.transcribe import MixError
from reina.sound.transcription.transcriber import Transcriber

if TYPE_CHECKING:
    from collections.abc import Awaitable, Callable
    from pathlib import Path

    from reina.sound.transcription.transcribe import Line

MOST_KEPT = 32
"""Beyond these the oldest is given up."""
MOST_WAITING = 8


class BusyError(InputError):
    """Too many recordings wait for their turn."""


class TranscriptionWork:
    """The search for one recording's notes.

    Attributes:
        id: Whoever has it may watch, take the score and end it.
        title: What the score is called.
        progress: 0..1.
        midi: The score as a MIDI file, once it is found.
        notes: How many it has.
        has_beat: Whether they tell a beat.
        error: Why there is none.
    """

    def __init__(self, title: str) -> None:
        self.id = new_id()
        self.title = title
        self.progress = 0.0
        self.midi: bytes | None = None
        self.notes = 0
        self.has_beat = False
        self.error: InputError | None = None
        self.task: asyncio.Task[None] | None = None

    @property
    def status(self) -> TranscriptionStatus:
        """How far it is."""
        if self.midi is not None:
            return "found"
        return "searching" if self.error is None else "failed"

    def resource(self) -> Transcription:
        """What is told of it."""
        href = transcription_href(self.id)
        return Transcription(
            id=self.id,
            title=self.title,
            status=self.status,
            progress=round(self.progress, 3),
            notes=self.notes,
            has_beat=self.has_beat,
            fault=None if self.error is None else "mix" if isinstance(self.error, MixError) else "other",
            detail=None if self.error is None else str(self.error),
            links=TranscriptionLinks(self=href, midi=f"{href}/score.mid"),
        )


class Transcriptions:
    """All of a server, in memory: a score is taken at once or searched anew.

    Args:
        transcriber: Finds the notes.
    """

    def __init__(self, transcriber: Transcriber | None = None) -> None:
        self._transcriber = transcriber or Transcriber()
        self._all: dict[str, TranscriptionWork] = {}

    def begin(
        self, song: Path, line: Line, title: str, discard: Callable[[], Awaitable[None]]
    ) -> TranscriptionWork:
        """Look for the notes of a recording, in the background.

        Args:
            song: The recording's file.
            line: What is looked for.
            title: What the score is to be called.
            discard: Removes the recording; called at the end.

        Raises:
            NoRuntimeError: What listens is not installed.
            BusyError: Too many wait already.
        """
        self.require()
        work = TranscriptionWork(title)
        self._all[work.id] = work
        work.task = asyncio.create_task(self._find(work, song, line, discard))
        for oldest in list(self._all)[:-MOST_KEPT]:
            self.end(oldest)
        return work

    def require(self) -> None:
        """See that a recording can be listened to now.

        Raises:
            NoRuntimeError: What listens is not installed.
            BusyError: Too many wait already.
        """
        if not is_installed():
            raise NoRuntimeError
        if sum(work.status == "searching" for work in self._all.values()) >= MOST_WAITING:
            raise BusyError(
                f"{MOST_WAITING} recordings are being listened to already; try again when one is done"
            )

    def get(self, transcription_id: str) -> TranscriptionWork | None:
        """One of them, or None."""
        return self._all.get(transcription_id)

    def end(self, transcription_id: str) -> None:
        """Give it up, and forget it."""
        work = self._all.pop(transcription_id, None)
        if work is not None and work.task is not None:
            work.task.cancel()

    async def aclose(self) -> None:
        """Give up all of them, and wait until their processes are gone."""
        tasks = [work.task for work in self._all.values() if work.task is not None]
        for each in list(self._all):
            self.end(each)
        if tasks:
            await asyncio.wait(tasks)
        await self._transcriber.aclose()

    async def _find(
        self, work: TranscriptionWork, song: Path, line: Line, discard: Callable[[], Awaitable[None]]
    ) -> None:
        def follow(share: float) -> None:
            work.progress = share

        try:
            score = await self._transcriber.transcribe(song, line, work.title, follow)
            # What few ask for is imported when it is asked for.
            from reina.music.midi.writer import write_midi

            work.midi = await asyncio.to_thread(write_midi, score)
            work.notes, work.progress = len(score.notes), 1.0
            work.has_beat = all(warning.kind != NO_BEAT for warning in score.warnings)
        except InputError as error:
            work.error = error
        finally:
            await asyncio.shield(discard())
