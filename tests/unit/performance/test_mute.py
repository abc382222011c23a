"""The mute is in the bell where the score asks for a muted trumpet, or as a show has it."""

import io

import mido
import numpy as np
import pytest

from reina.curves import ParameterRegistry
from reina.instruments import INSTRUMENTS
from reina.music import read_score
from reina.performance.mute import Mute


def muted(programs: list[tuple[float, int]], registry: ParameterRegistry) -> Mute:
    """A mute for a part of four notes, a second each with a rest of a second after, at 60 to the minute."""
    track = mido.MidiTrack([mido.MetaMessage("set_tempo", tempo=1_000_000)])
    events: list[tuple[float, int, mido.Message]] = [
        (at, 1, mido.Message("program_change", program=program)) for at, program in programs
    ]
    for number in range(4):
        events.append((2.0 * number, 2, mido.Message("note_on", note=70, velocity=90)))
        events.append((2.0 * number + 1.0, 0, mido.Message("note_off", note=70)))
    last = 0.0
    for at, _, message in sorted(events, key=lambda event: event[:2]):
        track.append(message.copy(time=round((at - last) * 480)))
        last = at
    data = io.BytesIO()
    mido.MidiFile(ticks_per_beat=480, tracks=[track]).save(file=data)
    score = read_score(data.getvalue())
    played = INSTRUMENTS["trumpet"].play(score, 0)
    return Mute(score, played.line, registry)


TIMES = np.array([0.5, 2.5, 3.5, 4.5, 6.5, 90.0])


@pytest.mark.parametrize(("program", "wanted"), [(56, 0.0), (59, 1.0), (60, 0.0)])
def test_program_59_asks_for_the_mute(registry: ParameterRegistry, program: int, wanted: float) -> None:
    values = np.broadcast_to(registry.defaults(), (len(TIMES), len(registry.defaults())))
    found = muted([(0.0, program)], registry).evaluate(TIMES, values)
    np.testing.assert_array_equal(found, wanted)


def test_it_goes_in_and_out_in_the_rest_before_the_program_changes(registry: ParameterRegistry) -> None:
    values = np.broadcast_to(registry.defaults(), (len(TIMES), len(registry.defaults())))
    found = muted([(0.0, 56), (4.0, 59), (6.0, 56)], registry).evaluate(TIMES, values)
    np.testing.assert_array_equal(found, [0, 0, 1, 1, 0, 0])


def test_a_show_may_take_it_out_or_put_it_in(registry: ParameterRegistry) -> None:
    column = registry.layout()["player/mute"][0]
    for program in (56, 59):
        mute = muted([(0.0, program)], registry)
        for choice, wanted in ((1.0, 0.0), (2.0, 1.0)):
            values = np.tile(registry.defaults(), (len(TIMES), 1))
            values[:, column] = choice
            np.testing.assert_array_equal(mute.evaluate(TIMES, values), wanted)
