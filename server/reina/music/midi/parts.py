"""Which notes belong to one instrument, and what is known of it."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from reina.music.arrays import IntArray
from reina.music.gm import PROGRAM_NAMES, are_variants
from reina.music.midi.channel_state import ChannelState
from reina.music.midi.messages import CHANNELS_OF_PORT, Messages
from reina.music.midi.text import decode_text
from reina.music.midi.track import INSTRUMENT_NAME, TRACK_NAME, Track
from reina.music.notes import NO_PROGRAM
from reina.music.score import Part


@dataclass
class _Source:
    """What sounds on one channel of one track, as tones or as drums."""

    index: int
    track: int
    channel: int
    is_drums: bool
    program: int
    notes: int

    def goes_with(self, other: "_Source") -> bool:
        """Whether one player may play both on one instrument; what names no program goes with anything."""
        if self.is_drums or other.is_drums:
            return self.is_drums == other.is_drums
        unsaid = NO_PROGRAM in {self.program, other.program}
        return unsaid or are_variants(self.program, other.program)


@dataclass
class _Staff:
    """The sources of one part, the one with the most notes first."""

    sources: list[_Source] = field(default_factory=list[_Source])

    @property
    def place(self) -> tuple[int, int]:
        """Where it stands among the parts: by track, then channel."""
        return min((source.track, source.index) for source in self.sources)


def find_parts(
    tracks: Sequence[Track], notes: Messages, state: ChannelState, encoding: str
) -> tuple[tuple[Part, ...], IntArray]:
    """Make a part of each track that has notes; of several if it holds several instruments.

    A track is a staff, and notation programs write its muted or plucked notes on a channel of their own, as
    guitars and MPE have a channel a string or note. So notes of one track on several channels are one part
    unless the programs of its channels are different instruments. A file whose one track holds several
    instruments is a merged one, where each channel is a part.

    Args:
        tracks: The tracks.
        notes: The note-on message of each note.
        state: What is in force at each note.
        encoding: The character set of the names.

    Returns:
        The parts and (N,) the index of each note's part.
    """
    keys = (notes.track << 12 | notes.channel) << 1 | state.is_drums
    values, source_of_note = np.unique(keys, return_inverse=True)
    sources = [
        _Source(index, value >> 13, value >> 1 & 0xFFF, bool(value & 1), *_most(programs))
        for index, (value, programs) in enumerate(
            zip(values.tolist(), _split(source_of_note, state.program, len(values)), strict=True)
        )
    ]
    by_track: dict[int, list[_Source]] = {}
    for source in sources:
        by_track.setdefault(source.track, []).append(source)
    staves: list[_Staff] = []
    for of_track in by_track.values():
        joined = _join(of_track)
        is_merged = len(by_track) == 1 and len(joined) > 1
        staves += [_Staff([source]) for source in of_track] if is_merged else joined
    staves.sort(key=lambda staff: staff.place)
    part_of_source = np.zeros(len(sources), dtype=np.int64)
    for index, staff in enumerate(staves):
        part_of_source[[source.index for source in staff.sources]] = index
    in_track = Counter(staff.sources[0].track for staff in staves)
    parts = tuple(
        _part(index, staff.sources, tracks[staff.sources[0].track], in_track, encoding)
        for index, staff in enumerate(staves)
    )
    return parts, part_of_source[source_of_note]


def _join(sources: Sequence[_Source]) -> list[_Staff]:
    """Put the sources of one track together that one player plays; those with the most notes decide."""
    staves: list[_Staff] = []
    # Those that name no program come last: they go with an instrument that is known by then.
    for source in sorted(sources, key=lambda source: (source.program == NO_PROGRAM, -source.notes)):
        fitting = [staff for staff in staves if staff.sources[0].goes_with(source)]
        if source.program == NO_PROGRAM and len(fitting) > 1:
            fitting = []
        if not fitting:
            staves.append(_Staff())
        (fitting or staves[-1:])[0].sources.append(source)
    return staves


def _part(
    index: int, sources: Sequence[_Source], track: Track, in_track: Counter[int], encoding: str
) -> Part:
    first = sources[0]
    alone = in_track[first.track] == 1
    program = None if first.program == NO_PROGRAM else first.program
    own_name = _name(track, encoding) if alone else ""
    known = "Drums" if first.is_drums else PROGRAM_NAMES[program] if program is not None else ""
    port, channel = divmod(first.channel, CHANNELS_OF_PORT)
    unknown = f"Channel {channel + 1}" + (f" of port {port + 1}" if port else "")
    if alone:
        unknown = f"Track {track.number}"
    name = own_name or known or unknown
    return Part(index, name, program, first.is_drums, first.channel, named=bool(own_name))


def _split(group: IntArray, values: IntArray, count: int) -> list[IntArray]:
    """Return for each of the groups 0 to `count` - 1 its values, in their order."""
    order = np.argsort(group, kind="stable")
    return np.split(values[order], np.searchsorted(group[order], np.arange(1, count)))


def _most(programs: IntArray) -> tuple[int, int]:
    """Return the program in force at most notes, and how many notes there are."""
    values, counts = np.unique(programs, return_counts=True)
    return int(values[np.argmax(counts)]), len(programs)


def _name(track: Track, encoding: str) -> str:
    """Return the name of a track."""
    for kind in (TRACK_NAME, INSTRUMENT_NAME):
        for meta in track.metas:
            text = decode_text(meta.data, encoding) if meta.kind == kind else ""
            if text:
                return text
    return ""
