"""Products of many rows with one matrix that come out the same in however many blocks they are asked for."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from reina.rotations.arrays import FloatArray

BLOCK_FRAMES = 60
"""Frames are evaluated in aligned blocks of so many, so that no byte depends on how a frame was asked for."""


def product(rows: FloatArray, matrix: FloatArray) -> FloatArray:
    """Rows ``(F, ..., K)`` times a matrix ``(K, N)``: ``(F, ..., N)``.

    How BLAS rounds depends on how many rows it is given. So whole blocks of frames are given one by one, and
    each has the bits that it would have alone.
    """
    blocks = len(rows) // BLOCK_FRAMES if len(rows) % BLOCK_FRAMES == 0 else 1
    found: FloatArray = np.matmul(rows.reshape(blocks, -1, rows.shape[-1]) if blocks else rows, matrix)
    return found.reshape(*rows.shape[:-1], matrix.shape[1])
