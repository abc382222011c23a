"""A shared machine stalls now and then: property tests have no deadline. And performances of small made-up
scores on the shipped rigs."""

import io
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import mido
import numpy as np
import pytest
from hypothesis import settings

from reina.curves import ParameterRegistry
from reina.instruments import INSTRUMENTS, Performer, player_parameters
from reina.instruments.player import Engagement
from reina.music import read_score
from reina.performance import Performance
from reina.show import Show, TimeMap
from reina.skeleton import Hold, HumanPose, Rig, load_hold, load_rig
from reina.stage import stage_registry

RIGS = Path(__file__).parents[2] / "rigs"

NoteBeats = tuple[float, float, int]
"""Onset and duration in beats at 120 to the minute, sounding pitch."""

Perform = Callable[..., Performance]

settings.register_profile("no deadline", deadline=None)
settings.load_profile("no deadline")


@pytest.fixture(scope="session", params=["trumpeter", "soloist"])
def player(request: pytest.FixtureRequest) -> str:
    name: str = request.param
    return name


@pytest.fixture(scope="session")
def player_rig(player: str) -> Rig:
    return load_rig(RIGS / player)


@pytest.fixture(scope="session")
def trumpet_rig() -> Rig:
    return load_rig(RIGS / "trumpet")


@pytest.fixture(scope="session")
def hold(player: str) -> Hold:
    return load_hold(RIGS / player, "trumpet")


@pytest.fixture(scope="session")
def registry() -> ParameterRegistry:
    known = stage_registry()
    return known.extended(player_parameters(0, INSTRUMENTS["trumpet"]))


def midi(notes: Sequence[NoteBeats], velocity: int) -> bytes:
    track = mido.MidiTrack(
        [mido.MetaMessage("track_name", name="Trumpet"), mido.Message("program_change", program=56)]
    )
    events = [(round(on * 480), 1, pitch) for on, _, pitch in notes]
    events += [(round((on + length) * 480), 0, pitch) for on, length, pitch in notes]
    last = 0
    for tick, kind, pitch in sorted(events):
        name = "note_on" if kind else "note_off"
        track.append(mido.Message(name, note=pitch, velocity=velocity if kind else 0, time=tick - last))
        last = tick
    file = mido.MidiFile(ticks_per_beat=480, tracks=[track])
    data = io.BytesIO()
    file.save(file=data)
    return data.getvalue()


@pytest.fixture(scope="session")
def perform(player_rig: Rig, trumpet_rig: Rig, hold: Hold, registry: ParameterRegistry) -> Perform:
    """Make a performance of notes; ``values`` are constant values of parameters, ``tracks`` a show's own."""

    def make(
        notes: Sequence[NoteBeats],
        *,
        values: Mapping[str, Any] | None = None,
        tracks: Sequence[Mapping[str, Any]] = (),
        velocity: int = 90,
        seed: int = 0,
        stances: Mapping[str, HumanPose] | None = None,
    ) -> Performance:
        score = read_score(midi(notes, velocity))
        instrument = INSTRUMENTS["trumpet"]
        own = player_parameters(0, instrument, stances=tuple(stances or ()))
        known = ParameterRegistry((*stage_registry(), *own)) if stances else registry
        constant = [
            {"parameter": path, "keyframes": [{"time": 0, "value": value}]}
            for path, value in (values or {}).items()
        ]
        show = Show.from_document({"version": 1, "tracks": [*constant, *tracks]}, known)
        performer = Performer(
            instrument,
            Engagement(
                score=score,
                played=instrument.play(score, 0),
                player_rig=player_rig,
                instrument_rigs={instrument.name: trumpet_rig},
                hold=hold,
                registry=known,
                seed=seed,
                stances=stances or {},
            ),
        )
        plan = show.plan(known, TimeMap.steady())
        return Performance([performer], plan, duration_s=score.duration_s)

    return make


@pytest.fixture(scope="session")
def tune() -> list[NoteBeats]:
    """Twenty seconds: a scale, leaps, repeats, a breath, a long rest, a long note, one note out of range."""
    rng = np.random.default_rng(7)
    notes: list[NoteBeats] = []
    beat = 2.0
    for pitch in [60, 62, 64, 65, 67, 69, 70, 72, 72, 72, 58, 79, 54, 82]:
        notes.append((beat, 0.5, pitch))
        beat += 0.5
    beat += 1.0
    for _ in range(24):
        notes.append((beat, 0.24, int(rng.integers(54, 86))))
        beat += 0.25
    notes.append((beat, 1.0, 30))
    beat += 16.0
    notes.append((beat, 6.0, 74))
    return notes
