"""Images of wood, lathed bronze and the front head, painted by the build."""

from __future__ import annotations

import io
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from body.images import jpeg

Picture = NDArray[np.floating[Any]]
INK, PAPER = (0.078, 0.090, 0.122), (0.957, 0.937, 0.902)
RED, BLUE, BRASS = (0.761, 0.231, 0.231), (0.298, 0.416, 0.604), (0.851, 0.643, 0.255)
STAIN_LIGHT, STAIN_DARK = np.array([0.50, 0.125, 0.085]), np.array([0.17, 0.035, 0.035])
MAPLE = np.array([0.80, 0.60, 0.38])
HOOP_ROWS = 0.125
"""The lowest share of the shell's image is the hoops' maple."""


def png(picture: Picture) -> tuple[bytes, str]:
    """RGB 0…1 (H, W, 3) as PNG bytes and their MIME type."""
    file = io.BytesIO()
    Image.fromarray((picture.clip(0, 1) * 255).round().astype(np.uint8)).save(file, "PNG", optimize=True)
    return file.getvalue(), "image/png"


def waves(rng: np.random.Generator, size: int, lowest: int, highest: int) -> Picture:
    """Noise (size,) that closes on itself, its waves between so many a round, of unit spread."""
    t = np.linspace(0, 2 * np.pi, size, endpoint=False)
    total = np.zeros(size)
    for k in range(lowest, highest):
        total += np.cos(k * t + rng.uniform(0, 2 * np.pi)) * rng.standard_normal() / np.sqrt(k)
    return total / total.std()


def shell_image(detail: float) -> tuple[bytes, str]:
    """Stained maple: u about the drum, v from head to head; darker at both ends, with the grain around."""
    width, height = (512, 256) if detail > 0.5 else (256, 128)
    rng = np.random.default_rng(21)
    rows: Picture = np.linspace(0, 1, height)[:, None]
    # Fine lines along u, which drift across as the grain of peeled wood does.
    drift = 3.2 * waves(rng, width, 1, 5) + 1.1 * waves(rng, width, 5, 14)
    lines = waves(rng, 1024, 20, 330)
    place = (rows * 700 + drift[None] * 6) % 1024
    grain: Picture = np.asarray(
        np.interp(place.ravel(), np.arange(1025), np.r_[lines, lines[0]]), dtype=np.float64
    ).reshape(height, width)
    broad = waves(rng, 1024, 2, 14)
    band: Picture = np.asarray(
        np.interp(((rows * 420 + drift[None] * 11) % 1024).ravel(), np.arange(1025), np.r_[broad, broad[0]]),
        dtype=np.float64,
    ).reshape(height, width)
    # Curl: light across the grain, in soft vertical flames.
    curl = waves(rng, width, 18, 60)[None] * np.exp(-(((rows - 0.5) / 0.5) ** 2))
    wood: Picture = np.clip(0.55 + 0.10 * grain + 0.13 * band + 0.09 * curl, 0, 1)
    inside = np.clip((rows - HOOP_ROWS) / (1 - HOOP_ROWS), 0, 1)
    burst = np.clip(1.0 - np.abs(2 * inside - 1) ** 2.6, 0, 1)
    amount: Picture = np.clip(wood * (0.35 + 0.85 * burst), 0, 1)[..., None]
    stained: Picture = STAIN_DARK * (1 - amount) + STAIN_LIGHT * amount
    hoop: Picture = MAPLE * (0.86 + 0.10 * grain[..., None] + 0.06 * band[..., None])
    picture: Picture = np.where((rows < HOOP_ROWS)[..., None], hoop, stained)
    # v runs from the image's top.
    return jpeg(picture.astype(np.float32), 82)


def bronze_images(detail: float) -> tuple[Picture, Picture, Picture, Picture]:
    """Of a cymbal, by radius (v from the middle to the edge).

    Its colour, its roughness (green), its grooves as normals, and how far it spreads light across (blue).
    """
    rows, columns = (512 if detail > 0.5 else 128), 16
    rng = np.random.default_rng(8)
    t: Picture = np.linspace(0, 1, rows)
    fine = rng.standard_normal(rows)
    bands = np.interp(t, np.linspace(0, 1, 90), rng.standard_normal(90))
    broad = np.interp(t, np.linspace(0, 1, 15), rng.standard_normal(15))
    lathed = np.clip((t - 0.24) / 0.03, 0, 1)  # the bell is left as it was cast and polished
    tone = 1 + lathed * (0.020 * fine + 0.024 * bands + 0.022 * broad) - 0.09 * (1 - lathed)
    bronze = np.array([0.900, 0.768, 0.520])
    colour = np.clip(tone[:, None] * bronze, 0, 1)
    rough = np.clip(
        0.30 + lathed * (0.030 * bands + 0.025 * broad) + 0.02 * fine * lathed - 0.08 * (1 - lathed),
        0.12,
        0.6,
    )
    groove = lathed * (0.5 * np.sin(2 * np.pi * rows / 4.2 * t + 2.5 * broad) + 0.45 * fine + 0.35 * bands)
    out = np.stack([np.zeros(rows), 0.55 * groove, np.ones(rows)], axis=1)
    out /= np.linalg.norm(out, axis=1, keepdims=True)
    shape = (rows, columns, 3)
    across = np.stack([np.full(rows, 0.5), np.ones(rows), 0.12 + 0.88 * lathed], axis=1)
    packed = np.stack([np.zeros(rows), rough, np.ones(rows)], axis=1)
    return (
        np.broadcast_to(colour[:, None], shape),
        np.broadcast_to(packed[:, None], shape),
        np.broadcast_to((0.5 + 0.5 * out)[:, None], shape),
        np.broadcast_to(across[:, None], shape),
    )


def skin_image() -> tuple[bytes, str]:
    """A coated head that is played: u about it, v from its edge to its middle, greyer where sticks land."""
    width, height = 256, 128
    rng = np.random.default_rng(33)
    v: Picture = np.linspace(0, 1, height)[:, None]
    blots = sum(
        waves(rng, width, k, 3 * k)[None] * np.sin(np.pi * (k * v + rng.uniform(0, 2))) for k in (2, 3, 5, 9)
    )
    worn = np.exp(-(((v - 0.86) / 0.20) ** 2)) * (0.55 + 0.16 * blots)
    specks = rng.standard_normal((height, width)) * 0.012
    grey = np.clip(1.0 - 0.13 * np.clip(worn, 0, 1) + specks, 0, 1)
    return jpeg((grey[..., None] * np.array([0.845, 0.835, 0.795])).astype(np.float32), 80)


def front_head_image(detail: float) -> tuple[bytes, str]:
    """The bass drum's front head, seen from the front: ink, a thin ring, three dots in a row."""
    size = 512 if detail > 0.5 else 256
    steps: Picture = (np.arange(size) + 0.5) / size * 2 - 1
    x, y = np.meshgrid(steps, steps)
    soft = 1.5 * 2 / size
    picture: Picture = np.ones((size, size, 3)) * np.array(INK)

    def over(distance: Picture, colour: tuple[float, float, float], share: float = 1.0) -> None:
        nonlocal picture
        amount = np.clip(0.5 - distance / soft, 0, 1)[..., None] * share
        picture = picture * (1 - amount) + np.array(colour) * amount

    r = np.hypot(x, y)
    over(np.abs(r - 0.90) - 0.006, PAPER, 0.85)
    for column, colour in ((-0.19, RED), (0.0, BLUE), (0.19, BRASS)):
        over(np.hypot(x - column, y) - 0.062, colour)
    return png(picture)
