"""What packing makes of every example's frames: how far anything is off, and how large it is."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest

from reina.music import read_score
from reina.protocol import Steps, encode_block, pack, unpack
from reina.rotations import rotate
from reina.sessions.production import Production, read_show
from reina.sessions.stage import Stage
from reina.skeleton import forward_kinematics

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from reina.protocol import Frames

EXAMPLES = Path(__file__).parents[3] / "examples"
SCORES = sorted((EXAMPLES / "scores").glob("*.*"))
BLOCKS = 12
"""Of each example, from begin to end."""
TIP_M, ANGLE_DEG, SHARE = 1e-4, 0.01, 1e-4
ONE_PLAYER, FURTHER_PLAYER = 4_000, 2_500


@pytest.fixture(scope="module")
def stage() -> Stage:
    return Stage.load(Path(__file__).parents[3] / "rigs")


@dataclass(frozen=True)
class Packed:
    """A block, as it was and as it comes back."""

    production: Production
    before: Frames
    after: Frames
    size: int


def _production(stage: Stage, score: Path) -> Production:
    read = read_score(score.read_bytes(), filename=score.name)
    planned = Production.plan(stage, read, cast=stage.found_cast(read))
    show = EXAMPLES / "shows" / f"{score.stem}.json"
    return planned.with_show(read_show(show.read_bytes(), planned.registry)) if show.exists() else planned


def packed_blocks(stage: Stage, score: Path) -> Iterator[Packed]:
    production = _production(stage, score)
    manifest, steps = production.manifest, Steps.of(production.performance.layout)
    last = int(production.score.duration_s + 4)
    for number in sorted({last * place // (BLOCKS - 1) for place in range(BLOCKS)}):
        before = encode_block(manifest, production.performance.evaluate(number))
        data = pack(manifest, before, steps, revision=1)
        yield Packed(production, before, unpack(manifest, data), len(data))


def tips(stage: Stage, production: Production, frames: Frames) -> NDArray[np.float64]:
    """Where every effector and contact of everybody and everything is, (points, 60, 3)."""
    found: list[NDArray[np.float64]] = []
    first = 0
    for number, layout in enumerate(production.manifest.skeletons):
        rig, end = stage.rigs[layout.rig], first + len(layout.joints)
        turns = frames["rotations"][:, first:end].astype(np.float64)
        turns /= np.linalg.norm(turns, axis=-1, keepdims=True)
        at, turned = forward_kinematics(rig.skeleton, turns, frames["root_positions"][:, number])
        found.extend(
            at[:, point.joint] + rotate(turned[:, point.joint], point.offset)
            for point in (*rig.effectors.values(), *rig.contacts.values())
        )
        first = end
    return np.stack(found)


@pytest.mark.parametrize("score", SCORES, ids=lambda path: path.name)
def test_nothing_is_off_by_more_than_nobody_sees(stage: Stage, score: Path) -> None:
    for block in packed_blocks(stage, score):
        apart = tips(stage, block.production, block.before) - tips(stage, block.production, block.after)
        assert np.linalg.norm(apart, axis=-1).max() <= TIP_M
        turned = block.before["rotations"].astype(np.float64) - block.after["rotations"]
        assert np.degrees(2.0 * np.linalg.norm(turned, axis=-1)).max() <= ANGLE_DEG
        place = 0
        for parameter in block.production.performance.layout.parameters:
            before, after = (
                frames["parameters"][:, place : place + parameter.length]
                for frames in (block.before, block.after)
            )
            place += parameter.length
            if not parameter.blend:
                assert np.array_equal(before, after), parameter.path
            elif parameter.minimum is not None and parameter.maximum is not None:
                off = np.abs(before - after).max()
                assert off <= SHARE * (parameter.maximum - parameter.minimum), parameter.path
            else:
                assert np.abs(before - after).max() <= SHARE, parameter.path
        assert np.array_equal(block.before["flags"], block.after["flags"])


def test_a_block_of_one_player_takes_a_few_kilobytes_and_a_further_one_less(stage: Stage) -> None:
    sizes: dict[int, list[float]] = {}
    for score in SCORES:
        blocks = list(packed_blocks(stage, score))
        players = [performer.instrument.name for performer in blocks[0].production.performers]
        if "drums" not in players:
            sizes.setdefault(len(players), []).append(float(np.mean([block.size for block in blocks])))
    assert np.mean(sizes[1]) <= ONE_PLAYER
    assert np.mean(sizes[2]) - np.mean(sizes[1]) <= FURTHER_PLAYER


def test_a_drummers_strokes_take_three_times_as_much(stage: Stage) -> None:
    """They are as many numbers that move, and each moves much more."""
    [score] = [score for score in SCORES if score.stem == "when-the-saints"]
    assert np.mean([block.size for block in packed_blocks(stage, score)]) <= ONE_PLAYER + 2 * FURTHER_PLAYER
