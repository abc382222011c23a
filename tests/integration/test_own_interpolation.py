"""An installed package's interpolation in a running server: in the API, in a show and in the frames."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

import httpx
import pytest
from tests.integration.scores import scale, song
from tests.integration.server import serve, upload

if TYPE_CHECKING:
    from pathlib import Path

LIGHT = "lights/key/intensity"
MODULE = '''
from reina.curves import Keyframe, option

class Power(Keyframe):
    """Follows a power of time."""

    exponent: float = option(2.0, "which power", minimum=1.0, maximum=9.0)

    def eval(self, previous, t):
        return previous.value + (self.value - previous.value) * self.fraction(previous, t) ** self.exponent
'''


def test_a_package_brings_one_that_is_in_the_api_by_itself(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    package = tmp_path / "package"
    metadata = package / "power-1.0.dist-info"
    metadata.mkdir(parents=True)
    decorated = MODULE.replace("class Power", "@dataclass(frozen=True)\nclass Power")
    (package / "power.py").write_text(f"from dataclasses import dataclass\n{decorated}", encoding="utf-8")
    (metadata / "METADATA").write_text("Metadata-Version: 2.1\nName: power\nVersion: 1.0\n", encoding="utf-8")
    (metadata / "entry_points.txt").write_text(
        "[reina.interpolations]\npower = power:Power\n", encoding="utf-8"
    )
    paths = [str(package), *os.environ.get("PYTHONPATH", "").split(os.pathsep)]
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join(path for path in paths if path))
    with serve(tmp_path / "data") as running, httpx.Client(base_url=running.address, timeout=30) as client:
        described = client.get("/api/v1/parameters").json()
        [power] = [entry for entry in described["interpolations"] if entry["name"] == "power"]
        assert power["documentation"] == "Follows a power of time."
        assert [option["name"] for option in power["options"]] == ["exponent"]
        light = next(entry for entry in described["parameters"] if entry["path"] == LIGHT)
        assert "power" in light["interpolations"]
        schema = client.get("/api/v1/shows/schema").json()
        named = [kind.get("properties", {}).get("interpolation", {}) for kind in schema["$defs"].values()]
        assert {"const": "power", "type": "string"} in named
        owned = upload(client, scale(), song=("song.wav", song()))
        ends = {"time": 2, "value": 8, "interpolation": "power", "exponent": 3}
        track = {"time": "seconds", "keyframes": [{"time": 0, "value": 0}, ends]}
        put = owned.change("PUT", f"/show/tracks/{LIGHT}", json=track).raise_for_status()
        assert put.json()["keyframes"][1]["exponent"] == 3
        span = {"parameter": LIGHT, "start_s": 0, "end_s": 2, "points": 5}
        curve = client.get(f"{owned.path}/show/curves", params=span).json()["curves"][0]
        assert curve["keys"]["values"] == [pytest.approx([0, 0.125, 1, 3.375, 8], abs=1e-6)]
