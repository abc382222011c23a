"""MusicXML: in which order measures are played."""

from __future__ import annotations

import pytest
from tests.unit.music.musicxml.musicxml_text import (
    REPEAT_BEGINS,
    REPEAT_ENDS,
    attributes,
    barline,
    direction,
    document,
    ending,
    measure,
    measures,
    note,
    tempo,
    tied,
    words,
)

from reina.errors import InputError
from reina.music import Limits, read_score

NAMES = "CDEFGAB"
PITCHES = (60, 62, 64, 65, 67, 69, 71)


def bars(*marks: tuple[str, str], first: str = "") -> bytes:
    """A document of measures whose pitches tell them apart; each has what stands at its beginning and end."""
    return document(
        "".join(
            measure((attributes() + first if n == 0 else "") + begin + note(f"{NAMES[n]}4", 4) + end, n + 1)
            for n, (begin, end) in enumerate(marks)
        )
    )


def played(data: bytes) -> str:
    """The measures, counted from 1, in the order in which they are heard; each must follow the one before."""
    score = read_score(data)
    assert [round(one.onset_beats, 6) for one in score.notes] == [4.0 * n for n in range(len(score.notes))]
    return "".join(str(PITCHES.index(one.sounding_pitch) + 1) for one in score.notes)


def said(sound: str) -> str:
    return direction("<words>.</words>", f"<sound {sound}/>")


SEGNO, CODA = direction("<segno/>"), direction("<coda/>")


@pytest.mark.parametrize(
    ("marks", "order"),
    [
        ([("", ""), ("", REPEAT_ENDS), ("", "")], "12123"),
        ([("", ""), (REPEAT_BEGINS, ""), ("", REPEAT_ENDS), ("", "")], "123234"),
        ([("", barline('<repeat direction="backward" times="3"/>')), ("", "")], "1112"),
        ([(REPEAT_BEGINS, REPEAT_ENDS), (REPEAT_BEGINS, REPEAT_ENDS)], "1122"),
        (
            [
                (REPEAT_BEGINS, ""),
                (ending("1", "start"), ending("1", "stop", '<repeat direction="backward"/>')),
                (ending("2", "start"), ending("2", "discontinue")),
                ("", ""),
            ],
            "12134",
        ),
        (
            [
                ("", ""),
                (ending("1, 2", "start"), ending("1, 2", "stop", '<repeat direction="backward"/>')),
                (ending("3", "start"), ending("3", "stop")),
                ("", REPEAT_ENDS),
            ],
            "12121344",
        ),
        (
            [
                ("", ""),
                (ending("1", "start"), ending("1", "stop", '<repeat direction="backward"/>')),
                (ending("2", "start"), ending("2", "stop", '<repeat direction="backward"/>')),
                (ending("3", "start"), ending("3", "stop")),
            ],
            "121314",
        ),
        (
            [
                ("", ""),
                (ending("1", "start"), ending("1", "stop", '<repeat direction="backward"/>')),
                ("", ""),
            ],
            "1213",
        ),
        ([("", ""), ("", said('fine="yes"')), ("", said('dacapo="yes"'))], "12312"),
        ([("", ""), ("", words("Fine")), ("", words("D.C. al Fine"))], "12312"),
        ([("", ""), (SEGNO, ""), ("", words("Fine")), ("", words("D.S. al Fine"))], "123423"),
        (
            [("", ""), (SEGNO, ""), ("", words("To Coda")), ("", words("D.S. al Coda")), (CODA, "")],
            "1234235",
        ),
        (
            [
                ("", ""),
                (said('segno="s1"'), ""),
                ("", said('tocoda="c1"')),
                ("", said('dalsegno="s1"')),
                (said('coda="c1"'), ""),
            ],
            "1234235",
        ),
        ([("", ""), ("", CODA), ("", words("D.C. al Coda")), (CODA, "")], "123124"),
        ([("", ""), ("", REPEAT_ENDS), ("", words("Da Capo"))], "12123123"),
        (
            [
                ("", ""),
                (ending("1", "start"), ending("1", "stop", '<repeat direction="backward"/>')),
                (ending("2", "start"), ending("2", "stop")),
                ("", words("D.C. al Fine")),
            ],
            "12134134",
        ),
    ],
)
def test_order(marks: list[tuple[str, str]], order: str) -> None:
    assert played(bars(*marks)) == order


def test_a_jump_that_leads_nowhere_is_told_and_left_out() -> None:
    score = read_score(bars(("", ""), ("", words("D.S. al Fine"))))
    assert len(score.notes) == 2
    assert [(w.kind, w.place) for w in score.warnings] == [("jump_left_out", "measure 2")]


def test_ties_hold_into_each_ending() -> None:
    score = read_score(
        document(
            measures(
                attributes() + note("C4", 4, inner=tied("start")),
                ending("1", "start")
                + note("C4", 4, inner=tied("stop"))
                + ending("1", "stop", '<repeat direction="backward"/>'),
                ending("2", "start") + note("C4", 4, inner=tied("stop")) + ending("2", "stop"),
            )
        )
    )
    assert [(one.onset_beats, one.duration_beats) for one in score.notes] == [(0.0, 8.0), (8.0, 8.0)]


def test_a_repeat_is_as_fast_as_it_was_written() -> None:
    score = read_score(bars(("", ""), (tempo(60), REPEAT_ENDS), first=tempo(120)))
    assert [one.onset_s for one in score.notes] == [0.0, 2.0, 6.0, 8.0]


def test_notes_and_verses_of_one_playing_alone() -> None:
    def sung(verse: int, text: str) -> str:
        return f'<lyric number="{verse}"><syllabic>single</syllabic><text>{text}</text></lyric>'

    first = note("C4", 2, inner=sung(1, "one") + sung(2, "two"))
    second = note("D4", 2, attributes='time-only="2"')
    score = read_score(document(measures(attributes() + first + second + REPEAT_ENDS)))
    assert [one.sounding_pitch for one in score.notes] == [60, 60, 62]
    assert [(text.text, text.onset_beats) for text in score.texts] == [("one ", 0.0), ("two ", 4.0)]


def test_repeats_cannot_make_a_small_file_large() -> None:
    many = bars(*[(REPEAT_BEGINS, barline('<repeat direction="backward" times="100000"/>'))] * 7)
    assert len(read_score(many).notes) == 700
    with pytest.raises(InputError, match="at most 500 are read"):
        read_score(many, limits=Limits(notes=500))
    with pytest.raises(InputError, match="500 measures are played"):
        read_score(many, limits=Limits(bars=500))
