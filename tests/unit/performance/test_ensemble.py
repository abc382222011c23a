"""Players of one figure are posed side by side, and each moves as it would alone."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
from tests.unit.conftest import NoteBeats, midi

from reina.curves import ParameterRegistry
from reina.instruments import INSTRUMENTS, Ensemble, Performer, cast_parameters
from reina.instruments.brass.body import BrassBody
from reina.instruments.player import SEATS, BodyMotion, Engagement
from reina.music import read_score
from reina.performance import Performance
from reina.show import Show, TimeMap
from reina.skeleton import Hold, Rig, load_hold, load_rig
from reina.stage import stage_registry

RIGS = Path(__file__).parents[3] / "rigs"


@pytest.fixture(scope="module")
def cast(player_rig: Rig, trumpet_rig: Rig, hold: Hold, tune: list[NoteBeats]) -> Performance:
    """Three trumpeters and a soloist; two of them play the tune, one of them an octave of it later."""
    instrument = INSTRUMENTS["trumpet"]
    registry = ParameterRegistry((*stage_registry(), *cast_parameters([instrument] * 4)))
    later = [(onset + 8.0, length, pitch) for onset, length, pitch in tune]
    scores = [read_score(midi(notes, 90)) for notes in (tune, tune, later, tune)]
    soloist = load_rig(RIGS / "soloist")
    figures = [(player_rig, hold)] * 3 + [(soloist, load_hold(RIGS / "soloist", "trumpet"))]
    performers = [
        Performer(
            instrument,
            Engagement(
                score=score,
                played=instrument.play(score, 0),
                player_rig=rig,
                instrument_rigs={instrument.name: trumpet_rig},
                hold=held,
                registry=registry,
                number=number,
                seat=SEATS[("left", "right", "middle", "far left")[number]],
                seed=number,
            ),
        )
        for number, (score, (rig, held)) in enumerate(zip(scores, figures, strict=True))
    ]
    still = {"parameter": "players/2/player/stance", "keyframes": [{"time": 0, "value": "none"}]}
    show = Show.from_document({"version": 1, "tracks": [still]}, registry)
    return Performance(performers, show.plan(registry, TimeMap.steady()), duration_s=scores[2].duration_s)


def test_players_of_one_figure_are_posed_at_once(cast: Performance, monkeypatch: pytest.MonkeyPatch) -> None:
    posed: list[int] = []
    pose = BrassBody.pose

    def counted(self: BrassBody, motions: Sequence[BodyMotion]) -> object:
        posed.append(len(motions))
        return pose(self, motions)

    monkeypatch.setattr(BrassBody, "pose", counted)
    cast.evaluate(3)
    # One of the three trumpeters has no stance, which is another way of posing.
    assert sorted(posed) == [1, 1, 2]


def test_each_moves_as_it_would_alone(cast: Performance) -> None:
    registry = ParameterRegistry(cast.layout.parameters)
    shown = np.zeros((60, len(registry.defaults()))) + registry.defaults()
    stance = np.zeros((60, 4))
    stance[:, 3] = 1.0
    lowered = 0
    for block in range(26):
        times = np.arange(60 * block, 60 * block + 60) / 60.0
        together = Ensemble(cast.performers).evaluate(times, shown, [stance] * 4)
        for performer, frames in zip(cast.performers, together, strict=True):
            (alone,) = Ensemble([performer]).evaluate(times, shown, [stance])
            np.testing.assert_allclose(frames.rotations, alone.rotations, rtol=0.0, atol=1e-6)
            np.testing.assert_allclose(frames.root_positions, alone.root_positions, rtol=0.0, atol=1e-9)
            np.testing.assert_array_equal(frames.parameters, alone.parameters)
        raised = [performer.move(times, shown, stance).body.lowered for performer in cast.performers]
        lowered += len({bool(one.any()) for one in raised}) == 2
    assert lowered > 2, "some blocks have one with the instrument down and another who plays"
