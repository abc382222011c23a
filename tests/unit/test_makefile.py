"""`make` brings Node and npm into .venv where the machine has none that fits the page, and only there."""

from __future__ import annotations

import json
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
COPIED = (
    "Makefile",
    "pyproject.toml",
    "requirements/node.txt",
    "web/package.json",
    "web/package-lock.json",
    "web/scripts/node-fits.mjs",
)
TOOLS = ("find", "ln", "sed", "sh", "touch")
LOGGED = '#!/bin/sh\necho "{name} $* with $(command -v node)" >> {log}\n'


def write_script(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    path.chmod(0o755)


class Clone:
    """A clone whose pip, npm and Node only write down how they are called."""

    def __init__(self, root: Path) -> None:
        self.root = root
        self.log = root / "log"
        self.tools = root / "tools"
        self.tools.mkdir()
        for name in TOOLS:
            (self.tools / name).symlink_to(shutil.which(name) or "")
        for name in COPIED:
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / name, root / name)
        (root / "web/node_modules").mkdir()
        wheel = root / "wheel"
        write_script(root / ".venv/bin/python", f"#!/bin/sh\necho {wheel}\n")
        write_script(root / ".venv/bin/pip", LOGGED.format(name="pip", log=self.log))
        write_script(wheel / "bin/node", "#!/bin/sh\nexit 0\n")
        cli = wheel / "lib/node_modules/npm/bin/npm-cli.js"
        write_script(cli, LOGGED.format(name="npm", log=self.log))

    def own_node(self, version: str) -> None:
        """Put a Node of a version on PATH."""
        node = shutil.which("node")
        said = self.root / "version.cjs"
        said.write_text(
            f"Object.defineProperty(process, 'versions', {{ value: {{ node: {json.dumps(version)} }} }});\n"
        )
        write_script(self.tools / "node", f'#!/bin/sh\nexec {node} -r {said} "$@"\n')

    def own_npm(self) -> None:
        """Put an npm on PATH."""
        write_script(self.tools / "npm", LOGGED.format(name="npm", log=self.log))

    def make(self) -> list[str]:
        """What is called for the page's modules."""
        self.log.write_text("")
        make = shutil.which("make")
        assert make is not None
        subprocess.run(
            [make, "web/node_modules/.stamp"], cwd=self.root, env={"PATH": str(self.tools)}, check=True
        )
        return self.log.read_text().splitlines()


@pytest.fixture
def clone(tmp_path: Path) -> Clone:
    return Clone(tmp_path)


def test_without_node_pip_brings_it_once(clone: Clone) -> None:
    pip, npm = clone.make()
    assert pip.startswith("pip install --quiet --require-hashes -r requirements/node.txt")
    assert npm == f"npm ci --no-fund --no-audit --loglevel=error with {clone.root}/.venv/bin/node"
    assert clone.make() == []


@pytest.mark.parametrize("version", ["0.12.18", "18.20.8", "20.18.3", "21.7.3", "22.12.0", "23.11.1"])
def test_a_node_that_does_not_fit_is_not_used(clone: Clone, version: str) -> None:
    clone.own_node(version)
    clone.own_npm()
    pip, npm = clone.make()
    assert "requirements/node.txt" in pip
    assert npm.endswith(f" with {clone.root}/.venv/bin/node")


@pytest.mark.parametrize("version", ["20.19.0", "20.20.2", "22.13.0", "24.0.0", "26.1.0"])
def test_a_node_that_fits_is_used(clone: Clone, version: str) -> None:
    clone.own_node(version)
    clone.own_npm()
    assert clone.make() == [f"npm ci --no-fund --no-audit --loglevel=error with {clone.tools}/node"]
    assert not (clone.root / ".venv/bin/node").exists()


def test_node_without_npm_is_not_enough(clone: Clone) -> None:
    clone.own_node("24.0.0")
    assert "requirements/node.txt" in clone.make()[0]
