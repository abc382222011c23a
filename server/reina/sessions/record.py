"""What is kept of a session beside its files."""

from __future__ import annotations

import re
import secrets
from datetime import UTC, datetime
from typing import TYPE_CHECKING, Annotated, Any, cast

from pydantic import BaseModel, ConfigDict, Field, model_validator

from reina.instruments import Cast  # noqa: TC001 - pydantic reads it
from reina.protocol.resources import Warned  # noqa: TC001 - pydantic reads it
from reina.sessions.kept_clock import KeptClock

if TYPE_CHECKING:
    from collections.abc import Iterable

SESSION_ID = re.compile(r"[A-Za-z0-9_-]{22}")
"""128 random bits, base64url."""

CASTING_FIELDS = ("instrument", "part", "transposition", "written", "player", "octave_fit", "joined_parts")
"""What a record of one player has of a casting."""


UNDECODED = frozenset({"audio/mp4", "audio/webm"})
"""What only browsers decode."""


class SongRecord(BaseModel):
    """An uploaded song, as it was decoded."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    file: str
    """What is served."""
    media_type: str
    duration_s: float | None
    warnings: tuple[Warned, ...] = ()
    """What its sender should know."""
    original: str | None = None
    """The file as it came, where what is served was made of it."""
    heard: str | None = None
    """What was decoded by a page, where the server does not decode it: to be listened to."""

    @property
    def is_heard(self) -> bool:
        """Whether the server can listen to it: to M4A and WebM only once a page has decoded them."""
        return self.media_type not in UNDECODED or self.heard is not None


class StanceRecord(BaseModel):
    """A pose that the session's players can stand in."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    name: str
    file: str | None
    """What its sender called the motion file."""
    time_s: float
    """Of which frame of that file it is."""
    turns: tuple[tuple[float, float, float, float], ...]
    """As `reina.skeleton.pose_numbers` has it."""


class FileRecord(BaseModel):
    """A file of a session, as the file store keeps it."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    name: str
    """What the session calls it: ``score``, ``song.flac``, ``song.peaks``."""
    digest: str
    """SHA-256 of its content, hexadecimal."""
    size: int
    """Bytes."""


class SessionRecord(BaseModel):
    """What is known of a session, as it is kept: JSON in the database."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    id: Annotated[str, Field(pattern=f"^{SESSION_ID.pattern}$")]
    title: str
    public: bool
    created_at: str
    token_sha256: str
    """Of the control token, which itself is not kept."""
    owner: str | None = None
    """Who made it, where the server knows people; controls it without the token."""
    cast: Cast
    """Who plays what."""
    score_filename: str | None
    """The name that the score was uploaded under."""
    song: SongRecord | None
    """None: the server renders the score."""
    files: tuple[FileRecord, ...] = ()
    """What it has in the file store."""
    stances: tuple[StanceRecord, ...] = ()
    """Its own stances, in the order of the show's choices."""
    clock: KeptClock = KeptClock()
    """The clock, at some time; where it is now follows from that."""
    sender: str = ""
    """Who sent it, as far as that was known: an address, which is told to nobody."""

    @model_validator(mode="before")
    @classmethod
    def _of_a_clock_that_stood(cls, fields: object) -> object:
        """Records of before clocks were kept have nothing but where it stood."""
        if not isinstance(fields, dict) or "song_time_s" not in fields:
            return cast("object", fields)
        rest = dict(cast("dict[str, Any]", fields))
        stood_s = rest.pop("song_time_s")
        return rest | {"clock": {"song_time_s": stood_s}}

    @model_validator(mode="before")
    @classmethod
    def _of_one_player(cls, fields: object) -> object:
        """Records of before there were casts have the only player's casting beside the other fields."""
        if not isinstance(fields, dict) or "cast" in fields:
            return cast("object", fields)
        rest = dict(cast("dict[str, Any]", fields))
        casting = {name: rest.pop(name) for name in CASTING_FIELDS if name in rest}
        return rest | {"cast": {"sequence": rest.pop("sequence", None), "castings": [casting]}}


def with_files(record: SessionRecord, files: Iterable[FileRecord]) -> SessionRecord:
    """A record with further files; one of a name that it has already takes its place."""
    named = {file.name: file for file in (*record.files, *files)}
    return record.model_copy(update={"files": tuple(named.values())})


def new_id() -> str:
    """An id that cannot be guessed: who has it may watch."""
    return secrets.token_urlsafe(16)


def created_now() -> str:
    """The present as ISO 8601, UTC."""
    return datetime.now(UTC).isoformat(timespec="seconds")
