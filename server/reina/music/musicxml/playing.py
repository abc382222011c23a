"""A part's written notes as they are played: ties joined, grace notes given time, repeats made."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from reina.music.musicxml.ornaments import played_out
from reina.music.musicxml.played_note import PlayedNote
from reina.music.musicxml.tables import GRACE_BEATS

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reina.music.limits import Limits
    from reina.music.musicxml.model import Source, WrittenNote
    from reina.music.musicxml.timeline import Timeline
    from reina.music.tempo import TempoMap

TIED_BEATS = 0.02
"""A note that is tied to one before it begins where that ends, but for the rounding of tuplets."""
NO_ROOM_BEATS = 1e-3
BREATH_LEAVES = 2 / 3
"""So much of a note sounds before a breath at least."""


@dataclass
class _Voice:
    """What a voice has played last, and the grace notes that wait for their note."""

    graces: list[tuple[WrittenNote, float]] = field(default_factory=list["tuple[WrittenNote, float]"])
    last: list[PlayedNote] = field(default_factory=list[PlayedNote])
    shift: float = 0.0
    """How much later than written its present note begins, for the grace notes on the beat."""


def play_notes(
    notes: Sequence[WrittenNote],
    velocities: Sequence[float],
    timeline: Timeline,
    tempo_map: TempoMap,
    limits: Limits,
) -> list[PlayedNote]:
    """Play a part's notes.

    Args:
        notes: As they are written.
        velocities: Of each.
        timeline: When which measure is played.
        tempo_map: How fast; trills are as fast at any tempo.
        limits: How many notes may come of it.

    Raises:
        ScoreLimitError: If ornaments make more notes than that.
    """
    by_measure: dict[int, list[tuple[WrittenNote, float]]] = {}
    for note, velocity in zip(notes, velocities, strict=True):
        by_measure.setdefault(note.measure, []).append((note, velocity))
    for of_measure in by_measure.values():
        of_measure.sort(key=lambda one: one[0].offset)
    player = _NotePlayer()
    for measure in timeline.played:
        for note, velocity in by_measure.get(measure.measure, ()):
            if not note.times or measure.playing in note.times:
                player.play(note, velocity, measure.begin + note.offset)
    player.finish(timeline.end)
    played: list[PlayedNote] = []
    for note in player.played:
        played.extend(played_out(note, tempo_map))
        limits.check("notes", len(played), what="number of notes, those of trills and tremolos among them")
    return played


class _NotePlayer:
    def __init__(self) -> None:
        self.played: list[PlayedNote] = []
        self._voices: dict[str, _Voice] = {}
        self._tied: dict[tuple[int, Source], list[PlayedNote]] = {}

    def play(self, note: WrittenNote, velocity: float, onset: float) -> None:
        voice = self._voices.setdefault(note.voice, _Voice())
        if note.grace:
            voice.graces.append((note, velocity))
            return
        if not note.in_chord:
            voice.shift = 0.0
            if voice.graces:
                voice.shift = self._ornament(voice, onset, note.duration)
        if note.tie_stop and self._prolong(note, onset, voice):
            return
        end = onset + note.duration
        begin = onset + voice.shift
        sounding = PlayedNote(
            begin, _until(note, begin, end), end, note.pitch, velocity, note.slurred, note.source, note.line,
            note.ornament, begin,
        )  # fmt: skip
        self.played.append(sounding)
        if note.tie_start:
            self._tied.setdefault((note.pitch, note.source), []).append(sounding)
        if note.in_chord:
            voice.last.append(sounding)
        else:
            voice.last = [sounding]

    def finish(self, end: float) -> None:
        """Play grace notes that no note follows."""
        for voice in self._voices.values():
            if voice.graces:
                self._ornament(voice, end, 0.0)

    def _prolong(self, note: WrittenNote, onset: float, voice: _Voice) -> bool:
        """Let a note that is tied to this one sound on; False if there is none."""
        tied = self._tied.get((note.pitch, note.source), [])
        for before in tied:
            if abs(before.written_end - onset) < TIED_BEATS:
                before.written_end = onset + note.duration
                before.end = _until(note, onset, onset + note.duration)
                if before.ornament is None and note.ornament is not None:
                    before.ornament, before.ornament_from = note.ornament, onset
                if not note.tie_start:
                    tied.remove(before)
                if note.in_chord:
                    voice.last.append(before)
                else:
                    voice.last = [before]
                return True
        tied[:] = [before for before in tied if before.written_end > onset]
        return False

    def _ornament(self, voice: _Voice, onset: float, duration: float) -> float:
        """Play the grace notes that wait; return how much later their note begins for it."""
        chords: list[list[tuple[WrittenNote, float]]] = []
        for grace in voice.graces:
            if grace[0].in_chord and chords:
                chords[-1].append(grace)
            else:
                chords.append([grace])
        voice.graces = []
        first = chords[0][0][0]
        wanted = len(chords) * GRACE_BEATS
        on_beat = first.grace == "on" and duration > 0
        time = 0.0
        if not on_beat:
            last_end = max((one.written_end for one in voice.last), default=0.0)
            last_onset = max((one.onset for one in voice.last), default=0.0)
            sounds_on = bool(voice.last) and last_end > onset - TIED_BEATS
            room = onset - last_onset if sounds_on else onset - last_end
            most = room / 2 if sounds_on else room
            time = min(first.steals * room if first.steals else wanted, most if not first.steals else room)
            if time < NO_ROOM_BEATS:
                on_beat = duration > 0
        if on_beat:
            single = len(chords) == 1 and first.grace == "on"
            wanted = first.steals * duration if first.steals else first.duration if single else wanted
            time = min(wanted, duration * 0.9 if first.steals else duration / 2)
        if time < NO_ROOM_BEATS:
            return 0.0
        begin = onset if on_beat else onset - time
        for number, chord in enumerate(chords):
            at, until = begin + time * number / len(chords), begin + time * (number + 1) / len(chords)
            for note, velocity in chord:
                self.played.append(
                    PlayedNote(at, until, until, note.pitch, velocity, note.slurred, note.source, note.line)
                )
        if on_beat:
            return time
        for one in voice.last:
            one.end = min(one.end, begin)
        return 0.0


def _until(note: WrittenNote, begin: float, end: float) -> float:
    """Where a note ends, of which `begin` to `end` is written: by its articulation, and for breath."""
    until = begin + (end - begin) * note.gate
    if note.breath:
        until = min(until, max(end - note.breath, begin + (end - begin) * BREATH_LEAVES))
    return until
