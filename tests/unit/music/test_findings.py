"""What a musician is told of warnings: each kind once, counted, in words of its own."""

import re
from pathlib import Path

import pytest
from tests.unit.music.midi_bytes import midi, off, on

from reina.music import ScoreWarning, WarningLog, findings_of, read_score
from reina.music.findings import finding_words

SOURCES = Path(__file__).parents[3] / "server" / "reina"
TOLD = re.compile(
    r'(?:log\.add|tell|drop|ScoreWarning|told_finding|_tell)\(\s*(?:log,\s*tracks,\s*on,\s*)?"([\w-]+)"'
)


def test_every_kind_that_is_told_anywhere_has_words_of_its_own():
    source = "".join(
        path.read_text(encoding="utf-8")
        for layer in ("music", "instruments", "sound", "sessions")
        for path in (SOURCES / layer).rglob("*.py")
    )
    kinds = set(TOLD.findall(source))
    assert len(kinds) > 50
    worded = {kind.split("/")[0] for kind in finding_words()}
    assert kinds - worded == set()


def test_the_words_hold_nothing_that_is_not_given():
    given = {"count", "instrument", "part", "parts", "notes", "out", "left"}
    for words in finding_words().values():
        for text in (words.one, words.many):
            assert set(re.findall(r"{(\w+)}", text)) <= given
            assert text[-1] not in ".!"


def test_warnings_of_a_kind_are_counted_and_what_is_missing_comes_first():
    log = WarningLog()
    for note in range(30):
        log.add("zero_length_note", f"note {note}", "has no length")
    log.add("truncated_track", "byte 80", "ends inside an event")
    cut, short = findings_of(log.warnings())
    assert (cut.text, cut.weight) == ("The file is cut short: it plays as far as it goes", "cut")
    assert (short.count, short.text) == (30, "30 notes have no length; they sound for a moment")
    assert len(short.details) == 21, "twenty, and how many more"
    assert short.details[0].place == "note 0"


def test_warnings_that_differ_in_their_values_are_told_apart():
    log = WarningLog(most_of_a_kind=2)
    for side in ("below", "below", "below", "above"):
        log.add("not_playable", "note", "out of range", values={"side": side})
    below, above = findings_of(log.warnings(), player=1, instrument="cornet")
    assert below.text == "Leaves out 3 notes below the cornet's range"
    assert above.text == "Leaves out one note above the cornet's range"
    assert (below.player, below.values) == (1, {"side": "below", "instrument": "cornet"})


def test_a_kind_without_words_is_told_in_its_own():
    strange = [ScoreWarning("strings_crossed", "note 3", "two strings are bowed at once")] * 2
    (finding,) = findings_of(strange)
    assert finding.text == "Two strings are bowed at once (2 times)"


@pytest.mark.parametrize(("cut", "kinds"), [(0, set[str]()), (6, {"truncated_track"})])
def test_a_cut_file_is_said_and_a_whole_one_is_not(cut: int, kinds: set[str]):
    data = midi((on(0, 60), off(480, 60), on(0, 62), off(480, 62)))
    score = read_score(data[: len(data) - cut])
    assert {one.kind for one in findings_of(score.warnings) if one.weight == "cut"} == kinds
