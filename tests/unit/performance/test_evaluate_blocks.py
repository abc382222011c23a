"""Blocks that are evaluated together are to the last bit those that are evaluated one by one."""

from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.unit.skeleton.figures import POSES, figure

from reina.curves import Parameter
from reina.curves.interpolation import interpolations_for
from reina.instruments import Cast, Casting
from reina.music import read_score
from reina.performance import FrameBlock, Performance
from reina.sessions.production import Production, read_show
from reina.sessions.stage import Stage
from reina.show import Show
from reina.skeleton import human_pose

ROOT = Path(__file__).parents[3]
SCORES = ("carnival-of-venice.mid", "trumpet-duet.mid", "when-the-saints.mid")
KEYED = "carnival-of-venice.mid, every parameter keyed"
LEFT_HANDED = "when-the-saints.mid, by a left-handed drummer"
TOGETHER = 4
STANCES = {name: human_pose(figure(name), 0.1) for name in POSES}


@cache
def performance(name: str) -> Performance:
    """An example with the cast that is found for it and its own show, or keyed in every way that there is."""
    stage = Stage.load(ROOT / "rigs")
    path = ROOT / "examples" / "scores" / name.partition(",")[0]
    score = read_score(path.read_bytes(), filename=path.name)
    cast = stage.found_cast(score)
    if name == LEFT_HANDED:
        drums = next(part.index for part in score.parts if part.is_drums)
        cast = Cast((Casting(drums, "drums", "trumpeter", handedness="left"),))
    production = Production.plan(stage, score, cast=cast, stances=STANCES)
    written = ROOT / "examples" / "shows" / f"{path.stem}.json"
    if name == KEYED:
        tracks = [track(parameter) for parameter in production.registry]
        show = Show.from_document({"version": 1, "tracks": tracks}, production.registry)
    else:
        show = read_show(written.read_bytes(), production.registry)
    return production.with_show(show).performance


def track(parameter: Parameter) -> dict[str, Any]:
    """Keys at random times of all interpolations, which loop; and an answer to the notes."""
    random = np.random.default_rng(sum(parameter.path.encode()))
    names = [
        name for name in interpolations_for(interpolates=parameter.interpolates) if name != "cubic_spline"
    ]
    found: dict[str, Any] = {
        "parameter": parameter.path,
        "after": "loop",
        "keyframes": [
            {"time": float(at), "value": value(parameter, random), "interpolation": str(random.choice(names))}
            for at in np.cumsum(random.uniform(0.3, 3.0, 12))
        ],
    }
    if parameter.type == "color":
        found["events"] = {"on": "notes", "amount": "#FFFFFF", "blend": "replace", "decay": 0.4}
    return found


def value(parameter: Parameter, random: np.random.Generator) -> Any:
    """One that the parameter may have."""
    if parameter.choices:
        return str(random.choice(parameter.choices))
    if parameter.type == "boolean":
        return bool(random.integers(2))
    if parameter.type == "color":
        return "#{:02X}{:02X}{:02X}".format(*random.integers(256, size=3))
    if parameter.type == "orientation":
        turned = random.normal(size=4)
        return (turned / np.linalg.norm(turned)).tolist()
    low = -1.0 if parameter.minimum is None else parameter.minimum
    high = low + 2.0 if parameter.maximum is None else parameter.maximum
    values = random.uniform(low, high, parameter.length).tolist()
    return values if parameter.length > 1 else values[0]


@pytest.mark.parametrize("name", [*SCORES, KEYED, LEFT_HANDED])
@settings(max_examples=25, deadline=None)
@given(first=st.integers(0, 90), count=st.integers(2, TOGETHER + 1))
def test_every_bit_is_the_same_together_and_alone(name: str, first: int, count: int) -> None:
    subject = performance(name)
    together = subject.evaluate_blocks(first, count)
    assert len(together) == count
    for block, frames in enumerate(together, start=first):
        assert frames.first_frame == 60 * block
        for field, (found, alone) in fields(frames, subject.evaluate(block)):
            differs = np.argwhere(found.view(np.uint8) != alone.view(np.uint8))
            assert not len(differs), f"{field} of block {block} differs at {differs[0].tolist()}"


def fields(one: FrameBlock, other: FrameBlock) -> Iterator[tuple[str, tuple[Any, Any]]]:
    """Each array of a block by its name, beside the other's."""
    for name in ("song_time_s", "rotations", "root_positions", "parameters", "cuts"):
        pair = (np.ascontiguousarray(getattr(one, name)), np.ascontiguousarray(getattr(other, name)))
        assert pair[0].shape == pair[1].shape
        yield name, pair
