"""What lies open is light in the models and what is closed in is dark, in every tier."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest
from tests.unit.rigs.skinned import HORNS, PLAYERS, ROOT, read_model, shaped

if TYPE_CHECKING:
    from pathlib import Path

TIERS = ("full", "medium", "low")
UNSHADED = {"Lashes", "Eyes"}


@pytest.mark.parametrize("tier", TIERS)
@pytest.mark.parametrize("player", PLAYERS)
def test_a_player_is_light_in_the_open_and_dark_where_closed_in(
    player: str, tier: str, tmp_path: Path
) -> None:
    content = read_model(ROOT / "rigs" / player / f"{tier}.glb", tmp_path / "model.json")
    for mesh in content["meshes"]:
        assert ("color_0" in mesh) == (mesh["name"] not in UNSHADED), mesh["name"]
    colours = {mesh["name"]: shaped(mesh["color_0"]) for mesh in content["meshes"] if "color_0" in mesh}
    for name, values in colours.items():
        assert values.min() > 0, name
        assert values.max() > 0.85, name
    skin = next(mesh for mesh in content["meshes"] if mesh["name"] == "Skin")
    places, normals = shaped(skin["position"]), shaped(skin["normal"])
    head = places[:, 1] > places[:, 1].max() - 0.22
    behind = places[head, 2].max() - places[:, 2]
    cavity = head & (behind > 0.01) & (behind < 0.07) & (np.abs(places[:, 0]) < 0.01) & (normals[:, 1] > 0.8)
    nose = head & (behind < 0.004)
    assert colours["Skin"][cavity][:, 0].min() < 0.4
    assert colours["Skin"][nose][:, 0].min() > 0.9
    # Skin's shade is red: light comes through it.
    assert (colours["Skin"][:, 0] >= colours["Skin"][:, 2] - 1e-3).all()


@pytest.mark.parametrize("tier", TIERS)
@pytest.mark.parametrize("horn", HORNS)
def test_a_horn_is_dark_between_its_tubes(horn: str, tier: str, tmp_path: Path) -> None:
    content = read_model(ROOT / "rigs" / horn / f"{tier}.glb", tmp_path / "model.json")
    brass = [mesh for mesh in content["meshes"] if mesh["name"] == "body" and mesh["material"] == "brass"]
    colours = np.vstack([shaped(mesh["color_0"]) for mesh in brass])
    assert colours[:, 0].max() > 0.95
    assert np.percentile(colours[:, 0], 5) < 0.75
    assert (colours[:, 0] >= colours[:, 2] - 1e-3).all()
    assert not any("color_0" in mesh for mesh in content["meshes"] if mesh["name"] == "mute")
