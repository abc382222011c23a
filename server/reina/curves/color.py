"""Colours: ``#RRGGBB``, linear sRGB, and OKLab, the space in which they are mixed.

Linear sRGB is what a renderer adds light in and what the wire carries. Halfway between two colours in it
looks too bright and drifts in hue, so keyframes mix in OKLab (Björn Ottosson 2020,
https://bottosson.github.io/posts/oklab/), where equal steps look equal.
"""

import re

import numpy as np

from reina.curves.arrays import FloatArray
from reina.curves.shown import shown

_HEX = re.compile(r"#[0-9a-fA-F]{6}")

_LMS_FROM_LINEAR: FloatArray = np.array(
    [
        [0.4122214708, 0.5363325363, 0.0514459929],
        [0.2119034982, 0.6806995451, 0.1073969566],
        [0.0883024619, 0.2817188376, 0.6299787005],
    ]
)
_LAB_FROM_ROOTS: FloatArray = np.array(
    [
        [0.2104542553, 0.7936177850, -0.0040720468],
        [1.9779984951, -2.4285922050, 0.4505937099],
        [0.0259040371, 0.7827717662, -0.8086757660],
    ]
)
# Inverted here, where the published inverses have as many digits as the matrices: there and back must be the
# same colour.
_LINEAR_FROM_LMS: FloatArray = np.linalg.inv(_LMS_FROM_LINEAR).astype(np.float64)
_ROOTS_FROM_LAB: FloatArray = np.linalg.inv(_LAB_FROM_ROOTS).astype(np.float64)


def linear_from_srgb(encoded: FloatArray) -> FloatArray:
    """Linear light of sRGB components in 0..1, any shape (IEC 61966-2-1)."""
    return np.where(encoded <= 0.04045, encoded / 12.92, ((np.maximum(encoded, 0.0) + 0.055) / 1.055) ** 2.4)


def srgb_from_linear(linear: FloatArray) -> FloatArray:
    """SRGB components of linear light in 0..1, any shape (IEC 61966-2-1)."""
    return np.where(linear <= 0.0031308, linear * 12.92, 1.055 * np.maximum(linear, 0.0) ** (1 / 2.4) - 0.055)


def check_hex(text: str) -> None:
    """Refuse a text that is no ``#RRGGBB``.

    Raises:
        ValueError: The text is of another form.
    """
    if _HEX.fullmatch(text) is None:
        raise ValueError(f"{shown(text)} is no colour; write #RRGGBB, as #D9A441")


def linear_from_hex(text: str) -> FloatArray:
    """The three linear components of ``#RRGGBB``.

    Raises:
        ValueError: The text is of another form.
    """
    check_hex(text)
    encoded = np.array([int(text[at : at + 2], 16) / 255.0 for at in (1, 3, 5)])
    return linear_from_srgb(encoded)


def hex_from_linear(linear: FloatArray) -> str:
    """The nearest ``#RRGGBB`` to three linear components; what lies outside 0..1 is clipped."""
    encoded = np.rint(np.clip(srgb_from_linear(np.asarray(linear)), 0.0, 1.0) * 255.0).astype(int)
    return "#" + "".join(f"{component:02X}" for component in encoded.tolist())


def oklab_from_linear(linear: FloatArray) -> FloatArray:
    """OKLab (L, a, b) of linear sRGB, ``(..., 3)``."""
    return _mapped(_LAB_FROM_ROOTS, np.cbrt(_mapped(_LMS_FROM_LINEAR, linear)))


def linear_from_oklab(lab: FloatArray) -> FloatArray:
    """Linear sRGB of OKLab, ``(..., 3)``; not clipped."""
    roots = _mapped(_ROOTS_FROM_LAB, lab)
    return _mapped(_LINEAR_FROM_LMS, roots * roots * roots)


def _mapped(matrix: FloatArray, colors: FloatArray) -> FloatArray:
    """A matrix times colours ``(..., 3)``; unlike BLAS to the same bits, however many there are."""
    return np.einsum("ij,...j->...i", matrix, colors)
