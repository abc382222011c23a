"""Cloth, skin and fingers keep out of each other in the poses of every example, at sampled vertices.

A vertex is inside a cloth by how far it lies behind the cloth's nearest point, along the normal there; points
are sampled all over the cloth. Where the nearest is on a triangle at a cloth's border, a vertex says nothing:
past an edge there is no inside.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import pytest
from scipy.spatial import cKDTree
from tests.unit.rigs.skinned import EXAMPLES, PLAYERS, ROOT, Array, Cloth, play, read_cloths

from reina.music import read_score
from reina.skeleton import load_rig

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

FRAMES = 6
"""Of each example, evenly spread."""

NEAR_M = 0.02
"""Who is further from a cloth than this is not in touch with it: it is another side of it that is seen."""


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


@pytest.fixture(scope="module", params=PLAYERS)
def model(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Model:
    name = request.param
    cloths = read_cloths(name, tmp_path_factory.mktemp("model") / "model.json")
    poses: list[Array] = []
    for path in EXAMPLES:
        end_s = read_score(path.read_bytes(), filename=path.name).duration_s + 3.0
        poses.extend(play(name, path, np.linspace(0.0, end_s, FRAMES)).matrices)
    return Model(name, cloths, list(load_rig(ROOT / "rigs" / name).skeleton.names), poses)


COAT = {"trumpeter": "Blazer", "soloist": "Jacket"}
LEGS = {"trumpeter": "Skirt", "soloist": "Trousers"}
GRAZE_M = 0.0015
"""What lies under a cloth may come so far out of it: less than the vertices' spacing lets one see."""

NECK_M = 0.03
"""So far below the coat's highest edge it covers what is worn under it, all round the neck."""

CLEAR_M = 0.005
"""Fingers keep at least so far from all cloth."""

UNDER = {
    "trumpeter": (("Skirt", "Blazer"), ("Tights", "Skirt"), ("Tights", "Shoes")),
    "soloist": (("Trousers", "Jacket"), ("Shoes", "Trousers")),
}
COARSE_GRAZE_M = 0.004
"""The lesser tiers' triangles are longer, and seen from further away."""

FEET = {"trumpeter": ("Tights", "Shoes"), "soloist": ("Shoes", "Trousers")}

SEWN_ON = {"Lapels", "Pockets", "Buttons"}

SHIFTS = 0.010 * np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]])


@dataclass(frozen=True)
class Draped:
    """A cloth in a pose: points all over it (N, 3), and the tree that finds the nearest of them."""

    tree: cKDTree
    places: Array
    normals: Array
    border: NDArray[np.bool_]


def drape(cloth: Cloth, pose: Array) -> Draped:
    corners, shares = cloth.samples
    at, facing = cloth.posed(pose)
    places = np.einsum("nk,nkj->nj", shares, at[corners])
    normals = np.einsum("nk,nkj->nj", shares, facing[corners])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    # Asked once or a few times, a tree that is built fast serves better than one that is searched fast.
    tree = cKDTree(places, balanced_tree=False, compact_nodes=False)
    return Draped(tree, places, normals, np.any(cloth.border[corners], axis=1))


def outside(inner: Cloth, outer: Draped, pose: Array, shift: Array | None = None) -> Array:
    """How far each vertex of `inner` is outside of `outer`, metres ``(V,)``; NaN if it is not under it.

    With a `shift`, metres (3,), the outer one hangs so far off.
    """
    points, _ = inner.posed(pose)
    if shift is not None:
        points = points - shift
    # The bound itself would be excluded.
    distance, index = outer.tree.query(points, k=1, distance_upper_bound=np.nextafter(NEAR_M, 1.0))
    under = np.flatnonzero(distance <= NEAR_M)
    under = under[~outer.border[index[under]]]
    nearest = index[under]
    depth: Array = np.full(len(points), np.nan)
    depth[under] = ((points[under] - outer.places[nearest]) * outer.normals[nearest]).sum(axis=1)
    return depth


def most_outside(model: Model, inner: Cloth, outer: str) -> float:
    """How far a vertex comes out of the cloth over it, at most over all poses, metres."""
    worst = -1.0
    judged = 0
    for pose in model.poses:
        depth = outside(inner, drape(model.cloths[outer], pose), pose)
        depth = depth[~np.isnan(depth)]
        judged += len(depth)
        worst = max(worst, float(depth.max(initial=-1.0)))
    assert judged >= len(model.poses), "too little was there to be judged"
    return worst


def found_off(model: Model, inner: Cloth, outer: str, allowed_m: float) -> bool:
    """Whether in any pose a vertex would come further out, were the cloth over it a centimetre off."""
    for pose in model.poses:
        draped = drape(model.cloths[outer], pose)
        for shift in SHIFTS:
            depth = outside(inner, draped, pose, shift)
            if depth[~np.isnan(depth)].max(initial=-1.0) > allowed_m:
                return True
    return False


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
    assert found_off(model, wrists(model), coat, 0.0)


def test_what_is_worn_under_the_coat_stays_under_it(model: Model) -> None:
    coat = COAT[model.player]
    # Beside the opening the shirt lies under the lapels: there they cover it, whatever the coat's edge does.
    # Round the neck it comes out above them.
    shirt, lapels = model.cloths["Shirt"], model.cloths["Lapels"]
    shirt = shirt.only(shirt.positions[:, 1] < model.cloths[coat].positions[:, 1].max() - NECK_M)
    judged = 0
    for pose in model.poses:
        over = (drape(lapels, pose), drape(model.cloths[coat], pose))
        depth = np.fmin(outside(shirt, over[0], pose), outside(shirt, over[1], pose))
        judged += int(np.sum(~np.isnan(depth)))
        assert np.nanmax(depth) < GRAZE_M
    assert judged >= 100 * len(model.poses)
    legs = model.cloths[LEGS[model.player]]
    assert most_outside(model, legs, coat) < GRAZE_M
    assert found_off(model, legs, coat, GRAZE_M)


@pytest.mark.parametrize("tier", ["medium", "low"])
def test_hems_hold_in_the_lesser_tiers(model: Model, tier: str, tmp_path: Path) -> None:
    cloths = read_cloths(model.player, tmp_path / "model.json", tier)
    lesser = Model(model.player, cloths, model.names, model.poses[::6])
    for inner, outer in UNDER[model.player]:
        assert most_outside(lesser, cloths[inner], outer) < COARSE_GRAZE_M, (inner, outer)


def test_feet_are_in_their_shoes_and_shoes_under_the_trousers(model: Model) -> None:
    inner, outer = FEET[model.player]
    assert most_outside(model, model.cloths[inner], outer) < GRAZE_M
    assert found_off(model, model.cloths[inner], outer, GRAZE_M)


def test_what_is_sewn_on_the_coat_faces_as_the_coat_does(model: Model) -> None:
    coat = model.cloths[COAT[model.player]]
    tree = cKDTree(coat.positions)
    for name in SEWN_ON & model.cloths.keys():
        cloth = model.cloths[name]
        distance, index = tree.query(cloth.positions, k=1)
        agree = (cloth.normals * coat.normals[index]).sum(axis=1)
        for half in (cloth.positions[:, 0] > 0, cloth.positions[:, 0] < 0):
            on_it = half & (distance < NEAR_M)
            assert on_it.sum() > 10, name
            assert np.median(agree[on_it]) > 0.5, name


def test_fingers_stay_clear_of_all_cloth(model: Model) -> None:
    fingers = model.cloths["Skin"].only(model.weighted("Skin", "Index", "Middle", "Ring", "Little", "Thumb"))
    assert len(fingers.positions) > 500
    for name, cloth in model.cloths.items():
        if name in ("Skin", "Lashes", "Eyes", "Hair", "Shirt"):
            continue  # the shirt's cuffs are at the wrists, where thumbs begin
        for pose in model.poses:
            tree = cKDTree(cloth.posed(pose)[0], balanced_tree=False, compact_nodes=False)
            # inf where nothing is as near as twice that.
            distance, _ = tree.query(fingers.posed(pose)[0], k=1, distance_upper_bound=2 * CLEAR_M)
            assert distance.min() > CLEAR_M, name
