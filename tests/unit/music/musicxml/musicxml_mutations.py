"""MusicXML documents made worse at random: their elements, or their bytes."""

from __future__ import annotations

import copy
from functools import cache
from typing import TYPE_CHECKING
from xml.etree import ElementTree

from tests.mutations import Format, mutate
from tests.unit.music.musicxml.musicxml_text import (
    B_FLAT,
    REPEAT_BEGINS,
    articulations,
    attributes,
    compressed,
    direction,
    document,
    dynamic,
    ending,
    listed,
    measures,
    note,
    slur,
    tempo,
    tied,
    wedge,
    words,
)

if TYPE_CHECKING:
    import random
    from collections.abc import Callable


DOCUMENTS = Format(
    interesting=(0x00, 0x09, 0x22, 0x26, 0x3C, 0x3E, 0x2F, 0x7F, 0x80, 0xFF),
    tokens=(
        b"<note>",
        b"</note>",
        b"</measure>",
        b"&amp;",
        b"&#0;",
        b"<![CDATA[",
        b"<!--",
        b"<chord/>",
        b"<grace/>",
    ),
    numbers=(b"-1", b"1e308", b"0", b"0.0000001", b"99999999999", b"", b"4+4", b"NaN"),
)
ODD = (
    "",
    "-1",
    "0",
    "0.5",
    "1e308",
    "99999999",
    "yes",
    "no",
    "stop",
    "start",
    "backward",
    "1,2",
    "whole",
    "C",
    "x" * 500,
)


@cache
def musicxml_seeds() -> tuple[bytes, ...]:
    """Small documents that hold everything that is read."""
    sung = '<lyric number="1"><syllabic>begin</syllabic><text>la</text></lyric>'
    graces = note("D5", 0.5, before='<grace slash="yes"/>') + note("E5", 0.5, before="<grace/>")
    second = "<backup><duration>48</duration></backup>" + note("C4", 4, inner="<voice>2</voice>")
    melody = measures(
        attributes(fifths=2, extra=B_FLAT) + tempo(100) + dynamic("p") + wedge("crescendo") + graces
        + note("C5", inner=slur("start") + sung) + note("D5", inner=slur("stop"))
        + note("E5", 2, inner=tied("start")) + second,
        REPEAT_BEGINS + wedge("stop") + dynamic("f") + note("E5", 2, inner=tied("stop"))
        + note("G5", before="<chord/>") + note("F5", 2, inner=articulations("staccato", "accent")),
        ending("1", "start") + words("con sord.") + note("G5", 4)
        + ending("1", "stop", '<repeat direction="backward"/>'),
        ending("2", "start") + direction("<segno/>") + note("A5", 4) + ending("2", "stop"),
        direction("<rehearsal>B</rehearsal>") + note("B5", 3) + words("To Coda"),
        note("r", 4) + words("D.S. al Coda"),
        direction("<coda/>") + note("C6", 4),
    )  # fmt: skip
    hit = '<note><unpitched/><duration>12</duration><instrument id="P2-I1"/></note>'
    drums = measures(attributes("3/4") + hit * 3, hit * 2 + note("r"))
    ornament = "<notations><ornaments>{}</ornaments></notations>"
    shaped = measures(
        attributes(fifths=1) + words("accel.") + note("B4", 2, inner=ornament.format("<trill-mark/>"))
        + note("C5", inner=ornament.format("<turn/><accidental-mark>sharp</accidental-mark>"))
        + note("C5", inner=ornament.format('<tremolo type="single">2</tremolo>')),
        "<direction><direction-type><words>rit.</words></direction-type><direction-type>"
        '<dashes type="start"/></direction-type></direction>'
        + note("D5", 2, inner=ornament.format("<inverted-mordent/>"))
        + direction('<dashes type="stop"/>') + note("G4", 2, inner="<notations><fermata/></notations>"),
        words("a tempo") + note("A4", 2, inner=articulations("caesura", "breath-mark")) + note("r", 2),
        '<barline location="right"><fermata/><repeat direction="backward"/></barline>',
    )  # fmt: skip
    two = document(melody, drums, parts_listed=listed("P1") + listed("P2", "Drums", 1))
    timewise = (
        f'<?xml version="1.0"?><score-timewise><part-list>{listed("P1")}</part-list><measure number="1">'
        f'<part id="P1">{attributes()}{note("C4", 2)}{note("D4", 2)}</part></measure></score-timewise>'
    ).encode()
    return two, document(melody), document(shaped), timewise, compressed(timewise), document(drums)


def mutate_musicxml(data: bytes, rng: random.Random) -> bytes:
    """A document with one mutation or more, of its elements or of its bytes."""
    worse = _mutate_elements(data, rng) if rng.random() < 0.7 else None
    return mutate(data, DOCUMENTS, rng) if worse is None else worse


def _mutate_elements(data: bytes, rng: random.Random) -> bytes | None:
    try:
        root = ElementTree.fromstring(data)
    except ElementTree.ParseError:
        return None
    for _ in range(1 + int(rng.expovariate(0.5))):
        inner = [(parent, child) for parent in root.iter() for child in parent]
        if not inner or len(inner) > 5_000:
            break
        rng.choice(CHANGES)(*rng.choice(inner), inner, rng)
    return ElementTree.tostring(root)


Pairs = list[tuple[ElementTree.Element, ElementTree.Element]]


def _remove(parent: ElementTree.Element, child: ElementTree.Element, _: Pairs, __: random.Random) -> None:
    parent.remove(child)


def _repeat(parent: ElementTree.Element, child: ElementTree.Element, _: Pairs, rng: random.Random) -> None:
    for _number in range(rng.randint(1, 3)):
        parent.append(copy.deepcopy(child))


def _move(parent: ElementTree.Element, child: ElementTree.Element, all_: Pairs, rng: random.Random) -> None:
    target = rng.choice(all_)[1]
    target.insert(rng.randint(0, len(target)), copy.deepcopy(child))


def _rename(parent: ElementTree.Element, child: ElementTree.Element, all_: Pairs, rng: random.Random) -> None:
    child.tag = rng.choice(all_)[1].tag


def _say(parent: ElementTree.Element, child: ElementTree.Element, all_: Pairs, rng: random.Random) -> None:
    child.text = rng.choice(ODD) if rng.random() < 0.5 else rng.choice(all_)[1].text


def _attribute(
    parent: ElementTree.Element, child: ElementTree.Element, all_: Pairs, rng: random.Random
) -> None:
    names = [name for _, one in all_ for name in one.attrib] or ["number"]
    child.set(rng.choice(names), rng.choice(ODD))


CHANGES: tuple[Callable[..., None], ...] = (_remove, _repeat, _move, _rename, _say, _say, _attribute)
