"""What the list of parts says: their names, and what sounds their notes."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from reina.music.gm import DRUM_CHANNEL
from reina.music.musicxml.element import Element, number_of, whole_of
from reina.music.musicxml.model import Source
from reina.music.musicxml.tables import DRUM_NAMES, INSTRUMENT_SOUNDS

if TYPE_CHECKING:
    from reina.music.musicxml.document import Head

LONGEST_NAME = 200


@dataclass(frozen=True)
class ScoreInstrument:
    """One instrument of a part.

    Attributes:
        name: What the document calls it.
        source: What sounds it.
        unpitched: The key of its drum, or None.
    """

    name: str = ""
    source: Source = field(default_factory=lambda: Source(None, is_drums=False))
    unpitched: int | None = None

    def with_midi(self, midi: Element) -> ScoreInstrument:
        """Return it as a `midi-instrument` has it."""
        channel, program = whole_of(midi.said("midi-channel")), whole_of(midi.said("midi-program"))
        key = whole_of(midi.said("midi-unpitched"))
        volume, pan = number_of(midi.said("volume")), number_of(midi.said("pan"))
        now = self.source
        source = Source(
            program - 1 if program is not None and 1 <= program <= 128 else now.program,
            channel - 1 == DRUM_CHANNEL if channel is not None else now.is_drums,
            _controller(volume, 127 / 100) if volume is not None else now.volume,
            _controller(pan + 90, 127 / 180) if pan is not None else now.pan,
        )
        unpitched = key - 1 if key is not None and 1 <= key <= 128 else self.unpitched
        return replace(self, source=source, unpitched=unpitched)

    def with_sound(self, sound: str) -> ScoreInstrument:
        """Return it with one of MusicXML's standard sounds, where its program is not known."""
        program = next((number for begins, number in INSTRUMENT_SOUNDS if sound.startswith(begins)), None)
        return self if program is None else replace(self, source=replace(self.source, program=program))

    @property
    def drum_key(self) -> int | None:
        """The key of its drum, by its name where nothing else says it."""
        if self.unpitched is not None:
            return self.unpitched
        name = self.name.lower()
        return next((key for word, key in DRUM_NAMES if word in name), None)


@dataclass
class ScorePart:
    """A part as the list of parts has it.

    Attributes:
        name: What the document calls it, "" if it does not.
        instruments: By their ids, the first being the one of notes that name none.
    """

    name: str = ""
    instruments: dict[str, ScoreInstrument] = field(default_factory=dict[str, ScoreInstrument])


def score_part(head: Head, identity: str) -> ScorePart:
    """Return what the list of parts says of a part; nothing if it does not have it."""
    listed = head.first("part-list")
    for element in listed.all("score-part") if listed else ():
        if element.attribute("id")[:60] == identity:
            return _score_part(element)
    return ScorePart()


def _score_part(element: Element) -> ScorePart:
    instruments: dict[str, ScoreInstrument] = {}
    for instrument in element.all("score-instrument"):
        named = ScoreInstrument(_line(instrument.said("instrument-name")))
        instruments[instrument.attribute("id")] = named.with_sound(instrument.said("instrument-sound"))
    for midi in element.all("midi-instrument"):
        identity = midi.attribute("id")
        instruments[identity] = instruments.get(identity, ScoreInstrument()).with_midi(midi)
    name = _line(element.said("part-name"))
    if name.lower() in {"musicxml part", "part"}:
        name = ""
    alone = next(iter(instruments.values())).name if len(instruments) == 1 else ""
    return ScorePart(name or alone, instruments)


def _line(text: str) -> str:
    return " ".join(text.split())[:LONGEST_NAME]


def _controller(value: float, scale: float) -> int:
    return min(max(round(value * scale), 0), 127)
