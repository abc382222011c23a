"""The JSON of Tone.js's converter: what is not needed may be strange."""

import json
import math
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any, cast

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reina.music import KeySignature, Score, ScoreError, read_score

CASES = Path(__file__).parents[2] / "cases"


def document() -> dict[str, Any]:
    """Two tracks that hold every field that is read, with times in seconds and in ticks."""
    kit = {"midi": 38, "name": "D2", "time": 0.5, "ticks": 480, "duration": 0.1, "durationTicks": 96}
    notes = [
        {
            "midi": 60 + n,
            "name": ["C4", "C#4", "D4", "D#4"][n],
            "time": n * 0.5,
            "ticks": n * 480,
            "duration": 0.5,
            "durationTicks": 480,
            "velocity": 0.5,
        }
        for n in range(4)
    ]
    return {
        "header": {
            "name": "Tune",
            "ppq": 480,
            "tempos": [{"bpm": 120, "ticks": 0, "time": 0}, {"bpm": 60, "ticks": 1920, "time": 2}],
            "timeSignatures": [{"ticks": 0, "timeSignature": [3, 4]}],
        },
        "tracks": [
            {
                "name": "Trumpet",
                "channel": 3,
                "instrument": {"number": 56, "name": "trumpet", "family": "brass", "percussion": False},
                "instrumentNumber": 56,
                "channelNumber": 3,
                "isPercussion": False,
                "controlChanges": {"7": [{"number": 7, "value": 0.5, "time": 0, "ticks": 0}]},
                "pitchBends": [{"value": 0.5, "time": 0, "ticks": 0}],
                "notes": notes,
            },
            {"name": "Kit", "channel": 9, "instrument": {"number": 0, "family": "drums"}, "notes": [kit]},
        ],
    }


def at(value: Any, path: str) -> Any:
    """What stands at a path."""
    for key in path.split("/") if path else ():
        value = value[int(key) if isinstance(value, list) else key]
    return value


def changed(path: str, value: object) -> dict[str, Any]:
    """The document with the value at a path replaced."""
    whole = document()
    way, _, last = path.rpartition("/")
    place = at(whole, way)
    place[int(last) if isinstance(place, list) else last] = value
    return whole


def read(whole: object) -> Score:
    return read_score(json.dumps(whole).encode())


def told(score: Score) -> list[tuple[str, str]]:
    return [(warning.kind, warning.place) for warning in score.warnings]


@pytest.mark.parametrize("case", ["json-cc", "json-null"])
def test_documents_that_were_refused(case: str):
    right = json.loads((CASES / f"{case}.json").read_text())
    score = read_score((CASES / f"{case}-score.json").read_bytes())
    assert len(score.notes) == right["right"]["notes"]
    assert score.warnings


def test_a_right_document_has_no_warnings():
    score = read(document())
    assert score.warnings == ()
    assert [(part.name, part.program, part.is_drums) for part in score.parts] == [
        ("Trumpet", 56, False),
        ("Kit", 0, True),
    ]
    assert len(score.controls) == 4


STRANGE: list[tuple[str, object]] = [
    ("header", None),
    ("header", []),
    ("header/name", 5),
    ("header/ppq", None),
    ("header/ppq", 0),
    ("header/ppq", "fast"),
    ("header/ppq", math.nan),
    ("header/tempos", None),
    ("header/tempos", {"bpm": 120}),
    ("header/tempos/0", None),
    *((f"header/tempos/{n}/bpm", bpm) for n in (0, 1) for bpm in (None, 0, -3, 1e300, 10**400, "x", True)),
    ("header/tempos/1/ticks", None),
    ("header/tempos/0/ticks", -1),
    ("header/tempos/0/time", [0]),
    ("header/timeSignatures", 4),
    ("header/timeSignatures/0", "3/4"),
    ("header/timeSignatures/0/ticks", "x"),
    *(
        ("header/timeSignatures/0/timeSignature", metre)
        for metre in (None, [], [0, 4], [3], [3, 4, 5], ["a", 4], [4.5, 4], [1e9, 4], "3/4", 10**400)
    ),
    ("tracks/0/name", None),
    ("tracks/0/name", 12),
    *(("tracks/0/channel", channel) for channel in (None, 99, -1, 1.5, True, "one")),
    ("tracks/0/channelNumber", 16),
    ("tracks/0/instrument", None),
    ("tracks/0/instrument", []),
    ("tracks/0/instrument", 56),
    *(("tracks/0/instrument/number", number) for number in (None, 200, -1, 56.5, "trumpet", 10**400)),
    ("tracks/0/instrument/name", {}),
    ("tracks/0/instrument/family", None),
    ("tracks/0/instrument/percussion", 1),
    ("tracks/0/instrumentNumber", 128),
    ("tracks/0/isPercussion", None),
    ("tracks/0/controlChanges", None),
    ("tracks/0/controlChanges", []),
    ("tracks/0/controlChanges/7", None),
    ("tracks/0/controlChanges/7/0", 64),
    ("tracks/0/controlChanges/7/0/value", 128),
    ("tracks/0/controlChanges/7/0/time", 1e5),
    ("tracks/0/controlChanges/7/0/ticks", -1),
    ("tracks/0/pitchBends", None),
    ("tracks/0/pitchBends/0", None),
    ("tracks/0/pitchBends/0/value", "up"),
    ("tracks/0/notes/1/name", "H9"),
    ("tracks/0/notes/1/midi", 300),
    ("tracks/0/notes/1/time", -1),
    ("tracks/0/notes/1/time", math.nan),
    ("tracks/0/notes/1/time", "now"),
    ("tracks/0/notes/1/ticks", None),
    ("tracks/0/notes/1/velocity", None),
    ("tracks/0/notes/1/velocity", 90),
    ("tracks/0/notes/1/velocity", -0.5),
    *(("tracks/0/notes/1/duration", value) for value in (None, -1, 1e5, 1e300, math.inf, "long")),
    ("tracks/0/notes/1/durationTicks", []),
]


@pytest.mark.parametrize(("path", "value"), STRANGE)
def test_what_is_not_needed_is_left_out_with_its_path(path: str, value: object):
    score = read(changed(path, value))
    assert len(score.notes) == 5
    assert told(score) == [("field_left_out", path)]


@pytest.mark.parametrize(
    ("path", "value", "kept"),
    [
        ("tracks/0/notes/1", None, 4),
        ("tracks/0/notes/1", [60, 0], 4),
        ("tracks/0/notes/1", {}, 4),
        ("tracks/0/notes/1", {"midi": 300, "time": 0}, 4),
        ("tracks/0/notes/1", {"midi": None, "time": 0}, 4),
        ("tracks/0/notes/1", {"midi": 60.5, "time": 0}, 4),
        ("tracks/0/notes/1", {"name": "C99", "time": 0}, 4),
        ("tracks/0/notes/1", {"midi": 60, "time": -1}, 4),
        ("tracks/0/notes/1", {"midi": 60, "time": None, "ticks": None}, 4),
        ("tracks/0/notes/1", {"midi": 60, "time": "0:1:2"}, 4),
        ("tracks/0/notes/1", {"midi": 60, "time": math.nan}, 4),
        ("tracks/0/notes/1", {"midi": 60, "time": 10**400}, 4),
        ("tracks/0/notes/1", {"midi": 60, "ticks": 10**12}, 4),
    ],
)
def test_a_note_without_pitch_or_time_is_left_out(path: str, value: object, kept: int):
    score = read(changed(path, value))
    assert len(score.notes) == kept
    assert told(score) == [("note_left_out", path)]


def test_a_track_that_is_none_or_has_no_list_of_notes_is_left_out():
    assert told(read(changed("tracks/0", None))) == [("field_left_out", "tracks/0")]
    assert told(read(changed("tracks/0/notes", {"midi": 60}))) == [
        ("field_left_out", "tracks/0/notes"),
        ("empty_part", "tracks/0"),
    ]


def test_when_no_note_is_left_all_reasons_are_told():
    with pytest.raises(ScoreError, match="and 1 more notes") as caught:
        read({"tracks": [{"notes": [{"midi": 300, "time": 0}, {"midi": 60, "time": None}]}]})
    assert caught.value.location == "tracks/0/notes/0"
    assert [place for place, _ in caught.value.problems] == ["tracks/0/notes/0", "tracks/0/notes/1"]
    assert "midi is 300" in caught.value.detail
    assert "time is null" in caught.value.problems[1][1]


def test_a_left_out_note_does_not_shift_the_places_of_the_others():
    whole = changed("tracks/0/notes/0", None)
    whole["tracks"][0]["notes"][2]["duration"] = 0
    assert told(read(whole)) == [
        ("note_left_out", "tracks/0/notes/0"),
        ("zero_length_note", "tracks/0/notes/2"),
    ]


def test_fields_that_are_unknown_are_told_once_a_list():
    whole = document()
    whole["mood"] = "gay"
    for note in whole["tracks"][0]["notes"]:
        note["finger"] = 2
    assert told(read(whole)) == [("unknown_field", "mood"), ("unknown_field", "tracks/0/notes/0/finger")]


def test_fields_that_are_known_and_not_read_may_hold_anything():
    whole = document()
    whole["header"].update(meta=5)
    whole["tracks"][0].update(endOfTrackTicks="x", id=[])
    whole["tracks"][0]["notes"][0].update(noteOffVelocity=-3, channel=99)
    assert read(whole).warnings == ()


def test_numbers_may_be_written_as_text():
    whole = changed("tracks/0/channel", "1")
    whole["tracks"][0]["instrument"]["number"] = "58"
    whole["tracks"][0]["notes"][1].update(time="0.5", midi="61")
    score = read(whole)
    assert (score.parts[0].channel, score.parts[0].program) == (1, 58)
    assert score.warnings == ()


def test_controllers_may_be_named():
    whole = changed("tracks/0/controlChanges", {"sustain": [{"value": 1, "time": 0}], "reverberation": []})
    score = read(whole)
    assert told(score) == [
        ("controller_name", "tracks/0/controlChanges/sustain"),
        ("field_left_out", "tracks/0/controlChanges/reverberation"),
    ]
    assert (64, 127) in [(control.number, control.value) for control in score.controls]


@pytest.mark.parametrize(
    "says",
    [
        {"channel": 9},
        {"isPercussion": True},
        {"instrument": {"percussion": True}},
        {"instrument": {"family": "drums"}},
        {"instrumentFamily": "drums"},
    ],
)
def test_what_says_that_a_track_is_drums(says: dict[str, Any]):
    score = read({"tracks": [{**says, "notes": [{"midi": 38, "time": 0}]}]})
    assert (score.parts[0].is_drums, score.parts[0].channel) == (True, 9)


def test_velocities_of_midi_are_told_by_most_of_them():
    whole = document()
    for velocity, note in zip((127, 1, 64, 0), whole["tracks"][0]["notes"], strict=True):
        note["velocity"] = velocity
    score = read(whole)
    assert told(score) == [("velocity_scale", "tracks")]
    assert score.notes.velocity[score.notes.part == 0] * 127 == pytest.approx([127, 1, 64, 0])


def test_a_note_without_duration_or_with_a_strange_one_is_a_tap():
    whole = document()
    for key in ("duration", "durationTicks"):
        del whole["tracks"][0]["notes"][1][key]
    score = read(whole)
    assert told(score) == [("zero_length_note", "tracks/0/notes/1")]
    assert sorted(score.notes.duration_s)[0] == pytest.approx(0.05)


def test_a_note_shorter_than_ticks_and_seconds_disagree_is_a_tap():
    whole = document()
    whole["tracks"][0]["notes"][1].update(time=0.4992, duration=0.0005)
    score = read(whole)
    assert np.all(score.notes.duration_beats > 0)
    assert told(score) == [("zero_length_note", "tracks/0/notes/1")]


def test_tempos_and_metres_that_make_too_many_beats_or_bars_are_left_out():
    fast = read(changed("header/tempos", [{"bpm": 1e8, "ticks": 0}]))
    assert told(fast) == [("field_left_out", "header/tempos")]
    assert fast.notes.onset_s.tolist() == [0, 0.5, 0.5, 1, 1.5]
    assert fast.notes.onset_beats.tolist() == [0, 1, 1, 2, 3]
    short = document()
    short["header"]["timeSignatures"][0]["timeSignature"] = [1, 1024]
    short["tracks"][0]["notes"][3].update(time=500, ticks=None)
    score = read(short)
    assert told(score)[-1] == ("field_left_out", "header/timeSignatures")
    assert len(score.metre_map.bar_lines(score.duration_beats)) < 1000


def paths(value: object, place: str = "") -> Iterator[str]:
    """Every place of a document, the document itself aside."""
    items: Iterable[tuple[object, object]] = ()
    if isinstance(value, dict):
        items = cast("dict[object, object]", value).items()
    elif isinstance(value, list):
        items = enumerate(cast("list[object]", value))
    for key, inner in items:
        path = f"{place}/{key}" if place else str(key)
        yield path
        yield from paths(inner, path)


FIELDS = [path for path in paths(document()) if not path.endswith("/number") or "instrument" in path]
"""All but the number of a controller, which its key says already."""

NOTES_LOST = {"tracks": 5, "tracks/0": 4, "tracks/1": 1, "tracks/0/notes": 4, "tracks/1/notes": 1}
"""How many notes go with what holds them."""

json_values = st.recursive(
    st.none()
    | st.booleans()
    | st.integers()
    | st.sampled_from([10**400, 1e300, -1e300, 127, 200, 1e12])
    | st.floats()
    | st.text(max_size=8),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=4), inner, max_size=3),
    max_leaves=6,
)


def is_strange(path: str, value: object) -> bool:
    """Whether a value is of another kind than what belongs at a path."""
    right = at(document(), path)
    if path.endswith("/instrument") and isinstance(value, str):
        return False
    return value is None or any(isinstance(value, kind) != isinstance(right, kind) for kind in (list, dict))


@settings(max_examples=400)
@given(st.sampled_from(FIELDS), json_values)
def test_any_field_replaced_costs_at_most_itself(path: str, value: object):
    try:
        score = read(changed(path, value))
    except ScoreError:
        assert path == "tracks"
        return
    holder, _, last = path.rpartition("/")
    is_note = holder.endswith("/notes") and last.isdigit()
    assert len(score.notes) >= 5 - (1 if is_note else NOTES_LOST.get(path, 0))
    if is_strange(path, value):
        # Of a metre the whole is left out.
        assert {path, path.partition("/timeSignature/")[0] + "/timeSignature"} & {p for _, p in told(score)}


def test_key_signatures_are_read_and_strange_ones_left_out():
    whole = document()
    whole["header"]["keySignatures"] = [
        {"key": "Bb", "scale": "major", "ticks": 0},
        {"key": "H", "scale": "major", "ticks": 480},
        {"key": 3, "ticks": 480},
        {"key": "C", "scale": "minor", "ticks": 960},
        {"key": "C"},
        {},
    ]
    score = read(whole)
    ppq = whole["header"]["ppq"]
    assert score.key_signatures == (KeySignature(0.0, -2), KeySignature(960 / ppq, 0, is_minor=True))
    assert [place for _, place in told(score)] == [
        "header/keySignatures/5",
        "header/keySignatures/1/key",
        "header/keySignatures/2/key",
        "header/keySignatures/4",
    ]
    assert read(changed("header/keySignatures", None)).key_signatures == ()
