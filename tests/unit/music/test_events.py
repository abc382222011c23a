import asyncio

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from reina.music import ClockState, MusicClock, NoteEvent, NoteEventEmitter

Told = list[tuple[str, float, str]]


def emitter(*notes: tuple[float, float, int, str]) -> tuple[NoteEventEmitter[str], Told]:
    """An emitter of (onset, end, pitch, name), with a list of what it tells."""
    onsets, ends, pitches = ([float(note[column]) for note in notes] for column in range(3))
    made = NoteEventEmitter(onsets, ends, pitches, [note[3] for note in notes])
    told: Told = []
    made.add_listener(lambda event: told.append(brief(event)))
    return made, told


def brief(event: NoteEvent[str]) -> tuple[str, float, str]:
    return {"note_on": "on", "note_off": "off"}[event.kind], event.song_time_s, event.note


SCALE = ((0.0, 1.0, 60, "c"), (1.0, 2.0, 62, "d"), (2.0, 3.0, 64, "e"))


def test_each_event_comes_once_and_in_order():
    scale, told = emitter(*SCALE)
    for step in range(61):
        scale.advance(step / 20)
    assert told == [
        ("on", 0.0, "c"),
        ("off", 1.0, "c"),
        ("on", 1.0, "d"),
        ("off", 2.0, "d"),
        ("on", 2.0, "e"),
        ("off", 3.0, "e"),
    ]


def test_an_event_at_the_reached_time_is_told_then():
    scale, told = emitter(*SCALE)
    scale.advance(0.0)
    assert told == [("on", 0.0, "c")]
    scale.advance(0.0)
    assert len(told) == 1


def test_at_one_time_ends_come_first_then_the_lower_pitch():
    chord, told = emitter(
        (0.0, 1.0, 67, "low g"),
        (0.0, 1.0, 60, "low c"),
        (1.0, 2.0, 72, "c"),
        (1.0, 2.0, 65, "f"),
        (1.0, 2.0, 65, "f again"),
    )
    chord.advance(1.0)
    assert [name for _, _, name in told] == ["low c", "low g", "low c", "low g", "f", "f again", "c"]
    assert [kind for kind, _, _ in told] == ["on", "on", "off", "off", "on", "on", "on"]


def test_a_note_without_duration_ends_after_it_begins():
    tap, told = emitter((1.0, 1.0, 60, "tap"))
    tap.advance(2.0)
    assert told == [("on", 1.0, "tap"), ("off", 1.0, "tap")]


def test_a_seek_into_a_note_announces_it():
    scale, told = emitter(*SCALE)
    heard: list[NoteEvent[str]] = []
    scale.add_listener(heard.append)
    scale.seek(1.5)
    assert told == [("on", 1.5, "d")]
    assert heard[0].resumed
    scale.advance(2.0)
    assert told[1:] == [("off", 2.0, "d"), ("on", 2.0, "e")]
    assert not heard[2].resumed


def test_a_seek_to_an_onset_is_a_beginning():
    scale, _ = emitter(*SCALE)
    heard: list[NoteEvent[str]] = []
    scale.add_listener(heard.append)
    scale.seek(1.0)
    assert [(event.note, event.resumed) for event in heard] == [("d", False)]


def test_a_seek_ends_what_sounds_no_longer_and_leaves_what_does():
    notes, told = emitter((0.0, 10.0, 40, "pedal"), *SCALE)
    notes.seek(0.5)
    told.clear()
    notes.seek(2.5)
    assert told == [("off", 2.5, "c"), ("on", 2.5, "e")]
    told.clear()
    notes.seek(0.5)
    assert told == [("off", 0.5, "e"), ("on", 0.5, "c")]
    told.clear()
    notes.seek(20.0)
    assert told == [("off", 20.0, "pedal"), ("off", 20.0, "c")]


def test_going_back_is_a_seek():
    scale, _ = emitter(*SCALE)
    scale.advance(2.0)
    with pytest.raises(ValueError, match="seek goes back"):
        scale.advance(1.0)


def test_a_late_listener_is_told_what_sounds():
    scale, _ = emitter(*SCALE)
    scale.advance(1.5)
    late: list[NoteEvent[str]] = []
    quiet: list[NoteEvent[str]] = []
    scale.add_listener(late.append)
    scale.add_listener(quiet.append, announce=False)
    assert [(event.kind, event.note, event.resumed) for event in late] == [("note_on", "d", True)]
    assert quiet == []
    scale.advance(2.0)
    assert [event.kind for event in quiet] == ["note_off", "note_on"]
    assert late[1:] == quiet


def test_a_removed_listener_hears_nothing_more():
    scale, _ = emitter(*SCALE)
    told: list[NoteEvent[str]] = []
    remove = scale.add_listener(told.append)
    scale.advance(0.0)
    remove()
    remove()
    scale.advance(3.0)
    assert len(told) == 1


def test_a_listener_that_raises_disturbs_nobody():
    failures: list[tuple[Exception, str]] = []
    scale = NoteEventEmitter(
        [0.0, 1.0],
        [1.0, 2.0],
        [60, 62],
        ["c", "d"],
        on_error=lambda error, event: failures.append((error, event.note)),
    )
    before: list[NoteEvent[str]] = []
    after: list[NoteEvent[str]] = []
    calls = 0

    def fails(event: NoteEvent[str]) -> None:
        nonlocal calls
        calls += 1
        if event.kind == "note_on":
            raise RuntimeError(event.note)

    scale.add_listener(before.append)
    scale.add_listener(fails)
    scale.add_listener(after.append)
    scale.advance(2.0)
    assert len(before) == len(after) == calls == 4
    assert [note for _, note in failures] == ["c", "d"]


def test_by_default_a_failure_is_logged(caplog: pytest.LogCaptureFixture):
    scale, told = emitter(*SCALE)

    def fails(event: NoteEvent[str]) -> None:
        raise KeyError(event.note)

    scale.add_listener(fails)
    scale.advance(0.0)
    assert told == [("on", 0.0, "c")]
    assert "note_on of note 0" in caplog.text


def test_a_listener_may_call_the_emitter():
    scale, told = emitter(*SCALE)

    def jump(event: NoteEvent[str]) -> None:
        if event.note == "c" and event.kind == "note_on":
            scale.seek(2.5)

    scale.add_listener(jump)
    scale.add_listener(lambda event: told.append(brief(event)))
    scale.advance(0.0)
    assert told == [("on", 0.0, "c")] * 2 + [("off", 2.5, "c")] * 2 + [("on", 2.5, "e")] * 2


def test_a_queue_of_asyncio_is_a_listener():
    async def play() -> list[str]:
        scale, _ = emitter(*SCALE)
        queue: asyncio.Queue[NoteEvent[str]] = asyncio.Queue()
        scale.add_listener(queue.put_nowait)
        scale.advance(1.0)
        return [(await queue.get()).note for _ in range(3)]

    assert asyncio.run(play()) == ["c", "c", "d"]


def test_the_rate_of_play_changes_no_event():
    def play(rate: float) -> Told:
        scale, told = emitter(*SCALE)
        clock = MusicClock(lambda: 0.0, 4.0)
        clock.set_rate(rate)
        state = clock.play()
        for step in range(400):
            scale.follow(state.spans(step * 0.11, (step + 1) * 0.11))
        return told

    assert play(0.1) == play(1.0) == play(4.0)
    assert len(play(1.0)) == 6


def test_the_end_of_the_song_ends_its_last_note():
    scale, told = emitter(*SCALE)
    state = MusicClock(lambda: 0.0, 3.0).play()
    scale.follow(state.spans(0.0, 2.9))
    assert told[-1] == ("on", 2.0, "e")
    scale.follow(state.spans(2.9, 50.0))
    assert told[-1] == ("off", 3.0, "e")


def loop_over(start: float, end: float, *notes: tuple[float, float, int, str]) -> Told:
    looped, told = emitter(*notes)
    clock = MusicClock(lambda: 0.0, 10.0)
    clock.set_loop(start, end)
    clock.seek(start)
    state = clock.play()
    looped.seek(start)
    for step in range(100):
        looped.follow(state.spans(step * 0.07, (step + 1) * 0.07))
    return [(kind, round(time, 6), name) for kind, time, name in told]


def test_a_loop_over_one_note_strikes_it_each_time():
    told = loop_over(1.0, 2.0, *SCALE)
    assert told[:4] == [("on", 1.0, "d"), ("off", 2.0, "d"), ("on", 1.0, "d"), ("off", 2.0, "d")]
    assert {name for _, _, name in told} == {"d"}


def test_a_loop_inside_a_note_strikes_it_each_time():
    told = loop_over(1.0, 2.0, (0.0, 10.0, 40, "pedal"))
    assert told[:3] == [("on", 1.0, "pedal"), ("off", 2.0, "pedal"), ("on", 1.0, "pedal")]


def test_a_loop_over_two_notes():
    told = loop_over(0.5, 1.5, *SCALE)
    assert told[:5] == [
        ("on", 0.5, "c"),
        ("off", 1.0, "c"),
        ("on", 1.0, "d"),
        ("off", 1.5, "d"),
        ("on", 0.5, "c"),
    ]


def test_columns_of_different_length_are_refused():
    with pytest.raises(ValueError, match="length 1"):
        NoteEventEmitter([0.0, 1.0], [1.0, 2.0], [60, 61], ["one"])
    with pytest.raises(ValueError, match="before it begins"):
        NoteEventEmitter([1.0], [0.0], [60], ["one"])


some_notes = st.lists(
    st.tuples(st.integers(0, 40), st.integers(0, 8), st.integers(50, 54)).map(
        lambda n: (n[0] / 4, (n[0] + n[1]) / 4, n[2])
    ),
    max_size=15,
)
moves = st.lists(st.tuples(st.booleans(), st.integers(0, 48).map(lambda quarter: quarter / 4)), max_size=12)


@given(some_notes, moves)
def test_what_was_told_is_what_sounds(notes: list[tuple[float, float, int]], path: list[tuple[bool, float]]):
    played = emitter(*((*note, str(index)) for index, note in enumerate(notes)))
    made, told = played
    position = -np.inf
    for is_seek, to in path:
        if is_seek or to < position:
            made.seek(to)
        else:
            made.advance(to)
        position = to
        counts = {str(index): 0 for index in range(len(notes))}
        for kind, _, name in told:
            counts[name] += 1 if kind == "on" else -1
        assert set(counts.values()) <= {0, 1}
        sounding = {str(index) for index, (onset, end, _) in enumerate(notes) if onset <= to < end}
        assert {name for name, count in counts.items() if count} == sounding
        assert {str(index) for index in made.sounding} == sounding
    assert [time for _, time, _ in told] == [time for _, time, _ in told]


@given(some_notes, st.lists(st.floats(0, 15), max_size=10))
def test_steps_do_not_matter(notes: list[tuple[float, float, int]], steps: list[float]):
    named = [(*note, str(index)) for index, note in enumerate(notes)]
    at_once, told_at_once = emitter(*named)
    in_steps, told_in_steps = emitter(*named)
    at_once.advance(15.0)
    for step in sorted(steps):
        in_steps.advance(step)
    in_steps.advance(15.0)
    assert told_in_steps == told_at_once
    assert [time for _, time, _ in told_at_once] == sorted(time for _, time, _ in told_at_once)


def test_a_state_that_goes_on_after_a_change_strikes_nothing_anew():
    notes, told = emitter((0.0, 9.0, 60, "long"))
    hand = [0.0]
    clock = MusicClock(lambda: hand[0], 10.0)
    state: ClockState = clock.play()
    notes.seek(0.0)
    last = 0.0
    for step in range(1, 60):
        hand[0] = step / 7
        notes.follow(state.spans(last, hand[0]))
        last = hand[0]
        state = clock.touch()
    assert told == [("on", 0.0, "long")]
