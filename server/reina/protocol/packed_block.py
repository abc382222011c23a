"""The packed block: 60 frames that never change, in a few kilobytes.

What is between a block's header and its end is compressed by zlib. Before that every float of a frame is a
column of whole numbers, one a frame: in steps of 2^(-fineness/4), or, where its fineness is `EXACT`, the
float's own bits. A column is written as its first number and the differences that follow, of the first or the
second order, whichever is smaller, modulo 2^32, zigzag, in byte planes. A quaternion whose greatest component
stays great through the block goes without it: it follows from the other three.

docs/protocol.md has the layout byte by byte; `web/src/connection/packed-block.ts` reads it too.
"""

from __future__ import annotations

import zlib
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from reina.protocol.frame import FrameError, FrameFlag, frame_dtype
from reina.protocol.manifest import PROTOCOL_VERSION, Manifest

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from reina.curves import Parameter
    from reina.performance import FrameLayout
    from reina.protocol.frame import Frames

FRAMES = 60
"""Frames of a block."""
EXACT = 255
"""The fineness of a column that is kept bit for bit."""
WHOLE = 4
"""What stands for the component that a quaternion goes without where it goes with all four."""
NEGATIVE = 8
"""Added to the component that a quaternion goes without, where it is negative."""
PACKED_VERSION = 1
LEVEL = 6
"""Of zlib: 9 takes twice as long and saves one byte in a hundred."""

HEADER = np.dtype(
    {
        "names": ["magic", "version", "fps", "block", "revision", "cuts", "frame_size", "unused"],
        "formats": ["S2", "u1", "u1", "<u4", "<u8", "<u8", "<u4", "<u4"],
        "offsets": [0, 2, 3, 4, 8, 16, 24, 28],
        "itemsize": 32,
    }
)
"""What a block begins with, as it is: frames a second, the block's number, which revision of the frames it is
of, a bit for each frame that is a cut, and the bytes of a frame of its manifest."""
MAGIC = b"RB"

_LEAST_GREATEST = 0.6
"""A component may be left out where it never is less: its own error is hardly greater than theirs."""
_GREATEST_STEPS = 2.0**30
"""Numbers of more steps are kept bit for bit."""

QUARTERS = 4
"""Finenesses to an octave: a step is 2^(-fineness/4)."""
ROTATION = 55
"""The least fineness of a joint's quaternion: half a step in each of three is 0.0083°."""
TIP_ERROR_M = 32e-6
"""How far a joint's rounding may move what hangs farthest from it, metres; a dozen are above a tip."""
ROUNDED_RAD = np.sqrt(3.0)
"""How far a quaternion turns at most, in steps, whose components are off by half a step each: 2·√3/2."""
ROOT = 64
"""Of a root's position: 0.008 mm at most."""
PARAMETER, FINEST_PARAMETER = 56, 96
"""The least fineness of a parameter, whatever its range, and the greatest."""
PARAMETER_SHARE = 2e-5
"""Of a parameter's range one step may take so much."""


@dataclass(frozen=True)
class Steps:
    """How finely the columns of a frame are kept.

    Attributes:
        fineness: Of each joint, of each float of the roots' positions, and of each float of the parameters:
            a step is 2^(-fineness/4); `EXACT` for the float itself. (J + 3·S + P,) uint8.
    """

    fineness: NDArray[np.uint8]

    @classmethod
    def of(cls, layout: FrameLayout) -> Steps:
        """As fine as the eye asks: at no fingertip more than 0.1 mm or 0.01° off (tests/unit/protocol)."""
        reaches = np.concatenate([skeleton.reaches for skeleton in layout.skeletons])
        fine = np.ceil(QUARTERS * np.log2(np.maximum(ROUNDED_RAD * reaches / TIP_ERROR_M, 1.0)))
        rotations = np.maximum(fine, ROTATION)
        roots = np.full(3 * len(layout.skeletons), ROOT)
        parameters = [fine for one in layout.parameters for fine in one.length * [_parameter_fineness(one)]]
        return cls(np.concatenate([rotations, roots, parameters]).astype(np.uint8))

    @classmethod
    def exact(cls, manifest: Manifest) -> Steps:
        """Nothing is rounded."""
        joints, skeletons, parameters = _counts(manifest)
        return cls(np.full(joints + 3 * skeletons + parameters, EXACT, np.uint8))


def pack(manifest: Manifest, frames: Frames, steps: Steps, *, revision: int) -> bytes:
    """Pack a block.

    Args:
        manifest: What its frames hold.
        frames: (60,) frames 60·b … 60·b + 59, as `encode_block` gives them.
        steps: How finely.
        revision: Which state of score, cast and show they are of, 64 bits.

    Returns:
        The block. The same frames give the same bytes.
    """
    joints, _, _ = _counts(manifest)
    rotations, dropped = _without_greatest(frames["rotations"])
    floats = np.concatenate(
        [
            rotations.reshape(FRAMES, -1),
            frames["root_positions"].reshape(FRAMES, -1),
            frames["parameters"],
        ],
        axis=1,
    )
    fineness = steps.fineness.copy()
    columns = _of_columns(fineness, joints)
    exact = columns == EXACT
    # Where a joint is to be exact none of its components is left out.
    whole = fineness[:joints] == EXACT
    dropped[whole] = WHOLE
    floats[:, : 4 * joints].reshape(FRAMES, joints, 4)[:, whole] = frames["rotations"][:, whole]
    scaled = floats / _steps(columns)
    far = ~exact & ~(np.abs(scaled).max(axis=0) < _GREATEST_STEPS)
    if far[: 4 * joints].any():
        raise FrameError("a rotation is no unit quaternion", location=f"block of frame {frames['index'][0]}")
    if far.any():
        fineness[joints:][far[4 * joints :]] = EXACT
        exact |= far
    numbers = np.empty(scaled.shape, np.int32)
    np.rint(scaled, out=numbers, casting="unsafe", where=~exact)
    bits = np.ascontiguousarray(floats).view(np.int32)
    np.copyto(numbers, bits, where=exact)
    body = bytes(dropped) + bytes(fineness) + _written(numbers)
    header = np.zeros((), HEADER)
    header["magic"], header["version"], header["fps"] = MAGIC, PACKED_VERSION, manifest.fps
    header["block"] = frames["index"][0] // FRAMES
    header["revision"], header["frame_size"] = revision, manifest.frame_size
    cuts = (frames["flags"] & FrameFlag.CUT) != 0
    header["cuts"] = int.from_bytes(np.packbits(cuts, bitorder="little").tobytes(), "little")
    return header.tobytes() + zlib.compress(body, LEVEL)


def unpack(manifest: Manifest, data: bytes) -> Frames:
    """The frames of a packed block.

    Returns:
        (60,) frames, as `GET .../frames` has them: epoch and due time 0, no flag but `CUT`.

    Raises:
        FrameError: It is no block, or one of another manifest or version.
    """
    header = packed_header(data)
    if header["frame_size"] != manifest.frame_size:
        raise FrameError(
            f"a block of frames of {header['frame_size']} bytes, and not of {manifest.frame_size}"
        )
    joints, skeletons, parameters = _counts(manifest)
    groups = joints + 3 * skeletons + parameters
    count = 4 * joints + 3 * skeletons + parameters
    body = _inflated(data, joints + groups, count)
    dropped, fineness = body[:joints], body[joints : joints + groups]
    numbers = _read(body[joints + groups :], count)
    columns = _of_columns(fineness, joints)
    exact = columns == EXACT
    floats = (numbers * _steps(columns)).astype("<f4")
    np.copyto(floats, numbers.view("<f4"), where=exact)
    roots = 4 * joints + 3 * skeletons
    frames = np.zeros(FRAMES, frame_dtype(manifest))
    frames["version"] = PROTOCOL_VERSION
    frames["flags"] = np.where(
        np.unpackbits(np.frombuffer(int(header["cuts"]).to_bytes(8, "little"), np.uint8), bitorder="little")[
            :FRAMES
        ],
        FrameFlag.CUT,
        0,
    )
    frames["index"] = int(header["block"]) * FRAMES + np.arange(FRAMES)
    frames["song_time_s"] = frames["index"] / manifest.fps
    frames["rotations"] = _with_greatest(floats[:, : 4 * joints].reshape(FRAMES, joints, 4), dropped, exact)
    frames["root_positions"] = floats[:, 4 * joints : roots].reshape(FRAMES, skeletons, 3)
    frames["parameters"] = floats[:, roots:]
    return frames


def packed_header(data: bytes) -> NDArray[np.void]:
    """The header of a packed block: () of `HEADER`.

    Raises:
        FrameError: It has none, or is of another version.
    """
    if len(data) < HEADER.itemsize or data[:2] != MAGIC:
        raise FrameError(f"{len(data)} bytes are no packed block: it begins with {MAGIC.decode()!r}")
    header = np.frombuffer(data, HEADER, count=1)[0]
    if header["version"] != PACKED_VERSION:
        raise FrameError(
            f"a packed block of version {header['version']}; this reads version {PACKED_VERSION}"
        )
    return header


def _parameter_fineness(parameter: Parameter) -> int:
    if not parameter.blend:
        return EXACT
    if parameter.minimum is None or parameter.maximum is None:
        return PARAMETER
    step = PARAMETER_SHARE * (parameter.maximum - parameter.minimum)
    if step <= 0:
        return EXACT
    return int(np.clip(np.ceil(-QUARTERS * np.log2(step)), PARAMETER, FINEST_PARAMETER))


def _counts(manifest: Manifest) -> tuple[int, int, int]:
    """Joints, skeletons, and floats of parameters."""
    return (
        sum(len(skeleton.joints) for skeleton in manifest.skeletons),
        len(manifest.skeletons),
        sum(parameter.length for parameter in manifest.parameters),
    )


def _of_columns(fineness: NDArray[np.uint8], joints: int) -> NDArray[np.uint8]:
    """The fineness of each float of a frame: a joint's for its four."""
    return np.concatenate([np.repeat(fineness[:joints], 4), fineness[joints:]])


def _steps(fineness: NDArray[np.uint8]) -> NDArray[np.float64]:
    """How large a step is."""
    return np.exp2(fineness / -QUARTERS)


def _without_greatest(
    rotations: NDArray[np.float32],
) -> tuple[NDArray[np.float32], NDArray[np.uint8]]:
    """Quaternions (60, J, 4) with the component that is to be left out 0, and which that is, (J,)."""
    # The least that a component is of one sign, (J, 4).
    least = np.maximum(rotations.min(axis=0), -rotations.max(axis=0))
    component = least.argmax(axis=1)
    joints = np.arange(len(component))
    enough = least[joints, component] >= _LEAST_GREATEST
    negative = rotations[0, joints, component] < 0
    left = rotations.copy()
    left[:, joints[enough], component[enough]] = 0.0
    dropped = np.where(enough, component + NEGATIVE * negative, WHOLE)
    return left, dropped.astype(np.uint8)


def _with_greatest(
    rotations: NDArray[np.float32], dropped: NDArray[np.uint8], exact: NDArray[np.bool_]
) -> NDArray[np.float32]:
    """The quaternions again, unit ones where they are rounded."""
    wide = rotations.astype(np.float64)
    squares = np.sum(wide**2, axis=2)
    without = np.flatnonzero(dropped != WHOLE)
    component = dropped[without] % NEGATIVE
    sign = np.where(dropped[without] >= NEGATIVE, -1.0, 1.0)
    wide[:, without, component] = sign * np.sqrt(np.maximum(1.0 - squares[:, without], 0.0))
    rounded = (dropped == WHOLE) & ~exact[: 4 * len(dropped) : 4]
    wide[:, rounded] /= np.sqrt(np.maximum(squares[:, rounded], 1e-12))[..., None]
    return wide.astype(np.float32)


def _written(numbers: NDArray[np.int32]) -> bytes:
    """Columns of whole numbers (60, C): orders (C), first numbers in four planes, planes of what follows."""
    once = np.diff(numbers, axis=0)
    twice = np.concatenate([once[:1], np.diff(once, axis=0)])
    once, twice = _zigzag(once), _zigzag(twice)
    moves = once.any(axis=0)
    again = _size(twice) < _size(once)
    orders = np.where(moves, 1 + again, 0).astype(np.uint8)
    following = np.where(again, twice, once)[:, moves].T
    planes = np.ascontiguousarray(following, "<u4").view(np.uint8).reshape(-1, 4)
    used = next((count for count in (4, 3, 2, 1) if planes[:, count - 1].any()), 0) if planes.size else 0
    first = np.ascontiguousarray(_zigzag(numbers[0]), "<u4").view(np.uint8).reshape(-1, 4)
    return (
        orders.tobytes() + first.T.tobytes() + bytes([used]) + np.ascontiguousarray(planes.T[:used]).tobytes()
    )


def _inflated(data: bytes, before: int, columns: int) -> NDArray[np.uint8]:
    """What is behind the header: `before` bytes, and the columns; no more than those can be."""
    inflating = zlib.decompressobj()
    most = before + 5 * columns + 1 + 4 * columns * (FRAMES - 1)
    try:
        body = inflating.decompress(data[HEADER.itemsize :], most + 1)
    except zlib.error as error:
        raise FrameError(f"a packed block is damaged: {error}") from error
    if len(body) <= before + 5 * columns or len(body) > most or not inflating.eof:
        raise FrameError("a packed block is cut off, or not as long as its columns")
    return np.frombuffer(body, np.uint8)


def _read(body: NDArray[np.uint8], columns: int) -> NDArray[np.int32]:
    """What `_written` wrote, (60, columns)."""
    orders = body[:columns]
    first = _unzigzag(_of_planes(body[columns : 5 * columns].reshape(4, columns)))
    used, rest = int(body[5 * columns]), body[5 * columns + 1 :]
    moves = np.flatnonzero(orders)
    if used > 4 or len(rest) != used * len(moves) * (FRAMES - 1):
        raise FrameError("a packed block is not as long as its columns")
    planes = rest.reshape(used, len(moves) * (FRAMES - 1))
    following = _unzigzag(_of_planes(planes)).reshape(len(moves), FRAMES - 1)
    twice = orders[moves] == 2
    following[twice] = np.cumsum(following[twice], axis=1, dtype=np.int32)
    numbers = np.repeat(first[:, None], FRAMES, axis=1)
    numbers[moves, 1:] = first[moves, None] + np.cumsum(following, axis=1, dtype=np.int32)
    return np.ascontiguousarray(numbers.T)


def _of_planes(planes: NDArray[np.uint8]) -> NDArray[np.uint32]:
    """(N,) numbers of the planes of their bytes, (up to 4, N), the lowest first."""
    whole = np.zeros((planes.shape[1], 4), np.uint8)
    whole[:, : len(planes)] = planes.T
    return whole.view("<u4")[:, 0]


def _zigzag(numbers: NDArray[np.int32]) -> NDArray[np.uint32]:
    """Signed numbers with small ones small: 0, -1, 1, -2 … are 0, 1, 2, 3 …."""
    return ((numbers << 1) ^ (numbers >> 31)).view(np.uint32)


def _unzigzag(numbers: NDArray[np.uint32]) -> NDArray[np.int32]:
    return ((numbers >> 1) ^ (~(numbers & 1) + 1)).view(np.int32)


def _size(numbers: NDArray[np.uint32]) -> NDArray[np.float64]:
    """About how many bits columns of numbers take, (C,)."""
    return np.log2(numbers + 1.0).sum(axis=0)
