"""Every kind of broken or unusual MIDI file that is read all the same, and what is said about it."""

import numpy as np
import pytest
from tests.unit.music.midi_bytes import (
    END,
    chunk,
    events,
    header,
    meta,
    metre,
    midi,
    name,
    off,
    on,
    program,
    tempo,
    varlen,
)

from reina.music import KeySignature, Score, ScoreError, ScoreLimitError, read_score

NOTE = (on(0, 60), off(480, 60))


def kinds(score: Score) -> list[str]:
    return [warning.kind for warning in score.warnings]


def only_note(score: Score) -> tuple[float, float, int]:
    assert len(score.notes) == 1
    note = score.notes[0]
    return note.onset_s, note.duration_s, note.sounding_pitch


def test_a_right_file_is_read_without_a_warning():
    score = read_score(midi(NOTE))
    assert only_note(score) == (0.0, 0.5, 60)
    assert score.warnings == ()
    assert score.notes.velocity[0] == 100 / 127


@pytest.mark.parametrize("padding", [b"", b"\0"])
def test_riff_is_unwrapped(padding: bytes):
    inner = midi(NOTE)
    info = b"DISP" + (3 + 0).to_bytes(4, "little") + b"abc" + b"\0"
    body = b"RMID" + info + b"data" + len(inner).to_bytes(4, "little") + inner + padding
    score = read_score(b"RIFF" + len(body).to_bytes(4, "little") + body)
    assert only_note(score) == (0.0, 0.5, 60)
    assert score.warnings == ()


def test_riff_without_a_data_chunk_is_read_with_a_warning():
    score = read_score(b"RIFF\0\0\0\0RMID" + midi(NOTE))
    assert only_note(score) == (0.0, 0.5, 60)
    assert kinds(score) == ["bad_riff"]


def test_bytes_before_the_header_are_skipped():
    score = read_score(bytes(128) + midi(NOTE))
    assert only_note(score) == (0.0, 0.5, 60)
    assert kinds(score) == ["leading_bytes"]


def test_places_count_from_the_beginning_of_the_file_as_sent():
    data = midi((tempo(0, 0), *NOTE))
    (plain,) = read_score(data).warnings
    shifted = read_score(bytes(100) + data).warnings[1]
    assert plain.kind == shifted.kind == "bad_tempo"
    assert plain.place == f"track 1, byte {data.index(bytes([0xFF, 0x51]))}"
    assert shifted.place == f"track 1, byte {100 + data.index(bytes([0xFF, 0x51]))}"


def test_a_longer_header_is_read():
    data = chunk(b"MThd", bytes([0, 1, 0, 1, 1, 224, 9, 9])) + midi(NOTE)[14:]
    assert only_note(read_score(data)) == (0.0, 0.5, 60)


def test_a_header_of_wrong_length_is_read_as_one_of_six_bytes():
    data = midi(NOTE)
    score = read_score(data[:4] + b"\0\0\0\2" + data[8:])
    assert only_note(score) == (0.0, 0.5, 60)
    assert kinds(score) == ["header_length"]


def test_an_unknown_format_is_read_as_1():
    score = read_score(midi(NOTE, form=7))
    assert only_note(score) == (0.0, 0.5, 60)
    assert kinds(score) == ["unknown_format"]


@pytest.mark.parametrize("claimed", [0, 1, 5, 65535])
def test_a_wrong_track_count_loses_no_track(claimed: int):
    data = header(1, claimed) + midi((tempo(0, 250_000),), NOTE)[14:]
    score = read_score(data)
    assert only_note(score) == (0.0, 0.25, 60)
    assert kinds(score) == ["track_count"]


def test_format_0_with_several_tracks_is_read_whole():
    score = read_score(midi(NOTE, (on(480, 62), off(480, 62)), form=0))
    assert score.notes.onset_s.tolist() == [0.0, 0.5]
    assert kinds(score) == ["format_0_tracks"]


def test_format_0_makes_a_part_of_each_channel():
    track = (
        name("Song"),
        program(0, 56, 0),
        program(0, 40, 1),
        on(0, 60),
        on(0, 64, channel=1),
        off(480, 60),
    )
    score = read_score(midi((*track, off(0, 64, channel=1)), form=0))
    assert [(part.channel, part.program) for part in score.parts] == [(0, 56), (1, 40)]
    assert score.title == "Song"


def test_of_format_2_one_sequence_is_read():
    data = midi((tempo(0, 250_000), *NOTE), (tempo(0, 1_000_000), on(0, 65), off(480, 65)), form=2)
    first = read_score(data)
    assert only_note(first) == (0.0, 0.25, 60)
    assert kinds(first) == ["sequences"]
    assert (first.sequence, first.sequences) == (0, 2)
    second = read_score(data, sequence=1)
    assert only_note(second) == (0.0, 1.0, 65)
    assert second.warnings == ()
    with pytest.raises(ScoreError, match="0 to 1"):
        read_score(data, sequence=2)
    with pytest.raises(ScoreError, match="one sequence"):
        read_score(midi(NOTE), sequence=1)


def test_tempo_in_any_track_holds_for_all():
    score = read_score(midi(NOTE, (tempo(240, 1_000_000), on(0, 62), off(240, 62))))
    assert score.notes.onset_s.tolist() == [0.0, 0.25]
    assert score.notes.end_s.tolist() == [0.75, 0.75]


def test_of_tempos_at_one_tick_the_later_tracks_holds():
    score = read_score(midi((tempo(0, 250_000), *NOTE), (tempo(0, 1_000_000), on(0, 62), off(480, 62))))
    assert score.duration_s == 1.0


@pytest.mark.parametrize(
    ("frames", "rate"),
    [(24, 24.0), (25, 25.0), (29, 30000 / 1001), (30, 30.0)],
    ids=["24", "25", "29.97", "30"],
)
def test_smpte_divisions(frames: int, rate: float):
    score = read_score(midi((on(80, 60), off(400, 60)), division=(256 - frames) << 8 | 40))
    onset, duration, _ = only_note(score)
    assert onset == pytest.approx(2 / rate, abs=1e-9)
    assert duration == pytest.approx(10 / rate, abs=1e-9)
    assert score.warnings == ()
    assert score.notes.onset_beats[0] == pytest.approx(2 * onset)


def test_in_smpte_files_a_tempo_changes_nothing():
    score = read_score(midi((tempo(0, 250_000), on(0, 60), off(1000, 60)), division=(256 - 25) << 8 | 40))
    assert only_note(score) == (0.0, pytest.approx(1.0), 60)
    assert kinds(score) == ["smpte_tempo"]


def test_strange_divisions_are_read_with_a_warning():
    assert kinds(read_score(midi(NOTE, division=0))) == ["division_zero"]
    assert only_note(read_score(midi(NOTE, division=0)))[1] == 0.5
    assert kinds(read_score(midi(NOTE, division=(256 - 25) << 8))) == ["division_zero"]
    odd = read_score(midi((on(0, 60), off(500, 60)), division=(256 - 50) << 8 | 10))
    assert kinds(odd) == ["smpte_rate"]
    assert only_note(odd)[1] == pytest.approx(1.0)


@pytest.mark.parametrize(
    "between", [meta(0, 0x01, b"text"), (0, b"\xf0\x03\x01\x02\xf7"), (0, b"\xf7\x01\x00")]
)
def test_running_status_lasts_over_meta_and_sysex(between: tuple[int, bytes]):
    track = events(on(0, 60), between, (480, bytes([60, 0])), END)
    score = read_score(header() + chunk(b"MTrk", track))
    assert only_note(score) == (0.0, 0.5, 60)
    assert score.warnings == ()


def test_note_on_with_velocity_0_ends_a_note():
    assert only_note(read_score(midi((on(0, 60), on(240, 60, 0))))) == (0.0, 0.25, 60)


def test_an_unreleased_note_ends_with_its_track():
    score = read_score(midi((on(0, 60), on(0, 64), off(480, 60), meta(480, 0x01, b"last"))))
    assert score.notes.end_s.tolist() == [0.5, 1.0]
    assert kinds(score) == ["unreleased_note"]
    assert score.warnings[0].place == "track 1, tick 0"


def test_overlapping_notes_of_one_pitch_end_first_in_first_out():
    score = read_score(midi((on(0, 60), on(240, 60), off(240, 60), off(480, 60))))
    assert score.notes.onset_s.tolist() == [0.0, 0.25]
    assert score.notes.end_s.tolist() == [0.5, 1.0]
    assert kinds(score) == ["overlapping_note"]


def test_a_zero_length_note_is_kept_as_a_tap():
    score = read_score(midi((on(480, 60), off(0, 60), on(480, 62), off(480, 62))))
    assert score.notes.sounding_pitch.tolist() == [60, 62]
    assert score.notes.duration_s[0] == pytest.approx(0.05)
    assert score.tempo_map.seconds(score.notes.duration_beats[0]) == pytest.approx(0.05)
    assert kinds(score) == ["zero_length_note"]


def test_note_offs_that_end_nothing_are_left_out():
    score = read_score(midi((off(0, 60), off(0, 61), *NOTE, off(0, 60))))
    assert only_note(score) == (0.0, 0.5, 60)
    assert kinds(score) == ["stray_note_off"]
    assert "3 note-offs" in score.warnings[0].message


def test_notes_of_other_tracks_and_channels_are_not_ended():
    score = read_score(
        midi((on(0, 60), off(480, 60, channel=1), off(480, 60)), (off(240, 60), on(0, 60), off(240, 60)))
    )
    assert score.notes.end_s.tolist() == [1.0, 0.5]


def test_unknown_chunks_are_skipped():
    data = midi((tempo(0, 250_000),), NOTE)
    cut = data.index(b"MTrk", 20)
    score = read_score(data[:cut] + chunk(b"XFIH", b"MTrk inside") + data[cut:])
    assert only_note(score) == (0.0, 0.25, 60)
    assert kinds(score) == ["unknown_chunk"]


def test_bytes_between_and_after_tracks_are_skipped():
    data = midi((tempo(0, 250_000),), NOTE)
    cut = data.index(b"MTrk", 20)
    score = read_score(data[:cut] + b"\1\2\3" + data[cut:] + b"\0\0\0\0\0")
    assert only_note(score) == (0.0, 0.25, 60)
    assert kinds(score) == ["unknown_bytes", "unknown_bytes"]


@pytest.mark.parametrize("claimed", [0, 3, 10_000, 0xFFFFFFFF])
def test_a_wrong_track_length_loses_nothing(claimed: int):
    first, second = events(tempo(0, 250_000), END), events(*NOTE, END)
    score = read_score(header(1, 2) + chunk(b"MTrk", first, claimed) + chunk(b"MTrk", second))
    assert only_note(score) == (0.0, 0.25, 60)
    assert kinds(score) == ["track_length"]


def test_what_follows_the_end_of_a_track_is_left_out():
    score = read_score(header() + chunk(b"MTrk", events(*NOTE, END) + bytes(7)))
    assert only_note(score) == (0.0, 0.5, 60)
    assert kinds(score) == ["after_end_of_track"]


def test_a_track_without_its_end_is_read():
    score = read_score(header() + chunk(b"MTrk", events(*NOTE)))
    assert only_note(score) == (0.0, 0.5, 60)
    assert kinds(score) == ["no_end_of_track"]


@pytest.mark.parametrize(
    "bad",
    [
        meta(0, 0x51, b""),
        meta(0, 0x51, b"\0\0"),
        meta(0, 0x51, b"\0\0\0"),
        meta(0, 0x51, b"\1\2\3\4"),
    ],
)
def test_a_bad_tempo_is_left_out(bad: tuple[int, bytes]):
    score = read_score(midi((bad, *NOTE)))
    assert only_note(score) == (0.0, 0.5, 60)
    assert kinds(score) == ["bad_tempo"]


@pytest.mark.parametrize("bad", [meta(0, 0x58, b"\4"), meta(0, 0x58, b"\0\2\x18\x08"), metre(0, 4, 200)])
def test_a_bad_metre_is_left_out(bad: tuple[int, bytes]):
    score = read_score(midi((bad, metre(0, 3, 2), *NOTE)))
    assert [(s.numerator, s.denominator) for s in score.metre_map.signatures] == [(3, 4)]
    assert kinds(score) == ["bad_metre"]


@pytest.mark.parametrize("key", [meta(0, 0x59, b"\x08\0"), meta(0, 0x59, b""), meta(0, 0x59, b"\2\2")])
def test_a_bad_key_is_left_out(key: tuple[int, bytes]):
    score = read_score(midi((key, meta(0, 0x59, b"\xfd\1"), *NOTE)))
    assert score.key_signatures == (KeySignature(0.0, -3, is_minor=True),)
    assert kinds(score) == ["bad_key"]


def test_of_keys_at_one_tick_the_first_tracks_holds():
    score = read_score(
        midi(
            (meta(0, 0x59, b"\2\0"), meta(480, 0x59, b"\2\0"), meta(480, 0x59, b"\xff\0")),
            (meta(0, 0x59, b"\4\0"), *NOTE),
        )
    )
    assert score.key_signatures == (KeySignature(0.0, 2), KeySignature(2.0, -1))


def test_metas_that_are_not_needed_may_hold_anything():
    score = read_score(midi((meta(0, 0x7F, b"\0" * 300), *NOTE)))
    assert only_note(score) == (0.0, 0.5, 60)
    assert score.warnings == ()


def test_data_bytes_over_127_are_taken_as_127():
    score = read_score(midi((on(0, 60, 200), off(480, 60))))
    assert only_note(score) == (0.0, 0.5, 60)
    assert score.notes.velocity[0] == 1.0
    assert kinds(score) == ["data_byte"]


@pytest.mark.parametrize(
    ("message", "told"),
    [
        (b"\xf1\x05", True),
        (b"\xf2\x01\x02", True),
        (b"\xf3\x01", True),
        (b"\xf4", True),
        (b"\xf8", True),
        (b"\xfe", True),
    ],
)
def test_system_messages_are_skipped(message: bytes, told: bool):
    score = read_score(midi((on(0, 60), (0, message), off(480, 60))))
    assert only_note(score) == (0.0, 0.5, 60)
    assert (kinds(score) == ["system_message"]) is told


def test_data_without_a_status_is_skipped():
    score = read_score(midi(((0, b"\x10\x20\x30"), *NOTE)))
    assert only_note(score)[1:] == (0.5, 60)
    assert kinds(score) == ["stray_data"]


def test_a_sysex_of_wrong_length_is_read_to_its_end_mark():
    score = read_score(midi(((0, b"\xf0\xff\x7f\x01\x02\xf7"), *NOTE)))
    assert only_note(score) == (0.0, 0.5, 60)
    assert kinds(score) == ["sysex_length"]


def test_what_stands_before_a_break_is_kept():
    long_number = events(*NOTE) + b"\xff\xff\xff\xff\xff\x90\x3c\x40"
    score = read_score(header() + chunk(b"MTrk", long_number))
    assert only_note(score) == (0.0, 0.5, 60)
    assert kinds(score) == ["broken_track"]
    too_long = events(*NOTE) + b"\x00\xff\x01\x7fabc"
    assert kinds(read_score(header() + chunk(b"MTrk", too_long))) == ["broken_track"]
    endless_sysex = events(*NOTE) + b"\x00\xf0\x7fabc"
    assert kinds(read_score(header() + chunk(b"MTrk", endless_sysex))) == ["broken_track"]


def test_every_truncation_keeps_the_whole_events_before_it():
    data = midi(
        (tempo(0, 500_000),),
        (name("Trumpet"), *(event for p in range(60, 72) for event in (on(0, p), off(480, p)))),
    )
    whole = read_score(data)
    first_note = data.index(b"\x90\x3c") + 3
    for size in range(first_note, len(data)):
        part = read_score(data[:size])
        count = len(part.notes)
        assert np.array_equal(part.notes.sounding_pitch, whole.notes.sounding_pitch[:count])
        assert np.array_equal(part.notes.onset_s, whole.notes.onset_s[:count])
        assert count >= (size - first_note) // 9
        assert part.warnings


def test_a_file_cut_at_a_track_header_is_read():
    data = midi(NOTE, NOTE)
    cut = data.index(b"MTrk", 20) + 6
    score = read_score(data[:cut])
    assert only_note(score) == (0.0, 0.5, 60)
    assert kinds(score) == ["truncated_track", "track_count"]


@pytest.mark.parametrize(
    ("data", "why"),
    [
        (b"", "empty"),
        (b"hello", "no MIDI file"),
        (b"\x89PNG\r\n\x1a\n" + bytes(100), "a PNG picture"),
        (b"RIFF\0\0\0\0WAVEfmt " + bytes(100), "a WAV recording"),
        (b"MThd\0\0\0\6\0\1", "inside its header"),
        (header(), "no track"),
        (midi((tempo(0, 500_000),)), "no note"),
        (midi((off(0, 60),)), "no note"),
        (midi((on(0, 60, 0),)), "no note"),
        (midi((), (), form=2), "no note"),
    ],
)
def test_what_holds_no_note_is_refused_with_the_reason(data: bytes, why: str):
    with pytest.raises(ScoreError, match=why):
        read_score(data)


def test_bombs_are_refused_at_once():
    hours = midi((on(2**28 - 1, 60), off(480, 60)), division=1)
    with pytest.raises(ScoreLimitError, match="length in seconds"):
        read_score(hours)
    beats = midi((tempo(0, 1), on(2**28 - 1, 60), off(480, 60)), division=1)
    with pytest.raises(ScoreLimitError, match="length in beats"):
        read_score(beats)
    bars = midi((metre(0, 1, 6), tempo(0, 1000), on(500_000, 60), off(480, 60)), division=1)
    with pytest.raises(ScoreLimitError, match="number of bars"):
        read_score(bars)
    ticks = header() + chunk(b"MTrk", events(*[on(2**28 - 1, 60)] * 1100, END))
    with pytest.raises(ScoreLimitError, match="ticks"):
        read_score(ticks)


@pytest.mark.parametrize(
    ("piece", "count", "what"),
    [
        (b"\x00\x90\x3c\x40", 1_000_001, "more events"),
        (b"\x00\xf8", 1_000_001, "more events"),
        (b"\x00\xff\x01\x00", 1_000_001, "more events"),
        (b"\x00\xff\x51\x03\x07\xa1\x20", 100_001, "more events"),
        (b"\x00\x90\x3c\x40\x01\x80\x3c\x40", 250_001, "number of notes"),
    ],
    ids=["notes", "system messages", "metas", "tempos", "short notes"],
)
def test_floods_of_events_are_refused(piece: bytes, count: int, what: str):
    with pytest.raises(ScoreLimitError, match=what):
        read_score(header() + chunk(b"MTrk", piece * count))


def test_floods_of_chunks_are_refused():
    with pytest.raises(ScoreLimitError, match="number of tracks"):
        read_score(header() + chunk(b"MTrk", events(END)) * 1025)
    with pytest.raises(ScoreLimitError, match="number of chunks"):
        read_score(header() + chunk(b"ABCD", b"") * 10_001)
    with pytest.raises(ScoreLimitError, match="size in bytes"):
        read_score(bytes(32 * 2**20 + 1))


def test_a_fault_that_occurs_often_is_told_some_times_and_counted():
    score = read_score(
        midi(tuple(on(0, 60, 200) for _ in range(500)) + tuple(off(1, 60) for _ in range(500)))
    )
    of_kind = [w for w in score.warnings if w.kind == "data_byte"]
    assert len(of_kind) == 21
    assert "480 more" in of_kind[-1].message


def test_text_is_decoded():
    def of(text: bytes) -> str:
        return read_score(midi((name(text), *NOTE))).parts[0].name

    assert of("Трубa".encode()) == "Трубa"
    assert of("Trompète".encode("cp1252")) == "Trompète"
    assert of("トランペット".encode("cp932")) == "トランペット"
    assert of(b"Tpt\x00\x07 1\x0a") == "Tpt 1"


def test_names_and_programs_of_parts():
    silent = (name("The Tune"), tempo(0, 500_000))
    tracks = (
        (name("Trumpet in Bb"), program(0, 56), *NOTE),
        (program(0, 40, 1), on(0, 60, channel=1), off(480, 60, channel=1)),
        (on(0, 36, channel=9), off(480, 36, channel=9)),
        (on(0, 60, channel=2), off(480, 60, channel=2)),
    )
    score = read_score(midi(silent, *tracks))
    assert score.title == "The Tune"
    assert [part.name for part in score.parts] == ["Trumpet in Bb", "Violin", "Drums", "Track 5"]
    assert [part.named for part in score.parts] == [True, False, False, False]
    assert [part.program for part in score.parts] == [56, 40, None, None]
    assert [part.is_drums for part in score.parts] == [False, False, True, False]
    assert read_score(midi(NOTE), filename="a/b/Fanfare.mid").title == "Fanfare"


def test_the_program_of_most_notes_counts_and_other_tracks_may_set_it():
    changes = (program(0, 0), *NOTE, program(0, 56), *NOTE, *NOTE)
    assert read_score(midi(changes)).parts[0].program == 56
    assert read_score(midi((program(0, 57),), NOTE)).parts[0].program == 57


def test_controls_are_kept_with_their_times():
    track = (
        program(0, 56, 3),
        (240, b"\xb3\x07\x64"),
        (0, b"\xe3\x00\x40"),
        (240, b"\xe3\x7f\x7f"),
        (0, b"\xd3\x11"),
        (0, b"\xa3\x3c\x22"),
        on(0, 60, channel=3),
        off(480, 60, channel=3),
    )
    controls = read_score(midi(track)).controls
    assert [tuple(control) for control in controls] == [
        ("program", 0.0, 0.0, 3, 0, 56),
        ("controller", 0.25, 0.5, 3, 7, 100),
        ("pitch_bend", 0.25, 0.5, 3, 0, 0),
        ("pitch_bend", 0.5, 1.0, 3, 0, 8191),
        ("channel_pressure", 0.5, 1.0, 3, 0, 17),
        ("key_pressure", 0.5, 1.0, 3, 60, 34),
    ]


def test_notes_are_sorted_and_read_only():
    score = read_score(midi((on(480, 64), on(0, 60), off(480, 60), off(0, 64)), (on(0, 72), off(960, 72))))
    assert score.notes.sounding_pitch.tolist() == [72, 60, 64]
    assert score.notes.part.tolist() == [1, 0, 0]
    with pytest.raises(ValueError, match="read-only"):
        score.notes.onset_s[0] = 1.0


def test_varlen_helper_agrees_with_the_standard():
    assert [varlen(n).hex() for n in (0, 0x7F, 0x80, 0x2000, 0x0FFFFFFF)] == [
        "00",
        "7f",
        "8100",
        "c000",
        "ffffff7f",
    ]
