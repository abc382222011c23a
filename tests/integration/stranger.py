"""Frames as a stranger reads them: the manifest, the rigs' JSON, and forward kinematics of its own.

Nothing here imports reina, so that a mistake in the server's own kinematics cannot hide in the test's.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.spatial.transform import Rotation

if TYPE_CHECKING:
    import httpx
    from numpy.typing import NDArray


@dataclass(frozen=True)
class Pose:
    """Where one skeleton's joints are in the world: joint name to (F, 3) metres and to F rotations."""

    positions: dict[str, NDArray[np.float64]]
    rotations: dict[str, Rotation]
    rig: dict[str, Any]

    def point(self, joint: str, offset: list[float]) -> NDArray[np.float64]:
        """(F, 3): a point fixed to a joint, in the world."""
        return self.positions[joint] + self.rotations[joint].apply(np.array(offset))

    def named(self, kind: str, name: str) -> NDArray[np.float64]:
        """(F, 3): an effector or a contact of the rig, in the world."""
        entry = next(entry for entry in self.rig[kind] if entry["name"] == name)
        return self.point(entry["joint"], entry["offset"])


@dataclass(frozen=True)
class Take:
    """Some frames of a session, decoded."""

    song_time_s: NDArray[np.float64]
    poses: dict[str, Pose]
    local: dict[str, NDArray[np.float64]]
    """Skeleton name to its (F, J, 4) local quaternions."""
    parameters: dict[str, NDArray[np.float64]]
    """Path to its (F, L) values."""
    raw: NDArray[np.uint8]
    """(F, frame_size) bytes."""
    sounding: NDArray[np.bool_]
    """(F,): a note that the player plays sounds."""

    def skeleton(self, rig: str) -> Pose:
        """The pose of the skeleton that wears a rig."""
        return next(pose for pose in self.poses.values() if pose.rig["name"] == rig)


def take(client: httpx.Client, session: str, start_s: float, end_s: float, fps: int = 60) -> Take:
    """Fetch and decode the frames of a span of a session."""
    manifest = client.get(f"/api/v1/sessions/{session}/manifest").raise_for_status().json()
    response = client.get(
        f"/api/v1/sessions/{session}/frames", params={"start_s": start_s, "end_s": end_s, "fps": fps}
    ).raise_for_status()
    size = manifest["frame_size"]
    raw = np.frombuffer(response.content, np.uint8).reshape(-1, size)

    def floats(offset: int, count: int) -> NDArray[np.float64]:
        return np.ascontiguousarray(raw[:, offset : offset + 4 * count]).view("<f4").astype(np.float64)

    poses: dict[str, Pose] = {}
    local: dict[str, NDArray[np.float64]] = {}
    for skeleton in manifest["skeletons"]:
        rig = client.get(f"/api/v1/rigs/{skeleton['rig']}").raise_for_status().json()
        joints: list[str] = skeleton["joints"]
        quaternions = floats(skeleton["offset"], 4 * len(joints)).reshape(-1, len(joints), 4)
        local[skeleton["name"]] = quaternions
        poses[skeleton["name"]] = _pose(rig, joints, quaternions, floats(skeleton["root_offset"], 3))
    parameters = {entry["path"]: floats(entry["offset"], entry["length"]) for entry in manifest["parameters"]}
    times = np.ascontiguousarray(raw[:, 8:16]).view("<f8")[:, 0]
    score = client.get(f"/api/v1/sessions/{session}/score").raise_for_status().json()
    sounding = np.zeros(len(times), bool)
    for note in score["notes"]:
        if note["part"] == score["part"] and note["valves"] is not None:
            sounding |= (times >= note["onset_s"]) & (times <= note["onset_s"] + note["duration_s"])
    return Take(times, poses, local, parameters, raw, sounding)


def _pose(
    rig: dict[str, Any], joints: list[str], quaternions: NDArray[np.float64], root: NDArray[np.float64]
) -> Pose:
    """World transforms: parent's world · rest translation · local rotation."""
    described = {joint["name"]: joint for joint in rig["joints"]}
    positions: dict[str, NDArray[np.float64]] = {}
    rotations: dict[str, Rotation] = {}
    for index, name in enumerate(joints):
        turned = Rotation.from_quat(quaternions[:, index])
        parent = described[name]["parent"]
        if parent is None:
            positions[name], rotations[name] = root, turned
        else:
            offset = np.array(described[name]["translation"])
            positions[name] = positions[parent] + rotations[parent].apply(offset)
            rotations[name] = rotations[parent] * turned
    return Pose(positions, rotations, rig)


def button(instrument: Pose, take_: Take, valve: int, prefix: str = "") -> NDArray[np.float64]:
    """(F, 3): the top of a valve's button in the world = the instrument's pose · (up + value · travel)."""
    entry = next(entry for entry in instrument.rig["buttons"] if entry["valve"] == valve)
    value = take_.parameters[f"{prefix}trumpet/valve/{valve}"]
    local = np.array(entry["position"]) + value * np.array(entry["travel"])
    root = instrument.rig["joints"][0]["name"]
    return instrument.positions[root] + instrument.rotations[root].apply(local)
