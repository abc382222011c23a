"""Puts into a wheel what `reina serve` serves: the page, the rigs, the examples, the packed soundfont."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

# This checkout's own table, whether the package is installed or not.
sys.path.insert(0, str(Path(__file__).parents[1] / "server"))
from reina.system.resources import BUNDLED, IN_CHECKOUT, Bundle

sys.path.pop(0)

SOUNDFONT_LICENCE = "FluidR3Mono_License.md"
EXAMPLES = ("scores", "songs", "shows")


class BundleHook(BuildHookInterface[Any]):
    """Adds files to wheels and source distributions; an editable install has the checkout's."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Have the page built where it is not, and name every file with its place.

        Raises:
            RuntimeError: Something is not there and cannot be made.
        """
        if version == "editable":
            return
        self._require_page()
        files: dict[str, str] = build_data["force_include"]
        if self.target_name == "sdist":
            # What is built comes along, so that a wheel can be made of it without Node.
            for path in (*self._page(), *self._soundfont()):
                files[str(path)] = path.relative_to(self.root).as_posix()
            return
        bundles: dict[Bundle, list[Path]] = {
            "page": self._page(),
            "rigs": self._rigs(),
            "examples": self._examples(),
        }
        for what, paths in bundles.items():
            for path in paths:
                files[str(path)] = f"reina/{BUNDLED}/{what}/{path.relative_to(self._source(what)).as_posix()}"
        soundfont, licence = self._soundfont()
        files[str(soundfont)] = f"reina/{BUNDLED}/soundfont.sf3"
        files[str(licence)] = f"reina/{BUNDLED}/soundfont-licence.md"

    def _source(self, what: Bundle) -> Path:
        return Path(self.root) / IN_CHECKOUT[what]

    def _require_page(self) -> None:
        needed = (self._source("page") / "index.html", self._source("page") / "lab.html", *self._soundfont())
        missing = [path for path in needed if not path.is_file()]
        if not missing:
            return
        npm = shutil.which("npm")
        if npm is None:
            there_is_not = missing[0].relative_to(self.root)
            raise RuntimeError(f"{there_is_not} is not there, nor npm to make it: `make wheel` brings both")
        for arguments in (("ci", "--no-fund", "--no-audit", "--loglevel=error"), ("run", "build")):
            self.app.display_info(f"npm {' '.join(arguments)}")
            subprocess.run((npm, *arguments), cwd=Path(self.root) / "web", check=True)

    def _page(self) -> list[Path]:
        return _files(self._source("page"))

    def _rigs(self) -> list[Path]:
        described = sorted(self._source("rigs").glob("*/rig.json"))
        return [path for description in described for path in _files(description.parent)]

    def _examples(self) -> list[Path]:
        return [path for folder in EXAMPLES for path in _files(self._source("examples") / folder)]

    def _soundfont(self) -> tuple[Path, Path]:
        path = self._source("soundfont.sf3")
        return path, path.with_name(SOUNDFONT_LICENCE)


def _files(folder: Path) -> list[Path]:
    return sorted(path for path in folder.rglob("*") if path.is_file() and not path.name.startswith("."))
