"""The binary half of the stream: the one declaration of a frame's layout, and its encoding.

A frame is a fixed header, then every skeleton's joint quaternions, the root positions and the parameter
values, each section padded with zeros to eight bytes. `_dtype` is where that is said; the manifest's offsets,
the page's reader and the documentation are derived from it.
"""

from __future__ import annotations

import struct
from enum import IntFlag
from functools import lru_cache
from typing import TYPE_CHECKING, Any, TypeAlias, cast

import numpy as np

from reina.errors import InputError
from reina.protocol.manifest import PROTOCOL_VERSION, Manifest, ParameterManifest, SkeletonManifest

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

    from reina.performance import FrameBlock, FrameLayout

Frames: TypeAlias = "NDArray[np.void]"
"""(F,) structured array of `frame_dtype`."""

ALIGNMENT = 8
FLOAT = np.dtype("<f4")

HEADER = np.dtype(
    [
        ("version", "u1"),
        ("epoch", "u1"),
        ("flags", "<u2"),
        ("index", "<u4"),
        ("song_time_s", "<f8"),
        ("due_time_s", "<f8"),
    ]
)
"""What every frame begins with, whatever its manifest says."""


class FrameFlag(IntFlag):
    """Bits of the header's `flags`."""

    PLAYING = 1
    """The music clock runs."""
    FIRST = 2
    """The first frame of its epoch."""
    CUT = 4
    """Do not blend from the frame before."""


class FrameError(InputError):
    """Bytes that are not whole frames of the manifest that they are read with."""


def _aligned(offset: int) -> int:
    return -(-offset // ALIGNMENT) * ALIGNMENT


def fields_of(dtype: np.dtype[np.void]) -> list[tuple[str, np.dtype[Any], int]]:
    """Name, type and offset in bytes of each field, in their order."""
    fields = cast("Mapping[str, tuple[np.dtype[Any], int]]", dtype.fields)
    return [(name, field[0], field[1]) for name, field in fields.items()]


_HEADER = struct.Struct("<" + "".join(field.char for _, field, _ in fields_of(HEADER)))
"""The same for one frame at a time, sixty times a second."""


@lru_cache
def _dtype(joints: int, skeletons: int, parameters: int) -> np.dtype[np.void]:
    """The layout of a frame with so many joints (of all skeletons), skeletons and parameter floats."""
    fields: list[tuple[str, Any, int]] = [*fields_of(HEADER)]
    end = HEADER.itemsize
    for name, shape in (
        ("rotations", (joints, 4)),
        ("root_positions", (skeletons, 3)),
        ("parameters", (parameters,)),
    ):
        fields.append((name, (FLOAT, shape), _aligned(end)))
        end = _aligned(end) + FLOAT.itemsize * int(np.prod(shape))
    return np.dtype(
        {
            "names": [name for name, _, _ in fields],
            "formats": [format_ for _, format_, _ in fields],
            "offsets": [offset for _, _, offset in fields],
            "itemsize": _aligned(end),
        }
    )


def _offset(dtype: np.dtype[np.void], field: str) -> int:
    """Bytes from the frame's start to a field."""
    return next(offset for name, _, offset in fields_of(dtype) if name == field)


def build_manifest(layout: FrameLayout) -> Manifest:
    """The manifest of the frames that a performance evaluates to.

    Args:
        layout: Frame rate, skeletons (name, rig, joints), parameters (path, type, length in floats, blend).
    """
    dtype = _dtype(
        sum(len(skeleton.joints) for skeleton in layout.skeletons),
        len(layout.skeletons),
        sum(parameter.length for parameter in layout.parameters),
    )
    skeletons: list[SkeletonManifest] = []
    offset, root_offset = _offset(dtype, "rotations"), _offset(dtype, "root_positions")
    for skeleton in layout.skeletons:
        skeletons.append(
            SkeletonManifest(
                name=skeleton.name,
                player=skeleton.player,
                rig=skeleton.rig,
                joints=list(skeleton.joints),
                offset=offset,
                root_offset=root_offset,
            )
        )
        offset += 4 * FLOAT.itemsize * len(skeleton.joints)
        root_offset += 3 * FLOAT.itemsize
    parameters: list[ParameterManifest] = []
    offset = _offset(dtype, "parameters")
    for parameter in layout.parameters:
        parameters.append(
            ParameterManifest(
                path=parameter.path,
                type=parameter.type,
                offset=offset,
                length=parameter.length,
                blend=parameter.blend,
            )
        )
        offset += FLOAT.itemsize * parameter.length
    return Manifest(fps=layout.fps, frame_size=dtype.itemsize, skeletons=skeletons, parameters=parameters)


def frame_dtype(manifest: Manifest) -> np.dtype[np.void]:
    """The layout of the manifest's frames.

    Returns:
        The header's fields, `rotations` (J, 4), `root_positions` (S, 3) and `parameters` (P,), J counting the
        joints of all skeletons and P the floats of all parameters.
    """
    return _dtype(
        sum(len(skeleton.joints) for skeleton in manifest.skeletons),
        len(manifest.skeletons),
        sum(parameter.length for parameter in manifest.parameters),
    )


def encode_block(manifest: Manifest, block: FrameBlock) -> Frames:
    """Encode a block once for all viewers; `stamp` adds epoch, due time and the other flags as it is sent.

    Returns:
        (F,) frames with padding zero, epoch 0, due time 0, and no flag but `CUT`: as they stand over HTTP.
    """
    # Zeros, not empty: the padding between the sections goes out on the wire too.
    frames = np.zeros(len(block.song_time_s), frame_dtype(manifest))
    frames["version"] = PROTOCOL_VERSION
    frames["flags"] = np.where(block.cuts, FrameFlag.CUT, 0)
    frames["index"] = block.first_frame + np.arange(len(frames))
    frames["song_time_s"] = block.song_time_s
    frames["rotations"] = block.rotations
    frames["root_positions"] = block.root_positions
    frames["parameters"] = block.parameters
    return frames


def join(runs: Sequence[Frames]) -> Frames:
    """Copy runs of frames into one, padding and all.

    NumPy copies structured arrays field by field and leaves the padding as it finds it, or packs it away; so
    this goes by bytes.
    """
    return np.concatenate([run.view(np.uint8) for run in runs]).view(runs[0].dtype)


def bytes_of(frames: Frames) -> memoryview:
    """The bytes of whole frames, padding and all; a view, not a copy."""
    return frames.view(np.uint8).data


def stamp(frame: memoryview, *, epoch: int, due_time_s: float, flags: int) -> bytes:
    """A copy of an encoded frame, with what is known only as it is sent.

    Args:
        frame: The frame's bytes.
        epoch: The clock's epoch; its low eight bits are sent.
        due_time_s: Server time at which the frame is to be seen.
        flags: Flags beside those that it has.
    """
    version, _, own, index, song_time_s, _ = _HEADER.unpack_from(frame)
    head = _HEADER.pack(version, epoch & 0xFF, own | flags, index, song_time_s, due_time_s)
    return head + frame[HEADER.itemsize :]


def decode(manifest: Manifest, data: bytes) -> Frames:
    """View bytes as frames, for readers of the stream or of HTTP.

    Raises:
        FrameError: When the bytes are not whole frames, or of another version.
    """
    if len(data) % manifest.frame_size:
        raise FrameError(
            f"{len(data)} bytes are not a whole number of frames of {manifest.frame_size} bytes each"
        )
    frames = np.frombuffer(data, frame_dtype(manifest))
    others = frames["version"] != PROTOCOL_VERSION
    if others.any():
        raise FrameError(
            f"the frame is of version {frames['version'][others][0]}; this reads version {PROTOCOL_VERSION}",
            location=f"frame {int(np.flatnonzero(others)[0])}",
        )
    return frames
