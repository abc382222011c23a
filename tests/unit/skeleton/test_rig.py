import copy
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from reina.skeleton import RigError, load_hold, load_rig, read_hold, read_rig
from reina.skeleton.document import Node

HALF = [0.0, 0.0, 0.70710678, 0.70710678]
DOCUMENT: dict[str, Any] = {
    "name": "stick",
    "joints": [
        {"name": "hips", "parent": None, "translation": [0, 1, 0], "rotation": [0, 0, 0, 1]},
        {"name": "a", "parent": "hips", "translation": [0, 1, 0], "rotation": HALF, "node": "A"},
        {
            "name": "b",
            "parent": "a",
            "translation": [1, 0, 0],
            "rotation": [0, 0, 0, 1],
            "limits": {"order": "yzx", "x": [0, 0], "y": [-0.5, 0.5], "z": [-1, 1]},
        },
        {"name": "c", "parent": "b", "translation": [1, 0, 0], "rotation": [0, 0, 0, 1]},
    ],
    "effectors": [{"name": "tip", "joint": "c", "offset": [0.5, 0, 0]}],
    "contacts": [{"name": "lips", "joint": "hips", "offset": [0, 0, 0.1]}],
    "capsules": [{"joint": "b", "from": [0, 0, 0], "to": [1, 0, 0], "radius": 0.1}],
    "morphs": [{"parameter": "face/smile", "target": "mouthSmile"}],
    "chains": [
        {
            "name": "finger",
            "joints": ["a", "b", "c"],
            "effector": "tip",
            "solver": "coupled_three_bone",
            "kappa": 0.5,
        }
    ],
    "twists": [{"joint": "c", "source": "b", "fraction": 0.5}],
    "parts": [
        {"node": "valve1", "parameter": "trumpet/valve/1", "travel": [0, -0.0165, 0]},
        {"node": "key", "parameter": "oboe/key/1", "axis": [1, 0, 0], "angle": 0.2},
    ],
    "buttons": [{"valve": 1, "effector": "tip", "position": [0, 0.1, 0], "travel": [0, -0.0165, 0]}],
    "cylinders": [{"piece": "drum", "joint": "a", "from": [0, 0, 0], "to": [0, 0.1, 0], "radius": 0.2}],
    "zones": [
        {
            "piece": "drum",
            "zone": "rim",
            "joint": "a",
            "position": [0, 0.1, 0.2],
            "normal": [0, 1, 0],
            "radius": 0,
        },
        {
            "piece": "drum",
            "zone": "edge",
            "joint": "a",
            "position": [0, 0.1, 0.1],
            "normal": [0, 0, 1],
            "radius": 0.1,
        },
    ],
}


def test_everything_in_the_document_is_read() -> None:
    rig = read_rig(Node(copy.deepcopy(DOCUMENT)))
    assert rig.name == "stick"
    assert rig.skeleton.names == ("hips", "a", "b", "c")
    assert rig.nodes == ("hips", "A", "b", "c")
    assert rig.skeleton.parents.tolist() == [-1, 0, 1, 2]
    np.testing.assert_allclose(np.linalg.norm(rig.skeleton.rest_rotations, axis=1), 1.0, atol=1e-15)
    assert rig.effector("tip").joint == 3
    assert rig.contact("lips").offset.tolist() == [0, 0, 0.1]
    chain = rig.chain_of_effector("tip")
    assert (chain.name, chain.joints, chain.solver, chain.kappa) == (
        "finger",
        (1, 2, 3),
        "coupled_three_bone",
        0.5,
    )
    assert rig.limits[2].order == "yzx"
    assert rig.limits[2].minimum == (0.0, -0.5, -1.0)
    assert rig.limits[2].maximum == (0.0, 0.5, 1.0)
    assert set(rig.limits) == {2}
    assert (rig.twists[0].joint, rig.twists[0].source, rig.twists[0].fraction) == (3, 2, 0.5)
    assert rig.morphs[0].parameter == "face/smile"
    assert rig.capsules[0].radius == 0.1
    assert rig.parts[1].angle_rad == 0.2
    assert rig.buttons[0].travel.tolist() == [0, -0.0165, 0]
    assert (rig.capsules[0].piece, rig.cylinders[0].piece) == (None, "drum")
    assert rig.cylinders[0].end.tolist() == [0, 0.1, 0]
    rim = rig.zone("drum", "rim")
    assert (rim.joint, rim.position.tolist(), rim.normal.tolist(), rim.radius) == (
        1,
        [0, 0.1, 0.2],
        [0, 1, 0],
        0,
    )


BREAKS: list[tuple[list[Any], Any, str]] = [
    (["joints", 1, "parent"], "d", "joints/1/parent: 'a' has the parent 'd'"),
    (["joints", 1, "rotation"], [0, 0, 0, 2], "joints/1/rotation: quaternions are unit"),
    (["joints", 1, "rotation"], [0, 0, 1], "joints/1/rotation: here belongs a list of 4 numbers, not of 3"),
    (["joints", 2, "translation", 1], "high", "joints/2/translation/1: here belongs a number, not a string"),
    (["joints", 2, "translation", 1], float("nan"), "joints/2/translation/1: here belongs a finite number"),
    (["joints", 2, "limits", "order"], "abc", "joints/2/limits/order: Euler order 'abc'"),
    (["joints", 2, "limits", "y"], [0.5, -0.5], "joints/2/limits/y: the least angle"),
    (["effectors", 0, "joint"], "d", "effectors/0/joint: there is no joint 'd'"),
    (["chains", 0, "solver"], "magic", "chains/0/solver: solver 'magic' is not known"),
    (["chains", 0, "joints"], ["a", "b"], "chains/0/joints: coupled_three_bone needs 3 joints, not 2"),
    (["chains", 0, "joints"], ["a", "c", "b"], "chains/0/joints: 'c' is no child of 'a'"),
    (["chains", 0, "effector"], "nose", "chains/0/effector: there is no effector 'nose'"),
    (["twists", 0, "fraction"], True, "twists/0/fraction: here belongs a number, not true or false"),
    (["parts", 1, "axis"], None, "parts/1: a part needs 'travel', or 'axis' and 'angle'"),
    (["buttons", 0, "valve"], 0, "buttons/0/valve: valves are numbered from 1"),
    (["zones", 1, "zone"], "rim", "zones/1/zone: 'drum' has the zone 'rim' twice"),
    (["zones", 1, "normal"], [0, 0, 2], "zones/1/normal: a normal has length 1, not 2"),
    (["zones", 1, "radius"], -0.1, "zones/1/radius: a zone's radius is at least 0, not -0.1"),
    (["zones", 1, "joint"], "d", "zones/1/joint: there is no joint 'd'"),
    (["cylinders", 0, "to"], [0, 1], "cylinders/0/to: here belongs a list of 3 numbers, not of 2"),
    (["joints"], None, "at least one joint"),
    (["joints"], {}, "joints: here belongs a list, not an object"),
    (["name"], 3, "name: here belongs a string, not a number"),
]


@pytest.mark.parametrize(("path", "value", "message"), BREAKS)
def test_a_fault_is_named_with_its_place(path: list[Any], value: object, message: str) -> None:
    document = copy.deepcopy(DOCUMENT)
    place: Any = document
    for key in path[:-1]:
        place = place[key]
    place[path[-1]] = value
    with pytest.raises(RigError) as caught:
        read_rig(Node(document))
    assert message in str(caught.value)


def test_what_is_missing_is_named() -> None:
    document = copy.deepcopy(DOCUMENT)
    del document["chains"][0]["kappa"]
    with pytest.raises(RigError, match="chains/0: coupled_three_bone needs 'kappa'"):
        read_rig(Node(document))
    del document["joints"]
    with pytest.raises(RigError, match="'joints' is missing"):
        read_rig(Node(document))
    with pytest.raises(RigError, match="there is no effector 'nose'; there are: tip"):
        read_rig(Node(copy.deepcopy(DOCUMENT))).effector("nose")


def test_rigs_and_holds_load_from_a_folder(tmp_path: Path) -> None:
    (tmp_path / "holds").mkdir()
    (tmp_path / "rig.json").write_text(json.dumps(DOCUMENT))
    hold = {
        "instrument": "stick",
        "player": "stick",
        "pose": {"b": HALF},
        "instrument_pose": {"position": [0, 1, 2], "rotation": [0, 0, 0, 1]},
        "hips": [0, 0.9, 0],
    }
    (tmp_path / "holds" / "stick.json").write_text(json.dumps(hold))
    rig = load_rig(tmp_path)
    loaded = load_hold(tmp_path, "stick")
    rotations = loaded.rotations(rig)
    np.testing.assert_allclose(rotations[2], HALF, atol=1e-8)
    np.testing.assert_array_equal(rotations[3], [0, 0, 0, 1])
    assert loaded.hips_position is not None
    assert loaded.hips_position.tolist() == [0, 0.9, 0]
    with pytest.raises(RigError, match=r"no file flute\.json"):
        load_hold(tmp_path, "flute")
    (tmp_path / "rig.json").write_text("{")
    with pytest.raises(RigError, match=r"rig\.json: this is not JSON"):
        load_rig(tmp_path)
    (tmp_path / "rig.json").write_text("[" * 100_000)
    with pytest.raises(RigError, match=r"rig\.json: this is not JSON"):
        load_rig(tmp_path)
    document = copy.deepcopy(DOCUMENT)
    document["joints"][0]["translation"] = [0, 10**400, 0]
    (tmp_path / "rig.json").write_text(json.dumps(document))
    with pytest.raises(RigError, match="joints/0/translation/1: here belongs a finite number"):
        load_rig(tmp_path)
    (tmp_path / "rig.json").write_text("[]")
    with pytest.raises(RigError, match="here belongs an object, not a list"):
        load_rig(tmp_path)


def grip_keys(*shares: float) -> dict[str, object]:
    """A hold with one grip, whose first key turns b and whose others turn nothing more."""
    keys = [
        {"share": share, "pose": {}, "attachments": {}, "points": {"stick": [0, share, 0]}}
        for share in shares
    ]
    keys[0]["pose"] = {"b": HALF}
    pose = {"position": [0, 0, 0], "rotation": [0, 0, 0, 1]}
    return {"instrument": "x", "player": "y", "pose": {}, "instrument_pose": pose, "grips": {"hook": keys}}


def test_a_joint_that_a_grips_key_leaves_out_is_as_in_the_key_before() -> None:
    keys = read_hold(Node(grip_keys(0.0, 0.4, 1.0))).grips["hook"]
    assert [key.share for key in keys] == [0.0, 0.4, 1.0]
    assert all(key.pose["b"] == pytest.approx(HALF) for key in keys)
    assert keys[1].points["stick"].tolist() == [0, 0.4, 0]


@pytest.mark.parametrize("shares", [(0.0,), (0.1, 1.0), (0.0, 0.5, 0.5, 1.0), (0.0, 0.9)])
def test_the_keys_of_a_grip_go_from_none_of_it_to_all(shares: tuple[float, ...]) -> None:
    with pytest.raises(RigError, match="begin at 0 and grow to 1"):
        read_hold(Node(grip_keys(*shares)))


@pytest.mark.parametrize("name", ["trumpeter", "trumpet"])
def test_the_shipped_rigs_load(name: str) -> None:
    rig = load_rig(Path(__file__).parents[3] / "rigs" / name)
    assert rig.name == name
    assert len(rig.nodes) == len(rig.skeleton)


def test_the_shipped_hold_names_joints_of_its_rig() -> None:
    folder = Path(__file__).parents[3] / "rigs" / "trumpeter"
    hold = load_hold(folder, "trumpet")
    assert (hold.player, hold.instrument) == ("trumpeter", "trumpet")
    rotations = hold.rotations(load_rig(folder))
    np.testing.assert_allclose(np.linalg.norm(rotations, axis=1), 1.0, atol=1e-12)
