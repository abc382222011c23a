"""The visible skin: its texture, and the faces that clothes leave bare.

The texture is painted by where each texel lies on the body.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from scipy.spatial import cKDTree

from body.images import Picture, blurred, jpeg, mixed
from body.joint_names import SIDES
from common.meshes import Mesh, normals
from common.parts import Part, Surface

if TYPE_CHECKING:
    from body.figure import Figure
    from body.figure_file import FigureFile
    from body.makehuman import Face
    from body.skeleton import Skeleton

Array = NDArray[np.float64]

SIZE = 1024


def texel_positions(figure: Figure) -> tuple[Array, NDArray[np.bool_]]:
    """Where each texel lies on the body: positions (SIZE, SIZE, 3) and which texels lie on it at all."""
    positions = np.zeros((SIZE, SIZE, 3))
    covered = np.zeros((SIZE, SIZE), dtype=bool)
    for corners, uv_corners in figure.mesh.groups["body"]:
        for k in range(1, len(corners) - 1):
            pick = (0, k, k + 1)
            uv = figure.mesh.uv[[uv_corners[i] for i in pick]] * [SIZE, -SIZE] + [0, SIZE]
            _fill(positions, covered, uv, figure.vertices[[corners[i] for i in pick]])
    return positions, covered


def _fill(positions: Array, covered: NDArray[np.bool_], uv: Array, corners: Array) -> None:
    low = np.floor(uv.min(axis=0) - 1).astype(int).clip(0, SIZE - 1)
    high = np.ceil(uv.max(axis=0) + 1).astype(int).clip(0, SIZE - 1)
    across: Array = np.arange(low[0], high[0] + 1, dtype=np.float64) + 0.5
    down: Array = np.arange(low[1], high[1] + 1, dtype=np.float64) + 0.5
    x, y = np.meshgrid(across, down)
    a, b = uv[1] - uv[0], uv[2] - uv[0]
    area = a[0] * b[1] - a[1] * b[0]
    if abs(area) < 1e-9:
        return
    s = ((x - uv[0, 0]) * b[1] - (y - uv[0, 1]) * b[0]) / area
    t = ((y - uv[0, 1]) * a[0] - (x - uv[0, 0]) * a[1]) / area
    inside = (s > -0.02) & (t > -0.02) & (s + t < 1.02)
    rows, columns = (y[inside] - 0.5).astype(int), (x[inside] - 0.5).astype(int)
    edges = corners[1] - corners[0], corners[2] - corners[0]
    positions[rows, columns] = corners[0] + s[inside][:, None] * edges[0] + t[inside][:, None] * edges[1]
    covered[rows, columns] = True


def _mask(figure: Figure, name: str) -> Picture:
    image = Image.open(figure.mesh.data / "textures" / f"mpfb_{name}.jpg").convert("L").resize((SIZE, SIZE))
    return np.asarray(image, np.float32) / 255


def lip_centre(figure: Figure, positions: Array, covered: NDArray[np.bool_]) -> Array:
    """The middle (3,) of the painted lips."""
    centre: Array = positions[(_mask(figure, "lips") > 0.5) & covered].mean(axis=0)
    return centre


def paint_skin(
    file: FigureFile, figure: Figure, skeleton: Skeleton, positions: Array, covered: NDArray[np.bool_]
) -> Picture:
    """Base tone, warmth at cheeks, nose, ears, lips, knuckles and nails, and the brows."""
    rng = np.random.default_rng(7)
    picture: Picture = np.tile(np.array(file.skin, np.float32), (SIZE, SIZE, 1))
    noise = blurred(rng.random((SIZE, SIZE)), 3)
    noise = (noise - noise.mean()) / noise.std()
    broad = blurred(rng.random((SIZE, SIZE)), 22)
    broad = (broad - broad.mean()) / broad.std()
    picture = picture * (1 + 0.013 * noise[..., None] * np.array([0.5, 1, 1], np.float32))
    picture = picture * (1 + 0.012 * broad[..., None] * np.array([0.3, 1.1, 1.0], np.float32))

    def spot(centre: Array, spread: list[float]) -> Array:
        glow: Array = np.exp(-(((positions - centre) / spread) ** 2).sum(axis=-1) / 2) * covered
        return glow

    mouth = lip_centre(figure, positions, covered)
    eyes = {sign: figure.centre(f"helper-{letter}-eye") for sign, letter in ((1, "l"), (-1, "r"))}
    for sign, eye in eyes.items():
        picture = mixed(
            picture,
            (0.93, 0.52, 0.47),
            0.38 * spot(eye + np.array([sign * 0.012, -0.03, 0]), [0.014, 0.010, 0.05]),
        )
        picture = mixed(
            picture, (0.80, 0.50, 0.45), 0.30 * spot(eye + np.array([0, 0.01, 0.01]), [0.016, 0.007, 0.03])
        )
    nose = np.array([0, eyes[1][1] - 0.032, mouth[2] + 0.012])
    picture = mixed(picture, (0.93, 0.62, 0.55), 0.35 * spot(nose, [0.009, 0.009, 0.012]))
    picture = mixed(picture, (0.90, 0.58, 0.52), 0.35 * blurred(_mask(figure, "ears"), 4))
    picture = mixed(picture, (0.84, 0.42, 0.42), 0.52 * blurred(_mask(figure, "lips"), 3))
    picture = mixed(picture, (0.97, 0.78, 0.75), 0.75 * blurred(_mask(figure, "fingernails"), 1))
    for name in skeleton.names:
        if any(part in name for part in ("Index", "Middle", "Ring", "Little", "Thumb")):
            picture = mixed(picture, (0.90, 0.62, 0.55), 0.20 * spot(skeleton.positions[name], [0.007] * 3))
    for sign, eye in eyes.items():
        picture = mixed(picture, file.brow, 0.95 * _brow(positions, covered, eye, sign))
    return picture


def _brow(positions: Array, covered: NDArray[np.bool_], eye: Array, sign: int) -> Picture:
    u = (positions[..., 0] - eye[0]) * sign
    t = (u + 0.017) / 0.040
    arch = eye[1] + 0.0185 + 0.0036 * np.sin(np.clip(t, 0, 1) * np.pi * 0.85) - 0.007 * np.clip(t - 0.6, 0, 1)
    half = 0.0036 * (1 - 0.62 * np.clip(t, 0, 1))
    stroke = np.clip(1.2 - np.abs(positions[..., 1] - arch) / half, 0, 1) * (t > 0) * (t < 1)
    stroke *= (
        np.clip(t * 6, 0, 1) * np.clip((1 - t) * 5, 0, 1) * covered * (positions[..., 2] > eye[2] - 0.01)
    )
    return blurred(stroke, 1.2)


def bare_skin(figure: Figure, skeleton: Skeleton, weights: Array, picture: Picture) -> Part:
    """Head, neck and hands as one part with morphs; body faces under cloth are left out."""
    v = figure.vertices
    column = {name: k for k, name in enumerate(skeleton.names)}
    hands = [
        k
        for name, k in column.items()
        if any(p in name for p in ("Hand", "Thumb", "Index", "Middle", "Ring", "Little"))
    ]
    keep = weights[:, hands].sum(axis=1) > 0.05
    for side, _ in SIDES:
        elbow, wrist = skeleton.positions[f"{side}LowerArm"], skeleton.positions[f"{side}Hand"]
        along = (v - elbow) @ (wrist - elbow) / ((wrist - elbow) @ (wrist - elbow))
        arm = weights[:, [column[f"{side}LowerArm"], column[f"{side}LowerArmTwist1"]]].sum(axis=1)
        keep |= (arm > 0.3) & (along > 0.88)
    rise = v[:, 1] - skeleton.positions["neck"][1]
    from_axis = np.hypot(v[:, 0], v[:, 2] - 0.0205 - 0.37 * np.clip(rise, -0.03, 0.06))
    above_collar = (rise > 0.05) | ((rise > -0.055) & (from_axis < 0.066))
    head, neck = weights[:, column["head"]], weights[:, column["neck"]]
    keep |= (head > 0.4) | ((head + neck > 0.12) & above_collar)
    faces = [face for face in figure.mesh.groups["body"] if keep[face[0]].all()]
    rows, uv_rows, triangles = _split_at_seams(faces)
    body_normals = normals(figure.vertices, figure.mesh.triangles(["body"]))
    mesh = Mesh(v[rows], weights[rows], triangles, figure.mesh.uv[uv_rows] * [1, -1] + [0, 1])
    surface = Surface("skin", 0.52, image=jpeg(picture, 88), shade=(0.70, 0.45, 0.39))
    return Part(
        "Skin",
        mesh,
        surface,
        body_normals[rows],
        {name: offsets[rows] for name, offsets in figure.morphs.items()},
    )


def _split_at_seams(faces: list[Face]) -> tuple[list[int], list[int], NDArray[np.int64]]:
    """One output vertex for each pair of vertex and texture coordinate; polygons become triangles."""
    pairs: dict[tuple[int, int], int] = {}
    triangles: list[list[int]] = []
    for corners, uv_corners in faces:
        ring = [pairs.setdefault(pair, len(pairs)) for pair in zip(corners, uv_corners, strict=True)]
        triangles.extend([ring[0], ring[k], ring[k + 1]] for k in range(1, len(ring) - 1))
    return [a for a, _ in pairs], [b for _, b in pairs], np.array(triangles)


def lashes(figure: Figure, weights: Array, length: float) -> Part:
    """The lashes, which follow the lids' morphs; `length` is a share of the source's."""
    groups = ["helper-l-eyelashes-2", "helper-r-eyelashes-2"]
    faces = figure.mesh.triangles(groups)
    used = np.unique(faces)
    mesh = Mesh(figure.vertices, weights, faces).compact()
    lids = figure.body[cKDTree(figure.body).query(mesh.vertices)[1]]
    mesh.vertices = lids + length * (mesh.vertices - lids)
    surface = Surface("lashes", 0.9, colour=(0.13, 0.085, 0.075), both_sides=True, shade=None)
    return Part(
        "Lashes", mesh, surface, None, {name: offsets[used] for name, offsets in figure.morphs.items()}
    )
