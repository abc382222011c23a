from __future__ import annotations

import zlib
from typing import TYPE_CHECKING, cast

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from tests.unit.sessions.fakes import Layout, NumberedPerformance, Parameter

from reina.protocol import FrameError, FrameFlag, Steps, build_manifest, encode_block, pack, unpack
from reina.protocol.packed_block import EXACT, HEADER, packed_header

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from reina.performance import FrameBlock, FrameLayout
    from reina.protocol import Frames, Manifest

LAYOUT = Layout(
    parameters=(
        Parameter("number", minimum=0.0, maximum=10.0),
        Parameter("blocks/color", "color", 3, minimum=0.0, maximum=1.0),
        Parameter("choice", "choice", blend=False),
        Parameter("camera/target", "vector", 2),
    )
)
SESSION = 0xFEDCBA9876543210


def manifest_of(layout: Layout) -> Manifest:
    return build_manifest(cast("FrameLayout", layout))


def steps_of(layout: Layout) -> Steps:
    return Steps.of(cast("FrameLayout", layout))


def numbered(block: int = 7, cuts: frozenset[int] = frozenset()) -> Frames:
    performance = NumberedPerformance(LAYOUT, cuts)
    return encode_block(manifest_of(LAYOUT), cast("FrameBlock", performance.evaluate(block)))


def turning(values: NDArray[np.float64]) -> Frames:
    """Frames whose joints turn as any numbers say."""
    frames = numbered()
    length = np.linalg.norm(values, axis=-1, keepdims=True)
    frames["rotations"] = np.where(length > 1e-3, values / np.maximum(length, 1e-3), [0.0, 0.0, 0.0, 1.0])
    return frames


def angles_deg(one: Frames, other: Frames) -> NDArray[np.float64]:
    """How far joints are turned from one to the other; the sign of a quaternion counts too."""
    apart = one["rotations"].astype(np.float64) - other["rotations"].astype(np.float64)
    return np.degrees(4.0 * np.arcsin(np.minimum(np.linalg.norm(apart, axis=-1) / 2.0, 1.0)))


def test_header_cuts_and_what_is_not_blended_come_back_as_they_were() -> None:
    frames = numbered(7, cuts=frozenset({420, 433, 479}))
    frames["parameters"][:, 4] = np.arange(60) % 3
    data = pack(manifest_of(LAYOUT), frames, steps_of(LAYOUT), revision=SESSION)
    header = packed_header(data)
    assert (header["block"], header["revision"], header["fps"]) == (7, SESSION, 60)
    found = unpack(manifest_of(LAYOUT), data)
    assert np.flatnonzero(found["flags"] == FrameFlag.CUT).tolist() == [0, 13, 59]
    for name in ("version", "index", "song_time_s", "epoch", "due_time_s"):
        assert np.array_equal(found[name], frames[name])
    assert np.array_equal(found["parameters"][:, 4], frames["parameters"][:, 4])
    assert np.abs(found["parameters"] - frames["parameters"]).max() <= 2e-4


@given(
    values=arrays(np.float64, (60, 3, 4), elements=st.floats(-1, 1, width=32)),
    walk=st.booleans(),
)
def test_no_rotation_is_off_by_a_hundredth_of_a_degree(values: NDArray[np.float64], *, walk: bool) -> None:
    frames = turning(np.cumsum(values, axis=0) if walk else values)
    manifest = manifest_of(LAYOUT)
    found = unpack(manifest, pack(manifest, frames, steps_of(LAYOUT), revision=1))
    assert angles_deg(found, frames).max() <= 0.012
    assert np.allclose(np.linalg.norm(found["rotations"], axis=-1), 1.0, atol=1e-6)


@given(
    floats=arrays(np.float32, (60, 7), elements=st.floats(width=32, allow_nan=False)),
    values=arrays(np.float64, (60, 3, 4), elements=st.floats(-1, 1, width=32)),
)
def test_the_lossless_form_is_bit_for_bit(floats: NDArray[np.float32], values: NDArray[np.float64]) -> None:
    frames, manifest = turning(values), manifest_of(LAYOUT)
    frames["parameters"] = floats
    found = unpack(manifest, pack(manifest, frames, Steps.exact(manifest), revision=1))
    assert found.tobytes() == frames.tobytes()


def test_what_is_too_large_for_steps_is_kept_as_it_is() -> None:
    frames, manifest = numbered(), manifest_of(LAYOUT)
    frames["parameters"][:, 5] = np.linspace(-1e30, 1e30, 60)
    frames["parameters"][:, 6] = np.inf
    found = unpack(manifest, pack(manifest, frames, steps_of(LAYOUT), revision=1))
    assert np.array_equal(found["parameters"][:, 5:], frames["parameters"][:, 5:])


def test_the_same_frames_give_the_same_bytes_and_are_not_changed() -> None:
    frames, manifest = numbered(), manifest_of(LAYOUT)
    before = frames.tobytes()
    frames.flags.writeable = False
    one = pack(manifest, frames, steps_of(LAYOUT), revision=1)
    assert one == pack(manifest, frames, steps_of(LAYOUT), revision=1)
    assert frames.tobytes() == before


def test_joints_that_much_hangs_on_are_kept_finer() -> None:
    steps = steps_of(LAYOUT)
    hips, spine, head = steps.fineness[:3].tolist()
    assert hips > spine > head
    assert steps.fineness[3 + 3 + 4] == EXACT


def test_bytes_that_are_no_block_are_refused_in_words() -> None:
    manifest = manifest_of(LAYOUT)
    data = pack(manifest, numbered(), steps_of(LAYOUT), revision=1)
    body = zlib.decompress(data[HEADER.itemsize :])
    for broken, words in (
        (b"", "no packed block"),
        (b"XX" + data[2:], "no packed block"),
        (data[:2] + b"\x09" + data[3:], "version 9"),
        (data[:-7], "cut off"),
        (data[: HEADER.itemsize] + zlib.compress(body + b"\0"), "as long as its columns"),
        (data[: HEADER.itemsize] + zlib.compress(body[:40]), "as long as its columns"),
    ):
        with pytest.raises(FrameError, match=words):
            unpack(manifest, broken)
    with pytest.raises(FrameError, match="frames of 120 bytes, and not of 8"):
        unpack(manifest.model_copy(update={"frame_size": 8}), data)


def test_a_quaternion_that_is_none_is_refused() -> None:
    frames = numbered()
    frames["rotations"][3, 1] = [np.nan, 0, 0, 1]
    with pytest.raises(FrameError, match="no unit quaternion"):
        pack(manifest_of(LAYOUT), frames, steps_of(LAYOUT), revision=1)
