"""MIDI channels for the parts of a document that names none, or the same for two instruments."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import count

from reina.music.gm import DRUM_CHANNEL

CHANNELS_OF_PORT = 16


@dataclass(frozen=True)
class Wish:
    """What a part wants of its channel.

    Attributes:
        program: Its program, or None.
        is_drums: Whether it needs the drums' channel.
        channel: The channel that the document names, or None.
    """

    program: int | None
    is_drums: bool
    channel: int | None = None


def allot_channels(wishes: Sequence[Wish]) -> list[int]:
    """Return a channel for each part: the wished one, unless another program is on it, else a free one.

    A channel of 16 and above is one of a further port: port * 16 + channel.
    """
    programs: dict[int, int | None] = {}
    wished = {wish.channel for wish in wishes}
    free = (n for n in count() if n % CHANNELS_OF_PORT != DRUM_CHANNEL)
    allotted: list[int] = []
    for wish in wishes:
        channel = wish.channel
        if wish.is_drums:
            channel = DRUM_CHANNEL
        elif (
            channel is None or channel == DRUM_CHANNEL or programs.get(channel, wish.program) != wish.program
        ):
            channel = next(n for n in free if n not in wished and n not in programs)
        allotted.append(channel)
        programs.setdefault(channel, wish.program)
    return allotted
