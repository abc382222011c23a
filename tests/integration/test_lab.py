"""The laboratory over HTTP: what it answers is checked by numbers, against formulas written anew here."""

from __future__ import annotations

import base64
import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from reina.rotations import from_euler, multiply, rotate

if TYPE_CHECKING:
    import httpx
    from numpy.typing import NDArray

LAB = "/api/v1/lab"
CLIPS = Path(__file__).parents[2] / "rigs" / "trumpeter" / "clips"
CASES = Path(__file__).parents[1] / "cases"
BVH = """HIERARCHY
ROOT hips
{
  OFFSET 0 90 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT spine
  {
    OFFSET 0 20 0
    CHANNELS 3 Zrotation Xrotation Yrotation
    End Site
    {
      OFFSET 0 30 0
    }
  }
}
MOTION
Frames: 2
Frame Time: 0.04
0 90 0 0 0 0 0 0 0
5 90 0 90 0 0 0 0 0
"""


def answer(client: httpx.Client, path: str, **body: Any) -> dict[str, Any]:
    response = client.post(f"{LAB}/{path}", json=body)
    assert response.status_code == 200, response.text
    return response.json()


def refusal(response: httpx.Response, status: int, kind: str) -> dict[str, Any]:
    assert response.status_code == status, response.text
    assert response.headers["content-type"] == "application/problem+json"
    body: dict[str, Any] = response.json()
    assert body["type"] == f"urn:reina:problem:{kind}"
    return body


def chain_of(client: httpx.Client, name: str) -> dict[str, Any]:
    chains = client.get(f"{LAB}/chains").json()["chains"]
    return next(chain for chain in chains if chain["name"] == name)


def end_of(client: httpx.Client, chain: str, angles: list[float]) -> NDArray[np.float64]:
    """Where the end is, by forward kinematics from the rig's own description."""
    rig = client.get("/api/v1/rigs/trumpeter").json()
    joints = {joint["name"]: joint for joint in rig["joints"]}
    described = next(one for one in rig["chains"] if one["name"] == chain)
    names: list[str] = list(described["joints"])
    if effector := described.get("effector"):
        tip = next(one["offset"] for one in rig["effectors"] if one["name"] == effector)
    else:
        tip = joints[names.pop()]["translation"]
    place, turn = np.zeros(3), np.array([0.0, 0.0, 0.0, 1.0])
    left = list(angles)
    for name in names:
        joint = joints[name]
        place = place + rotate(turn, joint["translation"])
        turn = multiply(turn, joint["rotation"])
        limits = joint["limits"]
        for letter in limits["order"]:
            if limits[letter][0] < limits[letter][1]:
                turn = multiply(turn, from_euler(np.array([left.pop(0)]), letter))
    assert left == []
    return place + rotate(turn, tip)


def test_slerp_is_even_and_the_others_are_not(client: httpx.Client) -> None:
    found = answer(
        client,
        "interpolations",
        start={"kind": "euler", "order": "zyx", "angles_rad": np.radians([80, -20, -50]).tolist()},
        end={"kind": "euler", "order": "zyx", "angles_rad": np.radians([-60, 80, 80]).tolist()},
        samples=101,
        tip=[0, 1, 0],
    )
    ways = {way["name"]: way for way in found["ways"]}
    assert list(ways) == ["slerp", "matrix", "euler", "rotation_vector"]
    assert np.degrees(found["angle_rad"]) == pytest.approx(141.1, abs=0.1)
    # A step's angle, from the dot product of its quaternions.
    slerp = np.array(ways["slerp"]["quaternions"])
    steps = 2 * np.arccos(np.abs(np.sum(slerp[1:] * slerp[:-1], axis=1)))
    np.testing.assert_allclose(steps, found["angle_rad"] / 100, rtol=1e-6)
    np.testing.assert_allclose(ways["slerp"]["speed"], found["angle_rad"], rtol=1e-9)
    assert ways["euler"]["fastest"] / ways["euler"]["slowest"] > 1.5
    assert ways["matrix"]["fastest"] / ways["matrix"]["slowest"] > 8
    for name in ("euler", "rotation_vector"):
        assert ways[name]["length_rad"] > 1.5 * found["angle_rad"]
        assert max(ways[name]["orthogonality_error"]) < 1e-12
    columns = np.array(ways["matrix"]["axes"])
    np.testing.assert_allclose(np.linalg.det(columns), ways["matrix"]["determinant"], atol=1e-12)
    assert min(ways["matrix"]["determinant"]) < 0.2
    np.testing.assert_allclose(columns[:, 1], ways["matrix"]["tip"], atol=1e-12)
    assert len(found["fractions"]) == 101
    assert len(ways["slerp"]["speed"]) == 100


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ({"end": {"kind": "axis_angle", "axis": [0, 0, 0], "angle_rad": 1}}, "end/axis: its length is zero"),
        ({"euler_order": "xxz"}, "euler_order"),
        ({"samples": 1}, "samples"),
        ({"samples": 100_000}, "samples"),
        ({"start": {"kind": "euler", "order": "zyx", "angles_rad": [0, 0]}}, "start/euler/angles_rad"),
        ({"start": {"kind": "spherical"}}, "start"),
        ({"tip": [0, 0, "far"]}, "tip/2"),
    ],
)
def test_wrong_orientations_are_refused(client: httpx.Client, change: dict[str, Any], told: str) -> None:
    turn = {"kind": "axis_angle", "axis": [0, 1, 0], "angle_rad": 1.0}
    response = client.post(f"{LAB}/interpolations", json={"start": turn, "end": turn} | change)
    kind = "input-unusable" if "length" in told else "request-invalid"
    assert told in refusal(response, 422, kind)["detail"]


def test_a_pose_is_where_the_rig_puts_it(client: httpx.Client) -> None:
    generator = np.random.default_rng(4)
    for name in ("rightIndex", "leftMiddle", "rightArm", "leftLeg"):
        hinges = chain_of(client, name)["hinges"]
        low: list[float] = [hinge["minimum_rad"] for hinge in hinges]
        high: list[float] = [hinge["maximum_rad"] for hinge in hinges]
        angles = generator.uniform(low, high).tolist()
        pose = answer(client, "forward", chain=name, angles_rad=angles)
        np.testing.assert_allclose(pose["positions"][-1], end_of(client, name, angles), atol=1e-9)
        assert [hinge["angle_rad"] for hinge in pose["hinges"]] == pytest.approx(angles)
        assert (pose["finger"] is not None) == (len(pose["positions"]) == 4)


@pytest.mark.parametrize("name", ["rightIndex", "rightArm"])
def test_every_solver_is_as_good_as_it_says(client: httpx.Client, name: str) -> None:
    chain = chain_of(client, name)
    wanted = [0.35 * hinge["minimum_rad"] for hinge in chain["hinges"]]
    if chain["kind"] == "finger":
        wanted[3] = wanted[2] / 3
    target = end_of(client, name, wanted)
    statuses: dict[str, str] = {}
    for solver in chain["solvers"]:
        found = answer(client, "inverse", chain=name, target=target.tolist(), choice={"solver": solver})
        angles = [hinge["angle_rad"] for hinge in found["pose"]["hinges"]]
        error = float(np.linalg.norm(end_of(client, name, angles) - target))
        assert error == pytest.approx(found["error_m"], abs=1e-9)
        for hinge, angle in zip(chain["hinges"], angles, strict=True):
            assert hinge["minimum_rad"] - 1e-9 <= angle <= hinge["maximum_rad"] + 1e-9
        statuses[solver] = found["status"]
        assert (error <= 1e-4) == (found["status"] == "reached")
        if found["rounds"]:
            assert len(found["rounds"]) == found["iterations"] + 1
            assert found["rounds"][-1]["error_m"] == pytest.approx(error, abs=1e-9)
    assert statuses[chain["solvers"][0]] == "reached"
    assert statuses["damped_least_squares"] == "reached"


def test_what_is_too_far_is_said_to_be(client: httpx.Client) -> None:
    chain = chain_of(client, "rightIndex")
    far = [chain["rest"]["positions"][0][0] + 2 * chain["reach_m"], 0.0, 0.0]
    for solver in chain["solvers"]:
        found = answer(
            client, "inverse", chain="rightIndex", target=far, choice={"solver": solver, "iterations": 5}
        )
        assert found["status"] == "out_of_reach"
        assert found["error_m"] > 0.9 * chain["reach_m"]


def test_bounds_and_tolerances_are_kept(client: httpx.Client) -> None:
    target = end_of(client, "rightArm", [0.4, 0.3, 0.1, 0.9]).tolist()
    for iterations in (1, 4):
        choice = {"solver": "ccd", "iterations": iterations, "tolerance_m": 1e-7}
        found = answer(client, "inverse", chain="rightArm", target=target, choice=choice)
        assert found["iterations"] == iterations
        assert found["status"] == "not_converged"
    choice = {"solver": "ccd", "iterations": 200, "tolerance_m": 0.05}
    loose = answer(client, "inverse", chain="rightArm", target=target, choice=choice)
    assert loose["status"] == "reached"
    assert 1e-4 < loose["error_m"] <= 0.05


def test_limits_can_be_left_out(client: httpx.Client) -> None:
    chain = chain_of(client, "rightIndex")
    x, y, z = chain["rest"]["positions"][0]
    behind = [x - 0.05, y + 0.035, z]
    choice = {"solver": "damped_least_squares", "iterations": 200}
    held = answer(client, "inverse", chain="rightIndex", target=behind, choice=choice)
    free = answer(client, "inverse", chain="rightIndex", target=behind, choice=choice | {"limits": False})
    assert held["status"] != "reached"
    assert free["status"] == "reached"
    assert max(hinge["beyond_rad"] for hinge in held["pose"]["hinges"]) == 0
    assert max(hinge["beyond_rad"] for hinge in free["pose"]["hinges"]) > 0.1


def test_reach_is_a_map_of_what_is_solved(client: httpx.Client) -> None:
    through = chain_of(client, "rightIndex")["rest"]["positions"][-1]
    asked = {"chain": "rightIndex", "plane": "xz", "through": through}
    found = answer(client, "reach", choice={"solver": "coupled_three_bone"}, **asked)
    cells = np.array(list(found["reached"])).reshape(found["rows"], found["columns"]) == "1"
    assert cells.mean() == pytest.approx(found["share"])
    assert 0.005 < found["share"] < 0.5
    corner, right, up = (np.array(found[name]) for name in ("corner", "right", "up"))
    assert corner[1] == pytest.approx(through[1])
    rows, columns = np.nonzero(cells)
    middle = len(rows) // 2
    inside = (corner + columns[middle] * right + rows[middle] * up).tolist()
    solved = answer(
        client, "inverse", chain="rightIndex", target=inside, choice={"solver": "coupled_three_bone"}
    )
    assert solved["status"] == "reached"


@pytest.mark.parametrize(
    ("path", "body", "status", "kind", "told"),
    [
        ("forward", {"chain": "tail", "angles_rad": []}, 404, "unknown-chain", "it has: leftArm"),
        ("forward", {"chain": "rightArm", "rig": "../x", "angles_rad": []}, 404, "unknown-rig", "no rig"),
        (
            "forward",
            {"chain": "rightArm", "rig": "trumpet", "angles_rad": []},
            404,
            "unknown-chain",
            "it has: none",
        ),
        ("forward", {"chain": "rightArm", "angles_rad": [0.0]}, 422, "input-unusable", "has 4 angles"),
        ("forward", {"chain": "rightArm", "angles_rad": [0, 0, 0, 3]}, 422, "input-unusable", "angles_rad/3"),
        (
            "inverse",
            {"chain": "rightArm", "target": [0, 0, 0], "choice": {"solver": "coupled_three_bone"}},
            422,
            "input-unusable",
            "rightArm takes two_bone",
        ),
        (
            "inverse",
            {"chain": "rightArm", "target": [0, 0, 0], "choice": {"solver": "jacobian"}},
            422,
            "request-invalid",
            "choice/solver",
        ),
        (
            "inverse",
            {"chain": "rightArm", "target": [0, 0, 0], "choice": {"solver": "ccd", "iterations": 100000}},
            422,
            "request-invalid",
            "choice/iterations",
        ),
        (
            "inverse",
            {"chain": "rightArm", "target": [0, 0], "choice": {"solver": "ccd"}},
            422,
            "request-invalid",
            "target",
        ),
        (
            "inverse",
            {"chain": "rightArm", "target": [0, 0, 0], "choice": {"solver": "ccd"}, "start_rad": [0]},
            422,
            "input-unusable",
            "start_rad",
        ),
    ],
)
def test_wrong_questions_are_refused(
    client: httpx.Client, path: str, body: dict[str, Any], status: int, kind: str, told: str
) -> None:
    assert told in refusal(client.post(f"{LAB}/{path}", json=body), status, kind)["detail"]


@pytest.mark.parametrize(
    "rig", ["a" * 300, "a/" * 3000, "\0", "\ud800", "..", "", ".", "trumpeter/../trumpeter"]
)
@pytest.mark.parametrize("path", ["forward", "inverse", "reach"])
def test_names_that_no_rig_has(client: httpx.Client, path: str, rig: str) -> None:
    asked: dict[str, dict[str, Any]] = {
        "forward": {"angles_rad": [0.0]},
        "inverse": {"target": [0, 0, 0], "choice": {"solver": "ccd"}},
        "reach": {"through": [0, 0, 0], "choice": {"solver": "ccd"}},
    }
    body = {"chain": "rightArm", "rig": rig} | asked[path]
    headers = {"Content-Type": "application/json"}
    response = client.post(f"{LAB}/{path}", content=json.dumps(body), headers=headers)
    assert "no rig has the name" in refusal(response, 404, "unknown-rig")["detail"]


def test_a_clip_is_read_into_places(client: httpx.Client) -> None:
    response = client.post(f"{LAB}/bvh", content=BVH.encode())
    assert response.status_code == 200, response.text
    clip = response.json()
    assert [(joint["name"], joint["parent"]) for joint in clip["joints"]] == [("hips", None), ("spine", 0)]
    assert clip["points"] == ["hips", "spine", "spine end"]
    assert clip["point_parents"] == [-1, 0, 1]
    assert (clip["frames"], clip["sampled_frames"], clip["frame_step"]) == (2, 2, 1)
    assert clip["duration_s"] == pytest.approx(0.08)
    positions = np.frombuffer(base64.b64decode(clip["positions"]), "<f4").reshape(2, 3, 3)
    expected = [[[0, 90, 0], [0, 110, 0], [0, 140, 0]], [[5, 90, 0], [-15, 90, 0], [-45, 90, 0]]]
    np.testing.assert_allclose(positions, expected, atol=1e-4)
    assert clip["minimum"] == pytest.approx([-45, 90, 0], abs=1e-4)


def test_a_rewritten_clip_is_the_same_motion(client: httpx.Client) -> None:
    untidy = (
        BVH.replace("ROOT", "root").replace("\n", "\r\n").replace("  ", "\t").replace("90 0 0\r", "9e1 0 0\r")
    )
    rewritten = client.post(f"{LAB}/bvh/rewritten", content=untidy.encode())
    assert rewritten.status_code == 200, rewritten.text
    assert rewritten.text.startswith("HIERARCHY\nROOT hips\n")
    places = [client.post(f"{LAB}/bvh", content=one).json()["positions"] for one in (BVH, rewritten.text)]
    assert places[0] == places[1]


@pytest.mark.parametrize(
    ("text", "line", "told"),
    [
        (BVH.replace("OFFSET 0 20 0", "OFFSET 0 20 zero"), 8, "'zero' is no number"),
        (BVH.replace("Zrotation", "Wrotation", 1), 5, "channel 'Wrotation' is none of"),
        (BVH.replace("0 90 0 0 0 0 0 0 0", "0 90 0 0 0 0 0 0"), 19, "a frame has 9 values, this line 8"),
        (BVH.replace("5 90 0 90", "5 ² 0 90"), 20, "'²' is no number"),
        (BVH.replace("5 90 0 90", f"5 {'9' * 5000} 0 90"), 20, "has 5000 characters"),
        (BVH.replace("5 90 0 90", "5 nan 0 90"), 20, "'nan' is no number"),
        (BVH.replace("CHANNELS 3", "CHANNELS ²"), 9, "'²' is no number"),
        (BVH.replace("Frames: 2", f"Frames: {'9' * 5000}"), 17, "has 5000 characters"),
        (BVH.replace("Time: 0.04", "Time: 1e308"), 18, "1e308 is too large"),
        (BVH.replace("OFFSET 0 20 0", "OFFSET 0 1e300 0"), 8, "1e300 is too large"),
        (BVH.replace("MOTION", "MOTIONS"), 16, "after the hierarchy comes MOTION"),
        ("", 1, "the file ends here"),
        ("not a clip", 1, "begins with HIERARCHY"),
    ],
)
def test_a_broken_clip_is_told_with_its_line(client: httpx.Client, text: str, line: int, told: str) -> None:
    problem = refusal(client.post(f"{LAB}/bvh", content=text.encode()), 422, "clip-unreadable")
    (fault,) = problem["errors"]
    assert fault["location"] == f"line {line}"
    assert told in fault["detail"]


def read_case(client: httpx.Client, name: str, **asked: str) -> dict[str, Any]:
    response = client.post(f"{LAB}/bvh", content=(CASES / name).read_bytes(), params=asked)
    assert response.status_code == 200, response.text
    return response.json()


def test_what_is_odd_is_read_and_told(client: httpx.Client) -> None:
    named = read_case(client, "bvh-dupname.bvh")
    assert (len(named["joints"]), named["frames"]) == (4, 3)
    assert named["warnings"] == [
        {
            "kind": "repeated_name",
            "place": "line 19",
            "message": "2 joints are called 'Nub'; the later ones are now 'Nub.001'",
        }
    ]
    more = read_case(client, "bvh-frames.bvh")
    assert (more["frames"], [warning["kind"] for warning in more["warnings"]]) == (3, ["frame_count"])
    braced = read_case(client, "bvh-endbrace.bvh")
    assert (len(braced["joints"]), braced["frames"], braced["warnings"]) == (2, 3, [])


def test_positions_replace_the_offset_or_are_added(client: httpx.Client) -> None:
    for asked, distance in (({}, 10), ({"positions": "replace"}, 10), ({"positions": "add"}, 20)):
        clip = read_case(client, "bvh-positions.bvh", **asked)
        positions = np.frombuffer(base64.b64decode(clip["positions"]), "<f4").reshape(3, 3, 3)
        assert np.linalg.norm(positions[:, 1] - positions[:, 0], axis=1) == pytest.approx([distance] * 3)
        content = (CASES / "bvh-positions.bvh").read_bytes()
        written = client.post(f"{LAB}/bvh/rewritten", content=content, params=asked).text
        for meaning in ("replace", "add"):
            again = client.post(f"{LAB}/bvh", content=written, params={"positions": meaning}).json()
            found = np.frombuffer(base64.b64decode(again["positions"]), "<f4").reshape(3, 3, 3)
            np.testing.assert_allclose(found, positions, atol=1e-4)
    for path in ("bvh", "bvh/rewritten"):
        wrong = client.post(f"{LAB}/{path}", content=BVH, params={"positions": "both"})
        assert "positions" in refusal(wrong, 422, "request-invalid")["detail"]


def test_a_deep_file_is_read_and_rewritten(client: httpx.Client) -> None:
    joints = len(read_case(client, "bvh-deep.bvh")["joints"])
    written = client.post(f"{LAB}/bvh/rewritten", content=(CASES / "bvh-deep.bvh").read_bytes())
    assert written.status_code == 200, written.text
    assert len(client.post(f"{LAB}/bvh", content=written.content).json()["joints"]) == joints > 900


def test_clips_without_frames_are_skeletons(client: httpx.Client) -> None:
    head = BVH.split("Frames")[0]
    bomb = "HIERARCHY ROOT a {OFFSET 0 0 0} MOTION Frames: {} Frame Time: 1"
    for still, kinds in (
        (head + "Frames: 0\nFrame Time: 0.04\n", []),
        (head.replace("MOTION\n", ""), ["no_motion"]),
        (bomb.replace("{}", "20000000"), ["frame_count"]),
        (bomb.replace("{}", "1000000000"), ["frame_count"]),
    ):
        clip = client.post(f"{LAB}/bvh", content=still).json()
        assert (clip["frames"], clip["sampled_frames"], clip["duration_s"]) == (0, 1, 0)
        assert [warning["kind"] for warning in clip["warnings"]] == kinds
        positions = np.frombuffer(base64.b64decode(clip["positions"]), "<f4").reshape(-1, 3)
        if "spine" in still:
            np.testing.assert_array_equal(positions, [[0, 90, 0], [0, 110, 0], [0, 140, 0]])
        written = client.post(f"{LAB}/bvh/rewritten", content=still)
        assert "Frames: 0\n" in written.text


def test_clips_that_are_too_large_are_refused(client: httpx.Client) -> None:
    refusal(client.post(f"{LAB}/bvh", content=b" " * 21_000_000), 413, "clip-too-large")
    assert client.post(f"{LAB}/bvh", content=BVH).status_code == 200, "the server goes on"


def test_a_long_clip_is_thinned(client: httpx.Client) -> None:
    head, _ = BVH.split("Frames")
    frames = 500_000
    motion = "0 0 0 0 0 0 0 0 0\n" * frames
    clip = client.post(f"{LAB}/bvh", content=f"{head}Frames: {frames}\nFrame Time: 0.01\n{motion}").json()
    assert clip["frames"] == frames
    assert clip["frame_step"] == 2
    assert clip["sampled_frames"] == frames // 2
    assert len(base64.b64decode(clip["positions"])) == clip["sampled_frames"] * 3 * 3 * 4


def test_shipped_clips_are_listed_and_read(client: httpx.Client) -> None:
    listed = client.get(f"{LAB}/clips").json()["clips"]
    shipped = {(path.parents[1].name, path.stem) for path in CLIPS.parents[1].glob("*/clips/*.bvh")}
    assert {(clip["rig"], clip["name"]) for clip in listed} == shipped
    assert len(listed) == len(shipped) >= 6, "clips ship with every player"
    for clip in listed:
        file = client.get(clip["href"])
        assert file.status_code == 200
        read = client.post(f"{LAB}/bvh", content=file.content).json()
        assert (read["frames"], len(read["joints"])) == (clip["frames"], clip["joints"])


def test_the_lab_has_a_page(client: httpx.Client) -> None:
    page = client.get("/lab")
    assert page.status_code == 200
    assert "<title>Reina: lab</title>" in page.text
    assert page.headers["cache-control"] == "no-cache"
    player = client.get("/")
    assert "/assets/lab-" not in player.text, "the player's page loads nothing of the lab"
