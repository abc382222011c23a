from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, cast

import pytest

from reina.sessions.limit_errors import PieceTooLargeError, ServerBusyError
from reina.sessions.memory_bound import MemoryBound

if TYPE_CHECKING:
    from collections.abc import Iterable

    from reina.sessions.session import Session

BOUND = MemoryBound(most_sessions=10, most_bytes=100, most_idle_bytes=30)


@dataclass(frozen=True)
class Loaded:
    name: str
    weight: int
    is_idle: bool = True


def leaving(loaded: Iterable[Loaded], adding: int, **options: int) -> list[str]:
    sessions = cast("list[Session]", list(loaded))
    gone = cast("list[Loaded]", BOUND.leaving(sessions, adding, **options))
    return [session.name for session in gone]


def test_idle_sessions_have_a_part_of_the_memory_and_the_oldest_go_first() -> None:
    idle = [Loaded("first", 10), Loaded("second", 10), Loaded("third", 10)]
    assert leaving(idle, 0) == []
    assert leaving(idle, 5) == ["first"]
    assert leaving(idle, 5, coming=10) == ["first", "second"]
    assert leaving(idle, 60) == ["first", "second", "third"], "what comes may be larger than the idle's part"


def test_watched_sessions_may_have_all_of_it() -> None:
    watched = [Loaded(name, 30, is_idle=False) for name in "abc"]
    assert leaving([*watched, Loaded("idle", 5)], 5) == []
    assert leaving([*watched, Loaded("idle", 10)], 10) == ["idle"]
    with pytest.raises(ServerBusyError, match="being watched"):
        leaving(watched, 11)
    with pytest.raises(PieceTooLargeError):
        leaving([], 101)


def test_what_a_watched_session_grows_by_is_no_idle_sessions() -> None:
    idle, growing = Loaded("idle", 30), Loaded("growing", 20, is_idle=False)
    sessions = cast("list[Session]", [idle, growing])
    assert BOUND.leaving(sessions, 50, staying=sessions[1]) == []
