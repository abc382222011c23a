"""A page as a notation program writes it, and all that is played of it."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
from tests.unit.music.musicxml.musicxml_text import (
    B_FLAT,
    articulations,
    attributes,
    barline,
    direction,
    document,
    dynamic,
    ending,
    listed,
    lyric,
    measure,
    notations,
    note,
    slur,
    tempo,
    tied,
    wedge,
    words,
)

from reina.music import Score, read_score, score_document

GOLDEN = Path(__file__).with_name("march_as_played.txt")

CREDITS = (
    "<work><work-title>March of the Trombones</work-title></work>\n"
    '<identification><creator type="composer">Nobody</creator><encoding><software>MuseScore 4.4.1</software>'
    '<encoding-date>2026-11-30</encoding-date><supports element="accidental" type="yes"/></encoding>'
    "</identification>\n<defaults><scaling><millimeters>6.99911</millimeters><tenths>40</tenths></scaling>"
    "</defaults>\n"
)
LAYOUT = "<print><system-layout><top-system-distance>170</top-system-distance></system-layout></print>"
TRILL = '<notations><ornaments><trill-mark/><wavy-line type="start" number="1"/></ornaments></notations>'
TRILL_ENDS = '<notations><ornaments><wavy-line type="stop" number="1"/></ornaments></notations>'
RIT = (
    '<direction placement="above"><direction-type><words font-style="italic">rit.</words></direction-type>'
    '<direction-type><dashes type="start" number="1"/></direction-type></direction>'
)


def _trumpet() -> str:
    """A trumpet in B♭: pickup, repeat with two endings, D.S. al Coda."""
    grace = note("A5", 0.5, before='<grace slash="yes"/>', inner="<stem>up</stem>")
    return (
        measure(
            LAYOUT + attributes("4/4", 2, "<clef><sign>G</sign><line>2</line></clef>" + B_FLAT) + tempo(112)
            + dynamic("mf") + note("A4", 1, inner="<stem>up</stem>" + lyric("begin", "For")),
            0,
            'implicit="yes" width="180.5"',
        )
        + measure(
            direction("<segno/>", '<sound segno="segno"/>') + barline('<repeat direction="forward"/>', "left")
            + note("D5", 1.5, inner=articulations("accent") + lyric("end", "ward"))
            + note("E5", 0.5, inner=articulations("staccato"))
            + note("F#5", 1, inner=slur("start")) + note("E5", 1, inner=slur("stop")),
            1,
        )
        + measure(
            wedge("crescendo") + note("D5", 2, inner=tied("start")) + note("D5", 1, inner=tied("stop"))
            + grace + note("G5", 1, inner=articulations("tenuto")) + wedge("stop"),
            2,
        )
        + measure(
            ending("1", "start") + dynamic("f") + note("F#5", 3, inner=articulations("strong-accent"))
            + note("A4", 1) + ending("1", "stop", '<repeat direction="backward"/>'),
            3,
        )
        + measure(
            ending("2", "start") + note("F#5", 2, inner=TRILL) + note("F#5", 2, inner=TRILL_ENDS)
            + ending("2", "discontinue") + words("To Coda", '<sound tocoda="codab"/>'),
            4,
        )
        + measure(
            "<attributes><key><fifths>1</fifths></key></attributes>" + direction("<rehearsal>B</rehearsal>")
            + note("B4", 1, inner="<notations><ornaments><inverted-mordent/></ornaments></notations>")
            + note("C5", 1) + RIT + note("B4", 1)
            + note("A4", 1, inner=notations('<fermata type="upright"/>'))
            + direction('<dashes type="stop" number="1"/>')
            + words("D.S. al Coda", '<sound dalsegno="segno"/>'),
            5,
        )
        + measure(
            direction("<coda/>", '<sound coda="codab"/>') + words("a tempo")
            + note("D5", 4, inner=notations("<fermata/>")) + barline("<bar-style>light-heavy</bar-style>"),
            6,
        )
    )  # fmt: skip


def _trombone() -> str:
    """Without a transposition; the signs that hold for all stand above the first part alone."""
    clef = "<clef><sign>F</sign><line>4</line></clef>"
    return (
        measure(attributes("4/4", 0, clef) + note("r", 1), 0, 'implicit="yes"')
        + measure(dynamic("p") + note("C3", 1) * 4, 1)
        + measure(note("G2", 2) * 2, 2)
        + measure(note("C3", 4), 3)
        + measure(note("C3", 4), 4)
        + measure("<attributes><key><fifths>-1</fifths></key></attributes>" + note("F3", 2) * 2, 5)
        + measure(note("C3", 4), 6)
    )


def march() -> bytes:
    parts = listed("P1", "Trumpet in B♭", 57) + listed("P2", "Trombone", 58)
    return document(_trumpet(), _trombone(), parts_listed=parts, head=CREDITS)


def as_text(score: Score) -> str:
    """Everything that is played, a line each."""
    lines = [f"title {score.title}"]
    lines += [f"part {p.index} {p.name}, program {p.program}, channel {p.channel}" for p in score.parts]
    lines += [f"key {k.onset_beats:g} {k.fifths}" for k in score.key_signatures]
    lines += [f"metre {s.onset_beats:g} {s.numerator}/{s.denominator}" for s in score.metre_map.signatures]
    lines += [f"tempo {t.onset_beats:g} {t.beats_per_minute:.2f}" for t in score.tempo_map.tempos]
    lines += [f"{t.kind} {t.onset_beats:g} {t.text!r}" for t in score.texts]
    columns = zip(score.notes, score.notes.tongued.tolist(), strict=True)
    lines += [
        f"note {n.part} at {n.onset_beats:.4f} for {n.duration_beats:.4f}, {n.onset_s:.3f} s, "
        f"pitch {n.sounding_pitch}, velocity {round(n.velocity * 127)}{', tongued' * tongued}"
        for n, tongued in columns
    ]
    lines += [f"warning {w.kind} {w.place}: {w.message}" for w in score.warnings]
    return "\n".join(lines) + "\n"


def test_a_march_is_played_as_it_was() -> None:
    """What is written down beside was looked through by hand; write it anew with ``as_text``."""
    assert as_text(read_score(march(), filename="March.musicxml")) == GOLDEN.read_text(encoding="utf-8")


def test_the_march_is_the_same_as_a_document_of_our_own() -> None:
    score = read_score(march())
    again = read_score(json.dumps(score_document(score)).encode())
    for name in ("part", "onset_s", "duration_s", "onset_beats", "sounding_pitch", "velocity", "tongued"):
        assert np.allclose(getattr(again.notes, name), getattr(score.notes, name), atol=1e-9), name
    texts = [sorted((text.onset_beats, text.kind, text.text) for text in one.texts) for one in (score, again)]
    assert texts[0] == texts[1]
