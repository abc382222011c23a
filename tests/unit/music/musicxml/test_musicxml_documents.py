"""MusicXML: what a document may be like, whole or damaged, packed or bare."""

from __future__ import annotations

import io
import zipfile

import pytest
from tests.unit.music.musicxml.musicxml_text import (
    articulations,
    attributes,
    compressed,
    document,
    listed,
    measure,
    measures,
    note,
    tempo,
    words,
)

from reina.errors import InputError
from reina.music import Limits, Score, read_score

PLAIN = document(measures(attributes() + tempo(60) + note("C4", 2) + note("D4", 2), note("E4", 4)))
ONE_PART = measures(attributes() + note("C4", 4))


def heard(score: Score) -> list[tuple[int, int, float]]:
    return [(one.part, one.sounding_pitch, one.onset_s) for one in score.notes]


def test_partwise_and_timewise_are_one() -> None:
    first = [attributes() + tempo(60) + note("C5", 4), note("D5", 4)]
    second = [attributes() + note("C4", 4), note("D4", 4)]
    partwise = document(measures(*first), measures(*second))
    body = "".join(
        f'<measure number="{n}"><part id="P1">{one}</part><part id="P2">{two}</part></measure>'
        for n, (one, two) in enumerate(zip(first, second, strict=True), 1)
    )
    timewise = (
        f'<?xml version="1.0"?><score-timewise><part-list>{listed("P1")}{listed("P2")}</part-list>'
        f"{body}</score-timewise>"
    )
    expected = [(0, 72, 0.0), (1, 60, 0.0), (0, 74, 4.0), (1, 62, 4.0)]
    assert heard(read_score(partwise)) == heard(read_score(timewise.encode())) == expected


@pytest.mark.parametrize(
    ("head", "title"),
    [
        ("", "Spring"),
        ("<work><work-title>A Work</work-title></work>", "A Work"),
        ("<movement-title>A Movement</movement-title>", "A Movement"),
        ("<work><work-title>W</work-title></work><movement-title>M</movement-title>", "W: M"),
        (
            "<credit><credit-type>title</credit-type><credit-words>On Paper</credit-words></credit>",
            "On Paper",
        ),
    ],
)
def test_titles(head: str, title: str) -> None:
    assert read_score(document(ONE_PART, head=head), filename="Spring.musicxml").title == title


@pytest.mark.parametrize("codec", ["utf-8-sig", "utf-16", "iso-8859-1"])
def test_character_sets(codec: str) -> None:
    declared = {"utf-8-sig": "UTF-8", "utf-16": "UTF-16", "iso-8859-1": "ISO-8859-1"}[codec]
    text = document(ONE_PART, parts_listed=listed(name="Flügelhorn")).decode()
    data = text.replace('encoding="UTF-8"', f'encoding="{declared}"').encode(codec)
    score = read_score(data)
    assert score.parts[0].name == "Flügelhorn"
    assert score.warnings == ()


def test_what_says_utf_8_and_is_not_is_read_as_windows_1252() -> None:
    score = read_score(document(ONE_PART, parts_listed=listed(name="Flügelhorn")).decode().encode("cp1252"))
    assert score.parts[0].name == "Flügelhorn"
    assert [(w.kind, w.place) for w in score.warnings] == [("bad_text", "line 4")]


def test_compressed_documents_open_without_a_word() -> None:
    score = read_score(compressed(PLAIN, "Inner name.xml"), filename="Outer.mxl")
    assert heard(score) == heard(read_score(PLAIN))
    assert (score.title, score.warnings) == ("Outer", ())


def test_a_container_that_names_nothing_leaves_the_only_document() -> None:
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w") as archive:
        archive.writestr("META-INF/container.xml", "<container>")
        archive.writestr("some.xml", PLAIN)
    assert heard(read_score(stream.getvalue())) == heard(read_score(PLAIN))


def test_entity_bombs_are_refused() -> None:
    bomb = (
        b'<?xml version="1.0"?><!DOCTYPE score-partwise [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;&a;">]>'
        b"<score-partwise><part-list>&b;</part-list></score-partwise>"
    )
    with pytest.raises(InputError, match="line 1: the document declares entities of its own"):
        read_score(bomb)


def test_files_beside_it_are_not_fetched() -> None:
    outside = (
        b'<?xml version="1.0"?><!DOCTYPE score-partwise [<!ENTITY a SYSTEM "file:///etc/passwd">]>'
        b"<score-partwise><part-list>&a;</part-list></score-partwise>"
    )
    with pytest.raises(InputError, match="declares entities of its own"):
        read_score(outside)


def test_archive_bombs_are_refused() -> None:
    blank = compressed(PLAIN + b" " * 3_000_000)
    assert len(blank) < 20_000
    with pytest.raises(InputError, match="unpacks to more than 1,000,000 bytes"):
        read_score(blank, limits=Limits(size_bytes=1_000_000))


def test_a_document_that_breaks_off_is_read_as_far_as_it_goes() -> None:
    score = read_score(PLAIN[: PLAIN.index(b"<step>E")])
    assert [pitch for _, pitch, _ in heard(score)] == [60, 62]
    assert [(w.kind, w.place, w.message) for w in score.warnings] == [
        ("broken_document", "line 14", "it breaks off; what stands before it was kept")
    ]


def test_what_is_wrong_inside_is_told_with_its_line() -> None:
    score = read_score(PLAIN.replace(b"<step>E", b"<step>E</note>"))
    assert [(w.kind, w.place) for w in score.warnings] == [("broken_document", "line 14")]


@pytest.mark.parametrize(
    ("data", "told"),
    [
        (b"<score-partwise>", "line 1: this is no MusicXML that can be read: it breaks off"),
        (b"<score-partwise><part-list></score-partwise>", "mismatched tag"),
        (document(""), "the document is MusicXML and holds no note"),
        (
            document(measures(attributes() + note("r", 4))),
            "1 measures: the document is MusicXML and holds no",
        ),
        (document(measures(note("C4", attributes='time-only="2"'))), "no note of the document is played"),
        (b"<opus><!-- <score-partwise --></opus>", "the document is <opus>"),
        (b"<score-partwise>" + b"<a>" * 200, "within one another"),
    ],
)
def test_refusals(data: bytes, told: str) -> None:
    with pytest.raises(InputError) as refused:
        read_score(data)
    assert told in str(refused.value)


def test_limits_are_those_of_other_scores() -> None:
    long = document(measures(attributes() + note("C4", 4), *[note("C4", 1) * 4] * 30))
    for limits, told in (
        (Limits(notes=100), "number of notes"),
        (Limits(bars=20), "number of measures"),
        (Limits(elements=300), "more than 300 elements"),
        (Limits(duration_s=20), "length in seconds"),
        (Limits(beats=50), "length in beats"),
    ):
        with pytest.raises(InputError, match=told):
            read_score(long, limits=limits)
    with pytest.raises(InputError, match="number of parts"):
        read_score(document(ONE_PART, ONE_PART), limits=Limits(tracks=1))


def test_a_sequence_is_asked_for_in_vain() -> None:
    with pytest.raises(InputError, match="a MusicXML document holds one sequence, 0; there is no sequence 1"):
        read_score(PLAIN, sequence=1)


def test_repairs_say_part_measure_and_line() -> None:
    odd = (
        attributes()
        + "<attributes><divisions>0</divisions><key><fifths>x</fifths></key>"
        + "<time><beats>0</beats><beat-type>4</beat-type></time></attributes>\n"
        + note("C4").replace("<duration>12</duration>", "")
        + note("D4").replace("<step>D</step>", "<step>H</step>")
        + '<sound tempo="-3"/>'
        + note("E4", 2)
    )
    score = read_score(document(measures(odd)))
    assert [(w.kind, w.place) for w in score.warnings] == [
        ("bad_divisions", "part P1, measure 1, line 9"),
        ("bad_key", "part P1, measure 1, line 9"),
        ("bad_metre", "part P1, measure 1, line 9"),
        ("bad_duration", "part P1, measure 1, line 10"),
        ("bad_pitch", "part P1, measure 1, line 11"),
        ("bad_tempo", "part P1, measure 1, line 12"),
    ]
    assert [(pitch, onset) for _, pitch, onset in heard(score)] == [(60, 0.0), (64, 1.0)]


def test_marks_and_words_are_kept_with_their_times() -> None:
    mark = "<direction><direction-type><rehearsal>A</rehearsal></direction-type></direction>"
    score = read_score(
        document(measures(attributes() + words("Allegro") + note("C4", 4), mark + note("C4", 4)))
    )
    assert [(t.kind, t.text, t.onset_s) for t in score.texts] == [
        ("text", "Allegro", 0.0),
        ("marker", "A", 2.0),
    ]


def test_syllables_of_a_word_are_joined_by_their_text() -> None:
    def sung(kind: str, text: str, more: str = "") -> str:
        return f'<lyric number="1"><syllabic>{kind}</syllabic><text>{text}</text>{more}</lyric>'

    inner = (
        note("C4", inner=sung("begin", "Hal"))
        + note("C4", inner=sung("end", "lo,"))
        + note("C4", 2, inner=sung("single", "you", "<end-line/>"))
    )
    score = read_score(document(measures(attributes() + inner)))
    assert "".join(text.text for text in score.texts) == "Hallo, you \n"


def test_drums_and_tones_of_one_part_are_two() -> None:
    hit = '<note><unpitched/><duration>24</duration><instrument id="P1-I1"/></note>'
    score = read_score(document(measures(attributes() + note("C4", 2) + hit)))
    assert [(part.name, part.is_drums) for part in score.parts] == [
        ("Trumpet", False),
        ("Trumpet (drums)", True),
    ]


def test_short_notes_without_length_are_taps() -> None:
    score = read_score(document(measures(attributes() + note("C4", 0) + note("D4", 4))))
    assert [w.kind for w in score.warnings] == ["zero_length_note"]


def test_articulated_notes_keep_their_onsets() -> None:
    short = note("C4", inner=articulations("staccatissimo"))
    score = read_score(document(measure(attributes() + short * 4)))
    assert [onset for _, _, onset in heard(score)] == [0.0, 0.5, 1.0, 1.5]
