"""What a new session is made of, as it was sent."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from reina.instruments import Cast

if TYPE_CHECKING:
    from pathlib import Path


@dataclass(frozen=True)
class Draft:
    """What a new session is made of.

    Attributes:
        folder: A folder of `Staging` that holds the files named here.
        score: Name of the score's file in it.
        score_filename: What the sender calls the score.
        song: Name of the song's file, or None.
        show: Name of the show's file, or None.
        title: What to call the session; the score's own title when None.
        public: Whether the list of sessions shows it.
        cast: Who plays what.
        in_time: Whether the score's seconds are the song's already, so that it need not be looked for.
        sender: Who sent it, as far as that is known; what is read of senders is read in turn.
        owner: The person whose it is, where people are known; controls it without a token.
    """

    folder: Path
    score: str
    score_filename: str | None = None
    song: str | None = None
    show: str | None = None
    title: str | None = None
    public: bool = False
    cast: Cast = field(default_factory=Cast)
    in_time: bool = False
    sender: str = ""
    owner: str | None = None
