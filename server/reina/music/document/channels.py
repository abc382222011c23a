"""MIDI channels for the parts of a document that names none, or the same for two instruments."""

from collections.abc import Sequence
from dataclasses import dataclass

from reina.music.gm import DRUM_CHANNEL
from reina.music.warnings import WarningLog

CHANNELS = tuple(channel for channel in range(16) if channel != DRUM_CHANNEL)


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


def allot_channels(wishes: Sequence[Wish], log: WarningLog) -> list[int]:
    """Return a channel for each part: the wished one, unless another program is on it, else a free one.

    When all are taken, parts of one program share a channel; when that does not help, the last one is shared.
    """
    programs: dict[int, int | None] = {}
    allotted: list[int] = []
    for index, wish in enumerate(wishes):
        if wish.is_drums:
            allotted.append(DRUM_CHANNEL)
            continue
        wished = () if wish.channel in {None, DRUM_CHANNEL} else (wish.channel,)
        same = [channel for channel, program in programs.items() if program == wish.program]
        free = [channel for channel in CHANNELS if channel not in programs]
        for channel in (*wished, *free, *same, CHANNELS[-1]):
            if channel is not None and (channel not in programs or programs[channel] == wish.program):
                break
        else:
            channel = CHANNELS[-1]
            log.add(
                "channels_shared", f"part {index}", "more instruments than channels; two of them sound alike"
            )
        programs.setdefault(channel, wish.program)
        allotted.append(channel)
    return allotted
