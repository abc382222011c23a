"""What cloth is cut and shaded by: lines through a mesh, turned edges, normals, how open a place lies."""

from __future__ import annotations

import importlib
import sys
from pathlib import Path
from typing import Any, cast

import numpy as np
import pytest
from numpy.typing import NDArray

Array = NDArray[np.float64]
BUILD = Path(__file__).parents[3] / "rigs/build"


@pytest.fixture(scope="module")
def build() -> Any:
    """The build's modules, which stand on a path of their own."""
    sys.path.insert(0, str(BUILD))
    try:
        return {name: importlib.import_module(f"common.{name}") for name in ("meshes", "occlusion", "shapes")}
    finally:
        sys.path.remove(str(BUILD))


def sheet(build: Any, rows: int = 9, columns: int = 13, ripple: float = 0.0) -> Any:
    """A mesh over the unit square, facing up the third axis; its one weight is x."""
    y, x = (
        axis.ravel()
        for axis in np.meshgrid(np.linspace(0, 1, rows), np.linspace(0, 1, columns), indexing="ij")
    )
    vertices = np.c_[x, y, ripple * np.sin(9 * x) * np.cos(7 * y)]
    return build["meshes"].Mesh(vertices, x[:, None].copy(), build["shapes"].grid_faces(rows, columns))


def area(mesh: Any) -> float:
    a, b, c = (mesh.vertices[mesh.faces[:, k]] for k in range(3))
    return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2)


def slanted(vertices: Array) -> Array:
    """Distance from a slanted line through the square."""
    return 0.8 * vertices[:, 0] + 0.6 * vertices[:, 1] - 0.63


def test_a_scored_mesh_has_its_line_and_is_the_same_surface(build: Any) -> None:
    mesh = sheet(build)
    scored, field = cast("tuple[Any, Array]", mesh.scored(slanted(mesh.vertices), near_m=0.01))
    assert area(scored) == pytest.approx(1.0, abs=1e-9)
    np.testing.assert_allclose(field[np.abs(field) < 1e-12], 0)
    sides: Array = np.sign(np.round(field[scored.faces], 12))
    assert not ((sides > 0).any(axis=1) & (sides < 0).any(axis=1)).any(), "a triangle crosses the line"
    np.testing.assert_allclose(slanted(scored.vertices)[field == 0], 0, atol=1e-9)
    np.testing.assert_allclose(scored.weights[:, 0], scored.vertices[:, 0], atol=1e-9)
    inner = build["meshes"].border_edges(scored.faces)
    ends = scored.vertices[inner]
    on_rim = np.isclose(ends, 0) | np.isclose(ends, 1)
    assert on_rim[..., :2].any(axis=2).all(), "the surface was torn"


def test_a_line_is_scored_only_where_it_is_wanted(build: Any) -> None:
    mesh = sheet(build)
    within = mesh.vertices[:, 1] < 0.5
    scored, _ = mesh.scored(slanted(mesh.vertices), within, near_m=0.0)
    new = scored.vertices[len(mesh.vertices) :]
    assert len(new) > 3
    assert (new[:, 1] < 0.5).all()
    assert area(scored) == pytest.approx(1.0, abs=1e-9)


def test_what_is_clipped_ends_at_the_line_without_slivers(build: Any) -> None:
    mesh = sheet(build)
    plain, snapped = (mesh.scored(slanted(mesh.vertices), near_m=near)[0] for near in (0.0, 0.02))
    clipped = mesh.clipped(slanted(mesh.vertices))
    assert slanted(clipped.vertices).min() > -1e-9
    whole = mesh.scored(slanted(mesh.vertices), near_m=0.004)[0]
    middle = whole.vertices[whole.faces].mean(axis=1)
    kept = build["meshes"].Mesh(whole.vertices, whole.weights, whole.faces[slanted(middle) > 0])
    assert area(clipped) == pytest.approx(area(kept), rel=1e-9)
    assert len(snapped.faces) < len(plain.faces)


def test_edges_are_turned_in_all_round(build: Any) -> None:
    mesh = sheet(build, ripple=0.03)
    edged = build["meshes"].edged(mesh, 0.01)
    rim = np.unique(build["meshes"].border_edges(mesh.faces))
    inner = edged.vertices[len(mesh.vertices) :]
    np.testing.assert_allclose(np.linalg.norm(inner - mesh.vertices[rim], axis=1), 0.01, atol=1e-12)
    assert (inner[:, 2] < mesh.vertices[rim, 2]).all()
    assert len(edged.faces) - len(mesh.faces) == 2 * len(rim)
    # Each old rim edge has a face on both sides now, and they go along it in opposite ways.
    directed = {
        tuple(edge) for edge in np.vstack([edged.faces[:, [k, (k + 1) % 3]] for k in range(3)]).tolist()
    }
    for a, b in build["meshes"].border_edges(mesh.faces).tolist():
        assert {(a, b), (b, a)} <= directed


def test_even_normals_do_not_mind_how_a_surface_is_cut(build: Any) -> None:
    meshes = build["meshes"]
    roof = np.array([[0, 0, 0.0], [1, 0, 1.0], [2, 0, 0.0], [0, 1, 0.0], [1, 1, 1.0], [2, 1, 0.0]])
    left = np.array([[0, 1, 4], [0, 4, 3]])
    right = np.array([[1, 2, 5], [1, 5, 4]])
    more = np.vstack([roof, [[0.5, 0.5, 0.5]]])
    left_fan = np.array([[0, 1, 6], [1, 4, 6], [4, 3, 6], [3, 0, 6]])
    one = meshes.even_normals(roof, np.vstack([left, right]))
    other = meshes.even_normals(more, np.vstack([left_fan, right]))
    np.testing.assert_allclose(one, other[:6], atol=1e-12)
    np.testing.assert_allclose(one[1], [0, 0, 1], atol=1e-12)


def test_an_open_place_is_open_and_a_closed_one_dark(build: Any) -> None:
    occlusion = build["occlusion"]
    grain = occlusion.Grain(0.02, 0.035, 0.6)
    floor = sheet(build, 30, 30)
    lid = floor.vertices + np.array([0.0, 0.0, 0.1])
    up = np.tile([0.0, 0.0, 1.0], (3, 1))
    places = np.array([[0.5, 0.5, 0.0], [0.5, 0.2, 0.0], [3.0, 3.0, 0.0]])
    alone = occlusion.openness(occlusion.Cells(grain, [(floor.vertices, floor.faces)]), places, up)
    np.testing.assert_allclose(alone, 1)
    covered = occlusion.openness(
        occlusion.Cells(grain, [(floor.vertices, floor.faces), (lid, floor.faces)]), places, up
    )
    assert covered[0] < 0.45
    assert covered[0] <= covered[1] < 0.6
    assert covered[2] == 1


def test_the_directions_weigh_as_a_matt_surface_does(build: Any) -> None:
    directions = build["occlusion"].hemisphere(400)
    np.testing.assert_allclose(np.linalg.norm(directions, axis=1), 1)
    np.testing.assert_allclose(directions.mean(axis=0), [0, 0, 2 / 3], atol=0.01)


def test_points_cover_a_triangle(build: Any) -> None:
    corners = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.7, 0.0]])
    points = build["occlusion"].covering_points(corners, np.array([[0, 1, 2]]), 0.05)
    rng = np.random.default_rng(3)
    share = rng.dirichlet([1, 1, 1], 200)
    gaps = np.linalg.norm((share @ corners)[:, None] - points, axis=2).min(axis=1)
    assert gaps.max() < 0.05
