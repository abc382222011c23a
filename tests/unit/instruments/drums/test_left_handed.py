"""A left-handed drummer is the mirror image of a right-handed one: limbs, words, and every frame."""

from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from tests.unit.instruments.drums.charted import Chart, charts
from tests.unit.instruments.drums.scores import Stroke, drum_score, played

from reina.curves import ParameterRegistry
from reina.instruments import INSTRUMENTS, Performer, StrikeFingering, cast_parameters
from reina.instruments.drums.body import KIT
from reina.instruments.drums.hit import PIECES
from reina.instruments.player import STANCES, BodyFrames, BodyMotion, Engagement
from reina.instruments.player.body_table import SIGNALS, TRUNK
from reina.instruments.player.mirrored_body import SIDEWAYS
from reina.music import Score
from reina.music.texts import ScoreText
from reina.rotations.arrays import FloatArray
from reina.skeleton import ACROSS, Rig, forward_kinematics, load_hold, load_rig, other_side

RIGS = Path(__file__).resolve().parents[4] / "rigs"
CHARTS = charts()
DRUMS = INSTRUMENTS["drums"]
KEYS = dict(
    zip(
        PIECES,
        (38, 36, 50, 47, 43, 42, 51, 49, 57, 52, 55, 56),
        strict=True,
    )
)
CROSS_STICK = 37
REGISTRY = ParameterRegistry(cast_parameters([DRUMS]))


def score_of_chart(chart: Chart) -> Score:
    struck = chart.struck
    strokes: list[Stroke] = [(float(at), KEYS["kick"], 0.8) for at in chart.kick_s]
    for at, piece, loud, crossed in zip(
        struck.onset_s, struck.piece, struck.velocity, struck.is_cross_stick, strict=True
    ):
        strokes.append((float(at), CROSS_STICK if crossed else KEYS[PIECES[piece]], float(loud)))
    return drum_score(sorted(strokes))


@pytest.mark.parametrize("name", CHARTS)
def test_every_chart_is_stuck_as_its_mirror_image(name: str) -> None:
    score = score_of_chart(CHARTS[name])
    right, left = played(score).fingering, played(score, "left").fingering
    assert (right.handedness, left.handedness) == ("right", "left")
    assert len(left.hits) == len(right.hits) > 0
    for one, other in zip(right.hits, left.hits, strict=True):
        assert other == replace(one, limb=other.limb)
        assert other.limb == other_side(one.limb) != one.limb
    for note, mirrored in zip(right.notes, left.notes, strict=True):
        if note is None:
            assert mirrored is None
            continue
        assert isinstance(note, StrikeFingering)
        assert isinstance(mirrored, StrikeFingering)
        assert (mirrored.piece, mirrored.zone) == (note.piece, note.zone)
        assert {mirrored.hand, note.hand} in ({"left", "right"}, {None})
        assert {mirrored.foot, note.foot} in ({"left", "right"}, {None})
    for note, reason in zip(left.notes, left.reasons, strict=True):
        # What is said first is the hand that plays.
        if isinstance(note, StrikeFingering) and reason.split()[0] in ("left", "right"):
            assert reason.split()[0] == note.hand or note.foot


def test_hands_that_are_written_are_those_that_play() -> None:
    strokes: list[Stroke] = [(0.25 * k, KEYS["snare"]) for k in range(8)]
    texts = [ScoreText("lyric", 0.25 * k, 0.5 * k, "LLRRLLRR"[k]) for k in range(8)]
    for handedness in ("right", "left"):
        hits = played(drum_score(strokes, texts=texts), handedness).fingering.hits
        assert "".join(hit.limb[0].upper() for hit in hits) == "LLRRLLRR", handedness


def test_the_crashes_keep_their_names() -> None:
    strokes: list[Stroke] = [(0.5 * k, (KEYS["crash_left"], KEYS["crash_right"])[k % 2]) for k in range(8)]
    left = played(drum_score(strokes), "left").fingering
    for note, reason in zip(left.notes, left.reasons, strict=True):
        assert isinstance(note, StrikeFingering)
        if "crash" in reason:
            assert f"{note.piece.removeprefix('crash_')} crash" in reason


@cache
def rig(name: str) -> Rig:
    return load_rig(RIGS / name)


def engagement(player: str, handedness: str, score: Score) -> Engagement:
    right = Engagement(
        score=score,
        played=DRUMS.play(score, 0, handedness=handedness),
        player_rig=rig(player),
        instrument_rigs={name: rig(one) for name, one in DRUMS.skeletons.items()},
        hold=load_hold(RIGS / player, DRUMS.rig),
        registry=REGISTRY,
    )
    if handedness == "right":
        return right
    return right.left_handed({name: rig(one) for name, one in DRUMS.skeletons_led_by("left").items()})


def performer(player: str, handedness: str, score: Score) -> Performer:
    return Performer(DRUMS, engagement(player, handedness, score))


def motion(
    one: Performer, times_s: FloatArray, signals: dict[str, float], **changes: FloatArray
) -> BodyMotion:
    """What moves a body that nothing sways: these signals."""
    shown = np.tile(REGISTRY.defaults(), (len(times_s), 1))
    moved = one.move(times_s, shown, np.zeros((len(times_s), len(STANCES)))).body
    still = np.zeros(len(times_s))
    rows = {name: still + signals.get(name, 0.0) for name in moved.signals}
    return replace(moved, signals=rows, stance=changes.get("stance"))


def places(of: Performer, frames: BodyFrames) -> dict[str, FloatArray]:
    """Where every joint of every skeleton is, by skeleton and joint: ``(F, 3)``, metres."""
    result: dict[str, FloatArray] = {}
    start = 0
    for slot, layout in enumerate(of.skeletons):
        name, own = layout.name, rig(layout.rig)
        count = len(own.skeleton.names)
        local = frames.rotations[:, start : start + count].astype(np.float64)
        at, _ = forward_kinematics(own.skeleton, local, frames.root_positions[:, slot])
        result |= {f"{name} {joint}": at[:, index] for index, joint in enumerate(own.skeleton.names)}
        start += count
    return result


def across(called: str) -> str:
    skeleton, joint = called.split()
    return f"{other_side(skeleton)} {other_side(joint)}"


@pytest.mark.parametrize("player", ["trumpeter", "soloist"])
def test_every_joint_is_where_the_mirror_image_has_it(player: str) -> None:
    score = score_of_chart(CHARTS["round_the_toms"])
    times = np.arange(0.0, 4.0, 1 / 60)
    trunk = [name for name in TRUNK if name in rig(player).skeleton]
    chance = np.random.default_rng(3)
    stance = 0.03 * chance.normal(size=(len(times), len(trunk) + 1, 3))
    mirrored = stance[:, [*(trunk.index(other_side(name)) for name in trunk), len(trunk)]]
    # Turns are about axes, a shift is along them.
    mirrored = mirrored * np.concatenate([np.tile(-ACROSS, (len(trunk), 1)), ACROSS[None]])
    signals = dict.fromkeys(SIGNALS, 0.05)
    sideways = {name: -value if name in SIDEWAYS else value for name, value in signals.items()}
    right, left = (performer(player, handedness, score) for handedness in ("right", "left"))
    one = places(right, right.body.solve(motion(right, times, signals, stance=stance)))
    other = places(left, left.body.solve(motion(left, times, sideways, stance=mirrored)))
    for called, at in one.items():
        assert other[across(called)] == pytest.approx(at * ACROSS, abs=2e-6), called


def test_a_show_s_turn_keeps_its_side() -> None:
    score, times = score_of_chart(CHARTS["rock_on_ride"]), np.arange(0.0, 1.0, 0.1)
    for handedness in ("right", "left"):
        one = performer("soloist", handedness, score)
        for signal in ("head_turn", "torso_turn", "sway_side"):
            moved, still = (
                places(one, one.body.solve(motion(one, times, signals)))["player leftEye"]
                for signals in ({signal: 0.5}, {})
            )
            assert (moved[:, 0] - still[:, 0]).min() > 0.002, (handedness, signal)


def test_a_left_handed_player_s_kit_stands_mirrored() -> None:
    one = performer("soloist", "left", score_of_chart(CHARTS["rock_on_ride"]))
    frames = one.body.solve(motion(one, np.arange(0.0, 2.0, 0.02), {}))
    at = places(one, frames)
    assert at[f"{KIT} hi_hat_top"][:, 0].max() < -0.3
    assert at[f"{KIT} ride"][:, 0].min() > 0.6
    assert frames.parameters.shape[1] == len(DRUMS.parameters)
