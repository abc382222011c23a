"""The committed rigs: their form, and that their models and their hold agree with rig.json."""

from __future__ import annotations

import json
import struct
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from reina.instruments import INSTRUMENTS

RIGS = Path(__file__).resolve().parents[3] / "rigs"
PLAYERS = ("trumpeter", "soloist")
HORNS = tuple(name for name, instrument in INSTRUMENTS.items() if instrument.rig and instrument.valve_count)
KIT = ("drumkit", "drumkit_left_handed", "left_stick", "right_stick")
NAMES = (*PLAYERS, *HORNS, *KIT)
TIERS = ("full", "medium", "low")
FINGERS = ("Index", "Middle", "Ring", "Little")
PHALANGES = ("Proximal", "Intermediate", "Distal")


def read_rig(name: str) -> dict[str, Any]:
    content: dict[str, Any] = json.loads((RIGS / name / "rig.json").read_text(encoding="utf-8"))
    return content


def read_gltf(path: Path) -> dict[str, Any]:
    """The JSON chunk of a binary glTF file."""
    data = path.read_bytes()
    magic, version, _ = struct.unpack_from("<III", data)
    length, kind = struct.unpack_from("<II", data, 12)
    assert (magic, version, kind) == (0x46546C67, 2, 0x4E4F534A)
    content: dict[str, Any] = json.loads(data[20 : 20 + length])
    return content


@pytest.mark.parametrize("name", NAMES)
def test_names_are_unique_and_parents_come_first(name: str) -> None:
    seen: set[str] = set()
    for joint in read_rig(name)["joints"]:
        assert joint["name"] not in seen
        assert joint["parent"] is None if not seen else joint["parent"] in seen
        seen.add(joint["name"])


@pytest.mark.parametrize("name", NAMES)
def test_rest_pose_is_finite_and_its_quaternions_unit(name: str) -> None:
    for joint in read_rig(name)["joints"]:
        assert np.isfinite(joint["translation"]).all()
        assert np.linalg.norm(joint["rotation"]) == pytest.approx(1, abs=1e-8)


@pytest.mark.parametrize("name", NAMES)
def test_everything_that_names_a_joint_names_one_that_is_there(name: str) -> None:
    rig = read_rig(name)
    joints = {joint["name"] for joint in rig["joints"]}
    effectors = {effector["name"] for effector in rig["effectors"]}
    assert {item["joint"] for kind in ("effectors", "contacts", "capsules") for item in rig[kind]} <= joints
    assert {joint for chain in rig["chains"] for joint in chain["joints"]} <= joints
    assert {chain["effector"] for chain in rig["chains"] if "effector" in chain} <= effectors
    assert {twist[end] for twist in rig.get("twists", []) for end in ("joint", "source")} <= joints
    offsets = [item["offset"] for kind in ("effectors", "contacts") for item in rig[kind]]
    assert not offsets or np.isfinite(offsets).all()


@pytest.mark.parametrize("name", NAMES)
def test_limits_hold_the_rest_pose(name: str) -> None:
    for joint in read_rig(name)["joints"]:
        limits = joint.get("limits")
        if limits:
            assert sorted(limits["order"]) == ["x", "y", "z"]
            assert all(limits[axis][0] <= 1e-9 and limits[axis][1] >= -1e-9 for axis in "xyz"), joint["name"]


@pytest.mark.parametrize("side", ["left", "right"])
@pytest.mark.parametrize("finger", FINGERS)
def test_fingers_are_planar_chains(side: str, finger: str) -> None:
    rig = read_rig("trumpeter")
    joints = {joint["name"]: joint for joint in rig["joints"]}
    for part in PHALANGES[1:]:
        joint = joints[f"{side}{finger}{part}"]
        assert joint["translation"][0] > 0.01
        assert np.abs(joint["translation"][1:]).max() < 1e-8
        assert np.abs(joint["rotation"][:2]).max() < 1e-8, "the rest rotation is about Z alone"
    tip = next(e for e in rig["effectors"] if e["name"] == f"{side}{finger}Tip")
    assert tip["joint"] == f"{side}{finger}Distal"
    assert np.abs(tip["offset"][1:]).max() < 1e-8
    chain = next(c for c in rig["chains"] if c["name"] == f"{side}{finger}")
    assert chain["joints"] == [f"{side}{finger}{part}" for part in PHALANGES]


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("tier", TIERS)
def test_models_have_each_joint_at_its_rest_transform(name: str, tier: str) -> None:
    gltf = read_gltf(RIGS / name / f"{tier}.glb")
    nodes = {node["name"]: node for node in gltf["nodes"]}
    assert len(nodes) == len(gltf["nodes"]), "node names are unique"
    parents = {
        gltf["nodes"][child]["name"]: node["name"]
        for node in gltf["nodes"]
        for child in node.get("children", [])
    }
    for joint in read_rig(name)["joints"]:
        node = nodes[joint["node"]]
        assert node.get("translation", [0, 0, 0]) == pytest.approx(joint["translation"], abs=1e-6)
        assert node.get("rotation", [0, 0, 0, 1]) == pytest.approx(joint["rotation"], abs=1e-6)
        assert "scale" not in node
        assert "matrix" not in node
        assert parents.get(joint["node"]) == joint["parent"]


@pytest.mark.parametrize("tier", TIERS)
def test_player_has_one_skin_and_all_morphs(tier: str) -> None:
    rig = read_rig("trumpeter")
    gltf = read_gltf(RIGS / "trumpeter" / f"{tier}.glb")
    assert len(gltf["skins"]) == 1
    assert [gltf["nodes"][k]["name"] for k in gltf["skins"][0]["joints"]] == [
        joint["node"] for joint in rig["joints"]
    ]
    targets = {name for mesh in gltf["meshes"] for name in mesh.get("extras", {}).get("targetNames", [])}
    assert {morph["target"] for morph in rig["morphs"]} <= targets


@pytest.mark.parametrize("horn", HORNS)
@pytest.mark.parametrize("tier", TIERS)
def test_instrument_has_the_nodes_of_its_parts(horn: str, tier: str) -> None:
    names = {node["name"] for node in read_gltf(RIGS / horn / f"{tier}.glb")["nodes"]}
    assert {part["node"] for part in read_rig(horn)["parts"]} <= names


@pytest.mark.parametrize("horn", HORNS)
def test_instruments_parts_go_by_its_own_parameters(horn: str) -> None:
    parameters = {part["parameter"] for part in read_rig(horn)["parts"]}
    assert parameters == {parameter.path for parameter in INSTRUMENTS[horn].parameters} | {f"{horn}/mute"}


@pytest.mark.parametrize("horn", HORNS)
def test_valve_one_is_nearest_the_face_and_the_index_fingers(horn: str) -> None:
    instrument = read_rig(horn)
    mouthpiece = next(c["offset"] for c in instrument["contacts"] if c["name"] == "mouthpiece")
    distances = [np.linalg.norm(np.subtract(b["position"], mouthpiece)) for b in instrument["buttons"]]
    assert distances == sorted(distances)
    assert [b["valve"] for b in instrument["buttons"]] == [1, 2, 3]
    assert [b["effector"] for b in instrument["buttons"]] == [
        "rightIndexTip",
        "rightMiddleTip",
        "rightRingTip",
    ]


def test_horns_differ_as_they_should_and_not_in_the_hands() -> None:
    """The cornet and the flugelhorn are shorter than the trumpet; what hands hold is the same on all."""
    rigs = {horn: read_rig(horn) for horn in HORNS}
    at = {
        horn: {contact["name"]: np.array(contact["offset"]) for contact in rig["contacts"]}
        for horn, rig in rigs.items()
    }
    length = {horn: float((places["bell"] - places["mouthpiece"])[2]) for horn, places in at.items()}
    assert 0.40 < length["cornet"] < length["flugelhorn"] < 0.47 < length["trumpet"]
    for horn in ("cornet", "flugelhorn"):
        assert rigs[horn]["buttons"] == rigs["trumpet"]["buttons"]
        for contact in ("ring", "hook", "saddle", "thumb_right", "grip_left"):
            np.testing.assert_array_equal(at[horn][contact], at["trumpet"][contact])
    widest = {horn: bell_diameter(horn) for horn in HORNS}
    assert widest["flugelhorn"] == pytest.approx(0.152, abs=0.004)
    assert widest["cornet"] < widest["trumpet"] < widest["flugelhorn"]


def bell_diameter(horn: str) -> float:
    """How wide the model of an instrument is, metres: no part of it is wider than its bell."""
    gltf = read_gltf(RIGS / horn / "full.glb")
    mesh = next(mesh for mesh in gltf["meshes"] if mesh["name"] == "body")
    bounds = [gltf["accessors"][part["attributes"]["POSITION"]] for part in mesh["primitives"]]
    bell = next(c["offset"] for c in read_rig(horn)["contacts"] if c["name"] == "bell")
    return 2 * float(max(bound["max"][0] for bound in bounds) - bell[0])


def test_models_are_small_and_valid() -> None:
    models = json.loads((RIGS / "validation.json").read_text(encoding="utf-8"))["models"]
    for name in NAMES:
        for tier in TIERS:
            said = models[f"{name}/{tier}.glb"]
            assert (said["errors"], said["warnings"]) == (0, 0)
            assert said["bytes"] == (RIGS / name / f"{tier}.glb").stat().st_size
    assert sum(models[f"{name}/full.glb"]["bytes"] for name in (*PLAYERS, "trumpet")) <= 4_000_000
    assert models["trumpeter/low.glb"]["triangles"] <= 12_000
    for horn in HORNS:
        assert models[f"{horn}/full.glb"]["bytes"] <= 600_000
        assert models[f"{horn}/low.glb"]["triangles"] <= 8_000


@pytest.mark.parametrize("name", NAMES)
def test_licence_and_provenance_stand_beside_the_rig(name: str) -> None:
    assert "CC0" in (RIGS / name / "LICENSE").read_text(encoding="utf-8")
    assert (RIGS / name / "PROVENANCE.md").read_text(encoding="utf-8").strip()
