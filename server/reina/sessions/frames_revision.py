"""Which state of score, cast and show frames are of: the same on every server, and after every start."""

from __future__ import annotations

import hashlib
from typing import TYPE_CHECKING

from reina.system.digest import code_digest

if TYPE_CHECKING:
    from collections.abc import Iterable

    from reina.instruments import Cast
    from reina.sessions.record import SessionRecord
    from reina.sessions.show_revision import ShowRevision
    from reina.sessions.stage import Stage
    from reina.sound.alignment.alignment import Alignment


def frames_revision(
    stage: Stage, record: SessionRecord, show_revision: ShowRevision, alignment: Alignment | None
) -> int:
    """64 bits that are others whenever the frames are.

    Args:
        stage: Who plays on what.
        record: The score's file, the cast and the stances.
        show_revision: The show.
        alignment: Where the score is heard in the song.
    """
    scores = [file.digest for file in record.files if file.name == "score"]
    stances = [stance.model_dump_json() for stance in record.stances]
    moved = alignment if alignment is not None and alignment.moves else None
    return revision_of(stage, scores, record.cast, show_revision, stances=stances, moved=moved)


def revision_of(
    stage: Stage,
    scores: Iterable[str],
    cast: Cast,
    show_revision: ShowRevision,
    *,
    stances: Iterable[str] = (),
    moved: Alignment | None = None,
) -> int:
    """The same of what is no session.

    Args:
        stage: Who plays on what.
        scores: SHA-256 of the score's file, hexadecimal.
        cast: Who plays what, completed.
        show_revision: The show.
        stances: Stances beside those that there always are, as JSON.
        moved: Where the score is heard in the song, where that is not where it is written.
    """
    said = (
        code_digest(),
        stage.digest,
        *scores,
        repr(cast),
        *stances,
        show_revision.text.etag,
        repr(moved),
    )
    return int.from_bytes(hashlib.sha256("\n".join(said).encode()).digest()[:8], "little")
