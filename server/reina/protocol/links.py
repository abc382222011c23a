"""Where everything stands on the server."""

from __future__ import annotations

from typing import TYPE_CHECKING

from reina.protocol.messages import StreamLinks
from reina.protocol.resources import SessionLinks

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

API = "/api/v1"


def session_href(session_id: str) -> str:
    """A session."""
    return f"{API}/sessions/{session_id}"


def rig_href(name: str) -> str:
    """A rig."""
    return f"{API}/rigs/{name}"


def session_links(session_id: str) -> SessionLinks:
    """Everything of a session."""
    href = session_href(session_id)
    return SessionLinks(
        self=href,
        page=f"/s/{session_id}",
        score=f"{href}/score",
        song=f"{href}/song",
        show=f"{href}/show",
        transport=f"{href}/transport",
        frames=f"{href}/frames",
        manifest=f"{href}/manifest",
        stream=f"{href}/stream",
    )


def rendering_href(
    session_id: str, sequence: int, part: int, transposition: int, joined_parts: Sequence[int] = ()
) -> str:
    """A song that the server makes from the score: another address for each of a session's renderings.

    The query only tells them apart; what is sent is always the song of the part that is played now.

    Args:
        session_id: Whose.
        sequence: Which of the file's sequences.
        part: The part that the player plays.
        transposition: Semitones by which it sounds moved, whatever moved it.
        joined_parts: Further parts that the player plays.
    """
    href = f"{session_href(session_id)}/song?sequence={sequence}&part={part}&transposition={transposition}"
    return f"{href}&joined_parts={','.join(map(str, joined_parts))}" if joined_parts else href


def stream_links(session_id: str, rigs: Iterable[str]) -> StreamLinks:
    """What a viewer needs beside the stream, the rigs of the skeletons in it among them."""
    links = session_links(session_id)
    return StreamLinks(
        session=links.self,
        score=links.score,
        show=links.show,
        song=links.song,
        rigs={name: rig_href(name) for name in rigs},
    )
