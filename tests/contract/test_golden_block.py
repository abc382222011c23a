"""The bytes of a packed block, version 1, as committed."""

from __future__ import annotations

import zlib

import numpy as np
import pytest
from tests.contract.golden import GOLDEN
from tests.contract.golden_block import BLOCK, CUTS, FORMS, REVISION, block_frames, manifest, steps

from reina.protocol import decode, pack, unpack
from reina.protocol.frame import fields_of
from reina.protocol.packed_block import HEADER, packed_header

HEADER_SIZE = 32


@pytest.mark.parametrize("form", FORMS)
def test_what_is_packed_is_the_committed_block(form: str) -> None:
    """Of what zlib makes of it the length may differ from one zlib to another, and nothing else."""
    golden = (GOLDEN / f"block_v1_{form}.bin").read_bytes()
    made = pack(manifest(), block_frames(), steps(form), revision=REVISION)
    assert made[:HEADER_SIZE] == golden[:HEADER_SIZE]
    assert zlib.decompress(made[HEADER_SIZE:]) == zlib.decompress(golden[HEADER_SIZE:])


@pytest.mark.parametrize("form", FORMS)
def test_the_committed_block_is_read_as_the_committed_frames(form: str) -> None:
    found = unpack(manifest(), (GOLDEN / f"block_v1_{form}.bin").read_bytes())
    golden = decode(manifest(), (GOLDEN / f"block_v1_{form}_frames.bin").read_bytes())
    for name in found.dtype.names or ():
        # Square roots and powers may differ in the last bit from one machine to another.
        np.testing.assert_allclose(found[name], golden[name], rtol=0, atol=1e-6)
    if form == "lossless":
        assert found.tobytes() == block_frames().tobytes()


def test_the_header_is_the_contracts_table() -> None:
    header = packed_header((GOLDEN / "block_v1_packed.bin").read_bytes())
    assert HEADER.itemsize == HEADER_SIZE
    assert {name: offset for name, _, offset in fields_of(HEADER)} == {
        "magic": 0,
        "version": 2,
        "fps": 3,
        "block": 4,
        "revision": 8,
        "cuts": 16,
        "frame_size": 24,
        "unused": 28,
    }
    assert (header["block"], header["revision"]) == (BLOCK, REVISION)
    assert [bit for bit in range(64) if int(header["cuts"]) >> bit & 1] == list(CUTS)
