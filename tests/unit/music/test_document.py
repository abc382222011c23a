"""Scores as JSON: both forms, and what is said of those that are wrong."""

import json
from pathlib import Path
from typing import Any

import pytest

import reina.music
from reina.music import (
    KeySignature,
    Score,
    ScoreError,
    ScoreLimitError,
    read_score,
    score_document,
    score_schema,
)
from reina.music.document.schema import schema_text


def own(**changed: Any) -> dict[str, Any]:
    return {
        "format": "reina-score",
        "title": "Tune",
        "tempos": [{"beat": 0, "bpm": 60}, {"beat": 2, "bpm": 120}],
        "time_signatures": [{"beat": 0, "numerator": 3, "denominator": 4}],
        "parts": [
            {
                "name": "Trumpet in B♭",
                "program": 56,
                "transposition": -2,
                "notes": [
                    {"beat": 0, "duration": 1, "pitch": "C4", "velocity": 0.5},
                    {"beat": 2, "duration": 2, "pitch": 64},
                ],
                "controllers": [{"beat": 2, "number": 11, "value": 90}],
            },
            {"name": "Kit", "drums": True, "notes": [{"beat": 1, "duration": 1, "pitch": 38}]},
        ],
        **changed,
    }


def tone(**changed: Any) -> dict[str, Any]:
    return {
        "header": {
            "name": "Tone tune",
            "ppq": 480,
            "tempos": [{"bpm": 60, "ticks": 0}, {"bpm": 120, "ticks": 960, "time": 2}],
            "timeSignatures": [{"ticks": 0, "timeSignature": [6, 8], "measures": 0}],
            "keySignatures": [],
            "meta": [],
        },
        "tracks": [
            {
                "channel": 3,
                "name": "Trumpet",
                "instrument": {"number": 56, "name": "trumpet", "family": "brass"},
                "controlChanges": {"7": [{"number": 7, "ticks": 480, "time": 1, "value": 0.5}]},
                "pitchBends": [{"ticks": 480, "time": 1, "value": -1}],
                "notes": [
                    {
                        "midi": 60,
                        "ticks": 0,
                        "time": 0,
                        "duration": 1,
                        "durationTicks": 480,
                        "velocity": 0.25,
                        "name": "C4",
                    },
                    {
                        "midi": 64,
                        "ticks": 960,
                        "time": 2,
                        "duration": 0.5,
                        "durationTicks": 480,
                        "velocity": 1,
                    },
                ],
                "endOfTrackTicks": 1440,
            }
        ],
        **changed,
    }


def read(document: object, **options: Any) -> Score:
    return read_score(json.dumps(document).encode(), **options)


def test_reinas_own_form():
    score = read(own())
    assert score.title == "Tune"
    assert [(part.name, part.program, part.is_drums, part.channel) for part in score.parts] == [
        ("Trumpet in B♭", 56, False, 0),
        ("Kit", None, True, 9),
    ]
    assert score.notes.sounding_pitch.tolist() == [58, 38, 62]
    assert score.notes.onset_s.tolist() == [0, 1, 2]
    assert score.notes.duration_s.tolist() == [1, 1, 1]
    assert score.notes.velocity.tolist() == [0.5, 0.7, 0.7]
    assert score.metre_map.bar_lines(5).tolist() == [0, 3]
    assert [tuple(control) for control in score.controls] == [
        ("program", 0, 0, 0, 0, 56),
        ("controller", 2, 2, 0, 11, 90),
    ]
    assert score.warnings == ()
    assert score.duration_s == 3


def test_tone_js_form():
    score = read(tone())
    assert score.title == "Tone tune"
    assert [(part.name, part.program, part.channel) for part in score.parts] == [("Trumpet", 56, 3)]
    assert score.notes.onset_s.tolist() == [0, 2]
    assert score.notes.duration_s.tolist() == [1, 0.5]
    assert score.notes.onset_beats.tolist() == [0, 2]
    assert score.notes.duration_beats.tolist() == [1, 1]
    assert score.metre_map.signatures[0].bar_beats == 3
    assert [tuple(control) for control in score.controls] == [
        ("program", 0, 0, 3, 0, 56),
        ("controller", 1, 1, 3, 7, 64),
        ("pitch_bend", 1, 1, 3, 0, -8192),
    ]


def test_the_older_form_of_tone_js():
    document = {
        "header": {"PPQ": 192, "bpm": 60, "timeSignature": [3, 4], "name": "Old"},
        "tracks": [
            {
                "id": 0,
                "instrument": "trumpet",
                "instrumentNumber": 56,
                "channelNumber": 0,
                "notes": [{"name": "A#4", "midi": 70, "time": 1, "velocity": 0.8, "duration": 2}],
            },
            {"id": 1, "isPercussion": True, "notes": [{"name": "C2", "time": 0, "duration": 1}]},
        ],
    }  # fmt: skip
    score = read(document)
    assert score.notes.sounding_pitch.tolist() == [36, 70]
    assert score.notes.onset_beats.tolist() == [0, 1]
    assert [(part.name, part.program, part.is_drums) for part in score.parts] == [
        ("trumpet", 56, False),
        ("Drums", None, True),
    ]
    assert score.metre_map.bar_lines(4).tolist() == [0, 3]


def test_seconds_go_before_ticks_and_either_is_enough():
    edited = tone()
    edited["tracks"][0]["notes"] = [
        {"midi": 60, "ticks": 0, "time": 3.0, "duration": 1.0, "durationTicks": 480},
        {"midi": 62, "ticks": 960, "durationTicks": 480},
        {"midi": 64, "time": 1.0, "duration": 1.0},
    ]
    score = read(edited)
    assert score.notes.sounding_pitch.tolist() == [64, 62, 60]
    assert score.notes.onset_s.tolist() == [1, 2, 3]
    assert score.notes.onset_beats.tolist() == [1, 2, 4]
    assert score.notes.duration_s.tolist() == [1, 0.5, 1]


def test_a_note_without_duration_is_a_tap():
    document = tone()
    document["tracks"][0]["notes"] = [{"midi": 60, "time": 1.0, "duration": 0}]
    score = read(document)
    assert score.notes.duration_s.tolist() == [pytest.approx(0.05)]
    assert [(warning.kind, warning.place) for warning in score.warnings] == [
        ("zero_length_note", "tracks/0/notes/0")
    ]


@pytest.mark.parametrize(
    "encoding", ["utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-16-be", "utf-32", "utf-32-be"]
)
def test_other_encodings(encoding: str):
    data = json.dumps(own(), ensure_ascii=False).encode(encoding)
    assert read_score(data).parts[0].name == "Trumpet in B♭"


def test_space_before_the_document():
    assert read_score(b" \r\n\t" + json.dumps(own()).encode()).title == "Tune"


def test_parts_without_notes_are_left_out():
    document = own()
    document["parts"].insert(0, {"name": "Tacet"})
    score = read(document)
    assert [part.index for part in score.parts] == [0, 1]
    assert [(warning.kind, warning.place) for warning in score.warnings] == [("empty_part", "parts/0")]


def test_a_title_comes_from_the_file_name_if_need_be():
    assert read(own(title=""), filename="My March.json").title == "My March"


def test_the_pickup():
    score = read(own(pickup_beats=1))
    assert score.metre_map.bar_lines(5).tolist() == [0, 1, 4]


def part(**changed: Any) -> dict[str, Any]:
    return own(parts=[{"notes": [{"beat": 0, "duration": 1, "pitch": 60, **changed}]}])


def slurred(*slurs: Any, **changed: Any) -> dict[str, Any]:
    """Four quarter notes under slurs; `changed` are fields of the third."""
    notes: list[dict[str, Any]] = [{"beat": beat, "duration": 1, "pitch": 60 + beat} for beat in range(4)]
    notes[2] |= changed
    return own(parts=[{"notes": notes, "slurs": list(slurs)}])


def test_slurs_lead_the_tongue_and_a_note_may_say_otherwise():
    slur = {"beat": 0, "end_beat": 2}
    assert read(slurred(slur)).notes.tongued.tolist() == [1, 0, 0, 1]
    assert read(slurred(slur, tongued=True)).notes.tongued.tolist() == [1, 0, 1, 1]
    assert read(slurred()).notes.tongued.tolist() == [1, 1, 1, 1]
    unsaid = slurred(tongued=False)
    del unsaid["parts"][0]["slurs"]
    assert read(unsaid).notes.tongued.tolist() == [-1, -1, 0, -1]


def test_lyrics_markers_and_words_have_their_times():
    document = own(
        lyrics=[{"beat": 0, "text": "Glo"}, {"beat": 2, "text": "ria "}],
        markers=[{"beat": 2, "text": "B"}],
        words=[{"beat": 1, "text": "dolce"}],
    )
    assert [(text.kind, text.onset_s, text.onset_beats, text.text) for text in read(document).texts] == [
        ("lyric", 0.0, 0.0, "Glo"),
        ("text", 1.0, 1.0, "dolce"),
        ("lyric", 2.0, 2.0, "ria "),
        ("marker", 2.0, 2.0, "B"),
    ]


def test_a_score_that_is_written_is_read_again_as_it_was():
    document = own(
        pickup_beats=1,
        key_signatures=[{"beat": 0, "fifths": -2}, {"beat": 4, "fifths": 0, "mode": "minor"}],
        lyrics=[{"beat": 0, "text": "Glo"}, {"beat": 2, "text": "ria\n"}],
        markers=[{"beat": 2, "text": "B"}],
        words=[{"beat": 1, "text": "dolce"}],
    )
    document["parts"][0] |= {"slurs": [{"beat": 0, "end_beat": 2}]}
    score = read(document)
    again = read(score_document(score))
    assert {name: column.tolist() for name, column in vars(again.notes).items()} == {
        name: column.tolist() for name, column in vars(score.notes).items()
    }
    assert again.texts == score.texts
    assert again.parts == score.parts
    assert again.key_signatures == score.key_signatures
    assert again.tempo_map.tempos == score.tempo_map.tempos
    assert again.metre_map.bar_lines(9).tolist() == score.metre_map.bar_lines(9).tolist()
    assert again.controls == score.controls
    assert score_document(again) == score_document(score)


@pytest.mark.parametrize(
    ("document", "where", "what"),
    [
        ([], "/", "an object, not a list"),
        ("text", "/", None),
        ({}, "/", "no members"),
        ({"songs": []}, "/", "songs"),
        (own(parts=[]), "parts", "at least 1 item"),
        (own(parts=[{"notes": []}]), "/", "no note"),
        ({"parts": []}, "format", "required"),
        (own(version=2), "version", "should be 1"),
        (own(surprise=1), "surprise", "not permitted"),
        (own(tempos=[{"beat": 0, "bpm": 0}]), "tempos/0/bpm", "greater than or equal to 1, not 0"),
        (own(tempos=[{"beat": -1, "bpm": 60}]), "tempos/0/beat", "greater than or equal to 0"),
        (
            own(time_signatures=[{"beat": 0, "numerator": 4, "denominator": 5}]),
            "time_signatures/0/denominator",
            "1, 2, 4",
        ),
        (part(pitch=128), "parts/0/notes/0/pitch", "less than or equal to 127, not 128"),
        (part(pitch="H4"), "parts/0/notes/0/pitch", "'H4' is no pitch"),
        (part(pitch=None), "parts/0/notes/0/pitch", "valid integer"),
        (part(duration=0), "parts/0/notes/0/duration", "greater than 0"),
        (part(beat="x"), "parts/0/notes/0/beat", "valid number"),
        (part(velocity=1.5), "parts/0/notes/0/velocity", "less than or equal to 1"),
        (part(beat=1e300), "parts/0/notes/0/beat", "less than or equal to"),
        (part(tongued="perhaps"), "parts/0/notes/0/tongued", "valid boolean, unable to interpret"),
        (slurred({"beat": 2, "end_beat": 2}), "parts/0/slurs/0/end_beat", "ends after it begins"),
        (slurred({"beat": 2}), "parts/0/slurs/0/end_beat", "required"),
        (slurred({"beat": 0, "end_beat": 0.5}), "parts/0/slurs/0", "no note begins after beat 0"),
        (own(lyrics=[{"beat": 0, "text": ""}]), "lyrics/0/text", "at least 1 character"),
        (own(words=[{"beat": -1, "text": "dolce"}]), "words/0/beat", "greater than or equal to 0"),
        (own(markers=[{"beat": 0}]), "markers/0/text", "required"),
        (own(markers="A"), "markers", "valid list"),
        (tone(tracks=[]), "/", "no note"),
        (tone(tracks=None), "tracks", "is null; a list of tracks is needed"),
        (tone(tracks={"notes": []}), "tracks", "is an object; a list of tracks is needed"),
        (tone(tracks=[{"notes": [{"midi": 60}]}]), "tracks/0/notes/0", "neither time nor ticks"),
        (tone(tracks=[{"notes": [{"time": 0}]}]), "tracks/0/notes/0", "has no pitch"),
        (tone(tracks=[{"notes": {"midi": 60, "time": 0}}]), "tracks/0/notes", "is an object; a list"),
        (tone(tracks=[None]), "tracks/0", "is null; an object"),
    ],
)
def test_what_is_wrong_is_named_with_its_path(document: object, where: str, what: str | None):
    with pytest.raises(ScoreError) as caught:
        read(document)
    if what is not None:
        assert caught.value.location == where
        assert what in caught.value.detail


def test_a_transposed_pitch_has_to_be_one():
    document = own(parts=[{"transposition": 24, "notes": [{"beat": 0, "duration": 1, "pitch": 120}]}])
    with pytest.raises(ScoreError, match="the pitch is 144") as caught:
        read(document)
    assert caught.value.location == "parts/0/notes/0/pitch"


def test_several_faults_are_all_told():
    document = own(
        parts=[
            {"notes": [{"beat": -1, "duration": 0, "pitch": 60}, {}]},
            {"notes": [{"beat": 0, "duration": 1}]},
        ]
    )
    with pytest.raises(ScoreError) as caught:
        read(document)
    assert [where for where, _ in caught.value.problems] == [
        "parts/0/notes/0/beat",
        "parts/0/notes/0/duration",
        "parts/1/notes/0/pitch",
    ]
    assert "and 2 more faults" in caught.value.detail


@pytest.mark.parametrize(
    "text",
    [
        "{",
        '{"format": }',
        "{]",
        "[" * 100_000,
        '{"a":' * 100_000,
        "{\x00}",
        '{"a": 1} x',
    ],
)
def test_what_is_no_json_is_refused(text: str):
    with pytest.raises(ScoreError, match="no JSON"):
        read_score(text.encode())


def test_null_is_the_same_as_missing_where_a_field_is_not_needed():
    document = own(
        version=None,
        title=None,
        tempos=None,
        time_signatures=None,
        pickup_beats=None,
        parts=[
            {
                **dict.fromkeys(["name", "program", "drums", "transposition", "controllers"]),
                "notes": [{"beat": 0, "duration": 1, "pitch": 60, "velocity": None}],
            },
            {"notes": None},
        ],
    )
    score = read(document, filename="Tune.json")
    assert score.title == "Tune"
    assert [tuple(vars(part).values()) for part in score.parts] == [(0, "Part 1", None, False, 0, False)]
    assert score.notes.velocity.tolist() == [0.7]
    assert [warning.kind for warning in score.warnings] == ["empty_part"]


@pytest.mark.parametrize("value", ["NaN", "Infinity", "-Infinity", "1e999", "1" + "0" * 400, '"\\ud800"'])
@pytest.mark.parametrize("field", ["beat", "duration", "pitch", "velocity"])
def test_numbers_beyond_all_numbers_are_named_with_their_path(value: str, field: str):
    with pytest.raises(ScoreError) as caught:
        read_score(json.dumps(part(**{field: "HERE"})).replace('"HERE"', value).encode())
    assert caught.value.location == f"parts/0/notes/0/{field}"
    assert len(caught.value.detail) < 200


@pytest.mark.parametrize(
    ("written", "name"),
    [
        (r"Fl\u00f6te", "Flöte"),
        (r"\ud83c\udfba Trumpet", "🎺 Trumpet"),
        (r"Trumpet \ud83c", "Trumpet \ufffd"),
        (r"\udfba\udfba", "\ufffd\ufffd"),
        (r"\ud83c\ud83c\udfba", "\ufffd🎺"),
        (r"back\\\\ud800", r"back\\ud800"),
    ],
)
def test_half_a_character_costs_only_itself(written: str, name: str):
    text = json.dumps(own(title="HERE")).replace("HERE", written)
    assert read_score(text.encode()).title == name


def test_letters_that_are_not_utf_8_cost_only_themselves():
    data = json.dumps(own(title="FlHERte")).encode().replace(b"HER", b"\xf6")
    score = read_score(data)
    assert score.title == "Fl\ufffdte"
    place = f"byte {data.index(0xF6)}"
    assert [(warning.kind, warning.place) for warning in score.warnings] == [("bad_text", place)]


def test_of_a_key_given_twice_the_last_counts():
    assert read_score(json.dumps(own()).replace("{", '{"title": "First", ', 1).encode()).title == "Tune"


def test_limits_hold_for_documents():
    many = [{"beat": 0, "duration": 1, "pitch": 60}] * 250_001
    with pytest.raises(ScoreLimitError, match="number of notes"):
        read(own(parts=[{"notes": many}]))
    for empty in (b"{}", b"[]"):
        with pytest.raises(ScoreLimitError, match="number of JSON objects and lists"):
            read_score(b'{"tracks": [' + b",".join([empty] * 1_000_000) + b"]}")
    with pytest.raises(ScoreError, match="at most 100000 items"):
        read(own(tempos=[{"beat": 0, "bpm": 60}] * 100_001))
    with pytest.raises(ScoreLimitError, match="number of parts"):
        read(own(parts=[{}] * 1025))
    with pytest.raises(ScoreLimitError, match="length in seconds"):
        read(own(parts=[{"notes": [{"beat": 9e6, "duration": 1, "pitch": 60}]}]))
    with pytest.raises(ScoreLimitError, match="number of bars"):
        read(own(
            time_signatures=[{"beat": 0, "numerator": 1, "denominator": 64}],
            parts=[{"notes": [{"beat": 9000, "duration": 1, "pitch": 60}]}],
        ))  # fmt: skip


def test_more_parts_than_channels_go_on_to_further_ports():
    parts = [
        {"program": program, "notes": [{"beat": 0, "duration": 1, "pitch": 60}]} for program in range(40)
    ]
    score = read(own(parts=parts))
    channels = [part.channel for part in score.parts]
    assert channels == [channel for channel in range(44) if channel % 16 != 9][:40]
    assert score.notes.channel.tolist() == channels
    assert score.warnings == ()


def test_tracks_of_one_channel_and_two_programs_get_two_channels():
    track = {"channel": 0, "notes": [{"midi": 60, "time": 0, "duration": 1}]}
    document = tone(tracks=[{**track, "instrument": {"number": 56}}, {**track, "instrument": {"number": 40}}])
    assert [part.channel for part in read(document).parts] == [0, 1]


def test_tracks_of_one_channel_and_one_program_share_it_with_its_pedal():
    track = {"channel": 4, "instrument": {"number": 0}, "notes": [{"midi": 60, "time": 0, "duration": 1}]}
    assert [part.channel for part in read(tone(tracks=[track, track])).parts] == [4, 4]


def test_a_track_is_one_part_whatever_channels_its_notes_name():
    notes = [{"midi": 60 + n, "time": n, "duration": 1, "channel": n} for n in range(12)]
    score = read(tone(tracks=[{"channel": 3, "instrument": {"number": 56}, "notes": notes}]))
    assert len(score.parts) == 1
    assert set(score.notes.channel.tolist()) == {3}
    assert score.warnings == ()


def test_the_published_schema_is_the_present_one():
    published = Path(reina.music.__file__).with_name("score.schema.json").read_text(encoding="utf-8")
    assert published == schema_text()
    assert json.loads(published) == score_schema()
    assert score_schema()["required"] == ["format", "parts"]


def test_key_signatures_of_our_own_form():
    keys = [{"beat": 4, "fifths": 0, "mode": "minor"}, {"beat": 0, "fifths": -2}]
    score = read_score(json.dumps(own(key_signatures=keys)).encode())
    assert score.key_signatures == (KeySignature(0.0, -2), KeySignature(4.0, 0, is_minor=True))
    with pytest.raises(ScoreError, match="less than or equal to 7"):
        read_score(json.dumps(own(key_signatures=[{"beat": 0, "fifths": 8}])).encode())
    assert read_score(json.dumps(own(key_signatures=None)).encode()).key_signatures == ()


@pytest.mark.parametrize("letter", ["x", "\0", "\x80", "\U000e0001", "\ud800", "\\", "'"])
def test_an_error_quotes_little_of_a_long_text(letter: str):
    with pytest.raises(ScoreError, match="a list of tracks is needed") as caught:
        read_score(json.dumps({"tracks": 100_000 * letter}).encode())
    assert len(str(caught.value)) < 150
