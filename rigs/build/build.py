"""Build the rigs: fetch the source, make the models, reduce and compress them, validate them, write rig.json.

`python rigs/build/build.py` writes a rig for each file of figures/ and of instruments/; the same input gives
the same bytes. How a player holds an instrument is committed data and solved apart, by solve_hold.py.
"""

from __future__ import annotations

import argparse
import json
import shutil
import subprocess
from pathlib import Path

from body.figure_file import figure_files
from body.player import build_player
from brass.instrument import build_instrument
from brass.measures import horns
from common.rig_file import write_json
from common.source import default_cache, fetch

HERE = Path(__file__).resolve().parent
# At most so many triangles in a tier; 0 keeps what the scripts made.
PLAYER_TRIANGLES = {"full": 0, "medium": 40_000, "low": 11_800}
INSTRUMENT_TRIANGLES = {"full": 0, "medium": 20_000, "low": 7_500}


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
    arguments = parser.parse_args()
    data = fetch(arguments.cache)
    raw = HERE / ".work"
    shutil.rmtree(raw, ignore_errors=True)
    raw.mkdir()
    figures, instruments = figure_files(), horns()
    triangles = {figure.name: PLAYER_TRIANGLES for figure in figures}
    triangles |= {horn.name: INSTRUMENT_TRIANGLES for horn in instruments}
    for rig in triangles:
        (arguments.rigs / rig).mkdir(parents=True, exist_ok=True)
    for figure in figures:
        build_player(data, raw, arguments.rigs / figure.name, figure)
    for horn in instruments:
        build_instrument(raw, arguments.rigs / horn.name, horn)
    models = pack(raw, arguments.rigs, triangles)
    write_json(
        arguments.rigs / "validation.json", {"validator": "gltf-validator 2.0.0-dev.3.10", "models": models}
    )


if __name__ == "__main__":
    main()
