"""The golden message: three frames, written field by field with `struct`, apart from the code that it tests.

`python -m tests.contract.golden` writes tests/golden/frame_v1.bin and frame_v1.json anew; a difference to
what is committed means that every page and every other reader has to change: another protocol version.
"""

from __future__ import annotations

import json
import struct
from pathlib import Path
from typing import Any

GOLDEN = Path(__file__).parents[1] / "golden"

JOINTS = {"player": ["hips", "spine", "head"], "trumpet": ["trumpet"], "mute": ["mute"]}
"""Three skeletons and nine floats, so that both sections end in padding."""
PARAMETERS = [
    ("camera/position", "vector", 3, True),
    ("blocks/color", "color", 3, True),
    ("blocks/arrangement", "choice", 1, False),
    ("trumpet/valve/1", "number", 1, True),
    ("blocks/visible", "boolean", 1, False),
]
FRAMES: list[dict[str, Any]] = [
    {"epoch": 255, "flags": 3, "index": 119, "song_time_s": 119 / 60, "due_time_s": 4321.125},
    {"epoch": 0, "flags": 7, "index": 120, "song_time_s": 2.0, "due_time_s": 4321.25},
    {"epoch": 0, "flags": 0, "index": 4_000_000_000, "song_time_s": 4_000_000_000 / 60, "due_time_s": 0.0},
]
COUNT = sum(len(joints) for joints in JOINTS.values())
HEADER_SIZE = 24
ROOTS = HEADER_SIZE + 16 * COUNT
VALUES = (ROOTS + 12 * len(JOINTS) + 7) // 8 * 8
SIZE = (VALUES + 4 * sum(length for _, _, length, _ in PARAMETERS) + 7) // 8 * 8


def quaternion(frame: int, joint: int) -> tuple[float, float, float, float]:
    """A unit quaternion of exact float32 values, another for each frame and joint."""
    turns = [(0.0, 0.0, 0.0, 1.0), (0.5, 0.5, 0.5, 0.5), (0.5, -0.5, 0.5, 0.5), (1.0, 0.0, 0.0, 0.0)]
    return turns[(frame + joint) % 4]


def root(frame: int, skeleton: int) -> tuple[float, float, float]:
    """A position of exact float32 values."""
    return (0.25 * frame, 1.5 + skeleton, -0.125)


def value(frame: int, number: int) -> float:
    """A parameter's float, exact in float32."""
    return frame + 0.0625 * number


def golden_bytes() -> bytes:
    """The message, byte by byte as the contract's table has it."""
    message = b""
    for number, frame in enumerate(FRAMES):
        data = struct.pack(
            "<BBHIdd", 1, *(frame[name] for name in ("epoch", "flags", "index", "song_time_s", "due_time_s"))
        )
        for joint in range(COUNT):
            data += struct.pack("<4f", *quaternion(number, joint))
        for skeleton in range(len(JOINTS)):
            data += struct.pack("<3f", *root(number, skeleton))
        data = data.ljust(VALUES, b"\0")
        for parameter in range(sum(length for _, _, length, _ in PARAMETERS)):
            data += struct.pack("<f", value(number, parameter))
        message += data.ljust(SIZE, b"\0")
    return message


def golden_manifest() -> dict[str, Any]:
    """The manifest that goes with it."""
    skeletons: list[dict[str, Any]] = []
    joints = 0
    for number, (name, names) in enumerate(JOINTS.items()):
        skeletons.append(
            {
                "name": name,
                "player": 0,
                "rig": "trumpeter" if name == "player" else name,
                "joints": names,
                "offset": HEADER_SIZE + 16 * joints,
                "root_offset": ROOTS + 12 * number,
            }
        )
        joints += len(names)
    parameters: list[dict[str, Any]] = []
    floats = 0
    for path, kind, length, blend in PARAMETERS:
        parameters.append(
            {"path": path, "type": kind, "offset": VALUES + 4 * floats, "length": length, "blend": blend}
        )
        floats += length
    return {
        "protocol": "reina.v1",
        "fps": 60,
        "frame_size": SIZE,
        "skeletons": skeletons,
        "parameters": parameters,
    }


def golden_frames() -> list[dict[str, Any]]:
    """What the frames hold, for readers in any language."""
    frames: list[dict[str, Any]] = []
    for number, frame in enumerate(FRAMES):
        joints = iter(range(COUNT))
        floats = iter(range(99))
        frames.append(
            {
                **frame,
                "rotations": {
                    name: [quaternion(number, next(joints)) for _ in names] for name, names in JOINTS.items()
                },
                "root_positions": {name: root(number, place) for place, name in enumerate(JOINTS)},
                "parameters": {
                    path: [value(number, next(floats)) for _ in range(length)]
                    for path, _, length, _ in PARAMETERS
                },
            }
        )
    return frames


def write() -> None:
    """Write the golden files."""
    GOLDEN.mkdir(exist_ok=True)
    (GOLDEN / "frame_v1.bin").write_bytes(golden_bytes())
    document = {"manifest": golden_manifest(), "frames": golden_frames()}
    (GOLDEN / "frame_v1.json").write_text(json.dumps(document, indent=1) + "\n")


if __name__ == "__main__":
    write()
