"""Tailored sleeves: close to the arm, set in at an armhole, with the folds that a bent arm leaves."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from body.joint_names import SIDES
from common.meshes import Mesh, joined, normals, on_border, smoothed, smoothstep
from common.raycast import ray_distances
from common.shapes import grid_faces
from dress.tailor import borrowed_weights

if TYPE_CHECKING:
    from dress.tailor import Tailor

Array = NDArray[np.float64]

ARM_PARTS = ("UpperArm", "UpperArmTwist1", "LowerArm", "LowerArmTwist1")
SLEEVE_EASE_M = 0.0115  # how far a sleeve stands off the arm, and the coat off the shoulder
COAT_EASE_M = 0.0135
LOOSENESS = (0.25, 0.12)  # what is left of the cloth's further distance, below the chest and at the shoulders
SHOULDER_EASE_M = 0.0018  # by so much it is closer there
SHOULDER_REACH_M = 0.15  # within it skin weights are eased
SHOULDER_ROUNDS = 16
PAD_M = (0.08, 0.040)  # a shoulder pad's reach inward and outward of the joint
PAD_LIFT_M = 0.008
HEAD_M = (0.11, 0.009)  # how far down the arm the sleeve's head is drawn in, and how much
PAD_HOLDS = 0.75  # what the shoulder keeps of what would follow the arm
CUFF = ((0.845, 0.0060), (0.885, 0.0072), (0.938, 0.0075), (0.940, 0.0062), (0.90, 0.0052))  # place, ease m
FOLDS = (  # centre and reach along the arm (0 shoulder, 1 elbow, 2 wrist), depth m, folds in the reach, slant
    (1.00, 0.36, 0.0085, 3.4, 0.22),
    (0.32, 0.26, 0.0065, 2.2, -0.45),
    (1.62, 0.24, 0.0035, 2.4, 0.20),
)


def fitted(tailor: Tailor, mesh: Mesh) -> Mesh:
    """The coat drawn to the body: closer along the arms, with a soft shoulder."""
    body = tailor.figure.body
    covered = tailor.weight_of(tailor.weights[: len(body)], "head", "neck") < 0.5
    tree = cKDTree(body[covered])
    distance, index = tree.query(mesh.vertices, k=6)
    near = 1 / (distance + 1e-3)
    near /= near.sum(axis=1, keepdims=True)
    skin = (body[covered][index] * near[..., None]).sum(axis=1)
    away = mesh.vertices - skin
    reach: Array = np.linalg.norm(away, axis=1)
    ease = COAT_EASE_M + (SLEEVE_EASE_M - COAT_EASE_M) * np.clip(_sleeve_share(tailor, mesh), 0, 1)
    high = smoothstep((mesh.vertices[:, 1] - float(tailor.at("chest")[1]) - 0.04) / 0.10)
    ease -= SHOULDER_EASE_M * high
    loose = LOOSENESS[0] + (LOOSENESS[1] - LOOSENESS[0]) * high
    wanted: Array = np.where(reach > ease, ease + loose * (reach - ease), reach)
    drawn: Array = mesh.vertices + away * (wanted / np.maximum(reach, 1e-6) - 1)[:, None]
    border = on_border(len(mesh.vertices), mesh.faces)
    mesh.vertices = smoothed(drawn, mesh.faces, 6, border)
    return mesh


def softened(tailor: Tailor, mesh: Mesh) -> Mesh:
    """Skin weights eased about the shoulders, so that a raised arm bends the cloth over a wider span."""
    near = np.zeros(len(mesh.vertices), dtype=bool)
    for side, _ in SIDES:
        near |= np.linalg.norm(mesh.vertices - tailor.at(f"{side}UpperArm"), axis=1) < SHOULDER_REACH_M
    mesh.weights = smoothed(mesh.weights, mesh.faces, SHOULDER_ROUNDS, ~near)
    return mesh


def padded(tailor: Tailor, mesh: Mesh) -> Mesh:
    """The coat with pads under its shoulders, which a raised arm leaves where they are."""
    v = mesh.vertices
    for side, _ in SIDES:
        joint, base = tailor.at(f"{side}UpperArm"), tailor.column(f"{side}Shoulder")
        outward = np.sign(joint[0]) * (v[:, 0] - joint[0])
        above = v[:, 1] - joint[1]
        share = (
            smoothstep((outward + PAD_M[0]) / PAD_M[0])
            * smoothstep((PAD_M[1] - outward) / PAD_M[1])
            * smoothstep((above + 0.015) / 0.035)
        )
        columns = [tailor.column(f"{side}{part}") for part in ARM_PARTS]
        kept = mesh.weights[:, columns] * (PAD_HOLDS * share)[:, None]
        mesh.weights[:, columns] -= kept
        mesh.weights[:, base] += kept.sum(axis=1)
        v = v + share[:, None] * PAD_LIFT_M * np.array([0.0, 1.0, 0.0])
        # The sleeve's head goes on from the pad, no higher.
        arm = tailor.at(f"{side}LowerArm") - joint
        arm /= np.linalg.norm(arm)
        along = (v - joint) @ arm
        head = smoothstep((along - 0.005) / 0.03) * smoothstep((HEAD_M[0] - along) / 0.05)
        inward = joint + along[:, None] * arm - v
        inward /= np.maximum(np.linalg.norm(inward, axis=1, keepdims=True), 1e-6)
        near = np.linalg.norm(v - joint, axis=1) < 2 * HEAD_M[0]
        v = v + inward * (HEAD_M[1] * head * near * smoothstep((above + 0.03) / 0.05))[:, None]
    mesh.vertices = v
    return mesh


def creased(tailor: Tailor, mesh: Mesh) -> Mesh:
    """Folds across elbow, armpit and cuff."""
    out = normals(mesh.vertices, mesh.faces)
    depth = np.zeros(len(mesh.vertices))
    for side, _ in SIDES:
        along, turn, share = _sleeve_coordinates(tailor, mesh, side)
        for centre, reach, height, count, slant in FOLDS:
            t = (along - centre) / reach
            window = np.clip(1 - t * t, 0, 1) ** 1.5
            phase = 2 * np.pi * count * (t / 2 + slant * np.cos(turn) / 2) + 1.3 * np.sin(turn)
            inner = 0.40 + 0.60 * smoothstep(0.5 + 0.5 * np.cos(turn))
            depth += share * window * inner * height * (np.sin(phase) - 0.35)
    mesh.vertices = mesh.vertices + out * depth[:, None]
    return mesh


def cuffs(tailor: Tailor, columns: int) -> Mesh:
    """Both of the shirt's cuffs: close round the wrist, with a turned edge."""
    body, faces = tailor.figure.body, tailor.figure.mesh.triangles(["body"])
    angle = np.linspace(0, 2 * np.pi, columns + 1)
    rings: list[Mesh] = []
    for side, _ in SIDES:
        elbow, wrist = tailor.at(f"{side}LowerArm"), tailor.at(f"{side}Hand")
        axes = tailor.skeleton.axes[f"{side}LowerArm"]
        near = np.linalg.norm(body - 0.1 * elbow - 0.9 * wrist, axis=1) < 0.09
        local = faces[near[faces].all(axis=1)]
        rows: list[Array] = []
        for share, ease in CUFF:
            centre = elbow + share * (wrist - elbow)
            spokes = np.cos(angle)[:, None] * axes[:, 1] + np.sin(angle)[:, None] * axes[:, 2]
            radii = np.array([ray_distances(centre, spoke, body, local)[0] for spoke in spokes[:-1]])
            smooth = np.convolve(np.r_[radii[-2:], radii, radii[:2]], np.full(5, 0.2), "valid") + ease
            rows.append(centre + spokes * np.r_[smooth, smooth[:1]][:, None])
        points = np.vstack(rows)
        weights = borrowed_weights(points, tailor.tights)
        rings.append(Mesh(points, weights, grid_faces(len(CUFF), columns + 1)))
    return joined(rings)


def _sleeve_share(tailor: Tailor, mesh: Mesh) -> Array:
    """How far (V,) each vertex belongs to a sleeve."""
    return tailor.weight_of(mesh.weights, *(f"{side}{part}" for side, _ in SIDES for part in ARM_PARTS))


def _sleeve_coordinates(tailor: Tailor, mesh: Mesh, side: str) -> tuple[Array, Array, Array]:
    """Place along the arm (V,), 0 shoulder, 1 elbow, 2 wrist.

    Turn (V,) rad about it, 0 inside the elbow; share (V,) of each vertex that is the sleeve's.
    """
    shoulder, elbow, wrist = (tailor.at(f"{side}{part}") for part in ("UpperArm", "LowerArm", "Hand"))
    upper, lower = elbow - shoulder, wrist - elbow
    first = (mesh.vertices - shoulder) @ upper / (upper @ upper)
    second = (mesh.vertices - elbow) @ lower / (lower @ lower)
    along = np.minimum(first, 1) + np.maximum(second, 0)
    foot = np.where(
        (along < 1)[:, None],
        shoulder + np.clip(first, 0, 1)[:, None] * upper,
        elbow + np.clip(second, 0, 1)[:, None] * lower,
    )
    spoke = mesh.vertices - foot
    axes = tailor.skeleton.axes[f"{side}LowerArm"]
    inward = -axes[:, 2] if side == "right" else axes[:, 2]
    turn = np.arctan2(spoke @ axes[:, 1], spoke @ inward)
    share: Array = tailor.weight_of(mesh.weights, *(f"{side}{part}" for part in ARM_PARTS))
    return along, turn, share
