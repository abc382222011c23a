"""The container image without an engine: its stage that installs is carried out, and what it starts is asked.

The commands are the Dockerfile's own, with a folder in place of `/`. The page comes from this checkout, whose
build is what the first stage runs; the last stage's user and read-only file system are an engine's to make.
"""

from __future__ import annotations

import json
import os
import shutil
import socket
import subprocess
import sys
from pathlib import Path, PurePosixPath
from typing import TYPE_CHECKING

import httpx
import pytest
from tests.dockerfile import ROOT, is_sent, stages
from tests.integration.server import PATIENCE_S

if TYPE_CHECKING:
    from collections.abc import Iterator

FOLDERS = ("/opt/reina", "/src", "/data", "/files")
"""What the image has of its own; everything else in its commands is the base's."""


def placed(text: str, root: Path) -> str:
    """A text of the Dockerfile, its own folders below another root."""
    for folder in FOLDERS:
        text = text.replace(folder, f"{root}{folder}")
    return text


def copy(source: Path, target: Path, *, only_sent: bool) -> None:
    """As COPY does: a folder's content; of the context what .dockerignore lets through alone."""
    for path in sorted(source.rglob("*")) if source.is_dir() else [source]:
        if path.is_dir() or (only_sent and not is_sent(path.relative_to(ROOT).as_posix())):
            continue
        place = target / path.relative_to(source) if source.is_dir() else target / path.name
        place.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(path, place)


@pytest.fixture(scope="module")
def image(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The root of what the stage `packages` makes."""
    root = tmp_path_factory.mktemp("image")
    programs = root / "base"
    programs.mkdir()
    # The base's `python`.
    (programs / "python").symlink_to(sys.executable)
    environment = {
        name: value
        for name, value in os.environ.items()
        if not name.startswith(("REINA_", "PYTHON", "VIRTUAL_ENV"))
    } | {"PATH": f"{programs}:/usr/bin:/bin"}
    page, packages, _ = stages()
    folder = root
    for instruction in packages.instructions:
        words = instruction.words
        if instruction.name == "WORKDIR":
            folder = Path(placed(words[0], root))
            folder.mkdir(parents=True)
        elif instruction.name == "ENV":
            environment |= dict(word.split("=", 1) for word in words)
        elif instruction.name == "COPY":
            from_page = words[0] == f"--from={page.name}"
            for source in words[1 if from_page else 0 : -1]:
                within = PurePosixPath(source).relative_to("/src") if from_page else source
                copy(ROOT / within, folder / words[-1], only_sent=not from_page)
        else:
            assert instruction.name == "RUN"
            command = placed(instruction.text, root)
            done = subprocess.run(
                ["sh", "-c", command],
                cwd=folder,
                env=environment,
                capture_output=True,
                text=True,
                check=False,
                timeout=300,
            )
            assert done.returncode == 0, f"{command}\n{done.stdout}{done.stderr}"
    (copied,) = stages()[-1].all("COPY")
    assert copied.words == ["--from=packages", "/opt/reina/", "/opt/reina/"]
    # What the last stage leaves behind is not there any more.
    shutil.rmtree(root / "src")
    return root


def environment_of(image: Path) -> dict[str, str]:
    """What the last stage's ENV sets, beside a container's home."""
    set_by_it = stages()[-1].all("ENV")[0].text.replace("$PATH", "/usr/bin:/bin")
    named = dict(word.split("=", 1) for word in placed(set_by_it, image).split())
    return named | {"HOME": "/nonexistent"}


@pytest.fixture(scope="module")
def port(image: Path) -> Iterator[str]:
    """The port at which what CMD says has been started answers."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = str(free.getsockname()[1])
    (image / "data").mkdir()
    (started,) = stages()[-1].all("CMD")
    command = [port if word == "8000" else word for word in json.loads(started.text)]
    process = subprocess.Popen(
        [str(image / "opt" / "reina" / "bin" / command[0]), *command[1:]],
        cwd=image / "data",
        env=environment_of(image),
        stdout=subprocess.PIPE,
        text=True,
    )
    assert process.stdout is not None
    try:
        assert process.stdout.readline().startswith("http://")
        yield port
        process.terminate()
        assert process.wait(PATIENCE_S) == 0
    finally:
        if process.poll() is None:
            process.kill()
            process.wait(PATIENCE_S)
        process.stdout.close()


def test_the_image_has_the_wheel_and_no_tool_that_built_it(image: Path) -> None:
    python = str(image / "opt" / "reina" / "bin" / "python")
    names = "import importlib.metadata as m; print(*(d.metadata['Name'].lower() for d in m.distributions()))"
    said = subprocess.run(
        [python, "-c", names], cwd="/", env=environment_of(image), capture_output=True, text=True
    )
    there = set(said.stdout.split())
    assert {"reina", "fastapi", "psycopg", "obstore"} <= there
    assert not there & {"hatchling", "editables", "pytest"}
    where = "import reina; print(reina.__file__)"
    said = subprocess.run(
        [python, "-c", where], cwd="/", env=environment_of(image), capture_output=True, text=True
    )
    assert Path(said.stdout).is_relative_to(image / "opt" / "reina" / "lib")


def test_what_is_started_is_well_and_keeps_its_data_in_the_volume(image: Path, port: str) -> None:
    (health,) = stages()[-1].all("HEALTHCHECK")
    command: list[str] = json.loads(health.text.split(" CMD ", 1)[1].replace(":8000/", f":{port}/"))
    python = str(image / "opt" / "reina" / "bin" / command[0])
    asked = subprocess.run(
        [python, *command[1:]], cwd="/", env=environment_of(image), capture_output=True, text=True
    )
    assert asked.returncode == 0, asked.stderr
    page = httpx.get(f"http://127.0.0.1:{port}/")
    assert page.content == (ROOT / "web" / "dist" / "index.html").read_bytes()
    assert httpx.get(f"http://127.0.0.1:{port}/lab").status_code == 404
    assert (image / "data" / "soundfont.sf2").is_file()
