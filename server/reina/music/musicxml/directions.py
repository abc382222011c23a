"""Directions, sounds and bar lines of a part: dynamics, tempo, mutes, words, repeats, endings and jumps."""

from __future__ import annotations

import math
import re
from dataclasses import replace

from reina.music.musicxml import tables
from reina.music.musicxml.element import Element, number_of, whole_of
from reina.music.musicxml.model import (
    DynamicMark,
    Hairpin,
    Hold,
    Place,
    TempoMark,
    TempoReturn,
    TempoShift,
    Words,
)
from reina.music.musicxml.state import PartState, loudness_of, times_of

MAX_WORDS = 200


MAX_PASSES = 100
MEASURE_END = math.inf
SIGNS = {"crescendo": 1, "diminuendo": -1}


def read_direction(state: PartState, element: Element) -> None:
    """Read a direction: its signs and words where it stands, its sound where that is played."""
    sound = element.first("sound")
    place = _moved(state, element)
    metronome: Element | None = None
    dashes: list[Element] = []
    has_dynamics = False
    words: list[str] = []
    for kind in element.all("direction-type"):
        for sign in kind:
            match sign.name:
                case "dynamics":
                    has_dynamics = True
                    for one in sign:
                        _dynamic(state, one, sound, place)
                case "wedge":
                    _wedge(state, sign, place)
                case "metronome":
                    metronome = sign
                case "words":
                    words.append(sign.text)
                case "dashes" | "bracket":
                    dashes.append(sign)
                case "rehearsal":
                    _add_words(state, "marker", sign.text, place)
                case "segno":
                    state.now.segno.add(sound.attribute("segno") if sound else "")
                case "coda":
                    # The sign also stands at "To Coda", whose sound says so.
                    if not (sound and sound.attribute("tocoda")) and not _is_to_coda(element):
                        state.now.coda.add(sound.attribute("coda") if sound else "")
                case _:
                    pass
    text = " ".join(" ".join(words).split())
    tempo = sound.attribute("tempo") if sound else ""
    if metronome is not None and not tempo:
        _metronome(state, metronome, place)
    if text:
        _words(state, text, place, sound)
    _dashes(state, dashes, place, begins=bool(text) and not tempo)
    if sound is not None:
        read_sound(state, sound, place, has_dynamics=has_dynamics)


def read_sound(state: PartState, element: Element, place: Place, *, has_dynamics: bool = False) -> None:
    """Read a `sound`: tempo, dynamics, jumps, instruments.

    Args:
        state: Where the part is read.
        element: The sound.
        place: Where it holds.
        has_dynamics: Whether a sign beside it has said its dynamics already.
    """
    tempo = element.attribute("tempo")
    if tempo:
        bpm = number_of(tempo)
        if bpm is None or not tables.SLOWEST <= bpm <= tables.FASTEST:
            what = f"a tempo of {tempo[:20]} quarter notes a minute was left out"
            state.log.add("bad_tempo", state.where(element), what)
        else:
            state.part.tempos.append(TempoMark(place, bpm, times=times_of(element)))
    level = loudness_of(element.attribute("dynamics"))
    if level is not None and not has_dynamics:
        state.part.dynamics.append(DynamicMark(place, level))
    now = state.now
    if element.attribute("segno"):
        now.segno.add(element.attribute("segno"))
    if element.attribute("coda"):
        now.coda.add(element.attribute("coda"))
    if element.attribute("dacapo") == "yes":
        now.da_capo = True
    if element.attribute("dalsegno"):
        now.dal_segno = element.attribute("dalsegno")
    if element.attribute("tocoda"):
        now.to_coda = element.attribute("tocoda")
    # "yes", or the number of a part or verse that it holds for.
    if element.attribute("fine") not in {"", "no"}:
        now.fine = True
    if element.attribute("forward-repeat") == "yes":
        now.forward = True
    _instruments(state, element)
    mute = element.said("play", "mute")
    if mute:
        state.muted = mute not in {"off", "open"}


def read_barline(state: PartState, element: Element) -> None:
    """Read a bar line: repeats and endings."""
    now = state.now
    repeat = element.first("repeat")
    if repeat is not None:
        if repeat.attribute("direction") == "forward":
            now.forward = True
        elif repeat.attribute("direction") == "backward":
            times = whole_of(repeat.attribute("times"))
            now.backward = max(now.backward, times if times is not None and times > 1 else 2)
            now.after_jump = now.after_jump or repeat.attribute("after-jump") == "yes"
    ending = element.first("ending")
    if ending is not None:
        if ending.attribute("type") == "start":
            passes = [int(n) for n in re.findall(r"\d{1,3}", ending.attribute("number") or ending.text)]
            now.ending_begins = frozenset(n for n in passes if 0 < n <= MAX_PASSES) or frozenset({1})
        else:
            now.ending_ends = True
    if element.first("segno") is not None:
        now.segno.add(element.attribute("segno"))
    if element.first("coda") is not None:
        now.coda.add(element.attribute("coda"))
    fermata = element.first("fermata")
    if fermata is not None:
        # What is before the line is held: of the last beat, wherever the voice stands that is read just now.
        is_left = element.attribute("location") == "left"
        place = (state.measure, 0.0) if is_left else (state.measure, MEASURE_END)
        state.part.holds.append(Hold(place, 0.0, fermata_share(fermata)))


def _moved(state: PartState, element: Element) -> Place:
    """Return where a direction is played: its offset moves it if it says that it sounds there."""
    offset = element.first("offset")
    if offset is None or offset.attribute("sound") != "yes":
        return state.place
    value = number_of(offset.text) or 0.0
    return state.measure, max(0.0, state.cursor + value / state.divisions)


def _dynamic(state: PartState, sign: Element, sound: Element | None, place: Place) -> None:
    said = loudness_of(sound.attribute("dynamics")) if sound else None
    if said is None:
        state.dynamic(sign.name, place)
    elif sign.name in tables.ACCENTS:
        state.part.dynamics.append(DynamicMark(place, None, said))
    elif sign.name in tables.ACCENT_THEN_LEVEL:
        state.dynamic(sign.name, place)
    else:
        state.part.dynamics.append(DynamicMark(place, said))


def _wedge(state: PartState, sign: Element, place: Place) -> None:
    number, kind = sign.attribute("number") or "1", sign.attribute("type")
    if kind in SIGNS:
        state.wedges[number] = (place, SIGNS[kind])
    elif kind == "stop":
        begun = state.wedges.pop(number, None)
        if begun is None:
            state.log.add("unmatched_wedge", state.where(sign), "a hairpin that never begins was left out")
        elif begun[0] < place:
            state.part.hairpins.append(Hairpin(begun[0], place, begun[1]))


def _metronome(state: PartState, sign: Element, place: Place) -> None:
    """Read a metronome mark: a note value and a number, or two note values of one length."""
    values: list[float] = []
    for child in sign:
        if child.name == "beat-unit":
            values.append(tables.NOTE_TYPES.get(child.text.strip(), 1.0))
        elif child.name == "beat-unit-dot" and values:
            values[-1] *= 1.5
    per_minute = re.search(r"\d{1,5}(\.\d{1,5})?", sign.said("per-minute"))
    if len(values) == 2:
        state.part.tempos.append(TempoMark(place, None, values[1] / values[0]))
    elif len(values) == 1 and per_minute:
        bpm = float(per_minute[0]) * values[0]
        if tables.SLOWEST <= bpm <= tables.FASTEST:
            state.part.tempos.append(TempoMark(place, bpm))
            return
        state.log.add("bad_tempo", state.where(sign), f"a metronome mark of {per_minute[0]} was left out")
    else:
        state.log.add("bad_tempo", state.where(sign), "a metronome mark without a number was left out")


def _words(state: PartState, text: str, place: Place, sound: Element | None) -> None:
    """Read words: jumps that no sound says, mutes, dynamics, changes of tempo; all are kept as text."""
    lower = text.lower()
    if not _jumps(sound):
        if tables.DA_CAPO.match(text):
            state.now.da_capo = True
        elif tables.DAL_SEGNO.match(text):
            state.now.dal_segno = ""
        elif tables.TO_CODA.match(text):
            state.now.to_coda = ""
        elif tables.FINE.match(text):
            state.now.fine = True
    if tables.MUTE_OUT.search(lower):
        state.muted = False
    elif tables.MUTE_IN.search(lower):
        state.muted = True
    if tables.CRESCENDO.match(lower):
        state.part.hairpins.append(Hairpin(place, None, 1))
    elif tables.DIMINUENDO.match(lower):
        state.part.hairpins.append(Hairpin(place, None, -1))
    if not (sound and sound.attribute("tempo")):
        change = _tempo_words(lower, place)
        if change is not None:
            state.part.tempo_words.append(change)
    _add_words(state, "text", text, place)


def _tempo_words(text: str, place: Place) -> TempoShift | TempoReturn | None:
    """Return what words in small letters say of the tempo."""
    degree = 2 if tables.MUCH.search(text) else 0 if tables.LITTLE.search(text) else 1
    for words, ratios, gradual in (
        (tables.SLOWER, tables.SLOWER_RATIOS, True),
        (tables.HELD_BACK, tables.SLOWER_RATIOS, False),
        (tables.FASTER, tables.FASTER_RATIOS, True),
    ):
        if words.search(text):
            return None if tables.NO_CHANGE.search(text) else TempoShift(place, ratios[degree], gradual)
    if tables.TEMPO_PRIMO.search(text):
        return TempoReturn(place, to_first=True)
    return TempoReturn(place, to_first=False) if tables.A_TEMPO.search(text) else None


def _dashes(state: PartState, dashes: list[Element], place: Place, *, begins: bool) -> None:
    """Read the dashes, or the line, that say how far the words for a change of tempo reach."""
    changes = state.part.tempo_words
    for sign in dashes:
        number = sign.attribute("number") or "1"
        if sign.attribute("type") == "start":
            state.dashed.pop(number, None)
            if begins and changes and changes[-1].place == place:
                state.dashed[number] = len(changes) - 1
        elif sign.attribute("type") == "stop" and number in state.dashed:
            index = state.dashed.pop(number)
            change = changes[index]
            if isinstance(change, TempoShift) and change.place < place:
                changes[index] = replace(change, end=place)


def fermata_share(sign: Element) -> float:
    """Return by which share of its length a fermata makes a note longer."""
    return tables.FERMATAS.get(sign.text.strip(), tables.FERMATAS["normal"])


def _jumps(sound: Element | None) -> bool:
    names = ("dacapo", "dalsegno", "tocoda", "fine", "segno", "coda")
    return sound is not None and any(sound.attribute(name) for name in names)


def _is_to_coda(element: Element) -> bool:
    words = (word for kind in element.all("direction-type") for word in kind.all("words"))
    return any(tables.TO_CODA.match(word.text) for word in words)


def _add_words(state: PartState, kind: str, text: str, place: Place) -> None:
    text = " ".join(text.split())[:MAX_WORDS]
    if text:
        state.part.words.append(Words(place, "marker" if kind == "marker" else "text", text))


def _instruments(state: PartState, element: Element) -> None:
    """Read changes of the instruments within the piece."""
    for change in element.all("instrument-change"):
        identity = change.attribute("id")
        sound = change.said("instrument-sound")
        if sound:
            now = state.instrument(identity)
            silent = replace(now, source=replace(now.source, program=None))
            state.change_instrument(identity, silent.with_sound(sound))
    for midi in element.all("midi-instrument"):
        identity = midi.attribute("id")
        state.change_instrument(identity, state.instrument(identity).with_midi(midi))
