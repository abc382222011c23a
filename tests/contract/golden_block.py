"""The golden block, packed and lossless, and the frames that a reader makes of each.

`python -m tests.contract.golden_block` writes tests/golden/block_v1_packed.bin, block_v1_lossless.bin and the
frames of each (…_frames.bin) anew; a difference means that every reader has to change: another version.
"""

from __future__ import annotations

import numpy as np
from tests.contract.golden import COUNT, GOLDEN, golden_manifest

from reina.protocol import Frames, Manifest, Steps, frame_dtype, pack, unpack
from reina.protocol.packed_block import EXACT

BLOCK = 40
REVISION = 0x0123456789ABCDEF
CUTS = (0, 13, 59)
FORMS = ("packed", "lossless")


def manifest() -> Manifest:
    """That of the golden frames."""
    return Manifest.model_validate(golden_manifest())


def steps(form: str) -> Steps:
    """Of a form of the block."""
    if form == "lossless":
        return Steps.exact(manifest())
    joints, roots = [60, 62, 55, 56, 64], 9 * [64]
    parameters = [*3 * [56], *3 * [63], EXACT, 63, EXACT]
    return Steps(np.array([*joints, *roots, *parameters], np.uint8))


def block_frames() -> Frames:
    """Joints that rest, turn, turn over, are of negative sign, and tremble."""
    frames = np.zeros(60, frame_dtype(manifest()))
    number = np.arange(60)
    frames["version"] = 1
    frames["index"] = 60 * BLOCK + number
    frames["song_time_s"] = frames["index"] / 60
    frames["flags"][list(CUTS)] = 4
    half = np.zeros((60, COUNT))
    half[:, 1] = 0.3 * np.sin(number / 7)
    half[:, 2] = np.pi * number / 59
    half[:, 3] = np.pi + 0.2 * np.cos(number / 11)
    half[:, 4] = 1e-3 * ((number * 7919) % 13)
    axis = np.array([0.36, 0.48, 0.8])
    frames["rotations"][..., :3] = np.sin(half)[..., None] * axis
    frames["rotations"][..., 3] = np.cos(half)
    frames["root_positions"] = np.linspace(-1.5, 2.5, 60)[:, None, None] * np.arange(9).reshape(3, 3) / 8
    frames["parameters"] = (number[:, None] // 20 + np.arange(9) * np.sin(number / 5)[:, None]) / 4
    frames["parameters"][:, [6, 8]] = (number // 30)[:, None]
    return frames


def write() -> None:
    """Write the golden files."""
    for form in FORMS:
        data = pack(manifest(), block_frames(), steps(form), revision=REVISION)
        (GOLDEN / f"block_v1_{form}.bin").write_bytes(data)
        (GOLDEN / f"block_v1_{form}_frames.bin").write_bytes(unpack(manifest(), data).tobytes())


if __name__ == "__main__":
    write()
