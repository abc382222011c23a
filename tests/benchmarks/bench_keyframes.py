"""Microseconds a frame to evaluate a show of 64 tracks of 1,000 keys, over aligned blocks of 60 frames.

Run as ``python tests/benchmarks/bench_keyframes.py``. Numbers, vectors, colours and orientations; with every
interpolation at random, and with those that other players have, beside them: Theatre.js (Bézier curves and
holds) and three.js's AnimationMixer (straight lines), which this runs in node, on the same keys, in the same
run. All are checked to show the same numbers.
"""

from __future__ import annotations

import json
import shutil
import subprocess
import time
from dataclasses import dataclass
from pathlib import Path
from statistics import median
from typing import TYPE_CHECKING, Any

import numpy as np
from machine import ROOT, heading, node_version, verdict
from table import SHORT, Row, alternate, tell

from reina.curves import Parameter, ParameterRegistry
from reina.curves.interpolation import interpolations
from reina.show import Show, with_edits

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from reina.curves.value_types import TypeName
    from reina.show import ShowPlan

TRACKS, KEYS = 64, 1000
BOUND_US = 12.0
BOUND_OF_BEZIER_US = 16.0
"""Curves with random handles alone, each of which is solved: more than any show has."""
ROUNDS = 5
TYPES: dict[TypeName, Any] = {
    "number": 0.0,
    "vector": (0, 0, 0),
    "color": "#000000",
    "orientation": (0, 0, 0, 1),
}
FOLDER = Path(__file__).parent
STRAIGHT = (1 / 3, 1 / 3, 2 / 3, 2 / 3)
"""Handles of a Bézier curve that is a straight line."""


@dataclass(frozen=True)
class Player:
    """Somebody else's player.

    Attributes:
        name: What it is called.
        script: Runs it in node.
        needs: A folder that is there when it has been installed.
        every: It takes one block of so many: enough for a median of code that has been compiled.
    """

    name: str
    script: Path
    needs: Path
    every: int = 1


MIXER = Player("three.js AnimationMixer", FOLDER / "mixer_player.mjs", ROOT / "web/node_modules/three")
THEATRE = Player(
    "Theatre.js",
    FOLDER / "theatre_player.mjs",
    FOLDER / "theatre/node_modules/@theatre/core",
    36 if SHORT else 12,
)


def show(span_s: float, names: Sequence[str]) -> tuple[dict[str, Any], ParameterRegistry]:
    """A show of keys at random times within a span, with interpolations of these names."""
    random = np.random.default_rng(1)
    kinds: list[TypeName] = [list(TYPES)[index % len(TYPES)] for index in range(TRACKS)]
    registry = ParameterRegistry(
        Parameter(f"p/{index}", kind, TYPES[kind]) for index, kind in enumerate(kinds)
    )
    tracks: list[dict[str, Any]] = []
    for parameter in registry:
        keyframes: list[dict[str, Any]] = []
        for at in np.sort(random.uniform(0.0, span_s, KEYS)).tolist():
            floats = random.uniform(0.0, 1.0, parameter.length)
            if parameter.type == "orientation":
                floats = (floats - 0.5) / np.linalg.norm(floats - 0.5)
            value = float(floats[0]) if parameter.length == 1 else floats.tolist()
            keyframe = {"time": at, "value": value, "interpolation": str(random.choice(names))}
            if keyframe["interpolation"] == "cubic_bezier":
                keyframe["handles"] = random.uniform(0.0, 1.0, 4).tolist()
            keyframes.append(keyframe)
        tracks.append({"parameter": parameter.path, "keyframes": keyframes})
    return {"version": 1, "tracks": tracks}, registry


def blocks_of(span_s: float) -> list[NDArray[np.float64]]:
    """Aligned blocks of 60 frames, one after another as they are played."""
    return [(60 * block + np.arange(60)) / 60.0 for block in range(int(min(span_s, 240)))]


def us_a_frame(plan: ShowPlan, blocks: Sequence[NDArray[np.float64]]) -> float:
    """The median block's time, the best of several rounds."""
    rounds: list[float] = []
    for _ in range(ROUNDS):
        spent: list[float] = []
        for times in blocks:
            begun = time.perf_counter()
            plan.evaluate(times)
            spent.append(time.perf_counter() - begun)
        rounds.append(median(spent))
    return min(rounds) / 60.0 * 1e6


def track_for_others(track: dict[str, Any], registry: ParameterRegistry) -> dict[str, Any]:
    """A track as the scripts read it. Theatre.js keeps a segment's first handle and hold at its start."""
    keys: list[dict[str, Any]] = track["keyframes"]
    following = [*keys[1:], keys[-1]]
    arriving = [key.get("handles", STRAIGHT)[2:] for key in keys]
    leaving = [key.get("handles", STRAIGHT)[:2] for key in following]
    return {
        "type": registry[track["parameter"]].type,
        "times": [key["time"] for key in keys],
        "values": [key["value"] for key in keys],
        "handles": [[*one, *other] for one, other in zip(arriving, leaving, strict=True)],
        "steps": [key["interpolation"] == "step" for key in following],
    }


def others_us(
    player: Player, document: dict[str, Any], registry: ParameterRegistry, span_s: float
) -> float | None:
    """The same keys in another player; None where it is not installed.

    Raises:
        RuntimeError: It shows other numbers.
    """
    node = shutil.which("node")
    if node is None or not player.needs.is_dir():
        return None
    starts = [float(times[0]) for times in blocks_of(span_s)][:: player.every]
    asked = {
        "tracks": [track_for_others(track, registry) for track in document["tracks"]],
        "starts": starts,
    }
    ran = subprocess.run(
        [node, str(player.script)], input=json.dumps(asked), capture_output=True, text=True, check=True
    )
    told: dict[str, Any] = json.loads(ran.stdout)
    plan = Show.from_document(document, registry).plan(registry)
    values, _ = plan.evaluate(np.array([starts[len(starts) // 2]]))
    for parameter, seen in zip(registry, told["seen"], strict=True):
        offset, _ = registry.layout()[parameter.path]
        if parameter.type == "number" and abs(seen[0] - values[0, offset]) > 1e-4:
            raise RuntimeError(f"{player.name} shows {seen[0]} where {values[0, offset]} is right")
    return float(told["us"])


def beside(
    player: Player,
    plan: ShowPlan,
    document: dict[str, Any],
    registry: ParameterRegistry,
    span_s: float,
    what: str,
) -> None:
    """Tell a row of Reina and another player on the same keys, turn by turn."""
    missing = shutil.which("node") is None or not player.needs.is_dir()
    own, theirs = alternate(
        1 if missing else 2,
        lambda: us_a_frame(plan, blocks_of(span_s)),
        lambda: others_us(player, document, registry, span_s) or 0.0,
        key=float,
    )
    tell(
        Row(
            "Keyframes: 64 tracks of 1,000 keys",
            f"a frame, {what}",
            "µs",
            own,
            player.name,
            "" if missing else node_version(player.needs),
            None if missing else theirs,
            notes="not installed" if missing else "in Node, a frame at a time; Reina in blocks of 60",
        )
    )


def edit_ms(plan: ShowPlan, document: dict[str, Any], registry: ParameterRegistry) -> float:
    """From one changed keyframe to the plan of the edited show."""
    before = Show.from_document(document, registry)
    plan = before.plan(registry)
    edit = {"edit": "change_keyframe", "parameter": "p/0", "key": "k500", "changes": {"value": 0.5}}
    spent: list[float] = []
    for _ in range(ROUNDS):
        begun = time.perf_counter()
        with_edits(before, [edit], registry).plan(registry, earlier=plan)
        spent.append(time.perf_counter() - begun)
    return min(spent) * 1e3


def main() -> int:
    """Print the figures."""
    print(heading(__file__))
    print(f"{TRACKS} tracks of {KEYS} keys, microseconds a frame over blocks of 60")
    met = True
    cases: tuple[tuple[str, list[str], tuple[Player, ...]], ...] = (
        ("all kinds", list(interpolations()), ()),
        ("Bézier curves and holds", ["cubic_bezier", "cubic_bezier", "cubic_bezier", "step"], (THEATRE,)),
        ("straight lines", ["linear"], (THEATRE, MIXER)),
    )
    for span_s, density in ((1000.0, "a key a second"), (180.0, "5.6 keys a second"))[: 1 if SHORT else 2]:
        for kinds, names, others in cases[1 if SHORT else 0 :]:
            document, registry = show(span_s, names)
            plan = Show.from_document(document, registry).plan(registry)
            figure = us_a_frame(plan, blocks_of(span_s))
            bound = BOUND_US if len(names) > 4 else BOUND_OF_BEZIER_US
            met &= figure <= bound
            print(verdict(f"{density}, {kinds}", figure, bound, "µs"))
            for player in others:
                beside(player, plan, document, registry, span_s, f"{density}, {kinds}")
    document, registry = show(1000.0, list(interpolations()))
    plan = Show.from_document(document, registry).plan(registry)
    print(f"{'an edit, planned again':44} {edit_ms(plan, document, registry):9.2f} ms")
    # The bounds are meant for the whole form alone.
    return 0 if met or SHORT else 1


if __name__ == "__main__":
    raise SystemExit(main())
