"""Rows of tables of signals put together."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from reina.rotations.arrays import FloatArray


def stacked(rows: Mapping[str, FloatArray], names: Sequence[str]) -> FloatArray:
    """Rows ``(F,)`` in the order of some names, ``(len(names), F)``.

    As `numpy.stack`, which on many short rows takes several times as long.
    """
    return np.concatenate([rows[name] for name in names]).reshape(len(names), -1)


def joined(tables: Sequence[FloatArray], axis: int = 0) -> FloatArray:
    """Tables one after another along an axis; one alone is not copied."""
    return tables[0] if len(tables) == 1 else np.concatenate(tables, axis=axis)


def joined_rows(rows: Sequence[Mapping[str, FloatArray]]) -> Mapping[str, FloatArray]:
    """Rows by name, each one after another."""
    return rows[0] if len(rows) == 1 else {name: joined([one[name] for one in rows]) for name in rows[0]}
