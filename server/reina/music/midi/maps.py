"""Tempo, metre and key from the meta events of all tracks."""

from collections.abc import Sequence

import numpy as np

from reina.music.key_signature import MAX_ACCIDENTALS, KeySignature, in_order
from reina.music.metre import MetreMap, TimeSignature
from reina.music.midi.division import Division
from reina.music.midi.track import KEY_SIGNATURE, SET_TEMPO, TIME_SIGNATURE, Track
from reina.music.tempo import TempoMap
from reina.music.warnings import WarningLog


def read_tempo_map(tracks: Sequence[Track], division: Division, log: WarningLog) -> TempoMap:
    """Merge the tempos of all tracks; at one tick the later track's holds, as in players."""
    changes: list[tuple[int, int]] = []
    for track in tracks:
        for meta in track.metas:
            if meta.kind != SET_TEMPO:
                continue
            value = int.from_bytes(meta.data[:3], "big")
            place = f"track {track.number}, byte {meta.byte}"
            if len(meta.data) != 3 or value == 0:
                log.add(
                    "bad_tempo", place, f"a tempo of the data {meta.data[:8].hex() or 'none'} was left out"
                )
            elif division.seconds_per_tick is not None:
                log.add("smpte_tempo", place, "in a file in SMPTE frames a tempo changes nothing")
            else:
                changes.append((meta.tick, value))
    if not changes:
        return TempoMap()
    changes.sort(key=lambda change: change[0])
    ticks, lengths = np.array(changes, dtype=np.float64).T
    return TempoMap(ticks / division.ticks_per_beat, lengths / 1e6)


def read_metre_map(tracks: Sequence[Track], division: Division, log: WarningLog) -> MetreMap:
    """Collect the time signatures of all tracks; those that are none are told of and left out."""
    signatures: list[TimeSignature] = []
    for track in tracks:
        for meta in track.metas:
            if meta.kind != TIME_SIGNATURE:
                continue
            numerator, power = (meta.data + b"\0\xff")[:2]
            if len(meta.data) < 2 or numerator == 0 or power > 6:
                place = f"track {track.number}, byte {meta.byte}"
                log.add(
                    "bad_metre", place, f"a metre of the data {meta.data[:8].hex() or 'none'} was left out"
                )
            else:
                signatures.append(TimeSignature(meta.tick / division.ticks_per_beat, numerator, 2**power))
    return MetreMap(signatures)


def read_key_signatures(
    tracks: Sequence[Track], division: Division, log: WarningLog
) -> tuple[KeySignature, ...]:
    """Collect the key signatures of all tracks; at one tick the first track's holds.

    The first track is the conductor's; a transposing part may have a signature of its own.
    """
    signatures: list[KeySignature] = []
    for track in tracks:
        for meta in track.metas:
            if meta.kind != KEY_SIGNATURE:
                continue
            fifths = int.from_bytes(meta.data[:1], "big", signed=True)
            if len(meta.data) < 2 or abs(fifths) > MAX_ACCIDENTALS or meta.data[1] > 1:
                place = f"track {track.number}, byte {meta.byte}"
                log.add("bad_key", place, f"a key of the data {meta.data[:8].hex() or 'none'} was left out")
            else:
                beat = meta.tick / division.ticks_per_beat
                signatures.append(KeySignature(beat, fifths, meta.data[1] == 1))
    return in_order(signatures)
