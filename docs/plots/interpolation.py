"""Draw docs/images/interpolation-speed.svg and interpolation-path.svg: four ways between two orientations.

Run as ``python docs/plots/interpolation.py``. The same input gives the same files.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from reina import rotations as r

if TYPE_CHECKING:
    from reina.rotations.arrays import FloatArray

IMAGES = Path(__file__).parents[1] / "images"
FRACTIONS: FloatArray = np.linspace(0.0, 1.0, 241)
START: FloatArray = r.exp([2.5, 0.2, 0.3])
END: FloatArray = r.exp([-1.9, 0.8, 0.6])
POINTED: FloatArray = np.array([1.0, 0.0, 0.0])
"""The axis of the turned body whose way is drawn."""

COLOURS = {
    "slerp": "#14171F",
    "rotation vectors": "#4C6A9A",
    "Euler angles": "#C23B3B",
    "matrices": "#D9A441",
}
WIDTH, HEIGHT = 640, 360


def paths() -> dict[str, FloatArray]:
    """Where the pointed axis is along each way, ``(F, 3)``; matrices are left as they come."""
    t = FRACTIONS[:, None]
    vectors = (1 - t) * r.log(START) + t * r.log(END)
    euler = (1 - t) * r.to_euler(START, "zyx") + t * r.to_euler(END, "zyx")
    matrices = (1 - t[..., None]) * r.to_matrix(START) + t[..., None] * r.to_matrix(END)
    return {
        "slerp": r.rotate(r.slerp(START, END, FRACTIONS), POINTED),
        "rotation vectors": r.rotate(r.exp(vectors), POINTED),
        "Euler angles": r.rotate(r.from_euler(euler, "zyx"), POINTED),
        "matrices": matrices @ POINTED,
    }


def speeds() -> dict[str, FloatArray]:
    """Angular speed along each way, ``(F - 1,)``, in whole angles; matrices are made orthogonal first."""
    t = FRACTIONS[:, None]
    matrices = (1 - t[..., None]) * r.to_matrix(START) + t[..., None] * r.to_matrix(END)
    u, _, v = np.linalg.svd(matrices)
    ways = {
        "slerp": r.slerp(START, END, FRACTIONS),
        "rotation vectors": r.exp((1 - t) * r.log(START) + t * r.log(END)),
        "Euler angles": r.from_euler((1 - t) * r.to_euler(START, "zyx") + t * r.to_euler(END, "zyx"), "zyx"),
        "matrices": r.from_matrix(u @ v),
    }
    whole = r.angle_between(START, END)
    return {name: r.angle_between(q[1:], q[:-1]) / np.diff(FRACTIONS) / whole for name, q in ways.items()}


def svg(body: list[str], title: str) -> str:
    """An SVG with a legend."""
    legend = [
        f'<rect x="{20 + 155 * i}" y="14" width="12" height="12" fill="{colour}"/>'
        f'<text x="{38 + 155 * i}" y="25">{name}</text>'
        for i, (name, colour) in enumerate(COLOURS.items())
    ]
    head = (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif"'
        f' font-size="13" role="img"><title>{title}</title><rect width="100%" height="100%" fill="#F4EFE6"/>'
    )
    return "\n".join([head, *legend, *body, "</svg>"]) + "\n"


def line(x: FloatArray, y: FloatArray, colour: str, dash: str = "") -> str:
    """A polyline."""
    points = " ".join(f"{a:.1f},{b:.1f}" for a, b in zip(x, y, strict=True))
    style = f'fill="none" stroke="{colour}" stroke-width="2" stroke-dasharray="{dash}"'
    return f'<polyline points="{points}" {style}/>'


def draw_speed() -> str:
    """Speed over the fraction."""
    left, top, right, bottom = 56.0, 50.0, WIDTH - 20.0, HEIGHT - 46.0
    curves = speeds()
    most = 1.1 * max(float(curve.max()) for curve in curves.values())
    middle = 0.5 * (FRACTIONS[1:] + FRACTIONS[:-1])
    body = [
        f'<path d="M{left} {top}V{bottom}H{right}" fill="none" stroke="#14171F"/>',
        f'<text x="{(left + right) / 2 - 40}" y="{HEIGHT - 14}">fraction of the way</text>',
        f'<text x="14" y="{top - 8}">angular speed / mean speed of slerp</text>',
    ]
    for value in np.arange(0.0, most, 0.5).tolist():
        y = bottom - value / most * (bottom - top)
        body.append(f'<text x="{left - 32}" y="{y + 4:.1f}">{value:.1f}</text>')
        body.append(f'<path d="M{left} {y:.1f}H{right}" stroke="#14171F" opacity="0.12"/>')
    for name, curve in curves.items():
        x = left + middle * (right - left)
        body.append(line(x, bottom - curve / most * (bottom - top), COLOURS[name]))
    return svg(body, "Angular speed of four interpolations")


def draw_path() -> str:
    """The pointed axis on the unit sphere, seen along the mean direction of the slerp."""
    ways = paths()
    ahead = ways["slerp"][len(FRACTIONS) // 2]
    across = np.cross([0.0, 1.0, 0.0], ahead)
    across /= np.linalg.norm(across)
    up = np.cross(ahead, across)
    size, cx, cy = 150.0, WIDTH / 2.0, HEIGHT / 2.0 + 16.0
    body = [f'<circle cx="{cx}" cy="{cy}" r="{size}" fill="none" stroke="#14171F" opacity="0.4"/>']
    for name, way in ways.items():
        x, y = cx + size * way @ across, cy - size * way @ up
        body.append(line(x, y, COLOURS[name], "6 4" if name == "matrices" else ""))
        marks = slice(0, None, 24)
        body += [
            f'<circle cx="{a:.1f}" cy="{b:.1f}" r="3" fill="{COLOURS[name]}"/>'
            for a, b in zip(x[marks], y[marks], strict=True)
        ]
    return svg(body, "Path of one axis under four interpolations")


def main() -> None:
    """Write the files."""
    IMAGES.mkdir(exist_ok=True)
    (IMAGES / "interpolation-speed.svg").write_text(draw_speed())
    (IMAGES / "interpolation-path.svg").write_text(draw_path())


if __name__ == "__main__":
    main()
