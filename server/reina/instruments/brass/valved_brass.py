"""A valved brass instrument: whatever its table says, it chooses a part, makes it playable and fingers it."""

import sys
from collections.abc import Sequence
from functools import cached_property
from typing import Literal

import numpy as np

from reina.curves import Parameter
from reina.instruments.brass.body import BrassBody
from reina.instruments.brass.chart import ChartEntry
from reina.instruments.brass.fingering import BrassFingering, BrassPart, pressed
from reina.instruments.brass.gestures import plan_gestures
from reina.instruments.brass.model import BrassModel
from reina.instruments.brass.mute import MUTE_CHOICE, mute_parameter
from reina.instruments.brass.phrase import Choice, Costs, choose
from reina.instruments.brass.reasons import why
from reina.instruments.chart_note import ChartNote
from reina.instruments.coded_column import coded
from reina.instruments.instrument import Instrument
from reina.instruments.joined_parts import check_parts, notes_of_parts
from reina.instruments.line import playable_line
from reina.instruments.note_fingerings import NoteFingering, ValvesFingering
from reina.instruments.note_names import spell_line
from reina.instruments.octaves import fitting_octaves
from reina.instruments.pitch_names import pitch_name
from reina.instruments.played import Line, PlayedPart
from reina.instruments.player.engagement import Engagement
from reina.instruments.ranking import PartRanking, rank_parts
from reina.kinematics import Curve, MotionCurves
from reina.music.arrays import IntArray, read_only
from reina.music.score import Score
from reina.music.warnings import WarningLog
from reina.notation import keys_of, named

DOWN, UP = "●", "○"

MAX_TOLD = 200
"""How many dropped or shortened notes are told of one by one; all of them stand in the line."""

SLIDE_FROM_S = 0.15
"""A note has to last this long for the slide to go out for it."""

SLIDE_FROM_CENTS = 10.0
"""What is less sharp is left to the lips."""


MIDDLE_ABOVE_FUNDAMENTAL = 22
"""Semitones from the open tube's first harmonic to the pitch that asks for neither much nor little effort."""


class ValvedBrass(Instrument):
    """An instrument made from a `BrassModel`."""

    show_parameters = (MUTE_CHOICE,)

    def __init__(self, model: BrassModel, costs: Costs | None = None) -> None:
        self.model = model
        self.name, self.title = model.name, model.title
        self.rig, self.program = model.rig, model.program
        self._costs = costs or Costs()
        self._moved = _moved(model)
        self.parameters = (*self._moved, mute_parameter(model.name))

    def __repr__(self) -> str:
        return f"ValvedBrass({self.model.name!r})"

    @property
    def valve_count(self) -> int:
        """How many valves it has."""
        return self.model.valve_count

    def can_play(self, sounding_pitch: int) -> bool:
        """Return whether it has a note, a MIDI number as it sounds."""
        return sounding_pitch in self.model.chart

    @property
    def clef(self) -> Literal["treble", "bass"]:
        """The clef that it is written in."""
        return self.model.clef

    @property
    def fingering_chart(self) -> tuple[ChartNote, ...]:
        """How each note that it has is fingered, from the lowest up."""
        return tuple(
            ChartNote(pitch, self.written_pitch(pitch), (entry.primary, *entry.alternates))
            for pitch, entry in self.model.chart.items()
        )

    def written_pitch(self, sounding_pitch: int) -> int:
        """Return the pitch that stands in the player's part for one that sounds, both MIDI numbers."""
        return sounding_pitch + self.model.written_above_sounding

    def rank_parts(self, score: Score) -> tuple[PartRanking, ...]:
        """Rank the parts of a score by how well they suit it, the best first."""
        return rank_parts(score, self.model.suitability)

    def play(
        self,
        score: Score,
        part: int,
        transposition: int = 0,
        *,
        written: bool = False,
        octave_fit: bool = False,
        joined_parts: Sequence[int] = (),
        usual_fingerings: bool = False,
        handedness: str = "right",  # noqa: ARG002
    ) -> BrassPart:
        """As `Instrument.play`."""
        joined = check_parts(score, part, joined_parts)
        log = WarningLog(MAX_TOLD)
        place = f"part {part}"
        if written:
            transposition -= self.model.written_above_sounding
            log.add(
                "written_pitch",
                place,
                f"read as written for {self.title}: it sounds {_semitones(transposition)}",
                things=abs(transposition),
                values={"side": "lower" if transposition < 0 else "higher"} if transposition else {},
            )
        pitches = score.notes.sounding_pitch[notes_of_parts(score, (part, *joined))].astype(np.int64)
        octaves = fitting_octaves(pitches + transposition, self.model.lowest, self.model.highest)
        told: dict[str, str | int] = {"side": "up" if octaves > 0 else "down"}
        if octaves and octave_fit:
            transposition += 12 * octaves
            message = f"moved by {_octaves(octaves)} to come into range"
            log.add("octave_fit", place, message, things=abs(octaves), values=told)
        elif octaves and not score.parts[part].is_drums:
            message = f"moved by {_octaves(octaves)}, more of its notes would be in range"
            moved = pitches + transposition
            out, left = self._beyond(moved), self._beyond(moved + 12 * octaves)
            told |= {"notes": len(pitches), "out": out, "left": left}
            log.add("octave_fit_possible", place, message, things=abs(octaves), values=told)
        line = playable_line(score, part, transposition, log, joined_parts=joined, playable=self.model.chart)
        above = self.model.written_above_sounding
        spelled = spell_line(score, line, keys_of(score), moved=transposition, written_above_sounding=above)
        written_names = [
            named(pitch + above, name)
            for pitch, name in zip(line.sounding_pitch.tolist(), spelled.tolist(), strict=True)
        ]
        fingering = self.finger(line, written_names, usual_fingerings=usual_fingerings)
        for note in np.flatnonzero(~fingering.playable).tolist():
            index = line.note_index[note]
            where = f"part {score.notes.part[index]}, note {index} at {line.onset_s[note]:.3f} s"
            side = "below" if line.sounding_pitch[note] < self.model.lowest else "above"
            log.add("not_playable", where, fingering.reasons[note], values={"side": side})
        return BrassPart(part, transposition, line, fingering, log.warnings(), joined_parts=joined)

    def show_fingering(self, fingering: NoteFingering) -> str:
        """Return a note's fingering as a table of text has it: a mark for each valve."""
        if not isinstance(fingering, ValvesFingering):
            return str(fingering)
        valves = range(1, self.valve_count + 1)
        return " ".join(DOWN if valve in fingering.valves else UP for valve in valves)

    def plan_gestures(self, played: PlayedPart, *, seed: int = 0) -> dict[str, Curve]:
        """Plan everything that its player does."""
        middle_pitch = self.model.tube.fundamental + MIDDLE_ABOVE_FUNDAMENTAL
        return plan_gestures(played, middle_pitch=middle_pitch, seed=seed)

    def body(self, engagement: Engagement, curves: MotionCurves) -> BrassBody:
        """Return what turns its player's curves into poses."""
        streamed = tuple(parameter.path.removeprefix(f"{self.name}/") for parameter in self._moved)
        return BrassBody(engagement, curves, self.valve_count, streamed)

    def finger(
        self, line: Line, written_names: Sequence[str], *, usual_fingerings: bool = False
    ) -> BrassFingering:
        """Finger a line, phrase by phrase; what is out of range ends a phrase.

        Args:
            line: M notes.
            written_names: What each is called in the player's part.
            usual_fingerings: Whether to take no fingering but the usual one of each note.
        """
        count = len(line)
        pitches: list[int] = line.sounding_pitch.tolist()
        onset_s: list[float] = line.onset_s.tolist()
        end_s: list[float] = line.end_s.tolist()
        phrases: list[int] = line.phrase.tolist()
        valves = np.zeros((count, self.valve_count), dtype=np.bool_)
        playable = np.array([pitch in self.model.chart for pitch in pitches], dtype=np.bool_)
        primary = np.zeros(count, dtype=np.bool_)
        cents, slide = [0.0] * count, [0.0] * count
        reasons = [self._out_of_range(pitch) for pitch in pitches]
        notes: list[ValvesFingering | None] = [None] * count
        begin = 0
        while begin < count:
            if not playable[begin]:
                begin += 1
                continue
            end = begin + 1
            while end < count and playable[end] and phrases[end] == phrases[begin]:
                end += 1
            span = slice(begin, end)
            choices = [
                self._choices(pitch, until - onset >= SLIDE_FROM_S)[: 1 if usual_fingerings else None]
                for pitch, onset, until in zip(pitches[span], onset_s[span], end_s[span], strict=True)
            ]
            taken = [
                of_note[index]
                for of_note, index in zip(
                    choices, choose(choices, onset_s[span], end_s[span], self._costs), strict=True
                )
            ]
            primaries = [of_note[0] for of_note in choices]
            onsets, names = onset_s[span], written_names[span]
            for index, choice in enumerate(taken):
                note = begin + index
                valves[note, [valve - 1 for valve in choice.valves]] = True
                notes[note] = pressed(choice.valves)
                primary[note] = choice.rank == 0
                cents[note] = choice.cents
                slide[note] = self._slide(pitches[note], choice, end_s[note] - onset_s[note] >= SLIDE_FROM_S)
                reasons[note] = sys.intern(why(index, taken, primaries, names, onsets))
            begin = end
        return BrassFingering(
            notes=coded(notes),
            playable=read_only(playable),
            reasons=coded(reasons),
            valves=read_only(valves),
            primary=read_only(primary),
            cents=coded(cents),
            slide=coded(slide),
        )

    @cached_property
    def _all_choices(self) -> dict[tuple[int, bool], tuple[Choice, ...]]:
        return {
            (pitch, long): self._make_choices(pitch, entry, long)
            for pitch, entry in self.model.chart.items()
            for long in (False, True)
        }

    def _choices(self, pitch: int, long: bool) -> tuple[Choice, ...]:
        return self._all_choices[pitch, long]

    def _make_choices(self, pitch: int, entry: ChartEntry, long: bool) -> tuple[Choice, ...]:
        tube = self.model.tube
        choices: list[Choice] = []
        for rank, valves in enumerate((entry.primary, *entry.alternates)):
            choice = Choice(valves, rank, tube.harmonic(pitch, valves), tube.cents(pitch, valves))
            slide = self._slide(pitch, choice, long)
            choices.append(Choice(valves, rank, choice.harmonic, tube.cents(pitch, valves, slide)))
        return tuple(choices)

    def _slide(self, pitch: int, choice: Choice, long: bool) -> float:
        sharp = self.model.tube.cents(pitch, choice.valves)
        if not long or sharp < SLIDE_FROM_CENTS:
            return 0.0
        return self.model.tube.slide_for(pitch, choice.valves)

    def _beyond(self, pitches: IntArray) -> int:
        """How many pitches, MIDI numbers as they sound, it does not have."""
        return int(np.count_nonzero((pitches < self.model.lowest) | (pitches > self.model.highest)))

    def _out_of_range(self, pitch: int) -> str:
        below = pitch < self.model.lowest
        limit = self.model.lowest if below else self.model.highest
        side, which = ("below", "lowest") if below else ("above", "highest")
        return f"{pitch_name(pitch)} lies {side} the {which} note of the {self.title}, {pitch_name(limit)}"


def _semitones(number: int) -> str:
    return f"{abs(number)} semitone{'' if abs(number) == 1 else 's'} {'higher' if number > 0 else 'lower'}"


def _octaves(number: int) -> str:
    return f"{abs(number)} octave{'' if abs(number) == 1 else 's'} {'up' if number > 0 else 'down'}"


def _moved(model: BrassModel) -> tuple[Parameter, ...]:
    documentation = {
        f"{model.name}/valve/{valve}": f"Valve {valve}: 0 up, 1 down."
        for valve in range(1, model.valve_count + 1)
    }
    documentation[f"{model.name}/slide/3"] = "The third valve's slide: 0 in, 1 out as far as it goes."
    return tuple(
        Parameter(path=path, type="number", default=0.0, minimum=0.0, maximum=1.0, documentation=text)
        for path, text in documentation.items()
    )
