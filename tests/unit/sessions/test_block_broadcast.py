from __future__ import annotations

import asyncio
import threading
from typing import TYPE_CHECKING

from tests.unit.sessions.fakes import NumberedPerformance, encoded, packed

from reina.music import ClockState
from reina.protocol.packed_block import packed_header
from reina.sessions.block_broadcast import AHEAD_S, BlockBroadcast
from reina.sessions.frames import KeptBytes

if TYPE_CHECKING:
    from collections.abc import Iterable

    from reina.sessions.packed_blocks import PackedBlocks

AT = 1000.0


def state(song_time_s: float = 0.0, *, playing: bool = True, at: float = AT) -> ClockState:
    return ClockState(playing, song_time_s, at, 1.0, None, 7, 10.0)


def numbers(messages: Iterable[bytes]) -> list[int]:
    return [int(packed_header(message)["block"]) for message in messages]


def made(blocks: PackedBlocks, wanted: Iterable[int]) -> PackedBlocks:
    for number in wanted:
        blocks.block(number, "packed")
    return blocks


def test_blocks_go_out_two_seconds_before_they_are_due() -> None:
    broadcast = BlockBroadcast(made(packed(encoded()), range(10)), "packed", state())
    assert numbers(broadcast.until(AT)) == [0, 1, 2]
    assert broadcast.until(AT + 0.9) == []
    assert broadcast.next_time() == AT + 3.0 - AHEAD_S
    assert numbers(broadcast.until(AT + 1.0)) == [3]


def test_what_is_not_packed_is_waited_for_in_its_order() -> None:
    blocks = made(packed(encoded()), [0, 2])
    broadcast = BlockBroadcast(blocks, "packed", state())
    assert broadcast.missing(AT) == [1]
    assert numbers(broadcast.until(AT)) == [0]
    made(blocks, [1])
    assert broadcast.missing(AT) == []
    assert numbers(broadcast.until(AT)) == [1, 2]


def test_only_what_comes_after_it_was_due_is_late() -> None:
    broadcast = BlockBroadcast(packed(encoded()), "packed", state())
    assert broadcast.overdue(AT + 0.5) == 0, "what an epoch begins with comes as soon as it can"
    assert broadcast.overdue(AT + 2.5) == 2


def test_who_joins_late_gets_what_the_others_have() -> None:
    broadcast = BlockBroadcast(made(packed(encoded()), range(10)), "packed", state())
    broadcast.until(AT + 1.2)
    assert numbers(broadcast.catch_up(state(1.5, at=AT + 1.5))) == [1, 2, 3]
    assert numbers(broadcast.until(AT + 2.0)) == [4], "and with the others the next"


def test_blocks_are_packed_once_and_on_a_thread() -> None:
    performance = NumberedPerformance()
    blocks = packed(encoded(performance))
    asyncio.run(blocks.made([0, 1, 0], "packed"))
    asyncio.run(blocks.made([1], "lossless"))
    assert performance.evaluated == [0, 1]
    assert set(performance.threads) != {threading.current_thread().name}
    first = blocks.packed(1, "packed")
    assert first is not None
    assert first is blocks.block(1, "packed")
    assert first != blocks.packed(1, "lossless")


def test_what_is_kept_is_bounded_and_counted_and_let_go_of() -> None:
    together = KeptBytes()
    frames = encoded(kept=1, together=together)
    blocks = packed(frames, kept=2)
    made(blocks, range(4))
    assert [blocks.packed(number, "packed") is None for number in range(4)] == [True, True, False, False]
    held = [blocks.block(number, "packed") for number in (2, 3)]
    assert together.of(frames) == frames.block(3).nbytes + sum(map(len, held))
    blocks.forget()
    assert together.of(frames) == 0
    assert blocks.packed(3, "packed") is None
