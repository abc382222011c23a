"""Files made worse at random, whatever their format: bytes flipped, set, put in, taken out, repeated."""

from __future__ import annotations

import random
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence


@dataclass(frozen=True)
class Format:
    """What means something to a format's reader.

    Attributes:
        interesting: Bytes that mean something.
        tokens: Runs of bytes that do.
        numbers: What a digit of a text is made into.
    """

    interesting: Sequence[int]
    tokens: Sequence[bytes]
    numbers: Sequence[bytes]


def _flip(data: bytearray, rng: random.Random, _: Format) -> None:
    data[rng.randrange(len(data))] ^= 1 << rng.randrange(8)


def _set(data: bytearray, rng: random.Random, form: Format) -> None:
    data[rng.randrange(len(data))] = rng.choice(form.interesting)


def _insert(data: bytearray, rng: random.Random, form: Format) -> None:
    at = rng.randrange(len(data) + 1)
    data[at:at] = rng.choice(form.tokens) if rng.random() < 0.3 else rng.randbytes(rng.randint(1, 6))


def _remove(data: bytearray, rng: random.Random, _: Format) -> None:
    at = rng.randrange(len(data))
    del data[at : at + rng.randint(1, 12)]


def _repeat(data: bytearray, rng: random.Random, _: Format) -> None:
    at = rng.randrange(len(data))
    piece = data[at : at + rng.randint(1, 40)]
    data[at:at] = piece * rng.randint(1, 4)


def _truncate(data: bytearray, rng: random.Random, _: Format) -> None:
    del data[rng.randrange(len(data)) :]


def _digit(data: bytearray, rng: random.Random, form: Format) -> None:
    """Make a number of a text another one."""
    digits = [index for index, byte in enumerate(data) if 0x30 <= byte <= 0x39]
    if digits:
        at = rng.choice(digits)
        data[at : at + 1] = rng.choice(form.numbers)


MUTATIONS: tuple[Callable[[bytearray, random.Random, Format], None], ...] = (
    _flip, _flip, _set, _set, _insert, _remove, _repeat, _truncate, _digit,
)  # fmt: skip


def mutate(data: bytes, form: Format, rng: random.Random) -> bytes:
    """A file with one mutation or more."""
    worse = bytearray(data)
    for _ in range(1 + int(rng.expovariate(0.5))):
        if worse:
            rng.choice(MUTATIONS)(worse, rng, form)
    return bytes(worse)


def mutated(seeds: Sequence[bytes], form: Format, count: int, seed: int) -> Iterator[bytes]:
    """Yield `count` files, each one of `seeds` with one mutation or more."""
    rng = random.Random(seed)
    for _ in range(count):
        yield mutate(rng.choice(seeds), form, rng)
