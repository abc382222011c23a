"""An amount that is shared out."""

from __future__ import annotations

import pytest

from reina.system.room import NoRoomLeftError, Room


def test_all_together_and_each_have_so_much() -> None:
    room = Room(10, 6)
    room.take("one", 5)
    with pytest.raises(NoRoomLeftError) as refused:
        room.take("one", 2)
    assert refused.value.to_owner
    room.take("two", 5)
    with pytest.raises(NoRoomLeftError) as refused:
        room.take("three", 1)
    assert not refused.value.to_owner
    room.give_back("one", 5)
    room.take("three", 3)
    assert (room.held, room.of("one"), room.of("three")) == (8, 0, 3)


def test_what_is_held_for_a_while_is_given_back_whatever_happens() -> None:
    room = Room(1)
    held: list[int] = []

    def fail() -> None:
        with room.holding("one"):
            held.append(room.held)
            raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        fail()
    assert (held, room.held) == ([1], 0)
