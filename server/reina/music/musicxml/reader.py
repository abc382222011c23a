"""A MusicXML document into a score."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from reina.music.controls import Control
from reina.music.document.channels import Wish, allot_channels
from reina.music.errors import ScoreError
from reina.music.gm import PROGRAM_NAMES
from reina.music.key_signature import KeySignature, in_order
from reina.music.musicxml.document import Cell, Head, read_document
from reina.music.musicxml.dynamics import velocities_of
from reina.music.musicxml.instruments import score_part
from reina.music.musicxml.navigation import playing_order
from reina.music.musicxml.part_reader import PartReader
from reina.music.musicxml.playing import play_notes
from reina.music.musicxml.tempos import read_tempo_map
from reina.music.musicxml.texts import read_texts
from reina.music.musicxml.timeline import Timeline
from reina.music.notes import NO_PROGRAM, Notes
from reina.music.score import Part, Score
from reina.music.taps import TAP_S, lengthen_taps
from reina.music.warnings import WarningLog

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reina.music.limits import Limits
    from reina.music.metre import MetreMap
    from reina.music.musicxml.model import Source, WrittenMeasure, WrittenPart
    from reina.music.musicxml.played_note import PlayedNote
    from reina.music.tempo import TempoMap

LONGEST_TITLE = 200


def read_musicxml(data: bytes, *, title: str, limits: Limits) -> Score:
    """Read a MusicXML document; `reina.music.read_score` says more.

    Raises:
        ScoreError: If it holds no note, or is no such document.
        ScoreLimitError: If it is beyond `limits`.
    """
    log = WarningLog()
    measures: list[WrittenMeasure] = []
    readers: dict[str, PartReader] = {}

    def read_cell(head: Head, cell: Cell) -> None:
        limits.check("bars", cell.measure + 1, what="number of measures", location=cell.place)
        identity = cell.part or f"part {cell.part_index + 1}"
        reader = readers.get(identity)
        if reader is None:
            limits.check("tracks", len(readers) + 1, what="number of parts", location=cell.place)
            reader = readers[identity] = PartReader(score_part(head, cell.part), measures, log)
        reader.read(cell)
        limits.check("notes", len(reader.part.notes), what="number of notes", location=cell.place)

    head = read_document(data, read_cell, limits=limits, log=log)
    parts = [reader.finish() for reader in readers.values()]
    if not any(part.notes for part in parts):
        raise ScoreError("the document is MusicXML and holds no note", location=f"{len(measures)} measures")
    timeline = Timeline(measures, playing_order(measures, most=limits.bars, log=log), log)
    limits.check("beats", timeline.end, what="length in beats")
    _check_played(parts, timeline, limits)
    tempo_map = read_tempo_map(parts, timeline, limits)
    pieces = [
        piece
        for reader, part in zip(readers.values(), parts, strict=True)
        for piece in _pieces(reader.listed.name, _played(part, timeline, tempo_map, limits))
    ]
    if not pieces:
        raise ScoreError("no note of the document is played", location=f"{len(measures)} measures")
    return _assemble(
        pieces,
        title=_title(head) or title,
        tempo_map=tempo_map,
        metre_map=timeline.metre_map(),
        keys=_keys(parts, timeline),
        written=parts,
        timeline=timeline,
        limits=limits,
        log=log,
    )


@dataclass(frozen=True)
class _Piece:
    """What becomes a part of the score: a part's tones, or its drums."""

    name: str
    is_drums: bool
    notes: list[PlayedNote]

    @property
    def sources(self) -> list[Source]:
        """What sounds its notes, the most frequent first."""
        return [source for source, _ in Counter(note.source for note in self.notes).most_common()]


def _pieces(name: str, notes: Sequence[PlayedNote]) -> list[_Piece]:
    split = [
        _Piece(name, is_drums, [note for note in notes if note.source.is_drums == is_drums])
        for is_drums in (False, True)
    ]
    both = all(piece.notes for piece in split)
    return [
        _Piece(f"{name} (drums)".strip() if both and piece.is_drums else name, piece.is_drums, piece.notes)
        for piece in split
        if piece.notes
    ]


def _played(part: WrittenPart, timeline: Timeline, tempo_map: TempoMap, limits: Limits) -> list[PlayedNote]:
    velocities = velocities_of(part, timeline.written_beats)
    return play_notes(part.notes, velocities, timeline, tempo_map, limits)


def _check_played(parts: Sequence[WrittenPart], timeline: Timeline, limits: Limits) -> None:
    """Check how many notes are played before any is made."""
    written = Counter(note.measure for part in parts for note in part.notes)
    limits.check("notes", sum(written[played.measure] for played in timeline.played), what="number of notes")


def _keys(parts: Sequence[WrittenPart], timeline: Timeline) -> tuple[KeySignature, ...]:
    """Return the key signatures, as they sound, of the first part that has any."""
    keyed = next((part for part in parts if part.keys and part.notes), None)
    marks = keyed.keys if keyed else []
    unrolled = timeline.unroll(marks, lambda mark: mark.place, holds=True)
    at_beats = {beat: KeySignature(beat, mark.fifths, mark.is_minor) for beat, _, mark in unrolled}
    return in_order(list(at_beats.values()))


def _assemble(
    pieces: Sequence[_Piece],
    *,
    title: str,
    tempo_map: TempoMap,
    metre_map: MetreMap,
    keys: tuple[KeySignature, ...],
    written: Sequence[WrittenPart],
    timeline: Timeline,
    limits: Limits,
    log: WarningLog,
) -> Score:
    sounding = [(index, source) for index, piece in enumerate(pieces) for source in piece.sources]
    allotted = allot_channels([Wish(source.program, source.is_drums) for _, source in sounding])
    channel_of = dict(zip(sounding, allotted, strict=True))
    notes = [(index, note) for index, piece in enumerate(pieces) for note in piece.notes]
    onset_beats = np.array([note.onset for _, note in notes])
    end_beats = np.array([note.end for _, note in notes])
    onset_s, end_s = tempo_map.seconds(onset_beats), tempo_map.seconds(end_beats)
    end_s, end_beats, taps = lengthen_taps(onset_s, end_s, end_beats, tempo_map)
    for tap in taps.tolist():
        place = f"line {notes[int(tap)][1].line}"
        log.add("zero_length_note", place, f"has no duration; it sounds for {TAP_S * 1000:.0f} ms")
    limits.check("duration_s", float(np.max(end_s)), what="length in seconds")
    limits.check("beats", float(np.max(end_beats)), what="length in beats")
    limits.check("bars", metre_map.bar_count(float(np.max(end_beats))), what="number of bars")
    table = Notes.from_columns(
        part=[index for index, _ in notes],
        channel=[channel_of[index, note.source] for index, note in notes],
        onset_s=onset_s,
        duration_s=end_s - onset_s,
        onset_beats=onset_beats,
        duration_beats=end_beats - onset_beats,
        sounding_pitch=[note.pitch for _, note in notes],
        velocity=[note.velocity for _, note in notes],
        program=[NO_PROGRAM if note.source.program is None else note.source.program for _, note in notes],
        tongued=[not note.slurred for _, note in notes],
    )
    return Score(
        title=title,
        parts=tuple(_part(index, piece, channel_of) for index, piece in enumerate(pieces)),
        notes=table,
        tempo_map=tempo_map,
        metre_map=metre_map,
        controls=_controls(channel_of),
        warnings=log.warnings(),
        duration_s=float(np.max(table.end_s)),
        key_signatures=keys,
        texts=read_texts(written, timeline, tempo_map),
    )


def _part(index: int, piece: _Piece, channel_of: dict[tuple[int, Source], int]) -> Part:
    most = piece.sources[0]
    known = "Drums" if piece.is_drums else PROGRAM_NAMES[most.program] if most.program is not None else ""
    name = piece.name or known or f"Part {index + 1}"
    program = next((source.program for source in piece.sources if source.program is not None), None)
    return Part(index, name, program, piece.is_drums, channel_of[index, most], named=bool(piece.name))


def _controls(channel_of: dict[tuple[int, Source], int]) -> tuple[Control, ...]:
    """The programs, volumes and places of all channels; drums share theirs, and the first says how it is."""
    controls: list[Control] = []
    done: set[int] = set()
    for (_, source), channel in channel_of.items():
        if channel in done:
            continue
        done.add(channel)
        if source.program is not None:
            controls.append(Control("program", 0.0, 0.0, channel, 0, source.program))
        if source.volume is not None:
            controls.append(Control("controller", 0.0, 0.0, channel, 7, source.volume))
        if source.pan is not None:
            controls.append(Control("controller", 0.0, 0.0, channel, 10, source.pan))
    return tuple(controls)


def _title(head: Head) -> str:
    work, movement = head.said("work", "work-title"), head.said("movement-title")
    titles = [" ".join(title.split()) for title in dict.fromkeys((work, movement)) if title]
    if not titles:
        titles = [
            " ".join(credit.said("credit-words").split())
            for credit in head.elements
            if credit.name == "credit" and credit.said("credit-type") == "title"
        ][:1]
    return ": ".join(titles)[:LONGEST_TITLE]
