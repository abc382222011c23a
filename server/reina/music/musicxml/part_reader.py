"""One part's measures, as they come, into what is written in it."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from reina.music.key_signature import MAX_ACCIDENTALS
from reina.music.musicxml import tables
from reina.music.musicxml.directions import fermata_share, read_barline, read_direction, read_sound
from reina.music.musicxml.element import Element, number_of, whole_of
from reina.music.musicxml.model import (
    GraceKind,
    Hairpin,
    Hold,
    KeyMark,
    Ornament,
    Syllable,
    WrittenMeasure,
    WrittenNote,
    WrittenPart,
)
from reina.music.musicxml.neighbours import Neighbours
from reina.music.musicxml.ornaments import ornament_of
from reina.music.musicxml.state import MAX_BEATS, PartState, loudness_of, times_of

if TYPE_CHECKING:
    from reina.music.musicxml.document import Cell
    from reina.music.musicxml.instruments import ScoreInstrument, ScorePart
    from reina.music.warnings import WarningLog

MAX_DIVISIONS = 1_000_000
MAX_TEXT = 500
MAX_SLURS = 64
"""Slurs of a part that are open at once."""


@dataclass
class Transposition:
    """How a staff's notes sound: diatonic steps and semitones above what is written."""

    diatonic: float | None = None
    chromatic: int = 0

    @property
    def fifths(self) -> int:
        """What it adds to the sharps of a key."""
        if self.diatonic is not None:
            return round(7 * self.chromatic - 12 * self.diatonic)
        return (7 * self.chromatic + 5) % 12 - 5


class PartReader(PartState):
    """Reads the measures of a part in their order."""

    def __init__(self, listed: ScorePart, measures: list[WrittenMeasure], log: WarningLog) -> None:
        super().__init__(listed, measures, log)
        self._metre: tuple[int, int] | None = (4, 4)
        self._transpositions: dict[str, Transposition] = {}
        self._onset = 0.0
        self._last: WrittenNote | None = None
        self._voices: dict[str, list[WrittenNote]] = {}
        self._slurs: dict[str, tuple[str, int, str]] = {}
        self._neighbours = Neighbours()
        self._waved: set[str] = set()
        """The voices above which a trill's wavy line goes on."""

    def read(self, cell: Cell) -> None:
        """Read the next measure."""
        is_first = len(self.measures) <= cell.measure
        while len(self.measures) <= cell.measure:
            self.measures.append(WrittenMeasure())
        self.measure = cell.measure
        self.measure_place = cell.place
        now = self.now
        now.number = now.number or cell.number
        now.implicit = now.implicit or cell.implicit
        self.cursor = self._onset = furthest = 0.0
        self._last = None
        self._neighbours.begin_measure()
        for element in cell.element:
            match element.name:
                case "note":
                    self._note(element)
                case "backup":
                    self.cursor = max(0.0, self.cursor - self.duration(element))
                case "forward":
                    self.cursor += self.duration(element)
                case "attributes":
                    self._attributes(element)
                case "direction":
                    read_direction(self, element)
                case "sound":
                    read_sound(self, element, self.place)
                case "barline":
                    read_barline(self, element)
                case _:
                    continue
            furthest = max(furthest, self.cursor)
        now.length = max(now.length, min(furthest, MAX_BEATS))
        if is_first:
            now.metre = self._metre

    def finish(self) -> WrittenPart:
        """Return what is written in the part."""
        for begin, sign in self.wedges.values():
            self.part.hairpins.append(Hairpin(begin, None, sign))
            where = self.measure_place.split(", measure")[0]
            number = self.measures[begin[0]].number or begin[0] + 1
            what = "crescendo" if sign > 0 else "diminuendo"
            self.log.add(
                "unmatched_wedge",
                f"{where}, measure {number}",
                f"a {what} that never ends; it lasts until the next dynamic",
            )
        for _, _, where in self._slurs.values():
            self.log.add("unmatched_slur", where, "a slur that never ends was left out")
        self.tell_counts()
        return self.part

    def _attributes(self, element: Element) -> None:
        for child in element:
            match child.name:
                case "divisions":
                    value = number_of(child.text)
                    if value is None or not 0 < value <= MAX_DIVISIONS:
                        shown = child.text.strip()[:20] or "nothing"
                        self.log.add(
                            "bad_divisions", self.where(child), f"divisions of {shown} were left out"
                        )
                    else:
                        self.divisions = value
                case "time":
                    self._time(child)
                case "key":
                    self._key(child)
                case "transpose":
                    self._transpose(child)
                case _:
                    pass

    def _time(self, element: Element) -> None:
        if element.first("senza-misura") is not None:
            self._metre = None
            return
        beats = [_sum(child.text) for child in element.all("beats")]
        types = [whole_of(child.text) for child in element.all("beat-type")]
        pairs = [(n, d) for n, d in zip(beats, types, strict=False) if n and d]
        if not pairs or any(not (0 < n <= 1024 and 0 < d <= 1024 and d & (d - 1) == 0) for n, d in pairs):
            self.log.add("bad_metre", self.where(element), "a time signature that is none was left out")
            return
        finest = max(d for _, d in pairs)
        self._metre = sum(n * finest // d for n, d in pairs), finest

    def _key(self, element: Element) -> None:
        fifths = whole_of(element.said("fifths"))
        if fifths is None:
            if element.first("key-step") is None:
                self.log.add("bad_key", self.where(element), "a key signature without fifths was left out")
            return
        if abs(fifths) <= MAX_ACCIDENTALS:
            self._neighbours.set_key(element.attribute("number"), fifths)
        sounding = fifths + self._transposition(element.attribute("number")).fifths
        while abs(sounding) > MAX_ACCIDENTALS and abs(fifths) <= MAX_ACCIDENTALS:
            sounding -= 12 if sounding > 0 else -12
        if abs(sounding) > MAX_ACCIDENTALS:
            self.log.add("bad_key", self.where(element), f"a key of {fifths} fifths was left out")
            return
        self.part.keys.append(KeyMark(self.place, sounding, element.said("mode") == "minor"))

    def _transpose(self, element: Element) -> None:
        chromatic, octaves = element.number("chromatic") or 0.0, element.number("octave-change") or 0.0
        diatonic = element.number("diatonic")
        if abs(chromatic) > 127 or abs(octaves) > 10:
            self.log.add(
                "bad_transpose", self.where(element), "a transposition beyond all pitches was left out"
            )
            return
        doubled = -12 if element.first("double") is not None else 0
        steps = round(chromatic + 12 * octaves) + doubled
        whole_steps = None if diatonic is None else diatonic + 7 * octaves + (-7 if doubled else 0)
        now = Transposition(whole_steps, steps)
        before = self._transpositions.get(element.attribute("number"), Transposition())
        self._transpositions[element.attribute("number")] = now
        # The key stands before the transposition in `attributes`, and is of the same staff.
        here = [mark for mark in self.part.keys if mark.place == self.place]
        for mark in here:
            moved = mark.fifths - before.fifths + now.fifths
            while abs(moved) > MAX_ACCIDENTALS:
                moved -= 12 if moved > 0 else -12
            self.part.keys[self.part.keys.index(mark)] = replace(mark, fifths=moved)

    def _transposition(self, staff: str) -> Transposition:
        return self._transpositions.get(staff) or self._transpositions.get("", Transposition())

    def _note(self, element: Element) -> None:
        in_chord = element.first("chord") is not None
        grace = element.first("grace")
        is_rest = element.first("rest") is not None
        if grace is not None:
            duration = self._written_value(element)
        elif element.first("duration") is None and element.first("type") is not None:
            self.log.add("bad_duration", self.where(element), "a note without duration; its value was taken")
            duration = self._written_value(element)
        else:
            duration = self.duration(element)
        if not in_chord:
            self._onset = self.cursor
        if grace is None and not in_chord:
            self.cursor += duration
        if grace is None:
            self._held(element, duration)
        if is_rest or element.first("cue") is not None:
            self._last = None if not in_chord else self._last
            return
        note = self._written_note(element, duration, grace)
        if note is None:
            return
        note.in_chord = in_chord and self._last is not None
        self.part.notes.append(note)
        self._notations(element, note)
        self._wave(element, note)
        if not note.in_chord:
            self._last = note
            self._voices.setdefault(note.voice, []).append(note)
            self._slur(element, note)
        elif self._last is not None:
            note.slurred = self._last.slurred
            self._slur(element, self._last)
        self._lyrics(element, note)

    def _written_note(self, element: Element, duration: float, grace: Element | None) -> WrittenNote | None:
        instrument_element = element.first("instrument")
        named = instrument_element.attribute("id") if instrument_element else ""
        instrument = self.instrument(named)
        source = instrument.source
        unpitched = element.first("unpitched") is not None
        pitch = self._drum(element, instrument) if unpitched else self._pitch(element)
        if pitch is None:
            return None
        if unpitched and not source.is_drums:
            source = replace(source, is_drums=True, program=None)
        elif source.is_drums and instrument.unpitched is not None:
            pitch = instrument.unpitched
        if self.muted and source.program in tables.BRASS_WITH_MUTES:
            source = replace(source, program=tables.MUTED)
        ties = {tie.attribute("type") for tie in element.all("tie")}
        if not ties:
            ties = {tied.attribute("type") for all_ in element.all("notations") for tied in all_.all("tied")}
        kind, steals = _grace(grace, duration)
        return WrittenNote(
            measure=self.measure,
            offset=self._onset,
            duration=duration,
            pitch=pitch,
            voice=element.said("voice")[:20],
            source=source,
            line=element.line,
            velocity=loudness_of(element.attribute("dynamics")),
            tie_start="start" in ties or "continue" in ties,
            tie_stop="stop" in ties or "continue" in ties,
            times=times_of(element),
            grace=kind,
            steals=steals,
        )

    def _pitch(self, element: Element) -> int | None:
        pitch = element.first("pitch")
        step = tables.STEPS.get(pitch.said("step").upper()) if pitch else None
        octave = pitch.number("octave") if pitch else None
        if pitch is None or step is None or octave is None or abs(octave) > 20:
            self.log.add("bad_pitch", self.where(element), "a note without a usable pitch was left out")
            return None
        alter = pitch.number("alter") or 0.0
        if alter != round(alter):
            self.log.add("microtone", self.where(element), "a pitch between semitones; the nearest is played")
        staff = element.said("staff")
        self._neighbours.add(staff, pitch.said("step").upper(), round(octave), round(alter))
        number = round(12 * (octave + 1) + step + alter) + self._transposition(staff).chromatic
        if not 0 <= number <= 127:
            self.log.add(
                "bad_pitch", self.where(element), f"the pitch is {number}; 0 to 127 sound; it was left out"
            )
            return None
        return number

    def _neighbour(self, element: Element, steps: int, alter: int | None) -> int:
        """Return the pitch so many steps above a note, as `Neighbours` has it."""
        transposition = self._transposition(element.said("staff")).chromatic
        return self._neighbours.pitch(element, steps, alter, transposition)

    def _held(self, element: Element, duration: float) -> None:
        """Read the fermata of a note or rest."""
        for notations in element.all("notations"):
            for sign in notations.all("fermata"):
                hold = Hold((self.measure, self._onset), duration, duration * fermata_share(sign))
                if duration > 0:
                    self.part.holds.append(hold)

    def _pause(self, note: WrittenNote) -> None:
        """Read a caesura: the note ends before its end, and all parts wait there."""
        note.breath = min(tables.CAESURA_BEATS, note.duration / 2)
        if note.breath > 0 and not note.grace:
            begin = note.offset + note.duration - note.breath
            self.part.holds.append(Hold((note.measure, begin), note.breath, tables.CAESURA_BEATS))

    def _drum(self, element: Element, instrument: ScoreInstrument) -> int:
        key = instrument.drum_key
        if key is None:
            self.log.add(
                "unknown_drum",
                self.where(element),
                f"nothing says which drum this is ({instrument.name or 'no name'}); a snare drum is played",
            )
            return tables.SNARE
        return key

    def _written_value(self, element: Element) -> float:
        """Return the length of a note by its value, dots and tuplet."""
        value = tables.NOTE_TYPES.get(element.said("type"), 0.5)
        value *= 2 - 0.5 ** min(sum(1 for _ in element.all("dot")), 8)
        actual = whole_of(element.said("time-modification", "actual-notes"))
        normal = whole_of(element.said("time-modification", "normal-notes"))
        return value * normal / actual if actual and normal and actual > 0 and normal > 0 else value

    def _notations(self, element: Element, note: WrittenNote) -> None:
        gates: set[str] = set()
        for notations in element.all("notations"):
            for notation in notations:
                match notation.name:
                    case "articulations":
                        for sign in notation:
                            note.louder += tables.LOUDER.get(sign.name, 0.0)
                            if sign.name in tables.GATES:
                                gates.add(sign.name)
                            elif sign.name == "breath-mark":
                                note.breath = tables.BREATH_BEATS
                            elif sign.name == "caesura":
                                self._pause(note)
                            elif sign.name in tables.BENDS:
                                self.tell(sign, f"a {sign.name}")
                    case "dynamics":
                        for sign in notation:
                            self.dynamic(sign.name, note.place)
                    case "ornaments":
                        self._ornaments(element, notation, note)
                    case "glissando" | "slide" | "arpeggiate":
                        self.tell(notation, f"a{'n' if notation.name[0] == 'a' else ''} {notation.name}")
                    case _:
                        pass
        if {"staccato", "tenuto"} <= gates:
            gates -= {"staccato", "tenuto"}
            note.gate = tables.PORTATO
        note.gate = min([note.gate, *(tables.GATES[name] for name in gates)])

    def _ornaments(self, element: Element, signs: Element, note: WrittenNote) -> None:
        ornament, left = ornament_of(
            signs, element.said("type"), lambda steps, alter: self._neighbour(element, steps, alter)
        )
        if ornament is not None and (note.grace or (note.source.is_drums and ornament.kind != "tremolo")):
            ornament, left = None, [*signs]
        note.ornament = note.ornament or ornament
        for sign in left:
            self.tell(sign, f"a {sign.name.replace('-', ' ')}")

    def _wave(self, element: Element, note: WrittenNote) -> None:
        """Have a note trill above which a trill's line goes on from a note before it."""
        lines = [
            line.attribute("type")
            for notations in element.all("notations")
            for signs in notations.all("ornaments")
            for line in signs.all("wavy-line")
        ]
        if note.voice in self._waved and not (note.ornament or note.grace or note.source.is_drums):
            note.ornament = Ornament("trill", self._neighbour(element, 1, None))
        if "start" in lines:
            self._waved.add(note.voice)
        if "stop" in lines:
            self._waved.discard(note.voice)

    def _slur(self, element: Element, note: WrittenNote) -> None:
        slurs = [slur for notations in element.all("notations") for slur in notations.all("slur")]
        for slur in slurs:
            if slur.attribute("type") == "stop":
                opened = self._slurs.pop(slur.attribute("number") or "1", None)
                if opened is None:
                    self.log.add("unmatched_slur", self.where(slur), "a slur that never begins was left out")
                    continue
                voice, begin, _ = opened
                under = self._voices[voice][begin + 1 :]
                for one in under if voice == note.voice else [*under, note]:
                    if one.place <= note.place:
                        one.slurred = True
        for slur in slurs:
            if slur.attribute("type") == "start" and len(self._slurs) < MAX_SLURS:
                number = slur.attribute("number") or "1"
                self._slurs[number] = (note.voice, len(self._voices[note.voice]) - 1, self.where(slur))

    def _lyrics(self, element: Element, note: WrittenNote) -> None:
        for lyric in element.all("lyric"):
            pieces: list[str] = []
            last = "single"
            for child in lyric:
                if child.name == "text":
                    pieces.append(child.text)
                elif child.name == "elision":
                    pieces.append(child.text if child.text.strip("‿_ ") else " ")
                elif child.name == "syllabic":
                    last = child.text.strip()
            text = "".join(pieces).strip("\r\n\t")[:MAX_TEXT]
            if not text.strip():
                continue
            text += "" if last in {"begin", "middle"} else " "
            if lyric.first("end-paragraph") is not None:
                text += "\n\n"
            elif lyric.first("end-line") is not None:
                text += "\n"
            digits = re.findall(r"\d{1,3}", lyric.attribute("number"))
            verse = int(digits[-1]) if digits else 1
            self.part.syllables.append(Syllable(note.place, max(verse, 1), text))


def _grace(grace: Element | None, duration: float) -> tuple[GraceKind, float | None]:
    """How a grace note takes its time, and which share of its note, as a `WrittenNote` has them."""
    if grace is None:
        return "", None
    ways: tuple[tuple[str, GraceKind], ...] = (
        ("steal-time-previous", "before"),
        ("steal-time-following", "on"),
    )
    for attribute, kind in ways:
        percent = number_of(grace.attribute(attribute))
        if percent is not None and 0 < percent <= 100:
            return kind, min(percent, 90.0) / 100
    is_long = grace.attribute("slash") != "yes" and duration >= tables.NOTE_TYPES["eighth"]
    return "on" if is_long else "before", None


def _sum(text: str) -> int:
    """Return the sum of ``"3+2"``, 0 if it is none."""
    numbers = [whole_of(piece) for piece in text.split("+")]
    return sum(number for number in numbers if number) if all(numbers) else 0
