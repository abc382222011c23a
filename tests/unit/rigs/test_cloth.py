"""Cloth, skin and fingers keep out of each other in the poses of every example, at sampled vertices.

The models are skinned here as a page skins them, by numbers that `read_model.mjs` takes out of the GLBs.
A vertex is inside a cloth by how far it lies behind the cloth's nearest vertex, along that vertex's normal.
Vertices whose nearest is on a cloth's border say nothing: past an edge there is no inside.
"""

from __future__ import annotations

import json
import subprocess
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from reina.instruments import INSTRUMENTS
from reina.keyframes import Show, TimeMap, stage_registry
from reina.music import read_score
from reina.performance import PLAYER_PARAMETERS, POSE_PARAMETERS, Performance
from reina.rotations import to_matrix
from reina.skeleton import Rig, forward_kinematics, load_hold, load_rig

Array = NDArray[np.float64]

ROOT = Path(__file__).parents[3]
EXAMPLES = sorted((ROOT / "examples/scores").iterdir())
PLAYERS = tuple(sorted(path.parents[1].name for path in (ROOT / "rigs").glob("*/holds/trumpet.json")))
FRAMES = 6
"""Of each example, evenly spread."""

NEAR_M = 0.02
"""Who is further from a cloth than this is not in touch with it: it is another side of it that is seen."""


@dataclass(frozen=True)
class Cloth:
    """A mesh of the model at rest: which vertices are on its border, and by what joints it is moved."""

    positions: Array
    normals: Array
    joints: NDArray[np.int64]
    weights: Array
    border: NDArray[np.bool_]

    def posed(self, matrices: Array) -> tuple[Array, Array]:
        """Positions and normals (V, 3) under joint matrices (J, 3, 4)."""
        blended = np.einsum("vk,vkij->vij", self.weights, matrices[self.joints])
        places = np.einsum("vij,vj->vi", blended[:, :, :3], self.positions) + blended[:, :, 3]
        normals = np.einsum("vij,vj->vi", blended[:, :, :3], self.normals)
        return places, normals / np.linalg.norm(normals, axis=1, keepdims=True)

    def only(self, kept: NDArray[np.bool_]) -> Cloth:
        """Some of its vertices."""
        return Cloth(
            self.positions[kept], self.normals[kept], self.joints[kept], self.weights[kept], self.border[kept]
        )


@dataclass(frozen=True)
class Model:
    """A player's meshes by name, and poses to stand them in."""

    player: str
    cloths: dict[str, Cloth]
    names: list[str]
    poses: list[Array]

    def weighted(self, mesh: str, *parts: str) -> NDArray[np.bool_]:
        """Which vertices of a mesh are moved wholly by joints whose names have one of these in them."""
        wanted = np.array([any(part in name for part in parts) for name in self.names])
        cloth = self.cloths[mesh]
        return (cloth.weights * wanted[cloth.joints]).sum(axis=1) > 0.98


def shaped(entry: dict[str, Any]) -> Array:
    return np.array(entry["values"], dtype=np.float64).reshape(-1, entry["width"])


def on_border(triangles: NDArray[np.int64], positions: Array) -> NDArray[np.bool_]:
    """Vertices of an edge that one triangle alone has; vertices at one place count as one."""
    _, place = np.unique(np.round(positions, 5), axis=0, return_inverse=True)
    corners = place.ravel()[triangles]
    edges = np.sort(np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]]), axis=1)
    found, count = np.unique(edges, axis=0, return_counts=True)
    return np.isin(place.ravel(), found[count == 1])


def performed(player: Rig, trumpet: Rig, name: str) -> list[Array]:
    """Joint matrices (J, 3, 4), world times inverse rest, of some frames of every example."""
    registry = stage_registry().extended([*PLAYER_PARAMETERS, *POSE_PARAMETERS])
    show = Show.from_document({"version": 1, "tracks": []}, registry)
    skeleton = player.skeleton
    rest_places, rest_turns = forward_kinematics(skeleton, skeleton.rest_rotations)
    back = np.swapaxes(to_matrix(rest_turns), -1, -2)
    poses: list[Array] = []
    for path in EXAMPLES:
        score = read_score(path.read_bytes(), filename=path.name)
        instrument = INSTRUMENTS["trumpet"]
        performance = Performance(
            score=score,
            played=instrument.play(score, instrument.rank_parts(score)[0].part),
            instrument=instrument,
            player_rig=player,
            instrument_rig=trumpet,
            hold=load_hold(ROOT / "rigs" / name, "trumpet"),
            show_plan=show.plan(registry, TimeMap.steady()),
            registry=registry,
        )
        block = performance.sample(np.linspace(0.0, score.duration_s + 3.0, FRAMES))
        local = block.rotations[:, : len(skeleton)].astype(np.float64)
        places, turns = forward_kinematics(skeleton, local, block.root_positions[:, 0].astype(np.float64))
        turned = to_matrix(turns) @ back
        moved = places - np.einsum("fjik,jk->fji", turned, rest_places)
        matrices: Array = np.concatenate([turned, moved[..., None]], axis=-1)
        poses.extend(matrices[frame] for frame in range(len(matrices)))
    return poses


@pytest.fixture(scope="module", params=PLAYERS)
def model(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Model:
    name = request.param
    out = tmp_path_factory.mktemp("model") / "model.json"
    script = Path(__file__).with_name("read_model.mjs")
    subprocess.run(["node", script, ROOT / "rigs" / name / "full.glb", out], check=True)
    content = json.loads(out.read_text())
    player = load_rig(ROOT / "rigs" / name)
    nodes = {node: index for index, node in enumerate(player.nodes)}
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
            on_border(triangles, positions),
        )
    poses = performed(player, load_rig(ROOT / "rigs/trumpet"), name)
    return Model(name, cloths, list(player.skeleton.names), poses)


COAT = {"trumpeter": "Blazer", "soloist": "Jacket"}
LEGS = {"trumpeter": "Skirt", "soloist": "Trousers"}
GRAZE_M = 0.0015
"""What lies under a cloth may come so far out of it: less than the vertices' spacing lets one see."""

UNDER_LAPEL_M = {"trumpeter": GRAZE_M, "soloist": 0.009}
"""The soloist's shirt presses on his jacket beside the opening, where the lapels lie over both."""

CLEAR_M = 0.005
"""Fingers keep at least so far from all cloth."""

SHIFTS = 0.010 * np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]])


def outside(inner: Cloth, outer: Cloth, pose: Array, shift: Array | None = None) -> Array:
    """How far each vertex of `inner` is outside of `outer`, metres ``(V,)``; NaN if it is not under it."""
    points, _ = inner.posed(pose)
    places, normals = outer.posed(pose)
    if shift is not None:
        places = places + shift
    distance, index = cKDTree(places).query(points, k=1)
    depth: Array = ((points - places[index]) * normals[index]).sum(axis=1)
    depth[(distance > NEAR_M) | outer.border[index]] = np.nan
    return depth


def most_outside(model: Model, inner: Cloth, outer: str, shift: Array | None = None) -> float:
    """How far a vertex comes out of the cloth over it, at most over all poses, metres."""
    worst = -1.0
    judged = 0
    for pose in model.poses:
        depth = outside(inner, model.cloths[outer], pose, shift)
        depth = depth[~np.isnan(depth)]
        judged += len(depth)
        worst = max(worst, float(depth.max(initial=-1.0)))
    assert shift is not None or judged >= len(model.poses), "too little was there to be judged"
    return worst


def wrists(model: Model) -> Cloth:
    """The skin that sleeves and cuffs go over."""
    return model.cloths["Skin"].only(model.weighted("Skin", "LowerArm", "Hand"))


def test_skin_stays_under_the_coat(model: Model) -> None:
    coat = COAT[model.player]
    neck = model.cloths["Skin"].only(model.weighted("Skin", "neck", "upperChest", "Shoulder"))
    assert most_outside(model, neck, coat) < 0.0
    assert most_outside(model, neck, "Shirt") < 0.0
    assert most_outside(model, wrists(model), coat) < 0.0


def test_a_sleeve_a_centimetre_off_would_be_found(model: Model) -> None:
    coat = COAT[model.player]
    assert max(most_outside(model, wrists(model), coat, shift=shift) for shift in SHIFTS) > 0.0


def test_what_is_worn_under_the_coat_stays_under_it(model: Model) -> None:
    coat = COAT[model.player]
    assert most_outside(model, model.cloths["Shirt"], coat) < UNDER_LAPEL_M[model.player]
    legs = model.cloths[LEGS[model.player]]
    assert most_outside(model, legs, coat) < GRAZE_M
    assert max(most_outside(model, legs, coat, shift=shift) for shift in SHIFTS) > GRAZE_M


def test_fingers_stay_clear_of_all_cloth(model: Model) -> None:
    fingers = model.cloths["Skin"].only(model.weighted("Skin", "Index", "Middle", "Ring", "Little", "Thumb"))
    assert len(fingers.positions) > 500
    for name, cloth in model.cloths.items():
        if name in ("Skin", "Lashes", "Eyes", "Hair", "Shirt"):
            continue  # the shirt's cuffs are at the wrists, where thumbs begin
        for pose in model.poses:
            distance, _ = cKDTree(cloth.posed(pose)[0]).query(fingers.posed(pose)[0], k=1)
            assert distance.min() > CLEAR_M, name
