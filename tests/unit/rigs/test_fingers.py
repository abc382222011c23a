"""The skin of both hands against the metal and against other fingers, over whole strokes of every fingering.

Metal is the instrument's own model, its triangles sampled a millimetre apart, valves and slide where
the frame has them. How deep a vertex of skin is in it is measured along the normal of the nearest sample.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from scipy.spatial import cKDTree
from tests.unit.rigs.skinned import HOLDS, ROOT, Array, play, read_cloths, read_model, shaped

from reina.skeleton import load_rig

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

PLAYED = {
    # Every combination of valves, with slow notes and the third slide out.
    "chromatic-scale.mid": np.concatenate([np.arange(1.0, 3.2, 0.11), np.arange(3.2, 22.0, 0.47)]),
    # Fast ones.
    "carnival-of-venice.mid": np.arange(14.0, 16.0, 0.031),
}
SAMPLE_AREA_M2 = 1e-6
NEAR_M = 0.008

PRESS_M = 0.0025
"""Flesh that holds gives way by so much, and no more of it than that is in the metal."""

PAD_PRESS_M = 0.0012
"""A pad on its button."""

FINGERS = ("Thumb", "Index", "Middle", "Ring", "Little")


@dataclass(frozen=True)
class Metal:
    """A part of the instrument as points with normals, in its frame, with the valve or slide 0."""

    tree: cKDTree
    points: Array
    normals: Array
    travel: Array
    parameter: str | None

    def depth(self, places: Array, amount: float) -> Array:
        """How deep each place (V, 3) is in it, metres (V,); NaN where it is not near."""
        moved = places - amount * self.travel
        # Beyond NEAR_M the search gives up, and says inf.
        distance, index = self.tree.query(moved, k=1, distance_upper_bound=NEAR_M)
        near = distance < NEAR_M
        deep = np.full(len(places), np.nan)
        index = index[near]
        deep[near] = -((moved[near] - self.points[index]) * self.normals[index]).sum(axis=1)
        return deep


@dataclass(frozen=True)
class Hands:
    """Hands as they play: each frame's vertices and normals in the instrument's frame."""

    player: str
    horn: str
    bones: NDArray[np.str_]
    """The bone that moves most of each vertex, by name (V,)."""
    frames: list[tuple[Array, Array]]
    metal: list[Metal]
    amounts: list[dict[str, float]]

    def deepest(self, which: NDArray[np.bool_]) -> dict[str, float]:
        """By bone, how deep the deepest of its chosen vertices ever is in any metal."""
        found: dict[str, float] = {}
        for (places, _), amounts in zip(self.frames, self.amounts, strict=True):
            for part in self.metal:
                deep = part.depth(places[which], amounts[part.parameter] if part.parameter else 0.0)
                for bone in np.unique(self.bones[which][~np.isnan(deep)]).tolist():
                    worst = float(np.nanmax(deep[self.bones[which] == bone]))
                    found[bone] = max(found.get(bone, -1.0), worst)
        return found


def sample(mesh: dict[str, Any], chance: np.random.Generator) -> tuple[Array, Array]:
    """Points on a mesh's triangles and their normals, (N, 3) each, about a millimetre apart."""
    place = np.array(mesh["place"]).reshape(4, 4).T
    corners = shaped(mesh["position"]) @ place[:3, :3].T + place[:3, 3]
    normals = shaped(mesh["normal"]) @ np.linalg.inv(place[:3, :3])
    triangles = np.array(mesh["triangles"]["values"], dtype=np.int64).reshape(-1, 3)
    a, b, c = (corners[triangles[:, k]] for k in range(3))
    areas = 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1)
    chosen = np.repeat(np.arange(len(triangles)), np.ceil(areas / SAMPLE_AREA_M2).astype(int))
    within = chance.random((len(chosen), 2))
    within = np.where(within.sum(axis=1, keepdims=True) > 1.0, 1.0 - within, within)
    shares = np.column_stack([1.0 - within.sum(axis=1), within])
    turned = np.einsum("nk,nkj->nj", shares, normals[triangles[chosen]])
    points: Array = np.einsum("nk,nkj->nj", shares, corners[triangles[chosen]])
    return points, turned / np.linalg.norm(turned, axis=1, keepdims=True)


def read_metal(horn: str, out: Path) -> list[Metal]:
    """An instrument's parts, each with all its materials; the mute is shown only where it is played with."""
    moving = {part.node: part for part in load_rig(ROOT / "rigs" / horn).parts}
    chance = np.random.default_rng(1)
    meshes = read_model(ROOT / "rigs" / horn / "full.glb", out)["meshes"]
    parts: list[Metal] = []
    for node in dict.fromkeys(mesh["name"] for mesh in meshes if mesh["name"] != "mute"):
        sampled = [sample(mesh, chance) for mesh in meshes if mesh["name"] == node]
        points, normals = (np.concatenate(arrays) for arrays in zip(*sampled, strict=True))
        part = moving.get(node)
        travel = np.zeros(3) if part is None or part.travel is None else part.travel
        parts.append(Metal(cKDTree(points), points, normals, travel, part.parameter if part else None))
    return parts


@pytest.fixture(scope="module", params=HOLDS, ids="-".join)
def hands(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Hands:
    name, horn = request.param
    folder = tmp_path_factory.mktemp("models")
    skin = read_cloths(name, folder / "player.json")["Skin"]
    names = np.array(load_rig(ROOT / "rigs" / name).skeleton.names)
    bones = names[skin.joints[np.arange(len(skin.positions)), skin.weights.argmax(axis=1)]]
    kept = np.array([any(part in bone for part in ("Hand", *FINGERS)) for bone in bones])
    skin = skin.only(kept)
    frames: list[tuple[Array, Array]] = []
    amounts: list[dict[str, float]] = []
    for score, times in PLAYED.items():
        played = play(name, ROOT / "examples/scores" / score, times, horn)
        for frame, matrices in enumerate(played.matrices):
            places, normals = skin.posed(matrices)
            turn = played.instrument_turns[frame]
            frames.append(((places - played.instrument_places[frame]) @ turn, normals @ turn))
            amounts.append({path: float(values[frame]) for path, values in played.parameters.items()})
    return Hands(name, horn, bones[kept], frames, read_metal(horn, folder / "horn.json"), amounts)


def test_what_is_played_has_every_fingering(hands: Hands) -> None:
    down = {
        tuple(amounts[f"{hands.horn}/valve/{valve}"] > 0.5 for valve in (1, 2, 3))
        for amounts in hands.amounts
    }
    assert len(down) >= 7  # the third valve alone is an alternate
    assert max(amounts[f"{hands.horn}/slide/3"] for amounts in hands.amounts) > 0.5
    half = [0.2 < amounts[f"{hands.horn}/valve/{v}"] < 0.8 for amounts in hands.amounts for v in (1, 2, 3)]
    assert sum(half) >= 5


def test_no_finger_is_in_metal(hands: Hands) -> None:
    """Two and a half millimetres deep in flesh is a grip; pads on buttons press less."""
    everywhere = np.ones(len(hands.bones), dtype=np.bool_)
    deepest = hands.deepest(everywhere)
    assert {f"right{finger}Distal" for finger in ("Index", "Middle", "Ring")} <= set(deepest)
    for bone, deep in deepest.items():
        assert deep < PRESS_M, bone
    pads = np.array(
        [bone in ("rightIndexDistal", "rightMiddleDistal", "rightRingDistal") for bone in hands.bones]
    )
    for bone, deep in hands.deepest(pads).items():
        assert deep < PAD_PRESS_M, bone


def test_a_hand_four_millimetres_off_would_be_found(hands: Hands) -> None:
    found = 0.0
    for shift in 0.004 * np.concatenate([np.eye(3), -np.eye(3)]):
        moved = Hands(
            hands.player,
            hands.horn,
            hands.bones,
            [(places + shift, normals) for places, normals in hands.frames[:1]],
            hands.metal,
            hands.amounts[:1],
        )
        deepest = moved.deepest(np.array(["left" in bone for bone in hands.bones]))
        found = max(found, *deepest.values())
    assert found > PRESS_M


def test_no_finger_is_in_another(hands: Hands) -> None:
    """From the middle bones on: nearer the hand, fingers are one skin."""
    finger = np.array([next((part for part in FINGERS if part in bone), "") for bone in hands.bones])
    side = np.array(["left" if "left" in bone else "right" for bone in hands.bones])
    outer = np.array(["Intermediate" in bone or "Distal" in bone for bone in hands.bones])
    outer |= np.array([bone.endswith("ThumbDistal") for bone in hands.bones])
    judged = 0
    for places, normals in hands.frames:
        for which in ("left", "right"):
            for own in FINGERS:
                mine = outer & (finger == own) & (side == which)
                others = (finger != own) & (finger != "") & (side == which)
                distance, index = cKDTree(places[others]).query(
                    places[mine], k=1, distance_upper_bound=NEAR_M
                )
                near = distance < NEAR_M
                index = index[near]
                apart = ((places[mine][near] - places[others][index]) * normals[others][index]).sum(axis=1)
                judged += len(apart)
                assert apart.min(initial=1.0) > 0.0, (which, own)
        left, right = cKDTree(places[side == "left"]), places[side == "right"]
        assert left.query(right, k=1, distance_upper_bound=NEAR_M)[0].min() > 0.004
    assert judged > 100 * len(hands.frames)
