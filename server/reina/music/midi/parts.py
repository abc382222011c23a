"""Which notes belong to one instrument, and what is known of it."""

from collections.abc import Sequence

import numpy as np

from reina.music.arrays import IntArray
from reina.music.gm import DRUM_CHANNEL, PROGRAM_NAMES
from reina.music.midi.messages import Messages
from reina.music.midi.text import decode_text
from reina.music.midi.track import INSTRUMENT_NAME, TRACK_NAME, Track
from reina.music.score import Part


def find_parts(
    tracks: Sequence[Track], source: IntArray, tick: IntArray, programs: Messages, encoding: str
) -> tuple[tuple[Part, ...], IntArray]:
    """Make a part of each channel in each track that has notes.

    Args:
        tracks: The tracks.
        source: (N,) ``track index << 4 | channel`` of each note.
        tick: (N,) onset of each note.
        programs: The program changes of all tracks, sorted by tick.
        encoding: The character set of the names.

    Returns:
        The parts and (N,) the index of each note's part.
    """
    sources, part = np.unique(source, return_inverse=True)
    values: list[int] = sources.tolist()
    channels_in_track = np.bincount(sources >> 4)
    ticks = _split(part, tick, len(sources))
    of_source, of_channel = _group(programs.track << 4 | programs.channel), _group(programs.channel)
    parts: list[Part] = []
    for index, value in enumerate(values):
        track, channel = value >> 4, value & 0xF
        changes = of_source.get(value, of_channel.get(channel))
        program = None
        if changes is not None:
            program = _program(programs.tick[changes], programs.first[changes], ticks[index])
        is_drums = channel == DRUM_CHANNEL
        own_name = _name(tracks[track], encoding, alone=channels_in_track[track] == 1)
        known = "Drums" if is_drums else PROGRAM_NAMES[program] if program is not None else ""
        shared = f"Channel {channel + 1}" if channels_in_track[track] > 1 else f"Track {tracks[track].number}"
        parts.append(
            Part(index, own_name or known or shared, program, is_drums, channel, named=bool(own_name))
        )
    return tuple(parts), part


def _split(group: IntArray, values: IntArray, count: int) -> list[IntArray]:
    """Return for each of the groups 0 to `count` - 1 its values, in their order."""
    order = np.argsort(group, kind="stable")
    return np.split(values[order], np.searchsorted(group[order], np.arange(1, count)))


def _group(keys: IntArray) -> dict[int, IntArray]:
    """Return for each key the indices where it stands."""
    values, group = np.unique(keys, return_inverse=True)
    return (
        dict(zip(values.tolist(), _split(group, np.arange(len(keys)), len(values)), strict=True))
        if len(keys)
        else {}
    )


def _name(track: Track, encoding: str, *, alone: bool) -> str:
    """Return the name of a track that holds one part; a track of several parts names none of them."""
    for kind in (TRACK_NAME, INSTRUMENT_NAME) if alone else ():
        for meta in track.metas:
            text = decode_text(meta.data, encoding) if meta.kind == kind else ""
            if text:
                return text
    return ""


def _program(changed: IntArray, program: IntArray, onsets: IntArray) -> int | None:
    """Return the program in force at most of the onsets, or None; times in ticks, `changed` sorted."""
    latest = np.searchsorted(changed, onsets, side="right") - 1
    values, counts = np.unique(np.where(latest < 0, -1, program[latest]), return_counts=True)
    most = int(values[np.argmax(counts)])
    return None if most < 0 else most
