"""Models skinned as a page skins them, by numbers that `read_model.mjs` takes out of the GLBs."""

from __future__ import annotations

import json
import subprocess
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reina.instruments import INSTRUMENTS, Performer, player_parameters
from reina.instruments.player import Engagement
from reina.music import read_score
from reina.performance import Performance
from reina.rotations import to_matrix
from reina.show import Show, TimeMap
from reina.skeleton import forward_kinematics, load_hold, load_rig
from reina.stage import stage_registry

Array = NDArray[np.float64]

ROOT = Path(__file__).parents[3]
EXAMPLES = sorted((ROOT / "examples/scores").iterdir())
PLAYERS = tuple(sorted(path.parents[1].name for path in (ROOT / "rigs").glob("*/holds/trumpet.json")))
HORNS = tuple(name for name, instrument in INSTRUMENTS.items() if instrument.rig and instrument.valve_count)
HOLDS = tuple((player, horn) for player in PLAYERS for horn in HORNS)
"""Every player with every instrument."""


SAMPLE_AREA_M2 = 4e-5


@dataclass(frozen=True)
class Cloth:
    """A mesh of the model at rest: which vertices are on its border, and by what joints it is moved."""

    positions: Array
    normals: Array
    joints: NDArray[np.int64]
    weights: Array
    border: NDArray[np.bool_]
    triangles: NDArray[np.int64]

    def posed(self, matrices: Array) -> tuple[Array, Array]:
        """Positions and normals (V, 3) under joint matrices (J, 3, 4)."""
        blended = np.einsum("vk,vkij->vij", self.weights, matrices[self.joints])
        places = np.einsum("vij,vj->vi", blended[:, :, :3], self.positions) + blended[:, :, 3]
        normals = np.einsum("vij,vj->vi", blended[:, :, :3], self.normals)
        return places, normals / np.linalg.norm(normals, axis=1, keepdims=True)

    def only(self, kept: NDArray[np.bool_]) -> Cloth:
        """Some of its vertices."""
        number = np.cumsum(kept) - 1
        return Cloth(
            self.positions[kept],
            self.normals[kept],
            self.joints[kept],
            self.weights[kept],
            self.border[kept],
            number[self.triangles[kept[self.triangles].all(axis=1)]],
        )

    @cached_property
    def samples(self) -> tuple[NDArray[np.int64], Array]:
        """Points all over its triangles, some millimetres apart: corners and shares (N, 3)."""
        a, b, c = (self.positions[self.triangles[:, k]] for k in range(3))
        areas = 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1)
        chosen = np.repeat(np.arange(len(areas)), np.ceil(areas / SAMPLE_AREA_M2).astype(int))
        within = np.random.default_rng(2).random((len(chosen), 2))
        within = np.where(within.sum(axis=1, keepdims=True) > 1.0, 1.0 - within, within)
        return self.triangles[chosen], np.column_stack([1.0 - within.sum(axis=1), within])


def shaped(entry: dict[str, Any]) -> Array:
    return np.array(entry["values"], dtype=np.float64).reshape(-1, entry["width"])


TURNED_IN = frozenset({"Blazer", "Jacket"})
"""Meshes whose edges are turned in: what is beside their borders is the edge, and faces to the side."""


def on_border(triangles: NDArray[np.int64], positions: Array, *, turned_in: bool) -> NDArray[np.bool_]:
    """Vertices of an edge that one triangle alone has, vertices at one place counting as one.

    And those beside them, if the edge is `turned_in`.
    """
    _, place = np.unique(np.round(positions, 5), axis=0, return_inverse=True)
    corners = place.ravel()[triangles]
    edges = np.sort(np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]]), axis=1)
    found, count = np.unique(edges, axis=0, return_counts=True)
    border = np.unique(found[count == 1])
    if turned_in:
        border = np.unique(corners[np.isin(corners, border).any(axis=1)])
    return np.isin(place.ravel(), border)


@dataclass(frozen=True)
class Played:
    """Frames of a performance, as far as models are moved by them."""

    matrices: Array
    """World times inverse rest of the player's joints (F, J, 3, 4)."""
    instrument_turns: Array
    """Matrices (F, 3, 3) from the instrument's frame to the world."""
    instrument_places: Array
    """Metres (F, 3)."""
    parameters: dict[str, Array]
    """Of one float each, by path (F,)."""


def play(name: str, path: Path, times_s: Array, horn: str = "trumpet") -> Played:
    """A player's frames of an example at some times, on one of the instruments."""
    registry = stage_registry().extended(player_parameters(0, INSTRUMENTS["trumpet"]))
    show = Show.from_document({"version": 1, "tracks": []}, registry)
    player, held = load_rig(ROOT / "rigs" / name), load_rig(ROOT / "rigs" / horn)
    skeleton = player.skeleton
    rest_places, rest_turns = forward_kinematics(skeleton, skeleton.rest_rotations)
    back = np.swapaxes(to_matrix(rest_turns), -1, -2)
    score = read_score(path.read_bytes(), filename=path.name)
    instrument = INSTRUMENTS[horn]
    performer = Performer(
        instrument,
        Engagement(
            score=score,
            played=instrument.play(score, instrument.rank_parts(score)[0].part),
            player_rig=player,
            instrument_rigs={instrument.name: held},
            hold=load_hold(ROOT / "rigs" / name, horn),
            registry=registry,
        ),
    )
    plan = show.plan(registry, TimeMap.steady())
    performance = Performance([performer], plan, duration_s=score.duration_s)
    block = performance.sample(times_s)
    local = block.rotations[:, : len(skeleton)].astype(np.float64)
    places, turns = forward_kinematics(skeleton, local, block.root_positions[:, 0].astype(np.float64))
    turned = to_matrix(turns) @ back
    moved = places - np.einsum("fjik,jk->fji", turned, rest_places)
    columns: dict[str, Array] = {}
    at = 0
    for parameter in performance.layout.parameters:
        if parameter.length == 1:
            columns[parameter.path] = block.parameters[:, at].astype(np.float64)
        at += parameter.length
    return Played(
        np.concatenate([turned, moved[..., None]], axis=-1),
        to_matrix(block.rotations[:, -1].astype(np.float64)),
        block.root_positions[:, 1].astype(np.float64),
        columns,
    )


def read_model(model: Path, out: Path) -> dict[str, Any]:
    """What is in a GLB, by way of a file."""
    script = Path(__file__).with_name("read_model.mjs")
    subprocess.run(["node", script, model, out], check=True)
    content: dict[str, Any] = json.loads(out.read_text())
    return content


def read_cloths(name: str, out: Path, tier: str = "full") -> dict[str, Cloth]:
    """A player's meshes by their names."""
    content = read_model(ROOT / "rigs" / name / f"{tier}.glb", out)
    nodes = {node: index for index, node in enumerate(load_rig(ROOT / "rigs" / name).nodes)}
    order = np.array([nodes[node] for node in content["joints"]])
    cloths: dict[str, Cloth] = {}
    for mesh in content["meshes"]:
        positions = shaped(mesh["position"])
        triangles = np.array(mesh["triangles"]["values"], dtype=np.int64).reshape(-1, 3)
        weights = shaped(mesh["weights_0"])
        cloths[mesh["name"]] = Cloth(
            positions,
            shaped(mesh["normal"]),
            order[shaped(mesh["joints_0"]).astype(np.int64)],
            weights / weights.sum(axis=1, keepdims=True),
            on_border(triangles, positions, turned_in=mesh["name"] in TURNED_IN),
            triangles,
        )
    return cloths
