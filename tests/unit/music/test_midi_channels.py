"""Which notes are one part, which program and which drums they have: tracks, channels, ports and banks."""

import pytest
from tests.unit.music.midi_bytes import meta, midi, name, off, on, program

from reina.music import Part, Score, read_score

Event = tuple[int, bytes]


def note(pitch: int = 60, channel: int = 0) -> tuple[Event, Event]:
    return on(0, pitch, channel=channel), off(480, pitch, channel)


def bank(number: int, channel: int = 0) -> Event:
    return 0, bytes([0xB0 | channel, 0, number])


def sysex(text: str, delta: int = 0) -> Event:
    data = bytes.fromhex(text)
    return delta, bytes([0xF0, len(data)]) + data


def parts_of(*tracks: tuple[Event, ...], form: int = 1) -> list[tuple[str, int | None, bool]]:
    score = read_score(midi(*tracks, form=form))
    return [(part.name, part.program, part.is_drums) for part in score.parts]


def channels(score: Score, part: Part) -> list[int]:
    return score.notes.channel[score.note_indices(part.index)].tolist()


GS_RESET = sysex("41 10 42 12 40 00 7f 00 41 f7")
XG_ON = sysex("43 10 4c 00 00 7e 00 f7")


@pytest.mark.parametrize(
    ("normal", "other"), [(56, 59), (57, 59), (60, 59), (40, 45), (48, 45), (27, 28), (33, 36), (24, 24)]
)
def test_ways_to_play_one_instrument_are_one_part(normal: int, other: int) -> None:
    staff = (name("Staff"), program(0, normal), program(0, other, 1), *note(), *note(), *note(62, 1))
    score = read_score(midi(staff, (name("Bass"), program(0, 33, 5), *note(36, 5))))
    assert [(part.name, part.program, part.channel) for part in score.parts] == [
        ("Staff", normal, 0),
        ("Bass", 33, 5),
    ]
    assert channels(score, score.parts[0]) == [0, 0, 1]
    assert [one.program for one in score.notes if one.part == 0] == [normal, normal, other]


@pytest.mark.parametrize("form", [0, 1])
def test_a_channel_for_each_note_is_one_part(form: int) -> None:
    notes = [event for number in range(12) for event in note(60 + number, 1 + number % 6)]
    score = read_score(midi((name("Lead"), *notes), form=form))
    assert len(score.parts) == 1
    assert score.notes.channel.tolist() == [1 + number % 6 for number in range(12)]
    programs = [program(0, 24, channel) for channel in range(1, 7)]
    assert parts_of((name("Guitar"), *programs, *notes), form=form)[0][1:] == (24, False)


def test_a_channel_that_names_no_program_goes_with_the_instrument_of_its_track() -> None:
    assert parts_of((name("Tpt"), program(0, 56), *note(), *note(62, 3))) == [("Tpt", 56, False)]


def test_two_instruments_of_one_track_are_two_parts() -> None:
    track = (name("Winds"), program(0, 56), program(0, 73, 1), *note(), *note(72, 1))
    assert parts_of(track, (name("Piano"), *note(48, 2))) == [
        ("Trumpet", 56, False),
        ("Flute", 73, False),
        ("Piano", None, False),
    ]


def test_drums_in_the_track_of_a_melody_are_a_part_of_their_own() -> None:
    assert parts_of((program(0, 56), *note(), *note(36, 9)), (*note(48, 2),)) == [
        ("Trumpet", 56, False),
        ("Drums", None, True),
        ("Track 2", None, False),
    ]


def test_in_a_merged_file_each_channel_is_a_part() -> None:
    programs = (program(0, 56), program(0, 56, 1), program(0, 0, 2))
    merged = (name("Song"), *programs, *note(), *note(62, 1), *note(48, 2), *note(36, 9))
    assert parts_of(merged, form=0) == [
        ("Trumpet", 56, False),
        ("Trumpet", 56, False),
        ("Acoustic Grand Piano", 0, False),
        ("Drums", None, True),
    ]


def test_a_setup_track_sets_programs_until_the_track_has_its_own() -> None:
    setup = (name("Setup"), program(0, 56), program(0, 60, 1))
    staff = (*note(), *note(), *note(), program(0, 59), *note())
    score = read_score(midi(setup, staff, note(60, 1)))
    assert [one.program for one in score.notes if one.part == 0] == [56, 56, 56, 59]
    assert [part.program for part in score.parts] == [56, 60]


def test_a_setup_track_may_change_a_program_within_the_piece() -> None:
    setup = (program(0, 56), program(960, 59))
    score = read_score(midi(setup, (*note(), *note(), *note())))
    assert [one.program for one in score.notes] == [56, 56, 59]


def test_tracks_that_collide_on_a_channel_keep_their_programs() -> None:
    trumpet = (program(0, 56), *note(), *note())
    piano = (program(0, 0), *note(48), program(0, 4), *note(50))
    score = read_score(midi(trumpet, piano))
    assert [one.program for one in score.notes if one.part == 0] == [56, 56]
    assert [one.program for one in score.notes if one.part == 1] == [0, 4]


def test_a_program_after_the_first_notes_leaves_them_without_one() -> None:
    score = read_score(midi((*note(), program(0, 56), *note(), *note())))
    assert [one.program for one in score.notes] == [None, 56, 56]


@pytest.mark.parametrize(
    ("setup", "channel", "is_drums"),
    [
        ((), 9, True),
        ((), 10, False),
        ((bank(120, 10),), 10, True),
        ((bank(121, 9),), 9, False),
        ((bank(127, 10), program(0, 0, 10)), 10, True),
        ((XG_ON, bank(126, 3)), 3, True),
        ((XG_ON, bank(127, 3), bank(0, 3)), 3, False),
        ((XG_ON, bank(0, 9)), 9, True),
        ((GS_RESET, bank(127, 3)), 3, False),
        ((GS_RESET, bank(8, 9)), 9, True),
        ((sysex("7e 7f 09 03 f7"), bank(120, 10)), 10, True),
        # GS: use for rhythm part. Block 0 is channel 10, block A channel 11.
        ((GS_RESET, sysex("41 10 42 12 40 1a 15 02 0f f7")), 10, True),
        ((GS_RESET, sysex("41 10 42 12 40 11 15 01 19 f7")), 0, True),
        ((GS_RESET, sysex("41 10 42 12 40 10 15 00 1b f7")), 9, False),
        ((GS_RESET, sysex("41 10 42 12 40 1a 15 02 0f f7"), bank(0, 10)), 10, True),
        # XG: part mode.
        ((XG_ON, sysex("43 10 4c 08 0a 07 02 f7")), 10, True),
        ((XG_ON, sysex("43 10 4c 08 09 07 00 f7")), 9, False),
        # Not theirs, or broken off.
        ((sysex("41 10 42 11 40 1a 15 02 f7"),), 10, False),
        ((sysex("41 10 42 12 40 1a 15"),), 10, False),
        ((sysex("43 10 4c 08 0a 07"),), 10, False),
        ((sysex("43 10 4c 08 7f 07 01 f7"),), 10, False),
    ],
)
def test_what_says_that_a_channel_is_drums(setup: tuple[Event, ...], channel: int, is_drums: bool) -> None:
    for tracks in (((*setup, *note(40, channel)),), (setup, note(40, channel))):
        assert [part.is_drums for part in read_score(midi(*tracks)).parts] == [is_drums]


def test_the_standard_that_a_file_ends_with_holds() -> None:
    assert parts_of((XG_ON, GS_RESET, bank(127, 3), *note(40, 3)))[0][2] is False
    assert parts_of((GS_RESET, XG_ON, bank(127, 3), *note(40, 3)))[0][2] is True


def port(number: int) -> Event:
    return meta(0, 0x21, bytes([number]))


def test_ports_keep_equal_channels_apart() -> None:
    trumpet = (port(0), program(0, 56), (0, b"\xb0\x07\x64"), *note())
    bass = (port(1), program(0, 33), (0, b"\xb0\x07\x1e"), *note(36))
    drums = (port(1), *note(36, 9))
    score = read_score(midi(trumpet, bass, drums))
    assert [(part.program, part.channel, part.is_drums) for part in score.parts] == [
        (56, 0, False),
        (33, 16, False),
        (None, 25, True),
    ]
    volumes = [(one.channel, one.value) for one in score.controls if one.kind == "controller"]
    assert volumes == [(0, 100), (16, 30)]


def test_a_port_named_late_or_of_any_number_holds_for_its_whole_track() -> None:
    score = read_score(midi((program(0, 56), port(7), *note()), (port(3), *note(48))))
    assert [(part.program, part.channel) for part in score.parts] == [(56, 16), (None, 0)]
    assert read_score(midi((port(200), *note()))).parts[0].channel == 0


def test_a_setup_track_that_names_no_port_sets_up_the_first() -> None:
    setup = (program(0, 56), program(0, 33, 1))
    score = read_score(midi(setup, (port(1), *note()), (port(2), *note(36, 1)), (port(1), *note(36, 1))))
    assert [(part.program, part.channel) for part in score.parts] == [(56, 0), (None, 17), (33, 1)]
    # A track that has notes and names no port is on the first of MIDI's.
    score = read_score(midi((program(0, 56), *note()), (port(1), program(0, 33), *note(36))))
    assert [(part.program, part.channel) for part in score.parts] == [(56, 0), (33, 16)]


def test_a_track_may_go_from_port_to_port() -> None:
    score = read_score(midi((port(0), program(0, 56), *note(), port(1), program(0, 33), *note(36)), form=0))
    assert [(part.program, part.channel) for part in score.parts] == [(56, 0), (33, 16)]
