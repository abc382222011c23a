"""Shows in the database, with what they were and what was taken back.

Each function works within a transaction.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from sqlalchemy import delete, func, insert, select, update

from reina.sessions.storage.errors import SessionGoneError
from reina.sessions.storage.schema import SESSIONS, SHOW_OBJECTS, SHOW_STATES
from reina.sessions.storage.show_pieces import (
    LIST,
    ShowUnreadableError,
    StoredState,
    StoredTrack,
    packed,
    show_text,
    split,
    track_texts,
    unpacked,
)

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Generator, Mapping

    from sqlalchemy import ColumnElement, Connection

AT_ONCE = 500
"""So many digests are asked for in one statement."""


MISSING_STATE = "a state of its show is missing"


@dataclass(frozen=True)
class Moved:
    """Where a show has come to: the number of the state, and how many bytes it all takes more."""

    number: int
    more_bytes: int


@dataclass(frozen=True)
class KeptShow:
    """A show as it was read.

    Attributes:
        text: As JSON; without the tracks that were known.
        digests: Of all its tracks, in their order; none where each track is in the text.
        earlier: How many states there are before it.
        later: How many were taken back.
        weights: What each step weighs, the oldest first; see `ShowRevision.weights`.
    """

    text: bytes
    digests: tuple[bytes, ...] = ()
    earlier: int = 0
    later: int = 0
    weights: tuple[int, ...] = ()


def add_show(
    connection: Connection, session_id: str, state: StoredState, tracks: Mapping[bytes, StoredTrack]
) -> int:
    """Keep the first state of a new session's show, whose number is 0; returns how many bytes it takes."""
    return _insert_state(connection, session_id, 0, 0, state, tracks)


def append_state(
    connection: Connection,
    session_id: str,
    state: StoredState,
    tracks: Mapping[bytes, StoredTrack],
    *,
    weight: int,
    kept: int,
    is_last: bool,
) -> Moved:
    """Keep what an edit made of a show, forget what was taken back, and what is too old.

    Args:
        connection: Within its transaction.
        session_id: Whose.
        state: What it is now.
        tracks: Its tracks, by digest.
        weight: What the step weighs.
        kept: How many states before it are kept.
        is_last: Whether nothing was taken back before.
    """
    present, oldest, content = _present(connection, session_id)
    number = present + 1
    before = _objects_of(connection, session_id, StoredState.read(content), tracks)
    freed = 0
    if not is_last:
        freed = _forget(
            connection, session_id, SHOW_STATES.c.number > present, SHOW_OBJECTS.c["first"] > present
        )
        # What the present state had in common with what was taken back is the newest's again.
        _set_last(connection, session_id, None, SHOW_OBJECTS.c["last"] >= present)
        before |= _digests(connection, session_id, SHOW_OBJECTS.c["last"].is_(None))
    after = {digest for track in tracks.values() for digest in (track.digest, *track.pieces)}
    for some in _some(before - after):
        _set_last(connection, session_id, present, SHOW_OBJECTS.c.digest.in_(some))
    added = _insert_state(connection, session_id, number, weight, state, tracks, known=before)
    if oldest < number - kept:
        too_old = SHOW_STATES.c.number < number - kept, SHOW_OBJECTS.c["last"] < number - kept
        freed += _forget(connection, session_id, *too_old)
    return Moved(number, added - freed)


def moved_by(connection: Connection, session_id: str, steps: int) -> Moved:
    """Walk to another state that is kept: -1 takes the last edit back, 1 does it again."""
    present, _, _ = _present(connection, session_id)
    _state(connection, session_id, present + steps)
    return Moved(present + steps, 0)


def read_show(connection: Connection, session_id: str, known: Collection[bytes] = ()) -> KeptShow:
    """Read the present state of a session's show.

    Args:
        connection: Within its transaction.
        session_id: Whose.
        known: Digests of tracks whose texts are not wanted.

    Raises:
        ShowUnreadableError: It is damaged.
    """
    present = _number(connection, session_id)
    rows = connection.execute(
        select(SHOW_STATES.c.number, SHOW_STATES.c.weight)
        .where(SHOW_STATES.c.session_id == session_id)
        .order_by(SHOW_STATES.c.number)
    ).all()
    numbers = [number for number, _ in rows]
    if present not in numbers or numbers != list(range(numbers[0], numbers[-1] + 1)):
        raise ShowUnreadableError(MISSING_STATE)
    state = _state(connection, session_id, present)
    wanted = [digest for digest in state.tracks if digest not in known]
    texts = track_texts(wanted, _fetching(connection, session_id))
    return KeptShow(
        show_text(state, texts),
        () if state.head is None or not known else state.tracks,
        present - numbers[0],
        numbers[-1] - present,
        tuple(weight for _, weight in rows[1:]),
    )


def read_state(
    connection: Connection, session_id: str, steps: int, known: Collection[bytes]
) -> tuple[StoredState, dict[bytes, bytes]]:
    """Read another state than the present one.

    Args:
        connection: Within its transaction.
        session_id: Whose.
        steps: How far from the present one; negative: before it.
        known: Digests of tracks whose texts are not wanted.

    Returns:
        The state, and the texts of its other tracks.

    Raises:
        ShowUnreadableError: It is damaged.
    """
    state = _state(connection, session_id, _number(connection, session_id) + steps)
    wanted = [digest for digest in state.tracks if digest not in known]
    return state, track_texts(wanted, _fetching(connection, session_id))


def _present(connection: Connection, session_id: str) -> tuple[int, int, bytes]:
    """The number of the present state, to be followed by another, that of the oldest, and the present one.

    Raises:
        SessionGoneError: There is no such session.
        ShowUnreadableError: There is no such state.
    """
    # Whoever writes next waits: its state is numbered by this one.
    asked = select(SESSIONS.c.show_state).where(SESSIONS.c.id == session_id).with_for_update()
    number = connection.execute(asked).scalar()
    if number is None:
        raise SessionGoneError(f"the session {session_id!r} was ended meanwhile")
    of_session = SHOW_STATES.c.session_id == session_id
    oldest = select(func.min(SHOW_STATES.c.number)).where(of_session).scalar_subquery()
    row = connection.execute(
        select(oldest, SHOW_STATES.c.content).where(of_session, SHOW_STATES.c.number == number)
    ).first()
    if row is None:
        raise ShowUnreadableError(MISSING_STATE)
    return number, row[0], row[1]


def _number(connection: Connection, session_id: str) -> int:
    number = connection.execute(select(SESSIONS.c.show_state).where(SESSIONS.c.id == session_id)).scalar()
    return -1 if number is None else number


def _state(connection: Connection, session_id: str, number: int) -> StoredState:
    content = connection.execute(
        select(SHOW_STATES.c.content).where(
            SHOW_STATES.c.session_id == session_id, SHOW_STATES.c.number == number
        )
    ).scalar()
    if content is None:
        raise ShowUnreadableError(MISSING_STATE)
    return StoredState.read(content)


def _fetching(connection: Connection, session_id: str) -> Callable[[set[bytes]], dict[bytes, bytes]]:
    def fetch(digests: set[bytes]) -> dict[bytes, bytes]:
        found: dict[bytes, bytes] = {}
        for some in _some(digests):
            rows = connection.execute(
                select(SHOW_OBJECTS.c.digest, SHOW_OBJECTS.c.data).where(
                    SHOW_OBJECTS.c.session_id == session_id, SHOW_OBJECTS.c.digest.in_(some)
                )
            )
            found.update((bytes(digest), bytes(data)) for digest, data in rows)
        return found

    return fetch


def _digests(connection: Connection, session_id: str, which: ColumnElement[bool]) -> set[bytes]:
    rows = connection.execute(
        select(SHOW_OBJECTS.c.digest).where(SHOW_OBJECTS.c.session_id == session_id, which)
    )
    return {bytes(digest) for digest in rows.scalars()}


def _objects_of(
    connection: Connection, session_id: str, state: StoredState, tracks: Mapping[bytes, StoredTrack]
) -> set[bytes]:
    """All objects of a state; lists of pieces are read of tracks alone that are not at hand."""
    objects = set(state.tracks)
    for digest in objects & tracks.keys():
        objects.update(tracks[digest].pieces)
    for digest, data in _fetching(connection, session_id)(set(state.tracks) - tracks.keys()).items():
        kind, content = unpacked(digest, data)
        if kind == LIST:
            objects.update(split(content))
    return objects


def _set_last(connection: Connection, session_id: str, last: int | None, which: ColumnElement[bool]) -> None:
    connection.execute(
        update(SHOW_OBJECTS).where(SHOW_OBJECTS.c.session_id == session_id, which).values(last=last)
    )


def _insert_state(
    connection: Connection,
    session_id: str,
    number: int,
    weight: int,
    state: StoredState,
    tracks: Mapping[bytes, StoredTrack],
    known: Collection[bytes] = (),
) -> int:
    """Keep a state and what it is made of; returns how many bytes it takes more."""
    objects = {digest: data for track in tracks.values() for digest, data in track.objects.items()}
    new = objects.keys() - set(known)
    if number:
        # What an earlier state had that is kept still.
        for some in _some(new):
            there = _digests(connection, session_id, SHOW_OBJECTS.c.digest.in_(some))
            if there:
                _set_last(connection, session_id, None, SHOW_OBJECTS.c.digest.in_(there))
                new -= there
    packs = {digest: packed(objects[digest]) for digest in new}
    if packs:
        of_all = {"session_id": session_id, "first": number, "last": None}
        rows = [{**of_all, "digest": digest, "data": data} for digest, data in packs.items()]
        connection.execute(insert(SHOW_OBJECTS), rows)
    content = state.written()
    connection.execute(
        insert(SHOW_STATES).values(session_id=session_id, number=number, weight=weight, content=content)
    )
    return len(content) + sum(map(len, packs.values()))


def _forget(
    connection: Connection, session_id: str, states: ColumnElement[bool], objects: ColumnElement[bool]
) -> int:
    """Remove states and what they alone are made of; returns how many bytes that frees."""
    freed = connection.execute(
        delete(SHOW_STATES)
        .where(SHOW_STATES.c.session_id == session_id, states)
        .returning(func.length(SHOW_STATES.c.content))
    ).scalars()
    size = sum(freed)
    if size:
        freed = connection.execute(
            delete(SHOW_OBJECTS)
            .where(SHOW_OBJECTS.c.session_id == session_id, objects)
            .returning(func.length(SHOW_OBJECTS.c.data))
        ).scalars()
        size += sum(freed)
    return size


def _some(digests: Collection[bytes]) -> Generator[list[bytes]]:
    ordered = sorted(digests)
    for at in range(0, len(ordered), AT_ONCE):
        yield ordered[at : at + AT_ONCE]
