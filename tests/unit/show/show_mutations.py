"""Shows made worse at random, and what may come of them."""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from tests.document_mutations import mutate_document
from tests.mutations import Format, mutate

from reina.curves.interpolation import BUILT_IN
from reina.instruments import INSTRUMENTS, player_parameters
from reina.sessions.production import read_show
from reina.show import Show, ShowError, TimeMap, Triggers
from reina.stage import stage_registry

if TYPE_CHECKING:
    import random

EXAMPLES = Path(__file__).parents[3] / "examples" / "shows"
REGISTRY = stage_registry().extended(player_parameters(0, INSTRUMENTS["trumpet"]))
TIME_MAP = TimeMap(
    beats=lambda seconds: np.where(seconds < 4, seconds * 2, 8 + (seconds - 4) * 3),
    seconds=lambda beats: np.where(beats < 8, beats / 2, 4 + (beats - 8) / 3),
    bar_lines_beats=np.array([0.0, 1.0, 5.0, 8.0, 12.0]),
)
TRIGGERS = Triggers(
    onset_s=np.array([0.0, 0.5, 0.5, 2.0]),
    part=np.array([0, 0, 1, 0]),
    pitch=np.array([60, 64, 67, 72]),
    velocity=np.array([0.0, 0.5, 1.0, 0.25]),
    valves=np.array([[True, False], [False, False], [True, True], [False, True]]),
    end_s=3.0,
)
TIMES_S = np.concatenate([np.arange(120) / 15.0, [-1.0, 100.0, 14_400.0]])

SHOWS = Format(
    interesting=b'\0\t\n ,.-+:[]{}"\\09eE#\x80\xc3\xff',
    tokens=(
        *(b'"version": 1', b'"tracks": [', b'"time": "bars"', b'"after": "loop"', b'"events": {', b"null"),
        *(b'{"time": 1, "value": 1}', b'"\\ud800"', b"NaN", b"-Infinity", b"[[[[[[[[", b"\xff\xfe"),
    ),
    numbers=(b"-1", b"1e308", b"0", b"1e-320", b"null", b"9999999999", b'"C9"', b"[]", b"{}", b"9" * 400),
)
"""What means something to the reader of shows."""

SMALL: tuple[dict[str, Any], ...] = (
    {"version": 1, "tracks": []},
    {
        "version": 1,
        "title": "All units",
        "time": "beats",
        "markers": [{"time": 2, "name": "A"}],
        "tracks": [
            {
                "parameter": "camera/fov",
                "time": "bars",
                "before": "extrapolate",
                "after": "ping_pong",
                "keyframes": [
                    {"time": 0, "value": 0.5},
                    {"time": 1, "value": 0.6, "interpolation": "cubic_spline", "in_tangent": 0.1},
                    {"time": 3, "value": 0.4, "interpolation": "automatic"},
                ],
            },
            {
                "parameter": "blocks/color",
                "color_space": "linear",
                "keyframes": [{"time": 0, "value": "#123456"}],
            },
            {"parameter": "look/style", "keyframes": [{"time": 1, "value": "toon"}]},
            {"parameter": "no/such", "keyframes": [{"time": 0, "value": 1}]},
        ],
    },
    {
        "version": 1,
        "tracks": [
            {
                "parameter": "camera/roll",
                "events": {"on": "bars", "decay": 1, "attack": 0.1, "hold": 0.2, "amount": 0.1, "every": 2},
            },
            {
                "parameter": "lights/key/intensity",
                "solo": True,
                "keyframes": [{"time": 0, "value": 1}],
                "events": {
                    "on": "notes",
                    "decay": 1,
                    "cycle": [1, 2, 3],
                    "by_velocity": True,
                    "blend": "add",
                    "where": {
                        "part": 0,
                        "pitch": [0, 127],
                        "velocity": [0, 1],
                        "valves": [],
                        "pieces": ["snare"],
                        "limbs": ["left_foot"],
                    },
                },
            },
        ],
    },
)


@cache
def seeds() -> tuple[bytes, ...]:
    """The examples, small shows of most fields, and one of each interpolation."""
    kinds: dict[str, Any] = {
        "version": 1,
        "tracks": [
            {
                "parameter": "lights/key/intensity",
                "keyframes": [
                    {"time": time, "value": time % 3, "interpolation": name}
                    for time, name in enumerate(BUILT_IN)
                ],
            }
        ],
    }
    return (
        *(path.read_bytes() for path in sorted(EXAMPLES.glob("*.json"))),
        *(2 * [json.dumps(document).encode() for document in (*SMALL, kinds)]),
    )


def mutate_show(data: bytes, rng: random.Random) -> bytes:
    """A show with one mutation or more, of its values or of its bytes."""
    worse = mutate_document(data, rng) if rng.random() < 0.7 else None
    return mutate(data, SHOWS, rng) if worse is None else worse


def check_show(data: bytes) -> bool:
    """Read a show, write it, plan and evaluate it; False if it is refused.

    Raises:
        AssertionError: Something that comes of it is wrong.
        Exception: Anything but `ShowError`: a fault of ours.
    """
    try:
        show = read_show(data, REGISTRY)
    except ShowError as error:
        told = error
    else:
        _check_sound(show)
        return True
    assert told.detail
    assert len(str(told)) < 2_000
    return False


def _check_sound(show: Show) -> None:
    text = json.dumps(show.to_document(), ensure_ascii=False, allow_nan=False).encode()
    assert Show.from_document(json.loads(text), REGISTRY) == show
    plan = show.plan(REGISTRY, TIME_MAP, triggers=TRIGGERS)
    values, cuts = plan.evaluate(TIMES_S)
    assert cuts.shape == TIMES_S.shape
    assert np.all(np.isfinite(values))
