"""Build the rigs: fetch the source, make the models, reduce and compress them, validate them, write rig.json.

`python rigs/build/build.py` writes a rig for each file of figures/ and of instruments/, the drum kits and
the sticks, or those of them that are named; the same input gives the same bytes. How a player holds an
instrument is committed data and solved apart, by solve_hold.py.
"""

from __future__ import annotations

import argparse
import json
import shutil
import subprocess
from pathlib import Path
from typing import TYPE_CHECKING

from body.figure_file import figure_files
from body.player import build_player
from brass.instrument import build_instrument
from brass.measures import horns
from common.rig_file import write_json
from common.source import default_cache, fetch
from drums.kit import NAME as KIT
from drums.kit import SIDES, build_kit, build_stick
from drums.mirrored import LEFT_HANDED, build_left_handed_kit

if TYPE_CHECKING:
    from collections.abc import Collection

HERE = Path(__file__).resolve().parent
# At most so many triangles in a tier; 0 keeps what the scripts made.
PLAYER_TRIANGLES = {"full": 0, "medium": 40_000, "low": 11_800}
INSTRUMENT_TRIANGLES = {"full": 0, "medium": 20_000, "low": 7_500}
KIT_TRIANGLES = {"full": 0, "medium": 45_000, "low": 18_000}
STICK_TRIANGLES = {"full": 0, "medium": 0, "low": 0}


def pack(raw: Path, rigs: Path, wanted: dict[str, dict[str, int]]) -> dict[str, dict[str, int]]:
    """Reduce, compress and validate every model; what each came to, by rig/tier.

    A model with issues stops the build.
    """
    if not (HERE / "node_modules").exists():
        subprocess.run(["npm", "ci", "--no-audit", "--no-fund"], cwd=HERE, check=True)
    results: dict[str, dict[str, int]] = {}
    for rig, tiers in wanted.items():
        for tier, triangles in tiers.items():
            target = rigs / rig / f"{tier}.glb"
            command = ["node", "tiers.mjs", str(raw / f"{rig}.{tier}.glb"), str(target), str(triangles)]
            done = subprocess.run(command, cwd=HERE, check=True, capture_output=True, text=True)
            said = json.loads(done.stdout.splitlines()[-1])
            messages = said.pop("messages")
            if said["errors"] or said["warnings"]:
                raise ValueError(f"{target} is not valid glTF: {messages}")
            results[f"{rig}/{tier}.glb"] = said
            print(f"{rig}/{tier}.glb: {said['triangles']} triangles, {said['bytes']} bytes, valid")
    return results


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rigs", type=Path, default=HERE.parent, help="where the rigs are written")
    parser.add_argument(
        "--cache", type=Path, default=default_cache(), help="where the downloaded source is kept"
    )
    parser.add_argument("names", nargs="*", help="the rigs to build; all by default")
    arguments = parser.parse_args()
    raw = HERE / ".work"
    shutil.rmtree(raw, ignore_errors=True)
    raw.mkdir()
    figures, instruments = figure_files(), horns()
    sticks = {f"{side}_stick": side for side in SIDES}
    triangles = {figure.name: PLAYER_TRIANGLES for figure in figures}
    triangles |= {horn.name: INSTRUMENT_TRIANGLES for horn in instruments}
    triangles |= dict.fromkeys((KIT, LEFT_HANDED), KIT_TRIANGLES) | dict.fromkeys(sticks, STICK_TRIANGLES)
    unknown = sorted(set(arguments.names) - set(triangles))
    if unknown:
        parser.error(f"there is no rig {unknown[0]!r}; there are {', '.join(triangles)}")
    wanted = {name: tiers for name, tiers in triangles.items() if name in (arguments.names or triangles)}
    for rig in wanted:
        (arguments.rigs / rig).mkdir(parents=True, exist_ok=True)
    players = [figure for figure in figures if figure.name in wanted]
    data = fetch(arguments.cache) if players else None
    for figure in players:
        assert data is not None
        build_player(data, raw, arguments.rigs / figure.name, figure)
    for horn in instruments:
        if horn.name in wanted:
            build_instrument(raw, arguments.rigs / horn.name, horn)
    if KIT in wanted:
        build_kit(raw, arguments.rigs / KIT)
    if LEFT_HANDED in wanted:
        build_left_handed_kit(raw, arguments.rigs / LEFT_HANDED)
    for name, side in sticks.items():
        if name in wanted:
            build_stick(raw, arguments.rigs / name, side)
    models = known_models(arguments.rigs / "validation.json", triangles) | pack(raw, arguments.rigs, wanted)
    in_order = {
        f"{rig}/{tier}.glb": models[f"{rig}/{tier}.glb"]
        for rig in triangles
        for tier in triangles[rig]
        if f"{rig}/{tier}.glb" in models
    }
    write_json(
        arguments.rigs / "validation.json",
        {"validator": "gltf-validator 2.0.0-dev.3.10", "models": in_order},
    )


def known_models(path: Path, rigs: Collection[str]) -> dict[str, dict[str, int]]:
    """What the validator said before of models of these rigs."""
    if not path.exists():
        return {}
    models: dict[str, dict[str, int]] = json.loads(path.read_text(encoding="utf-8"))["models"]
    return {name: said for name, said in models.items() if name.split("/")[0] in rigs}


if __name__ == "__main__":
    main()
