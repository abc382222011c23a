"""Microseconds a frame to evaluate a show of 64 tracks of 1,000 keys, over aligned blocks of 60 frames.

Run as ``python tests/benchmarks/bench_keyframes.py``. Numbers, vectors, colours and orientations, with every
interpolation at random; beside them the same keys, linear, in three.js's AnimationMixer, which this runs in
node.
"""

import json
import shutil
import subprocess
import time
from collections.abc import Sequence
from statistics import median
from typing import Any

import numpy as np
from machine import ROOT, heading, verdict
from numpy.typing import NDArray

from reina.keyframes import Parameter, ParameterRegistry, Show, ShowPlan
from reina.keyframes.interpolation import interpolations
from reina.keyframes.value_types import TypeName

TRACKS, KEYS = 64, 1000
BOUND_US = 12.0
ROUNDS = 5
TYPES: dict[TypeName, Any] = {
    "number": 0.0,
    "vector": (0, 0, 0),
    "color": "#000000",
    "orientation": (0, 0, 0, 1),
}

MIXER = """
import * as THREE from "three";
let text = "";
for await (const chunk of process.stdin) text += chunk;
const { tracks, starts } = JSON.parse(text);
const kinds = {
  number: [THREE.NumberKeyframeTrack, () => 0],
  vector: [THREE.VectorKeyframeTrack, () => new THREE.Vector3()],
  color: [THREE.ColorKeyframeTrack, () => new THREE.Color()],
  orientation: [THREE.QuaternionKeyframeTrack, () => new THREE.Quaternion()],
};
const root = new THREE.Object3D();
const clip = new THREE.AnimationClip("show", -1, tracks.map(({ type, times, values }, index) => {
  const node = new THREE.Object3D();
  node.name = `n${index}`;
  root.add(node);
  const [Track, make] = kinds[type];
  const property = type === "orientation" ? "quaternion" : type === "vector" ? "position" : "shown";
  if (property === "shown") node.shown = make();
  return new Track(`n${index}.${property}`, times, values.flat());
}));
const mixer = new THREE.AnimationMixer(root);
mixer.clipAction(clip).play();
const spent = [];
for (const start of [...starts, ...starts]) {
  const begun = performance.now();
  for (let frame = 0; frame < 60; frame++) mixer.setTime(start + frame / 60);
  spent.push(((performance.now() - begun) * 1000) / 60);
}
spent.sort((a, b) => a - b);
console.log(spent[spent.length >> 1]);
"""


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
            name = str(random.choice(names))
            keyframes.append({"time": at, "value": value, "interpolation": name})
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


def mixer_us_a_frame(document: dict[str, Any], registry: ParameterRegistry, span_s: float) -> float | None:
    """The same keys in three.js's AnimationMixer; None where node or three.js is not there."""
    node = shutil.which("node")
    if node is None or not (ROOT / "web/node_modules/three").is_dir():
        return None
    tracks = [
        {
            "type": registry[track["parameter"]].type,
            "times": [key["time"] for key in track["keyframes"]],
            "values": [key["value"] for key in track["keyframes"]],
        }
        for track in document["tracks"]
    ]
    starts = [float(times[0]) for times in blocks_of(span_s)]
    ran = subprocess.run(
        [node, "--input-type=module", "-e", MIXER],
        input=json.dumps({"tracks": tracks, "starts": starts}),
        cwd=ROOT / "web",
        capture_output=True,
        text=True,
        check=True,
    )
    return float(ran.stdout)


def edit_ms(plan: ShowPlan, document: dict[str, Any], registry: ParameterRegistry) -> float:
    """From one changed keyframe to the plan of the edited show."""
    before = Show.from_document(document, registry)
    plan = before.plan(registry)
    spent: list[float] = []
    for _ in range(ROUNDS):
        begun = time.perf_counter()
        before.with_changed(registry["p/0"], "k500", {"value": 0.5}).plan(registry, earlier=plan)
        spent.append(time.perf_counter() - begun)
    return min(spent) * 1e3


def main() -> int:
    """Print the figures."""
    print(heading(__file__))
    print(f"{TRACKS} tracks of {KEYS} keys, microseconds a frame over blocks of 60")
    met = True
    for span_s, density in ((1000.0, "a key a second"), (180.0, "5.6 keys a second")):
        for names, kinds in ((list(interpolations()), "all kinds"), (["linear"], "linear")):
            document, registry = show(span_s, names)
            plan = Show.from_document(document, registry).plan(registry)
            figure = us_a_frame(plan, blocks_of(span_s))
            met &= figure <= BOUND_US
            print(verdict(f"{density}, {kinds}", figure, BOUND_US, "µs"))
            if kinds == "linear":
                mixer = mixer_us_a_frame(document, registry, span_s)
                shown = "no node" if mixer is None else f"{mixer:9.2f} µs"
                print(f"{density}, linear, AnimationMixer".ljust(44), shown)
    document, registry = show(1000.0, list(interpolations()))
    plan = Show.from_document(document, registry).plan(registry)
    print(f"{'an edit, planned again':44} {edit_ms(plan, document, registry):9.2f} ms")
    return 0 if met else 1


if __name__ == "__main__":
    raise SystemExit(main())
