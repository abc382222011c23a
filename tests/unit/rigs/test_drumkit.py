"""The drum kit and its sticks: sizes, places, zones on the surfaces, nothing through anything else."""

from __future__ import annotations

import itertools
import json
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from tests.unit.rigs.skinned import ROOT, Array, read_model, shaped
from tests.unit.rigs.test_rigs import TIERS, read_gltf, read_rig

from reina.rotations import rotate
from reina.skeleton import Rig, RigError, forward_kinematics, load_rig

if TYPE_CHECKING:
    from pathlib import Path

    from reina.skeleton import Capsule, Cylinder

INCH = 0.0254
DRUM_INCHES = {"snare": 14, "kick": 22, "tom_high": 10, "tom_mid": 12, "tom_floor": 16}
CYMBAL_INCHES = {"hi_hat": 14, "ride": 20, "crash_left": 16, "crash_right": 18, "china": 16, "splash": 10}
ZONES = (
    {("kick", "centre"), ("cowbell", "centre"), ("cowbell", "edge")}
    | {(drum, zone) for drum in DRUM_INCHES if drum != "kick" for zone in ("centre", "edge", "rim")}
    | {(cymbal, zone) for cymbal in CYMBAL_INCHES for zone in ("bow", "bell", "edge")}
)
SHOULDERS = {"left": np.array([0.158, 1.01, 0.04]), "right": np.array([-0.158, 1.01, 0.04])}
"""Of the trumpeter on the stool, metres in the kit's frame."""
ARM_M = 0.59
"""From the shoulder to the grip of the straight arm."""
JOINED = {
    frozenset(pair)
    for pair in (
        ("kick", "tom_mount"),
        ("hi_hat", "hi_hat_stand"),
        ("ride", "ride_stand"),
        ("crash_left", "crash_left_stand"),
        ("crash_right", "crash_right_stand"),
        ("china", "china_stand"),
    )
}
"""What is held by what, and so touches it."""


@pytest.fixture(scope="module")
def kit() -> Rig:
    return load_rig(ROOT / "rigs/drumkit")


@pytest.fixture(scope="module")
def at_rest(kit: Rig) -> tuple[Array, Array]:
    """Places and turns of the joints."""
    return forward_kinematics(kit.skeleton, kit.skeleton.rest_rotations)


def solid(piece: Capsule | Cylinder, at_rest: tuple[Array, Array]) -> tuple[Array, Array, float]:
    places, turns = at_rest
    start, end = (places[piece.joint] + rotate(turns[piece.joint], p) for p in (piece.start, piece.end))
    return start, end, piece.radius


def test_the_kit_has_every_piece_and_zone(kit: Rig) -> None:
    assert set(kit.zones) == ZONES


def test_notes_come_to_it_over_the_toms_and_before_the_bass_drum() -> None:
    contacts = {item["name"]: item["offset"] for item in read_rig("drumkit")["contacts"]}
    shells = {item["piece"]: item for item in read_rig("drumkit")["cylinders"] if item["joint"] == "kit"}
    toms = [shells[f"tom_{name}"]["from"] for name in ("high", "mid")]
    assert contacts["lane"][1] > max(tom[1] for tom in toms) + 0.2
    assert min(tom[0] for tom in toms) < contacts["lane"][0] < max(tom[0] for tom in toms)
    np.testing.assert_allclose(contacts["lane_kick"], shells["kick"]["to"], atol=1e-6)


def test_a_zone_that_is_not_there_is_named_with_those_that_are(kit: Rig) -> None:
    with pytest.raises(RigError, match=r"no zone 'bell' of 'snare'.*snare rim"):
        kit.zone("snare", "bell")


@pytest.mark.parametrize(
    ("tier", "off_m", "off_deg"), [("full", 0.001, 4), ("medium", 0.002, 20), ("low", 0.003, 90)]
)
def test_zones_lie_on_the_surface_and_look_out_of_it(
    kit: Rig, at_rest: tuple[Array, Array], tier: str, off_m: float, off_deg: float, tmp_path: Path
) -> None:
    """On the low tier a hoop's edge is no longer round: there the place alone counts."""
    corners, normals = triangles_of(read_model(ROOT / f"rigs/drumkit/{tier}.glb", tmp_path / "model.json"))
    places, turns = at_rest
    for (piece, name), zone in kit.zones.items():
        point = places[zone.joint] + rotate(turns[zone.joint], zone.position)
        out = rotate(turns[zone.joint], zone.normal)
        nearby = np.linalg.norm(corners - point, axis=2).min(axis=1) < 0.16
        nearest, shares = closest_on(corners[nearby], point)
        away = np.linalg.norm(nearest - point, axis=1)
        assert away.min() < off_m, (piece, name, away.min())
        # Of what is as near, what looks the same way: the edge of a hoop has other sides.
        close = away < away.min() + 0.001
        seen = np.einsum("nk,nkj->nj", shares[close], normals[nearby][close])
        seen /= np.linalg.norm(seen, axis=1, keepdims=True)
        angle = np.degrees(np.arccos(np.clip((seen @ out).max(), -1, 1)))
        assert angle < off_deg, (piece, name, angle)


def triangles_of(content: dict[str, Any]) -> tuple[Array, Array]:
    """Corners and normals (T, 3, 3) of all meshes, in the world."""
    corners: list[Array] = []
    normals: list[Array] = []
    for mesh in content["meshes"]:
        place = np.array(mesh["place"]).reshape(4, 4).T
        index = np.array(mesh["triangles"]["values"], dtype=np.int64).reshape(-1, 3)
        corners.append((shaped(mesh["position"]) @ place[:3, :3].T + place[:3, 3])[index])
        normals.append((shaped(mesh["normal"])[:, :3] @ place[:3, :3].T)[index])
    return np.concatenate(corners), np.concatenate(normals)


def closest_on(corners: Array, point: Array) -> tuple[Array, Array]:
    """The nearest point (T, 3) of each triangle, and the shares (T, 3) of its corners."""
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    out = np.cross(b - a, c - a)
    area = np.maximum((out**2).sum(axis=1), 1e-30)
    shares = np.stack(
        [
            (np.cross(c - b, point - b) * out).sum(axis=1) / area,
            (np.cross(a - c, point - c) * out).sum(axis=1) / area,
            (np.cross(b - a, point - a) * out).sum(axis=1) / area,
        ],
        axis=1,
    )
    inside = np.asarray((shares >= 0).all(axis=1))
    best = np.where(inside[:, None], shares, 0.0)
    found = np.where(
        inside, np.linalg.norm((shares[..., None] * corners).sum(axis=1) - point, axis=1), np.inf
    )
    for k, n in ((0, 1), (1, 2), (2, 0)):
        along = corners[:, n] - corners[:, k]
        t = ((point - corners[:, k]) * along).sum(axis=1) / np.maximum((along**2).sum(axis=1), 1e-30)
        t = np.clip(t, 0, 1)
        on_edge = np.zeros_like(shares)
        on_edge[:, k], on_edge[:, n] = 1 - t, t
        away = np.linalg.norm((on_edge[..., None] * corners).sum(axis=1) - point, axis=1)
        better = away < found
        best[better], found[better] = on_edge[better], away[better]
    return (best[..., None] * corners).sum(axis=1), best


def test_drums_and_cymbals_have_their_sizes(kit: Rig) -> None:
    widest: dict[str | None, float] = {}
    for cylinder in kit.cylinders:
        widest[cylinder.piece] = max(widest.get(cylinder.piece, 0.0), 2 * cylinder.radius)
    for piece, inches in {**DRUM_INCHES, **CYMBAL_INCHES}.items():
        assert widest[piece] == pytest.approx(inches * INCH, abs=0.001), piece


def test_everything_stands_where_a_player_of_the_figures_size_has_it(
    kit: Rig, at_rest: tuple[Array, Array]
) -> None:
    places, turns = at_rest

    def point(piece: str, name: str) -> Array:
        zone = kit.zone(piece, name)
        spot: Array = places[zone.joint] + rotate(turns[zone.joint], zone.position)
        return spot

    assert point("snare", "rim")[1] == pytest.approx(0.65, abs=0.005)
    assert point("hi_hat", "edge")[1] == pytest.approx(0.85, abs=0.02)
    assert point("ride", "bow")[1] == pytest.approx(0.95, abs=0.02)
    assert all(1.05 < point(f"crash_{side}", "edge")[1] < 1.3 for side in ("left", "right"))
    assert kit.contact("seat").offset[1] == 0.5
    # Right-handed: the hi-hat is at the player's left (+X), ride and floor tom at the right.
    assert point("hi_hat", "bow")[0] > 0.25
    assert point("ride", "bow")[0] < -0.4
    assert point("tom_floor", "centre")[0] < point("tom_mid", "centre")[0] < point("tom_high", "centre")[0]
    stick = load_rig(ROOT / "rigs/left_stick").effector("leftStickTip").offset[2]
    for piece, name in kit.zones:
        if piece != "kick":
            near = min(float(np.linalg.norm(point(piece, name) - at)) for at in SHOULDERS.values())
            assert near < ARM_M - 0.05 + stick, (piece, name)


def test_every_struck_side_looks_up_or_to_the_player(kit: Rig, at_rest: tuple[Array, Array]) -> None:
    _, turns = at_rest
    for (piece, name), zone in kit.zones.items():
        out = rotate(turns[zone.joint], zone.normal)
        assert out[2] < -0.9 if piece == "kick" else out[1] > 0.5, (piece, name)


def test_no_piece_goes_through_another(kit: Rig, at_rest: tuple[Array, Array]) -> None:
    """By the capsules and cylinders of rig.json, sampled: stands, drums, cymbals, pedals and stool."""
    capsules = [(c.piece, *solid(c, at_rest)) for c in kit.capsules]
    cylinders = [(c.piece, *solid(c, at_rest)) for c in kit.cylinders]
    for piece, start, end, radius in capsules:
        points = start + (end - start) * np.linspace(0, 1, 40)[:, None]
        for other, low, high, wide in cylinders:
            if piece != other and frozenset((str(piece), str(other))) not in JOINED:
                assert outside(points, low, high, wide).min() > radius, (piece, other)
    for (piece, a, b, radius), (other, c, d, wide) in itertools.combinations(capsules, 2):
        if piece == other or frozenset((str(piece), str(other))) in JOINED:
            continue
        if np.linalg.norm((a + b - c - d) / 2) > (np.linalg.norm(b - a) + np.linalg.norm(d - c)) / 2 + 0.1:
            continue
        p, q = (s + (e - s) * np.linspace(0, 1, 40)[:, None] for s, e in ((a, b), (c, d)))
        assert np.linalg.norm(p[:, None] - q, axis=2).min() > radius + wide, (piece, other)


def outside(points: Array, low: Array, high: Array, radius: float) -> Array:
    """How far points lie outside of a cylinder (N,), metres; 0 inside."""
    length = float(np.linalg.norm(high - low))
    axis = (high - low) / length
    along = (points - low) @ axis
    away = np.linalg.norm(points - low - along[:, None] * axis, axis=1)
    return np.hypot(np.maximum(np.maximum(-along, along - length), 0), np.maximum(away - radius, 0))


def test_the_beater_meets_the_head_at_its_limit(kit: Rig, at_rest: tuple[Array, Array]) -> None:
    joint = kit.skeleton.index("kick_beater")
    places, turns = at_rest
    _, high = (kit.limits[joint].minimum[0], kit.limits[joint].maximum[0])
    forward = np.array([np.sin(high / 2), 0.0, 0.0, np.cos(high / 2)])
    felt = places[joint] + rotate(turns[joint], rotate(forward, kit.contact("beater").offset))
    assert np.linalg.norm(felt - kit.zone("kick", "centre").position) < 0.001


def test_the_hi_hat_closes_at_its_parameters_one(kit: Rig, at_rest: tuple[Array, Array]) -> None:
    part = next(part for part in kit.parts if part.parameter == "drums/hi_hat/pedal")
    assert part.travel is not None
    top = kit.skeleton.index("hi_hat_top")
    under = max(
        solid(c, at_rest)[1][1]
        for c in kit.cylinders
        if c.piece == "hi_hat" and c.joint == kit.skeleton.index("kit")
    )
    edge = kit.zone("hi_hat", "edge").position[1] + at_rest[0][top][1]
    assert edge + part.travel[1] - under == pytest.approx(0.0, abs=0.003)


def test_feet_find_the_pedals_with_the_knees_bent(kit: Rig, at_rest: tuple[Array, Array]) -> None:
    """Hips over the stool, thigh and shin as long as the trumpeter's, the ball of the foot on the board."""
    thigh, shin, ankle = 0.384, 0.4185, np.array([0.0, 0.083, -0.107])
    places, turns = at_rest
    for side, hip_x in (("left", 0.092), ("right", -0.092)):
        ball = kit.contact(f"{side}Pedal")
        joint = places[ball.joint] + rotate(turns[ball.joint], ball.offset + ankle)
        reach = float(np.linalg.norm(joint - [hip_x, 0.58, 0.0]))
        knee = np.degrees(np.arccos((thigh**2 + shin**2 - reach**2) / (2 * thigh * shin)))
        assert 92 < knee < 115, side


@pytest.mark.parametrize("side", ["left", "right"])
def test_a_stick_is_a_5a_held_a_third_from_its_butt(side: str) -> None:
    rig = load_rig(ROOT / f"rigs/{side}_stick")
    assert rig.skeleton.names == (f"{side}Stick",)
    tip, butt = rig.effector(f"{side}StickTip").offset, rig.contact("butt").offset
    gltf = read_gltf(ROOT / f"rigs/{side}_stick/full.glb")
    bounds = [
        gltf["accessors"][p["attributes"]["POSITION"]] for mesh in gltf["meshes"] for p in mesh["primitives"]
    ]
    low, high = np.min([b["min"] for b in bounds], axis=0), np.max([b["max"] for b in bounds], axis=0)
    assert high[2] - low[2] == pytest.approx(0.406, abs=0.001)
    assert high[0] - low[0] == pytest.approx(0.0144, abs=0.0003)
    assert -butt[2] == pytest.approx(0.406 / 3, abs=0.002)
    assert low[2] == pytest.approx(butt[2], abs=1e-4)
    assert 0 < high[2] - tip[2] < 0.012
    assert tip[1] == pytest.approx(-0.0048, abs=1e-6), "the underside of the bead"


def test_models_keep_to_their_budgets() -> None:
    models = json.loads((ROOT / "rigs/validation.json").read_text(encoding="utf-8"))["models"]
    most = {"full": (1_200_000, 110_000), "medium": (650_000, 46_000), "low": (350_000, 18_500)}
    for tier, (most_bytes, triangles) in most.items():
        said = models[f"drumkit/{tier}.glb"]
        assert said["bytes"] <= most_bytes
        assert said["triangles"] <= triangles
        assert models[f"left_stick/{tier}.glb"]["bytes"] <= 16_000
    assert (ROOT / "rigs/left_stick/full.glb").stat().st_size == models["left_stick/full.glb"]["bytes"]


@pytest.mark.parametrize("tier", TIERS)
def test_a_kit_is_drawn_in_few_calls(tier: str) -> None:
    """Meshes of one material become one call in the page, the moving ones as well."""
    gltf = read_gltf(ROOT / f"rigs/drumkit/{tier}.glb")
    kinds = {
        (primitive["material"], *sorted(primitive["attributes"]))
        for mesh in gltf["meshes"]
        for primitive in mesh["primitives"]
    }
    assert len(kinds) <= 12


def test_parts_move_nodes_of_the_models_along_the_way_in(kit: Rig) -> None:
    names = {node["name"] for node in read_gltf(ROOT / "rigs/drumkit/full.glb")["nodes"]}
    assert {part.node for part in kit.parts} <= names
    for drum in DRUM_INCHES:
        part = next(part for part in kit.parts if part.parameter == f"drums/{drum}/head")
        assert part.travel is not None
        assert part.travel @ kit.zone(drum, "centre").normal < 0, drum


def test_every_solid_says_of_which_piece_it_is() -> None:
    rig = read_rig("drumkit")
    assert all(entry.get("piece") for kind in ("capsules", "cylinders") for entry in rig[kind])


def test_the_left_handed_kit_is_the_mirror_image(kit: Rig, at_rest: tuple[Array, Array]) -> None:
    """Every place of it, in the world: joints, zones, contacts, solids, and the way of every part."""
    left = load_rig(ROOT / "rigs/drumkit_left_handed")
    own = forward_kinematics(left.skeleton, left.skeleton.rest_rotations)
    across = np.array([-1.0, 1.0, 1.0])

    def put(joint: int, offset: Array, rest: tuple[Array, Array]) -> Array:
        spot: Array = rest[0][joint] + rotate(rest[1][joint], offset)
        return spot

    assert left.skeleton.names == kit.skeleton.names
    assert own[0] == pytest.approx(at_rest[0] * across, abs=1e-8)
    assert set(left.zones) == set(kit.zones)
    for key, zone in kit.zones.items():
        other = left.zones[key]
        assert (other.joint, other.radius) == (zone.joint, zone.radius)
        assert put(other.joint, other.position, own) == pytest.approx(
            put(zone.joint, zone.position, at_rest) * across, abs=1e-8
        )
        normal = rotate(at_rest[1][zone.joint], zone.normal) * across
        assert rotate(own[1][other.joint], other.normal) == pytest.approx(normal, abs=1e-8)
    for name, contact in kit.contacts.items():
        swapped = name.replace("left", "*").replace("right", "left").replace("*", "right")
        other = left.contact(swapped)
        assert put(other.joint, other.offset, own) == pytest.approx(
            put(contact.joint, contact.offset, at_rest) * across, abs=1e-8
        )
    for solids, others in ((kit.capsules, left.capsules), (kit.cylinders, left.cylinders)):
        for one, other in zip(solids, others, strict=True):
            assert (other.piece, other.radius) == (one.piece, one.radius)
            for end, other_end in ((one.start, other.start), (one.end, other.end)):
                assert put(other.joint, other_end, own) == pytest.approx(
                    put(one.joint, end, at_rest) * across, abs=1e-8
                )
    for part, other in zip(kit.parts, left.parts, strict=True):
        assert (other.node, other.parameter) == (part.node, part.parameter)
        assert part.travel is not None
        assert other.travel == pytest.approx(part.travel * across, abs=1e-9)
    for joint, limits in kit.limits.items():
        (low_x, low_y, low_z), (high_x, high_y, high_z) = limits.minimum, limits.maximum
        assert left.limits[joint].minimum == pytest.approx((low_x, -high_y, -high_z))
        assert left.limits[joint].maximum == pytest.approx((high_x, -low_y, -low_z))


@pytest.mark.parametrize("tier", TIERS)
def test_the_left_handed_models_are_the_mirror_images(tier: str, tmp_path: Path) -> None:
    right, left = (
        triangles_of(read_model(ROOT / f"rigs/{name}/{tier}.glb", tmp_path / f"{name}.json"))
        for name in ("drumkit", "drumkit_left_handed")
    )
    across = np.array([-1.0, 1.0, 1.0])
    assert len(right[0]) == len(left[0]) > 10_000
    for one, other in zip(right, left, strict=True):
        first, second = (part.reshape(len(part), -1) for part in (one * across, other))
        first, second = (np.round(part, 5)[np.lexsort(np.round(part, 5).T)] for part in (first, second))
        assert np.abs(first - second).max() < 1e-3
