"""The wheel: what is in it, and that it serves everything from an empty folder, without the checkout."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import sysconfig
import zipfile
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import httpx
import pytest
from release import check
from tests.integration.server import PATIENCE_S, Running, rendered, upload

import reina

if TYPE_CHECKING:
    from collections.abc import Iterator

ROOT = Path(__file__).parents[2]
MARCH = "prince-of-denmarks-march"
WITHOUT_NODE = "/nonexistent"


def program(
    *command: str, folder: Path, path: str | None = None, python: str = sys.executable
) -> subprocess.CompletedProcess[str]:
    """Run a Python, this one, in a folder, where it finds programs in `path` alone if one is given."""
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    return subprocess.run(
        [python, *command],
        cwd=folder,
        env=environment | ({"PATH": path} if path is not None else {}),
        capture_output=True,
        text=True,
        check=False,
        timeout=120,
    )


@pytest.fixture(scope="module")
def dist(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a wheel and a source distribution of this checkout."""
    folder = tmp_path_factory.mktemp("dist")
    built = program("-m", "hatchling", "build", "-d", str(folder), folder=ROOT)
    assert built.returncode == 0, built.stderr
    return folder


@pytest.fixture(scope="module")
def wheel(dist: Path) -> Path:
    """The wheel alone."""
    (found,) = dist.glob("*.whl")
    return found


@dataclass(frozen=True)
class Installed:
    """An environment that the wheel is installed in, its user's home, and an empty folder to run in."""

    bin: Path
    home: Path
    folder: Path

    @property
    def environment(self) -> dict[str, str]:
        """Nothing of the checkout, and no setting."""
        kept = {
            name: value
            for name, value in os.environ.items()
            if not name.startswith(("REINA_", "XDG_", "PYTHON", "VIRTUAL_ENV"))
        }
        return kept | {"HOME": str(self.home)}

    def run(self, *command: str) -> str:
        """What one of its programs says."""
        done = subprocess.run(
            [str(self.bin / command[0]), *command[1:]],
            cwd=self.folder,
            env=self.environment,
            capture_output=True,
            text=True,
            check=False,
            timeout=60,
        )
        assert done.returncode == 0, done.stderr
        return done.stdout


@pytest.fixture(scope="module")
def installed(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Installed:
    """The wheel in a fresh environment, whose other packages are those that the tests run with."""
    root = tmp_path_factory.mktemp("installed")
    environment = root / "environment"
    assert program("-m", "venv", "--without-pip", str(environment), folder=root).returncode == 0
    python = str(environment / "bin" / "python")
    options = ("--quiet", "--no-deps", "--no-index")
    done = program("-m", "pip", "--python", python, "install", *options, str(wheel), folder=root)
    assert done.returncode == 0, done.stderr
    (packages,) = environment.glob("lib/python*/site-packages")
    # A folder that is named so is searched, but its own .pth files, of editable packages, are not.
    (packages / "others.pth").write_text(sysconfig.get_path("purelib"))
    home, folder = root / "home", root / "folder"
    home.mkdir()
    folder.mkdir()
    return Installed(environment / "bin", home, folder)


@pytest.fixture(scope="module")
def client(installed: Installed) -> Iterator[httpx.Client]:
    """A client of `reina serve`, started with nothing but a free port."""
    process = subprocess.Popen(
        [str(installed.bin / "reina"), "serve", "--port", "0"],
        cwd=installed.folder,
        env=installed.environment,
        stdout=subprocess.PIPE,
        text=True,
    )
    assert process.stdout is not None
    try:
        address = process.stdout.readline().strip()
        assert address.startswith("http://"), f"the server did not start: {address!r}"
        with httpx.Client(base_url=address, timeout=30.0) as client:
            yield client
        assert Running(process, address).stop() == 0
    finally:
        if process.poll() is None:
            process.kill()
            process.wait(PATIENCE_S)
        process.stdout.close()


def test_nothing_is_wrong_with_what_is_built(dist: Path) -> None:
    assert list(check.faults(dist)) == []
    changelog = (ROOT / "CHANGELOG.md").read_text()
    assert list(check.faults(dist, "v9.9")) == [
        f"the tag v9.9 is not v{reina.__version__}, which server/reina/__init__.py says",
        *(
            []
            if f"\n## {reina.__version__}\n" in changelog
            else [f"CHANGELOG.md has no heading `## {reina.__version__}`"]
        ),
    ]


@pytest.mark.parametrize(
    "stray",
    [
        "reina/bundled/rigs/build/build.py",
        "reina/bundled/page/node_modules/three/index.js",
        "reina/bundled/data/soundfont.sf2",
        "reina/tests/test_it.py",
        "reina/api/settings.py.orig",
        "tests/conftest.py",
    ],
)
def test_what_does_not_belong_into_a_wheel_is_found(wheel: Path, tmp_path: Path, stray: str) -> None:
    with_it = tmp_path / wheel.name
    shutil.copy(wheel, with_it)
    with zipfile.ZipFile(with_it, "a") as file:
        file.writestr(stray, b"")
    (fault,) = check.wheel_faults(with_it)
    assert stray in fault


def test_what_is_not_in_a_wheel_is_found(wheel: Path, tmp_path: Path) -> None:
    (script,) = (ROOT / "web" / "dist" / "assets").glob("lab-*.js")
    missing = {
        f"reina/bundled/page/assets/{script.name}",
        "reina/bundled/rigs/trumpeter/medium.glb",
        "reina/bundled/rigs/soloist/holds/drumkit.json",
        f"reina/bundled/examples/scores/{MARCH}.mid",
        "reina/bundled/soundfont.sf3",
        "reina/music/instrument_names.toml",
        f"reina-{reina.__version__}.dist-info/licenses/THIRD_PARTY.md",
    }
    without = tmp_path / wheel.name
    with zipfile.ZipFile(wheel) as whole, zipfile.ZipFile(without, "w") as less:
        for name in whole.namelist():
            if name not in missing:
                less.writestr(name, whole.read(name))
    found = sorted(check.wheel_faults(without))
    assert len(found) == len(missing), found
    for name in missing:
        last = name.split("/")[-1]
        assert sum(fault.endswith(last) for fault in found) == 1


def test_a_wheel_is_made_of_the_source_distribution_without_node(
    dist: Path, wheel: Path, tmp_path: Path
) -> None:
    (source,) = dist.glob("*.tar.gz")
    options = ("--quiet", "--no-deps", "--no-index", "--no-build-isolation")
    built = program(
        "-m", "pip", "wheel", *options, "-w", ".", str(source), folder=tmp_path, path=WITHOUT_NODE
    )
    assert built.returncode == 0, built.stderr
    (again,) = tmp_path.glob("*.whl")
    with zipfile.ZipFile(wheel) as one, zipfile.ZipFile(again) as other:
        sizes = {entry.filename: (entry.file_size, entry.CRC) for entry in one.infolist()}
        assert {entry.filename: (entry.file_size, entry.CRC) for entry in other.infolist()} == sizes


@pytest.fixture
def unbuilt(tmp_path: Path) -> Path:
    """A checkout in which nothing has been built: what a build begins with."""
    for name in ("pyproject.toml", "README.md", "LICENSE", "THIRD_PARTY.md"):
        shutil.copy(ROOT / name, tmp_path / name)
    for folder in ("release", "server/reina/system"):
        shutil.copytree(ROOT / folder, tmp_path / folder, ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copy(ROOT / "server" / "reina" / "__init__.py", tmp_path / "server" / "reina" / "__init__.py")
    (tmp_path / "rigs").mkdir()
    return tmp_path


def test_without_page_and_node_a_build_says_what_to_do(unbuilt: Path) -> None:
    built = program("-m", "hatchling", "build", "-t", "wheel", folder=unbuilt, path=WITHOUT_NODE)
    assert built.returncode != 0
    assert "web/dist/index.html is not there, nor npm to make it: `make wheel` brings both" in built.stderr
    assert list(unbuilt.glob("dist/*.whl")) == []


def test_an_editable_install_needs_no_page(unbuilt: Path) -> None:
    environment = unbuilt / "environment"
    assert program("-m", "venv", "--without-pip", str(environment), folder=unbuilt).returncode == 0
    (packages,) = environment.glob("lib/python*/site-packages")
    (packages / "others.pth").write_text(sysconfig.get_path("purelib"))
    python = str(environment / "bin" / "python")
    options = ("--quiet", "--no-deps", "--no-index", "--no-build-isolation", "--editable", ".")
    done = program("-m", "pip", "--python", python, "install", *options, folder=unbuilt, path=WITHOUT_NODE)
    assert done.returncode == 0, done.stderr
    shown = (
        "from reina.system import resources; print(resources.bundled('rigs'), resources.default_data_dir())"
    )
    found = program("-c", shown, folder=Path("/"), python=python)
    assert found.stdout.split() == [str(unbuilt / "rigs"), str(unbuilt / "data")]


def test_the_package_says_the_version_that_it_has(installed: Installed) -> None:
    shown = (
        "import reina, importlib.metadata as m; print(reina.__file__, reina.__version__, m.version('reina'))"
    )
    file, says, has = installed.run("python", "-c", shown).split()
    assert Path(file).is_relative_to(installed.bin.parent)
    assert says == has == reina.__version__


def test_the_command_is_a_module_too(installed: Installed) -> None:
    assert installed.run("python", "-m", "reina", "--help") == installed.run("reina", "--help")
    score = str(ROOT / "examples" / "scores" / f"{MARCH}.mid")
    assert "Trumpet" in installed.run("reina", "inspect", score)


def test_page_rigs_and_examples_are_served_as_from_the_checkout(client: httpx.Client) -> None:
    for address, document in (("/", "index.html"), ("/lab", "lab.html")):
        answer = client.get(address)
        assert answer.status_code == 200
        assert answer.content == (ROOT / "web" / "dist" / document).read_bytes()
        for reference in check.REFERENCE.findall(answer.text):
            assert client.get(f"/{reference}").status_code == 200
    rigs = client.get("/api/v1/rigs").json()["rigs"]
    assert [rig["name"] for rig in rigs] == sorted(path.parent.name for path in ROOT.glob("rigs/*/rig.json"))
    for rig in rigs:
        models = client.get(rig["href"]).json()["models"]
        model = client.get(models["medium"])
        assert model.content == (ROOT / "rigs" / rig["name"] / "medium.glb").read_bytes()
    examples = client.get("/api/v1/examples").json()["examples"]
    scores = {path.stem for path in (ROOT / "examples" / "scores").iterdir()}
    assert {example["name"] for example in examples} == scores
    assert all(client.get(example["score"]).status_code == 200 for example in examples)


def test_an_upload_is_rendered_and_kept_in_the_users_data(client: httpx.Client, installed: Installed) -> None:
    session = upload(client, client.get("/api/v1/examples/scores/taps.mid").content)
    assert session.body["song"]["source"] == "rendered"
    song = rendered(client, session.body["song"]["href"])
    assert song.status_code == 200, song.text
    assert song.content[:4] == b"fLaC"
    frames = client.get(f"{session.path}/frames", params={"start_s": 0, "end_s": 1})
    assert frames.status_code == 200
    assert len(frames.content) > 10_000
    data = installed.home / ".local" / "share" / "reina"
    assert (data / "soundfont.sf2").stat().st_size > 100e6
    assert list(data.glob("songs/*/song.flac"))
    assert list(installed.folder.iterdir()) == []
