"""Reads scores and shows, writes MIDI: what is short on a thread, what is long in a process of its own."""

from __future__ import annotations

import asyncio
from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any, TypeVar
from typing import cast as typed

from reina.curves.shown import shown
from reina.instruments.as_played import score_as_played
from reina.music import from_second_zero, read_score
from reina.music.packed import GZIP_MAGIC, ZIP_MAGICS
from reina.sessions.production import Production, read_show
from reina.sessions.score_text import packed_score
from reina.sessions.workers.pool import WorkerPool
from reina.show import Show, ShowError, Track
from reina.show.edits import read_edits
from reina.show.show_reader import read_track
from reina.show.show_writer import write_with
from reina.system.json_text import read_json

if TYPE_CHECKING:
    from collections.abc import Callable, Hashable
    from pathlib import Path

    from reina.curves import Parameter, ParameterRegistry
    from reina.instruments import Cast
    from reina.music import SongTimes
    from reina.sessions.stage import Stage
    from reina.show.edits import Edit
    from reina.show.time_map import TimeUnit
    from reina.skeleton import HumanPose

T = TypeVar("T")

LONG_BYTES = 64_000
"""A longer file is read in a process; what takes a thread some tenths of a second is not worth one."""
MIDI_BYTES = 16
"""A note that is written weighs about as much as so many bytes that are read."""
LONG_NOTES = 10_000
"""The text of a score of so many notes is written where it is read, and kept."""
PACKED = 30
"""A compressed score counts as so many times its size, about what JSON shrinks by."""


class Reader:
    """Reads what people send and what is kept of it.

    Args:
        stage: On what scores are played; never changed.
        pool: Where long files are read.
    """

    def __init__(self, stage: Stage, pool: WorkerPool | None = None) -> None:
        self._stage = stage
        self._pool = pool or WorkerPool(shared_of(stage))

    async def production(
        self,
        path: Path,
        *,
        filename: str | None,
        cast: Cast,
        alignment: SongTimes | None = None,
        stances: Mapping[str, HumanPose] | None = None,
        transposition: int = 0,
        owner: Hashable = None,
    ) -> Production:
        """Read a score and plan how a cast plays it, with the show that is written for it.

        Args:
            path: The score's file.
            filename: What its sender called it.
            cast: Who plays what, and which of its sequences.
            alignment: Where it is heard in the song.
            stances: Poses that its players can stand in, by name.
            transposition: Semitones by which all is played higher than it is written.
            owner: For whom; see `WorkerPool.run`.

        Raises:
            InputError: It cannot be read, or not be played so.
        """
        size = await asyncio.to_thread(_weight, path)
        heard = alignment, stances, transposition
        planned = await self._read(
            size, read_and_plan, self._stage, path, filename, cast, *heard, owner=owner
        )
        return await asyncio.to_thread(planned.weighed)

    async def show(self, data: bytes, registry: ParameterRegistry, *, owner: Hashable = None) -> Show:
        """Read a show from JSON text.

        Args:
            data: The show.
            registry: What it can move.
            owner: For whom; see `WorkerPool.run`.

        Raises:
            ShowError: It is no show.
        """
        return await self._read(len(data), read_written_show, data, registry, owner=owner)

    async def track(
        self, data: bytes, parameter: Parameter, unit: TimeUnit, *, owner: Hashable = None
    ) -> Track:
        """Read a track from JSON text.

        Args:
            data: The track; it may leave out its parameter.
            parameter: What it moves.
            unit: The unit of its times where it names none.
            owner: For whom; see `WorkerPool.run`.

        Raises:
            ShowError: It is no track of the parameter.
        """
        return await self._read(len(data), read_written_track, data, parameter, unit, owner=owner)

    async def preview(
        self, track: Mapping[str, Any], size: int, parameter: Parameter, unit: TimeUnit, *, owner: Hashable
    ) -> Track:
        """Read a track that need not be one yet.

        Args:
            track: JSON.
            size: How long it was as text, bytes.
            parameter: What it moves.
            unit: The unit of its times where it names none.
            owner: For whom; see `WorkerPool.run`.

        Raises:
            ShowError: It is no track of the parameter.
        """
        return await self._read(size, read_track, track, parameter, unit, owner=owner)

    async def edits(self, data: bytes, *, owner: Hashable = None) -> list[Edit]:
        """Read a list of edits from JSON text.

        Args:
            data: The list.
            owner: For whom; see `WorkerPool.run`.

        Raises:
            ShowError: It is none.
        """
        return await self._read(len(data), read_written_edits, data, owner=owner)

    async def midi(self, production: Production, *, owner: Hashable = None) -> bytes:
        """Write the score of a production as its players play it, as a MIDI file."""
        # What few ask for is imported when it is asked for.
        from reina.music.midi.writer import write_midi

        played = [performer.played for performer in production.performers]
        score = await asyncio.to_thread(lambda: from_second_zero(score_as_played(production.score, played)))
        return await self._read(MIDI_BYTES * len(score.notes), write_midi, score, owner=owner)

    @property
    def workers(self) -> WorkerPool:
        """The processes that read."""
        return self._pool

    async def aclose(self) -> None:
        """Stop the processes."""
        await self._pool.aclose()

    async def _read(
        self, size: int, function: Callable[..., T], *arguments: object, owner: Hashable = None
    ) -> T:
        if size <= LONG_BYTES:
            return await asyncio.to_thread(function, *arguments)
        return await self._pool.run(function, *arguments, owner=owner)


def shared_of(stage: Stage) -> tuple[object, ...]:
    """What productions hold of a stage, so that none brings its own copy from the other process."""
    return (stage, *stage.parts)


def _weight(path: Path) -> int:
    """A score's size, roughly, in bytes that have to be read."""
    with path.open("rb") as file:
        packed = file.read(4).startswith((GZIP_MAGIC, *ZIP_MAGICS))
    return path.stat().st_size * (PACKED if packed else 1)


def read_and_plan(
    stage: Stage,
    path: Path,
    filename: str | None,
    cast: Cast,
    alignment: SongTimes | None = None,
    stances: Mapping[str, HumanPose] | None = None,
    transposition: int = 0,
) -> Production:
    """What `Reader.production` does."""
    score = read_score(path.read_bytes(), filename=filename, sequence=cast.sequence)
    production = Production.plan(
        stage, score, cast=cast, alignment=alignment, stances=stances, transposition=transposition
    )
    if len(score.notes) < LONG_NOTES:
        return production
    _write(production.show)
    return replace(production, packed_score=packed_score(production))


def read_written_show(data: bytes, registry: ParameterRegistry) -> Show:
    """What `Reader.show` does; it is written too, which takes as long as reading it."""
    show = read_show(data, registry)
    _write(show)
    return show


def _write(show: Show) -> None:
    """Put the text of its tracks with a show."""
    for track in show.tracks:
        if isinstance(track, Track):
            write_with(track, show.time)


def read_written_track(data: bytes, parameter: Parameter, unit: TimeUnit) -> Track:
    """What `Reader.track` does."""
    try:
        document: object = read_json(data)
    except ValueError as error:
        raise ShowError(f"the track is no JSON: {error}", track=parameter.path) from error
    if not isinstance(document, Mapping):
        raise ShowError(f"a track is a JSON object, not {type(document).__name__}", track=parameter.path)
    fields = typed("Mapping[str, Any]", document)
    if fields.get("parameter", parameter.path) != parameter.path:
        detail = f"this is the track of {parameter.path}, and the body names {shown(fields['parameter'])}"
        raise ShowError(detail, track=parameter.path, field="parameter")
    if not fields.get("keyframes") and "events" not in fields:
        detail = "a track has one keyframe at least, or answers events; DELETE removes it"
        raise ShowError(detail, track=parameter.path)
    track = read_track({"parameter": parameter.path, **fields}, parameter, unit)
    write_with(track, unit)
    return track


def read_written_edits(data: bytes) -> list[Edit]:
    """What `Reader.edits` does."""
    try:
        document: object = read_json(data)
    except ValueError as error:
        raise ShowError(f"the edits are no JSON: {error}") from error
    return read_edits(document)
