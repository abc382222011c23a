"""Where everything stands on the server."""

from __future__ import annotations

from typing import TYPE_CHECKING
from urllib.parse import quote

from reina.protocol.messages import StreamLinks
from reina.protocol.resources import SessionLinks

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

API = "/api/v1"


def session_href(session_id: str) -> str:
    """A session."""
    return f"{API}/sessions/{session_id}"


def blocks_href(session_id: str, revision: str) -> str:
    """What the addresses of a session's packed blocks begin with."""
    return f"{session_href(session_id)}/blocks/{revision}"


def stance_href(session_id: str, name: str) -> str:
    """A session's own stance."""
    return f"{session_href(session_id)}/stances/{quote(name, safe='')}"


def transcription_href(transcription_id: str) -> str:
    """The search for a recording's notes."""
    return f"{API}/transcriptions/{transcription_id}"


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


def rendering_href(session_id: str, sequence: int, played: Iterable[tuple[Sequence[int], int]]) -> str:
    """A song that the server makes from the score: another address for each of a session's renderings.

    The query only tells them apart; what is sent is always the song of what is played now.

    Args:
        session_id: Whose.
        sequence: Which of the file's sequences.
        played: Of each player the parts, and the semitones by which they sound moved, whatever moved them.
    """
    moved = "".join(
        f"&part={part}&transposition={semitones}"
        + (f"&joined_parts={','.join(map(str, joined))}" if joined else "")
        for (part, *joined), semitones in played
    )
    return f"{session_href(session_id)}/song?sequence={sequence}{moved}"


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
