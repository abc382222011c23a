"""One track's bytes into events."""

from dataclasses import dataclass, field

from reina.music.errors import ScoreLimitError
from reina.music.midi.sysex import LONGEST_SYSEX, Standard, read_part_mode, read_standard
from reina.music.midi.unicode_text import LONGEST_BYTES
from reina.music.warnings import WarningLog

TICK_SHIFT = 24
MAX_TICKS = 2**38
MAX_METAS = 100_000

NOTE_OFF, NOTE_ON, KEY_PRESSURE, CONTROLLER, PROGRAM, CHANNEL_PRESSURE, PITCH_BEND = range(0x8, 0xF)
"""The upper four bits of a channel message's status."""

SYSTEM_DATA_BYTES = {0xF1: 1, 0xF2: 2, 0xF3: 1}
"""System messages that have data; they do not belong into a file, and are skipped."""

TRACK_NAME, INSTRUMENT_NAME, PORT, END_OF_TRACK, SET_TEMPO, TIME_SIGNATURE, KEY_SIGNATURE = (
    0x03,
    0x04,
    0x21,
    0x2F,
    0x51,
    0x58,
    0x59,
)
"""Types of the meta events that are read."""

KEPT_METAS = frozenset({TRACK_NAME, INSTRUMENT_NAME, SET_TEMPO, TIME_SIGNATURE, KEY_SIGNATURE})

PART_MODE = 0xF
"""Not a command of MIDI: what a system exclusive message says of a channel is kept as a channel message,
whose first data byte is 1 for drums and 0 for tones."""

TEXTS = frozenset({0x01, 0x02, 0x05, 0x06, 0x07})
"""Texts, copyrights, lyrics, markers and cue points: they tell the character set of the names."""

TEXT_BYTES = 4096
"""How much of such texts is looked at of a track."""

TEXT, LYRIC, MARKER, CUE_POINT = 0x01, 0x05, 0x06, 0x07
WORDS = frozenset({TEXT, LYRIC, MARKER, CUE_POINT})
"""Texts that are sung or shown at their time."""
MAX_WORDS = 20_000
"""How many of them are kept of a track."""

TOO_MANY_EVENTS = "more events than are read"


@dataclass(frozen=True)
class Meta:
    """A meta event.

    Attributes:
        tick: When.
        kind: Its type byte.
        data: Its data.
        byte: Where in the file it stands.
    """

    tick: int
    kind: int
    data: bytes
    byte: int


@dataclass
class Track:
    """What a track holds.

    Attributes:
        number: Its place in the file, from 1.
        packed: Channel messages, each as ``tick << 24 | status << 16 | first data byte << 8 | second``.
        metas: Meta events of `KEPT_METAS`.
        ports: Where the track changes its port: the number of channel messages before, and the port.
        standards: The standards that the track switches to, in order, each with its tick.
        texts: Texts of `TEXTS` that are not ASCII, `TEXT_BYTES` at most.
        text_bytes: How long they are together.
        words: Texts of `WORDS`, `MAX_WORDS` at most.
        end_tick: When the track ends.
        end: Position after the last byte read.
        ended: Whether an end-of-track event was found.
        intact: Whether reading came to the end without breaking off.
    """

    number: int
    packed: list[int] = field(default_factory=list[int])
    metas: list[Meta] = field(default_factory=list[Meta])
    ports: list[tuple[int, int]] = field(default_factory=list[tuple[int, int]])
    standards: list[tuple[int, Standard]] = field(default_factory=list[tuple[int, Standard]])
    texts: list[bytes] = field(default_factory=list[bytes])
    text_bytes: int = 0
    words: list[Meta] = field(default_factory=list[Meta])
    end_tick: int = 0
    end: int = 0
    ended: bool = False
    intact: bool = True


class _BrokenError(Exception):
    """The rest of the track cannot be read; the first argument says why."""


def read_track(
    data: bytes, start: int, end: int, *, number: int, offset: int, most_events: int, log: WarningLog
) -> Track:
    """Read the events in ``data[start:end]``; what stands before a break is kept.

    Running status lasts over meta and system exclusive events, as players have it.

    Args:
        data: The whole file.
        start: Position of the first delta time.
        end: Position after the track.
        number: The track's number for messages, from 1.
        offset: What to add to a position to get the place in the file as it was sent.
        most_events: How many channel messages may be kept.
        log: Where repairs are told.

    Raises:
        ScoreLimitError: If there are too many events or ticks.
    """
    track = Track(number)
    place = _Place(number, offset + start)
    try:
        _read_events(data[start:end], track, place, most_events, log)
    except IndexError:
        track.intact = False
        track.end = end - start
        log.add(
            "truncated_track",
            place(track.end),
            "the track ends inside an event; what stands before it was kept",
        )
    except _BrokenError as broken:
        track.intact = False
        log.add("broken_track", place(track.end), f"{broken}; what stands before it was kept")
    track.end += start
    return track


@dataclass(frozen=True)
class _Place:
    number: int
    offset: int

    def __call__(self, position: int) -> str:
        return f"track {self.number}, byte {position + self.offset}"


def _read_events(data: bytes, track: Track, place: _Place, most_events: int, log: WarningLog) -> None:
    packed = track.packed
    end = len(data)
    at = 0
    tick = 0
    status = 0
    others = 0
    while at < end:
        track.end_tick, track.end = tick, at
        delta = data[at]
        at += 1
        if delta > 0x7F:
            delta, at = _read_rest(data, at, delta)
        tick += delta
        byte = data[at]
        if byte > 0x7F:
            at += 1
            if byte < 0xF0:
                status = byte
            else:
                others += 1
                if others > most_events:
                    raise ScoreLimitError(TOO_MANY_EVENTS, location=place(at))
                at = _read_system(data, at, byte, tick, track, place, log)
                if track.ended:
                    track.end_tick, track.end = tick, at
                    return
                continue
        elif not status:
            others += 1
            if others > most_events:
                raise ScoreLimitError(TOO_MANY_EVENTS, location=place(at))
            at = _skip_stray(data, at, place, log)
            continue
        first = data[at]
        if 0xC0 <= status < 0xE0:
            second = 0
            at += 1
        else:
            second = data[at + 1]
            at += 2
        if (first | second) > 0x7F:
            log.add("data_byte", place(at), "a data byte over 127 was taken as 127")
            first, second = min(first, 0x7F), min(second, 0x7F)
        packed.append(tick << TICK_SHIFT | status << 16 | first << 8 | second)
        if len(packed) > most_events:
            raise ScoreLimitError(TOO_MANY_EVENTS, location=place(at))
        if tick > MAX_TICKS:
            raise ScoreLimitError(
                f"a length of {tick:,} ticks; at most {MAX_TICKS:,} are read", location=place(at)
            )
    track.end_tick, track.end = tick, at


def _read_rest(data: bytes, at: int, value: int) -> tuple[int, int]:
    """Read the rest of a variable-length number whose first byte was `value`: at most four bytes together."""
    value &= 0x7F
    for _ in range(3):
        byte = data[at]
        at += 1
        value = value << 7 | byte & 0x7F
        if byte < 0x80:
            return value, at
    raise _BrokenError("a variable-length number of more than four bytes")


def _read_length(data: bytes, at: int) -> tuple[int, int]:
    length = data[at]
    return (length, at + 1) if length < 0x80 else _read_rest(data, at + 1, length)


def _read_system(
    data: bytes, at: int, status: int, tick: int, track: Track, place: _Place, log: WarningLog
) -> int:
    """Read a meta or system event after its status; return the position after it."""
    if status == 0xFF:
        kind = data[at]
        length, begin = _read_length(data, at + 1)
        if begin + length > len(data):
            raise _BrokenError(f"a meta event of {length} bytes where {len(data) - begin} are left")
        if kind == END_OF_TRACK:
            track.ended = True
        elif kind == PORT and length:
            if not track.ports or track.ports[-1][1] != data[begin]:
                track.ports.append((len(track.packed), data[begin]))
        elif kind in KEPT_METAS:
            if len(track.metas) == MAX_METAS:
                raise ScoreLimitError(TOO_MANY_EVENTS, location=place(at))
            track.metas.append(Meta(tick, kind, data[begin : begin + length], at - 1 + place.offset))
            return begin + length
        if kind in WORDS and len(track.words) < MAX_WORDS:
            text = data[begin : begin + min(length, LONGEST_BYTES)]
            track.words.append(Meta(tick, kind, text, at - 1 + place.offset))
        if kind in TEXTS and track.text_bytes < TEXT_BYTES:
            text = data[begin : begin + min(length, LONGEST_BYTES, TEXT_BYTES - track.text_bytes)]
            if not text.isascii():
                track.texts.append(text)
                track.text_bytes += len(text)
        return begin + length
    if status in {0xF0, 0xF7}:
        length, begin = _read_length(data, at)
        if begin + length <= len(data):
            _keep_sysex(data[begin : begin + min(length, LONGEST_SYSEX)], tick, track)
            return begin + length
        closing = data.find(b"\xf7", at)
        if closing < 0:
            raise _BrokenError(
                f"a system exclusive message of {length} bytes where {len(data) - begin} are left"
            )
        log.add(
            "sysex_length", place(at), "a system exclusive message with a wrong length; read to its end mark"
        )
        return closing + 1
    log.add("system_message", place(at - 1), f"status {status:#04x} does not belong into a file; skipped")
    return at + SYSTEM_DATA_BYTES.get(status, 0)


def _keep_sysex(data: bytes, tick: int, track: Track) -> None:
    """Keep what a system exclusive message says of drums, if it says anything of them."""
    if (mode := read_part_mode(data)) is not None and tick <= MAX_TICKS:
        status = PART_MODE << 4 | mode.channel
        track.packed.append(tick << TICK_SHIFT | status << 16 | int(mode.is_drums) << 8)
    elif (standard := read_standard(data)) is not None:
        track.standards.append((tick, standard))


def _skip_stray(data: bytes, at: int, place: _Place, log: WarningLog) -> int:
    """Skip data bytes that belong to no message; return the position of the next delta time."""
    begin = at
    while data[at] < 0x80:
        at += 1
    log.add("stray_data", place(begin), f"{at - begin} data bytes that belong to no message were skipped")
    return at - 1 if at > begin else at
