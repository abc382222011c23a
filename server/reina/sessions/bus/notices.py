"""What servers tell one another of a session."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, TypeAdapter

from reina.sessions.kept_clock import KeptClock  # noqa: TC001 - pydantic reads it


class SharedClock(BaseModel):
    """A session's clock as all servers have it.

    Attributes:
        turn: Counts the changes: whoever changes it names the turn that is known there.
        clock: Where it stands.
    """

    model_config = ConfigDict(frozen=True)

    turn: int
    clock: KeptClock


class _Notice(BaseModel):
    model_config = ConfigDict(frozen=True)

    sender: str
    """The server that tells it."""


class ClockSet(_Notice):
    """Somebody played, paused or sought."""

    kind: Literal["clock"] = "clock"
    shared: SharedClock


class SessionChanged(_Notice):
    """Something of it was changed, and is kept; it has this version now."""

    kind: Literal["changed"] = "changed"
    version: int


class SessionEnded(_Notice):
    """It is no more."""

    kind: Literal["ended"] = "ended"


class SearchProgress(_Notice):
    """So much of a search for the score in the song is done, 0..1; None: it has come to its end."""

    kind: Literal["search"] = "search"
    progress: float | None


Notice = ClockSet | SessionChanged | SessionEnded | SearchProgress
notice: TypeAdapter[Notice] = TypeAdapter(Annotated[Notice, Field(discriminator="kind")])
"""Reads and writes one as JSON."""
