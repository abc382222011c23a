"""Images painted by the build: small raster operations and JPEG bytes."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageFilter

if TYPE_CHECKING:
    from body.figure_file import Colour

Picture = NDArray[np.floating[Any]]


def jpeg(picture: Picture, quality: int) -> tuple[bytes, str]:
    """RGB 0…1 (H, W, 3) as JPEG bytes and their MIME type."""
    file = io.BytesIO()
    Image.fromarray((picture.clip(0, 1) * 255).astype(np.uint8)).save(file, "JPEG", quality=quality)
    return file.getvalue(), "image/jpeg"


def blurred(grey: Picture, radius_px: float) -> Picture:
    """A grey picture 0…1 (H, W), blurred."""
    image = Image.fromarray((grey * 255).clip(0, 255).astype(np.uint8)).filter(
        ImageFilter.GaussianBlur(radius_px)
    )
    return np.asarray(image, np.float32) / 255


def mixed(picture: Picture, colour: tuple[float, float, float], amount: Picture) -> Picture:
    """The picture (H, W, 3) with a colour laid over it by `amount` (H, W)."""
    over = amount[..., None].astype(np.float32)
    result: Picture = picture * (1 - over) + np.array(colour, np.float32) * over
    return result


def hair_picture(tint: Colour, width: int = 256, height: int = 512) -> Picture:
    """Strands along v, lighter in a band where the crown catches the light; the last rows dark."""
    rng = np.random.default_rng(11)
    strands = np.zeros(width)
    for size, amount in ((1, 0.5), (3, 0.35), (7, 0.25)):
        noise = rng.standard_normal(width)
        strands += amount * np.convolve(noise, np.ones(size) / size, "same") * np.sqrt(size)
    strands = (strands - strands.mean()) / strands.std()
    t = np.linspace(0, 1, height)[:, None]
    shade = 0.80 + 0.38 * np.exp(-(((t - 0.40) / 0.12) ** 2)) + 0.10 * t
    grey = shade * (1 + 0.16 * strands[None]) * np.where(t > 0.98, 0.12, 1.0)
    return (grey[..., None] * np.array(tint)).astype(np.float32)


def eye_picture(inner: Colour, outer: Colour, size: int = 512) -> Picture:
    """An eye seen from the front: white, iris from its inner to its outer colour, pupil and two lights."""
    rng = np.random.default_rng(5)
    steps = np.arange(size, dtype=np.float64)
    x, y = np.meshgrid(steps, steps)
    half = size / 2
    r = np.hypot(x - half + 0.5, y - half + 0.5) / half
    angle = np.arctan2(y - half, x - half)
    iris, pupil = 0.49, 0.20
    spokes: Picture = np.interp(
        angle, np.linspace(-np.pi, np.pi, 181), np.convolve(rng.random(181), np.ones(3) / 3, "same")
    )
    picture: Picture = np.ones((size, size, 3)) * [0.96, 0.955, 0.95]
    picture *= 1 - 0.18 * np.clip(r - 0.55, 0, 1)[..., None] * np.array([0.6, 1, 1])
    t = np.clip((r - pupil) / (iris - pupil), 0, 1)
    brown: Picture = np.array(inner) * (1 - t)[..., None] + np.array(outer) * t[..., None]
    brown *= (0.75 + 0.5 * spokes[..., None]) * (1.15 - 0.55 * np.clip((half - y) / (size * 0.23), -1, 1))[
        ..., None
    ]
    brown *= (1 - 0.75 * np.clip((t - 0.80) / 0.2, 0, 1))[..., None]
    black: Picture = np.full(3, 0.02)
    for edge, colour, soft in ((iris, brown, 1.5), (pupil, black, 2.0)):
        inside = np.clip((edge - r) * half / soft, 0, 1)[..., None]
        picture = picture * (1 - inside) + colour * inside
    lid = np.clip((half * 0.80 - y) / (half * 0.42), 0, 1)  # the upper lid's shadow
    picture = picture * (1 - 0.42 * lid[..., None] * np.array([0.8, 0.95, 1.0]))
    for cx, cy, radius, amount in ((-0.15, -0.17, 0.085, 1.0), (0.14, 0.15, 0.04, 0.7)):
        light = np.clip((radius - np.hypot((x - half) / half - cx, (y - half) / half - cy)) * half / 2, 0, 1)[
            ..., None
        ]
        picture = picture * (1 - light * amount) + light * amount
    return picture.astype(np.float32)
