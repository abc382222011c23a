"""The header of a document of Tone.js's converter: its name, tempos, metres and keys."""

from dataclasses import dataclass
from typing import cast

import numpy as np

from reina.music.document.fields import LEFT_OUT, Entry, Span, to_number
from reina.music.document.model import MAX_CHANGES
from reina.music.document.tonejs import (
    BPM,
    HEADER,
    KEY_SIGNATURE,
    KEYS,
    METRE_NUMBER,
    PPQ,
    TEMPO,
    TICKS,
    TIME_SIGNATURE,
)
from reina.music.key_signature import KeySignature, in_order
from reina.music.limits import Limits
from reina.music.metre import MetreMap, TimeSignature
from reina.music.tempo import DEFAULT_SECONDS_PER_BEAT, TempoMap

DEFAULT_PPQ = 480.0
NO_PLACE = "neither time nor ticks says when this is; it was left out"


@dataclass(frozen=True)
class ToneHeader:
    """What the tracks are read by; ``bpm``, ``PPQ`` and ``timeSignature`` are of the older form."""

    name: str
    ppq: float
    tempo_map: TempoMap
    metre_map: MetreMap
    key_signatures: tuple[KeySignature, ...]


def read_header(header: Entry, limits: Limits) -> ToneHeader:
    """Read the header, without what is strange in it."""
    header.tell_unknown(HEADER)
    written = (header.number("ppq", PPQ), header.number("PPQ", PPQ))
    ppq = written[0] or written[1] or DEFAULT_PPQ
    return ToneHeader(
        name=header.text("name"),
        ppq=ppq,
        tempo_map=_tempo_map(header, ppq, limits),
        metre_map=_metre_map(header, ppq),
        key_signatures=_key_signatures(header, ppq),
    )


def _tempo_map(header: Entry, ppq: float, limits: Limits) -> TempoMap:
    """Place tempos by their ticks; those that have seconds alone by the tempo that they end."""
    beat, second = 0.0, 0.0
    bpm = header.number("bpm", BPM)
    length = DEFAULT_SECONDS_PER_BEAT if bpm is None else 60.0 / bpm
    beats, lengths = [beat], [length]
    tempos = header.entries("tempos", most=MAX_CHANGES)
    tempos.tell_unknown(TEMPO)
    tempos.tell_missing("bpm")
    columns = (
        tempos.column("bpm", BPM),
        tempos.column("ticks", TICKS) / ppq,
        tempos.column("time", Span(0, limits.duration_s)),
    )
    for row, (bpm, at_beat, at_second) in enumerate(zip(*(c.tolist() for c in columns), strict=True)):
        if np.isnan(bpm):
            continue
        if not np.isnan(at_beat):
            to = at_beat
        elif not np.isnan(at_second):
            to = max(beat + (at_second - second) / length, 0.0)
        elif row == 0:
            to = 0.0
        else:
            header.log.add(LEFT_OUT, tempos.place(row), NO_PLACE)
            continue
        second += (to - beat) * length
        beat, length = to, 60.0 / bpm
        beats.append(beat)
        lengths.append(length)
    return TempoMap(beats, lengths)


def _metre_map(header: Entry, ppq: float) -> MetreMap:
    entries = header.entries("timeSignatures", most=MAX_CHANGES)
    entries.tell_unknown(TIME_SIGNATURE)
    entries.tell_missing("timeSignature")
    signatures: list[TimeSignature] = []
    at = (entries.column("ticks", TICKS) / ppq).tolist()
    for row, beat in enumerate(at):
        entry = entries.entry(row)
        if "timeSignature" not in entry.value:
            continue
        if np.isnan(beat) and row > 0:
            header.log.add(LEFT_OUT, entry.path, NO_PLACE)
        elif (metre := _metre(entry)) is not None:
            signatures.append(TimeSignature(0.0 if np.isnan(beat) else beat, *metre))
    if not signatures and "timeSignature" in header.value and (metre := _metre(header)) is not None:
        signatures = [TimeSignature(0.0, *metre)]
    return MetreMap(signatures)


def _metre(entry: Entry) -> tuple[int, int] | None:
    """Return the two numbers of ``timeSignature``, or None."""
    value = entry.value["timeSignature"]
    numbers = [to_number(number) for number in cast("list[object]", value)] if isinstance(value, list) else []
    if len(numbers) == 2 and all(number in METRE_NUMBER for number in numbers):
        return int(numbers[0]), int(numbers[1])
    entry.leave_out("timeSignature", "a metre such as [3, 4]")
    return None


def _key_signatures(header: Entry, ppq: float) -> tuple[KeySignature, ...]:
    entries = header.entries("keySignatures", most=MAX_CHANGES)
    entries.tell_unknown(KEY_SIGNATURE)
    entries.tell_missing("key")
    signatures: list[KeySignature] = []
    at = (entries.column("ticks", TICKS) / ppq).tolist()
    for row, beat in enumerate(at):
        entry = entries.entry(row)
        if "key" not in entry.value:
            continue
        if np.isnan(beat) and row > 0:
            header.log.add(LEFT_OUT, entry.path, NO_PLACE)
        elif (key := entry.text("key")) not in KEYS:
            if isinstance(entry.value["key"], str):
                entry.leave_out("key", "a key such as Bb or F#")
        else:
            fifths = KEYS.index(key) - KEYS.index("C")
            signatures.append(
                KeySignature(0.0 if np.isnan(beat) else beat, fifths, entry.text("scale") == "minor")
            )
    return in_order(signatures)
