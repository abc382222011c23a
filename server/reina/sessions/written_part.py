"""A player's part as the wire tells it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from reina.instruments import ValvesFingering, spell_line
from reina.instruments.describe import describe_keys
from reina.notation import (
    Accidentals,
    Key,
    Measure,
    WrittenPart,
    key_at,
    keys_of,
    letter,
    named,
    octave,
    write_part,
)
from reina.protocol import written_part as wire
from reina.protocol.resources import MusicKey
from reina.sessions.part_measures import SAME_BEAT, TICKS_PER_QUARTER, joined, tempi
from reina.sessions.written_drums import written_drum_part

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reina.instruments import Line
    from reina.music import Score
    from reina.music.arrays import IntArray
    from reina.sessions.production import Production

PRINTED: dict[int, wire.Accidental] = {-1: "flat", 0: "natural", 1: "sharp"}


@dataclass(frozen=True, eq=False)
class _Reading:
    """One of the two ways to read a line: as it sounds, or as it is written.

    Attributes:
        pitches: (M,) MIDI numbers.
        names: (M,) places on the line of fifths.
        keys: The keys that they are in.
    """

    pitches: list[int]
    names: list[int]
    keys: tuple[Key, ...]

    def pitch(self, note: int, accidentals: Accidentals, *, tied_from: bool = False) -> wire.PartPitch:
        """Return a note as it stands in a bar whose accidentals so far are known."""
        pitch, name = self.pitches[note], self.names[note]
        height = octave(pitch, name)
        printed = accidentals.printed(name, height, tied_from=tied_from)
        return wire.PartPitch.model_validate(
            {
                "name": named(pitch, name),
                "letter": letter(name),
                "octave": height,
                "accidental": None if printed is None else PRINTED[printed],
            }
        )


def written_part(production: Production, title: str, player: int) -> wire.WrittenPart:
    """Return what a player plays, as notation; of a long part this takes a while."""
    performer = production.performers[player]
    played, instrument, score = performer.played, performer.instrument, production.score
    line, fingering = played.line, played.fingering
    strokes = played.strokes
    if strokes is not None:
        return written_drum_part(
            score,
            strokes.hits,
            note_index=line.note_index[list(strokes.notes)].tolist(),
            reasons=[fingering.reasons[note] for note in strokes.notes],
            title=title,
            part_name=score.parts[played.part].name,
            player=player,
            instrument=instrument.name,
            instrument_title=instrument.title,
        )
    above = instrument.written_pitch(0)
    keys = keys_of(score)
    sounding = _reading(score, line, keys, played.transposition, 0)
    written = _reading(score, line, keys, played.transposition, above)
    part = write_part(score, line.onset_s, line.end_s, line.sounding_pitch)
    usual = {note.sounding_pitch: list(note.fingerings[0]) for note in instrument.fingering_chart}
    notes = [
        wire.PartNote(
            index=index,
            onset_s=onset,
            end_s=end,
            sounding_name=named(pitch, sounding.names[note]),
            written_name=named(pitch + above, written.names[note]),
            valves=list(played_so.valves) if isinstance(played_so, ValvesFingering) else None,
            usual_valves=usual.get(pitch),
            reason=fingering.reasons[note],
        )
        for note, (index, onset, end, pitch, played_so) in enumerate(
            zip(
                line.note_index.tolist(),
                line.onset_s.tolist(),
                line.end_s.tolist(),
                line.sounding_pitch.tolist(),
                fingering.notes,
                strict=True,
            )
        )
    ]
    measures = joined([_measure(score, one, part, sounding, written) for one in part.measures])
    return wire.WrittenPart(
        title=title,
        part_name=score.parts[played.part].name,
        player=player,
        instrument=instrument.name,
        instrument_title=instrument.title,
        clef=instrument.clef,
        written_above_sounding=above,
        swing=part.swing,
        keys=music_keys(score, played.transposition, above),
        tempi=tempi([measure.bar for measure in part.measures], part.tempo_marks, measures),
        notes=notes,
        measures=measures,
    )


def music_keys(score: Score, moved: int, above: int) -> list[MusicKey]:
    """Return the keys of a part.

    Args:
        score: The score.
        moved: Semitones by which the part is played away from the file's pitches.
        above: Semitones from a pitch that sounds to the one that is written.
    """
    return [MusicKey(**fields) for fields in describe_keys(score, moved, above)]


def _reading(score: Score, line: Line, keys: Sequence[Key], moved: int, above: int) -> _Reading:
    names: IntArray = spell_line(score, line, keys, moved=moved, written_above_sounding=above)
    return _Reading(
        pitches=(line.sounding_pitch.astype(np.int64) + above).tolist(),
        names=names.tolist(),
        keys=tuple(key.transposed(moved + above) for key in keys),
    )


def _measure(
    score: Score, measure: Measure, part: WrittenPart, sounding: _Reading, written: _Reading
) -> wire.PartMeasure:
    bar = measure.bar
    key, written_key = (key_at(reading.keys, bar.begin_beats + SAME_BEAT) for reading in (sounding, written))
    said, written_said = Accidentals(key.fifths), Accidentals(written_key.fifths)
    entries: list[wire.PartEntry] = []
    for entry in measure.entries:
        placed = entry.placed
        graces: list[wire.PartGrace] = []
        if placed is not None and not entry.tied_from:
            graces = [
                wire.PartGrace(
                    note=grace,
                    written=written.pitch(grace, written_said),
                    sounding=sounding.pitch(grace, said),
                )
                for grace in placed.graces
            ]
        trill = part.trills.get(placed.note) if placed is not None and not entry.tied_from else None
        note = None if placed is None else _main(part, placed.note)
        entries.append(
            wire.PartEntry(
                begin_ticks=entry.begin,
                ticks=entry.ticks,
                value=entry.value.fraction,
                dots=entry.value.dots,
                note=note,
                is_bar_rest=entry.is_bar_rest,
                written=None
                if note is None
                else written.pitch(note, written_said, tied_from=entry.tied_from),
                sounding=None if note is None else sounding.pitch(note, said, tied_from=entry.tied_from),
                tied_from=entry.tied_from,
                tied_to=entry.tied_to,
                beam=entry.beam,
                tuplet=entry.tuplet,
                is_staccato=placed is not None and placed.is_staccato and not entry.tied_from,
                graces=graces,
                trill=None if trill is None else trill.upper,
                heads=[],
            )
        )
    begin, end = (
        score.tempo_map.seconds(beats)
        for beats in (bar.begin_beats, bar.begin_beats + bar.shape.ticks / TICKS_PER_QUARTER)
    )
    return wire.PartMeasure(
        number=bar.number,
        bars=1,
        begin_s=begin,
        end_s=end,
        ticks=bar.shape.ticks,
        numerator=bar.numerator,
        denominator=bar.denominator,
        fifths=key.fifths,
        written_fifths=written_key.fifths,
        entries=entries,
    )


def _main(part: WrittenPart, note: int) -> int:
    """Return the note whose pitch and fingering stand for a note of the line: of a trill the lower one."""
    trill = part.trills.get(note)
    return note if trill is None else trill.main
