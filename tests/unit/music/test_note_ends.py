"""When notes end that the file does not end itself."""

import pytest
from tests.unit.music.midi_bytes import END, chunk, events, header, meta, midi, off, on

from reina.music import Score, read_score

TICKS_IN_A_SECOND = 960


def lengths(score: Score) -> list[float]:
    return score.notes.duration_s.round(3).tolist()


def kinds(score: Score) -> list[str]:
    return [warning.kind for warning in score.warnings]


def all_off(delta: int, controller: int = 123, channel: int = 0) -> tuple[int, bytes]:
    return delta, bytes([0xB0 | channel, controller, 0])


@pytest.mark.parametrize("controller", [120, 123])
def test_a_controller_ends_what_sounds_on_its_channel(controller: int) -> None:
    track = (on(0, 60), on(0, 64), on(0, 67, channel=1), off(480, 64), all_off(480, controller))
    score = read_score(midi((*track, off(960, 67, channel=1), meta(96_000, 1, b"end"))))
    assert lengths(score) == [1.0, 0.5, 2.0]
    assert kinds(score) == ["silenced_note"]


def test_a_controller_ends_a_note_before_its_note_off() -> None:
    score = read_score(midi((on(0, 60), all_off(480), off(9600, 60), on(0, 62), off(480, 62))))
    assert lengths(score) == [0.5, 0.5]
    assert kinds(score) == ["silenced_note"]


def test_a_controller_at_the_beginning_or_at_the_end_of_a_note_changes_nothing() -> None:
    track = (all_off(0), on(0, 60), all_off(0), all_off(480), off(0, 60), on(0, 62), off(480, 62))
    score = read_score(midi(track))
    assert lengths(score) == [0.5, 0.5]
    assert kinds(score) == []


def test_a_controller_ends_nothing_in_other_tracks() -> None:
    score = read_score(midi((on(0, 60), off(960, 60)), (on(0, 48), off(480, 48), all_off(0))))
    assert lengths(score) == [1.0, 0.5]


def test_an_unreleased_note_before_a_controller_shifts_no_later_end() -> None:
    track = (on(0, 60), all_off(480), on(480, 60), off(480, 60), on(480, 60), off(480, 60))
    score = read_score(midi(track))
    assert lengths(score) == [0.5, 0.5, 0.5]
    assert kinds(score) == ["silenced_note"]


@pytest.mark.parametrize(
    ("held_until", "track_end", "wanted"),
    [
        (960, 1440, 1.5),  # its track ends soon after
        (960, 1_000_000, 2.0),  # long after: a bar
        (9600, 9600, 2.0),  # the others go on for long: a bar
    ],
)
def test_an_unreleased_note_ends_with_its_track_or_after_a_bar(
    held_until: int, track_end: int, wanted: float
) -> None:
    track = events(on(0, 60), on(0, 48), off(held_until, 48), (track_end - held_until, END[1]))
    score = read_score(header() + chunk(b"MTrk", track))
    assert lengths(score) == [held_until / TICKS_IN_A_SECOND, wanted]
    assert kinds(score) == ["unreleased_note"]
    assert score.duration_s == max(held_until / TICKS_IN_A_SECOND, wanted)


def test_a_key_struck_again_ends_the_note_that_was_never_released() -> None:
    track = [on(0, 72), on(1920, 72), off(480, 72)]
    for _ in range(7):
        track += [on(1440, 72), off(480, 72)]
    score = read_score(midi(track))
    assert lengths(score) == [2.0] + [0.5] * 8
    assert kinds(score) == ["unreleased_note"]
    assert "struck again" in score.warnings[0].message


def test_an_unreleased_note_with_which_its_track_ends_lasts_a_beat() -> None:
    score = read_score(midi((on(0, 60), off(480, 60), on(0, 62))))
    assert lengths(score) == [0.5, 0.5]
    assert kinds(score) == ["unreleased_note"]


def test_a_melody_without_any_note_off_is_played() -> None:
    chord = (on(0, 72), on(480, 60), on(0, 64), on(480, 62), on(0, 48, channel=1), off(4800, 48, channel=1))
    score = read_score(midi(chord))
    assert lengths(score) == [0.5, 0.5, 0.5, 5.0, 2.0]
    assert kinds(score) == ["unreleased_note"] * 4


def repeated(pitch: int, times: int, unreleased: int) -> list[tuple[int, bytes]]:
    """Notes of a beat's half, each a beat after the other, one of them without its note-off."""
    played: list[tuple[int, bytes]] = []
    for number in range(times):
        played += [on(480 if number - 1 == unreleased else 240 if number else 0, pitch)]
        played += [off(240, pitch)] if number != unreleased else []
    return played


def test_note_offs_for_all_keys_end_only_what_sounds() -> None:
    last = [off(480, 0), *(off(0, key) for key in range(1, 128))]
    score = read_score(midi((*repeated(60, 6, unreleased=2), on(0, 67), *last)))
    assert lengths(score) == [0.25, 0.25, 0.5, 0.25, 0.25, 0.25, 0.5]
    assert kinds(score) == ["unreleased_note", "silenced_note"]


def test_many_keys_let_go_at_once_are_music() -> None:
    chord = [on(0, key) for key in range(30, 90)]
    score = read_score(midi((*chord, off(480, 30), *(off(0, key) for key in range(31, 90)))))
    assert lengths(score) == [0.5] * 60
    assert kinds(score) == []


def test_a_controller_in_a_track_without_notes_on_its_channel_holds_for_all_tracks() -> None:
    score = read_score(midi((on(0, 60), on(0, 48, channel=1), off(1440, 48, 1)), (all_off(480),)))
    assert lengths(score) == [1.5, 0.5]
    assert kinds(score) == ["silenced_note"]
