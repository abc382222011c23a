"""The recordings of sessions: what pages decode of them, and their peaks."""

from __future__ import annotations

import asyncio
import contextlib
from typing import TYPE_CHECKING

from reina.errors import InputError
from reina.sessions.session_reading import peaks_name
from reina.sessions.storage.errors import SessionDamagedError
from reina.sound.recording.as_flac import SUFFIX as FLAC_SUFFIX
from reina.sound.recording.peaks import Peaks, peaks_path, read_peaks
from reina.sound.recording.probe import Conversion

if TYPE_CHECKING:
    from pathlib import Path

    from reina.sessions.record import SessionRecord, SongRecord
    from reina.sessions.session import Session
    from reina.sessions.session_edits import SessionEdits
    from reina.sessions.staging import Staging
    from reina.sessions.storage.session_storage import SessionStorage
    from reina.sound.recording.decoder import SongDecoder
    from reina.sound.recording.probe import AudioInfo

HEARD_TOLERANCE_S, HEARD_TOLERANCE = 1.0, 0.01
"""By how much what a page decoded may differ from the length that the song's headers say: s, and a share."""
LOWEST_HEARD_RATE = 8000
"""Fewer samples a second tell too little of notes."""


class Recordings:
    """Songs that came with scores.

    Args:
        storage: Keeps them.
        edits: Changes their sessions.
        decoder: Decodes them.
        staging: Where that is done.
    """

    def __init__(
        self, storage: SessionStorage, edits: SessionEdits, decoder: SongDecoder, staging: Staging
    ) -> None:
        self._storage = storage
        self._edits = edits
        self._decoder = decoder
        self._staging = staging

    async def file(self, session: Session, *, is_original: bool = False) -> Path | None:
        """The recording of a session, or what it was sent as; None where there is none.

        Raises:
            SessionDamagedError: The file is lost.
        """
        song = session.record.song
        if song is None:
            return None
        name = (song.original or song.file) if is_original else song.file
        return await asyncio.to_thread(self._storage.file, session.record, name)

    async def hear(self, session: Session, sent: Path) -> None:
        """Take what a page decoded of a song that the server does not decode, and look for the score in it.

        Its length is the song's from then on, and its peaks are.

        Args:
            session: Whose.
            sent: The sound, in a folder of `Staging`: WAV or anything else that is decoded here.

        Raises:
            InputError: It cannot be decoded, or not be that song.
        """
        heard = sent.with_name(f"heard{FLAC_SUFFIX}")
        info = await self._decoder.probe(sent, Conversion(heard, is_forced=True))
        await self._edits.until_kept(session, lambda: self._keep_heard(session, sent, heard, info))
        self._edits.search_alignment(session)

    async def _keep_heard(self, session: Session, sent: Path, heard: Path, info: AudioInfo) -> None:
        async with self._edits.held(session):
            song = session.record.song
            if song is None:
                raise InputError("the session has no recording")
            _check_heard(info, song)
            record = session.record.model_copy(
                update={"song": song.model_copy(update={"heard": heard.name, "duration_s": info.duration_s})}
            )

            async def show(record: SessionRecord) -> None:
                session.alignment.is_heard = True
                await session.change_cast(record, session.production)

            staged = {heard.name: heard, peaks_name(song): peaks_path(sent)}
            await self._edits.keep(session, record, staged=staged, show=show)

    async def peaks(self, session: Session) -> Peaks | None:
        """The peaks of a session's recording, decoded where they are not kept; None where they cannot be.

        Raises:
            InputError: It cannot be decoded any more.
        """
        song = session.record.song
        if song is None:
            return None
        name = peaks_name(song)
        with contextlib.suppress(SessionDamagedError):
            return await asyncio.to_thread(lambda: read_peaks(self._storage.file(session.record, name)))
        if not song.is_heard:
            return None
        async with self._staging.folder() as folder:
            # What is decoded is written beside what looks like the file.
            link = folder / (song.heard or song.file)
            path = await asyncio.to_thread(self._storage.file, session.record, link.name)
            await asyncio.to_thread(link.symlink_to, path.absolute())
            await self._decoder.probe(link)
            peaks = await asyncio.to_thread(read_peaks, peaks_path(link))
            if peaks is not None:

                async def keep() -> None:
                    async with self._edits.held(session):
                        await self._edits.keep(session, session.record, staged={name: peaks_path(link)})

                await self._edits.until_kept(session, keep)
        return peaks


def _check_heard(info: AudioInfo, song: SongRecord) -> None:
    """Refuse what is not the sound of a song, as far as can be told.

    Raises:
        InputError: It is not.
    """
    if info.duration_s is None or info.sample_rate is None or not info.is_converted:
        raise InputError(
            f"{info.format} is not decoded here either: send the sound as WAV or FLAC, of one channel or two"
        )
    if info.sample_rate < LOWEST_HEARD_RATE:
        raise InputError(
            f"the sound has {info.sample_rate:,} samples a second; {LOWEST_HEARD_RATE:,} at least are needed "
            "to hear notes in it, 22,050 are enough"
        )
    if song.duration_s is None or song.heard is not None:
        return
    if abs(info.duration_s - song.duration_s) > HEARD_TOLERANCE_S + HEARD_TOLERANCE * song.duration_s:
        raise InputError(
            f"the sound lasts {info.duration_s:.2f} s, and the song {song.duration_s:.2f} s: it is not this "
            "song, or not all of it"
        )
