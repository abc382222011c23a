"""The bytes of version 1, as committed."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, cast

import numpy as np
import pytest
from tests.contract.golden import GOLDEN, JOINTS, PARAMETERS, golden_bytes, golden_frames, golden_manifest

from reina.protocol import (
    FrameError,
    Manifest,
    build_manifest,
    bytes_of,
    decode,
    encode_block,
    frame_dtype,
    stamp,
)

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from reina.performance import FrameBlock, FrameLayout


@pytest.fixture(scope="module")
def golden() -> dict[str, Any]:
    return cast("dict[str, Any]", json.loads((GOLDEN / "frame_v1.json").read_text()))


@pytest.fixture(scope="module")
def manifest(golden: dict[str, Any]) -> Manifest:
    return Manifest.model_validate(golden["manifest"])


def test_the_committed_files_are_the_written_ones(golden: dict[str, Any]) -> None:
    assert (GOLDEN / "frame_v1.bin").read_bytes() == golden_bytes()
    assert golden == json.loads(json.dumps({"manifest": golden_manifest(), "frames": golden_frames()}))


def test_the_golden_bytes_decode_to_the_golden_values(golden: dict[str, Any], manifest: Manifest) -> None:
    frames = decode(manifest, (GOLDEN / "frame_v1.bin").read_bytes())
    assert len(frames) == len(golden["frames"])
    for got, expected in zip(frames, golden["frames"], strict=True):
        assert got["version"] == 1
        for name in ("epoch", "flags", "index", "song_time_s", "due_time_s"):
            assert got[name] == expected[name]
        rotations = [q for joints in expected["rotations"].values() for q in joints]
        assert got["rotations"].tolist() == rotations
        assert got["root_positions"].tolist() == list(expected["root_positions"].values())
        assert got["parameters"].tolist() == [v for values in expected["parameters"].values() for v in values]


@dataclass(frozen=True)
class Skeleton:
    name: str
    rig: str
    joints: tuple[str, ...]
    player: int = 0


@dataclass(frozen=True)
class Parameter:
    path: str
    type: str
    length: int
    blend: bool


@dataclass(frozen=True)
class Layout:
    fps: int
    skeletons: tuple[Skeleton, ...]
    parameters: tuple[Parameter, ...]


LAYOUT = cast(
    "FrameLayout",
    Layout(
        60,
        tuple(Skeleton(n, "trumpeter" if n == "player" else n, tuple(j)) for n, j in JOINTS.items()),
        tuple(Parameter(*parameter) for parameter in PARAMETERS),
    ),
)


def test_the_manifest_is_the_golden_one(golden: dict[str, Any]) -> None:
    assert build_manifest(LAYOUT).model_dump() == golden["manifest"]


@dataclass(frozen=True)
class Block:
    first_frame: int
    fps: int
    song_time_s: NDArray[np.float64]
    rotations: NDArray[np.float32]
    root_positions: NDArray[np.float32]
    parameters: NDArray[np.float32]
    cuts: NDArray[np.bool_]


def test_the_golden_values_encode_to_the_golden_bytes(golden: dict[str, Any], manifest: Manifest) -> None:
    """Each frame by itself, since the golden ones do not follow one another."""
    message = b""
    for frame in golden["frames"]:
        block = Block(
            first_frame=frame["index"],
            fps=60,
            song_time_s=np.array([frame["song_time_s"]]),
            rotations=np.array([[q for joints in frame["rotations"].values() for q in joints]], np.float32),
            root_positions=np.array([list(frame["root_positions"].values())], np.float32),
            parameters=np.array([[v for values in frame["parameters"].values() for v in values]], np.float32),
            cuts=np.array([bool(frame["flags"] & 4)]),
        )
        encoded = encode_block(manifest, cast("FrameBlock", block))
        message += stamp(
            bytes_of(encoded),
            epoch=frame["epoch"] + 256,
            due_time_s=frame["due_time_s"],
            flags=frame["flags"] & 3,
        )
    assert message == golden_bytes()


def test_the_layout_is_the_contracts_table(manifest: Manifest) -> None:
    dtype = frame_dtype(manifest)
    offsets = {name: dtype.fields[name][1] for name in dtype.fields} if dtype.fields else {}
    assert offsets == {
        "version": 0,
        "epoch": 1,
        "flags": 2,
        "index": 4,
        "song_time_s": 8,
        "due_time_s": 16,
        "rotations": 24,
        "root_positions": 24 + 16 * 5,
        "parameters": 24 + 16 * 5 + 12 * 3 + 4,
    }
    assert manifest.frame_size == dtype.itemsize
    assert dtype.itemsize % 8 == 0


@pytest.mark.parametrize("length", [1, 23, 185])
def test_bytes_that_are_no_whole_frames_are_refused(manifest: Manifest, length: int) -> None:
    with pytest.raises(FrameError, match="whole number of frames"):
        decode(manifest, golden_bytes()[:length])


def test_another_version_is_refused(manifest: Manifest) -> None:
    data = bytearray(golden_bytes())
    data[manifest.frame_size] = 2
    with pytest.raises(FrameError, match="frame 1: the frame is of version 2; this reads version 1"):
        decode(manifest, bytes(data))
