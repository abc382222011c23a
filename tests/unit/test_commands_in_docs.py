"""The commands that README.md and docs/serving.md tell a reader to type."""

from __future__ import annotations

import argparse
import importlib
import importlib.util
import json
import re
import shlex
import tomllib
from pathlib import Path

import pytest

import reina
from reina.cli import COMMANDS

ROOT = Path(__file__).parents[2]
PAGES = ("README.md", "CONTRIBUTING.md", "docs/serving.md")
BEGINS = ("make", "reina", ".venv/bin/reina", "uvx", "pip", "curl", "docker", "python")


def told() -> list[str]:
    """Whole lines of code blocks, and code within a line that begins as a command does."""
    found: list[str] = []
    for page in PAGES:
        text = (ROOT / page).read_text()
        blocks = re.findall(r"^```\n(.*?)^```", text, re.MULTILINE | re.DOTALL)
        found += [line for block in blocks for line in block.splitlines()]
        found += re.findall(
            r"`([^`\n]+)`", re.sub(r"^```\n.*?^```", "", text, flags=re.MULTILINE | re.DOTALL)
        )
    commands = [re.sub(r"^(?:[A-Z_]+=\S+ )+", "", command) for command in found]
    return sorted({command for command in commands if command.split(" ")[0] in BEGINS and " " in command})


def of(*begins: str) -> list[str]:
    """Those of one program."""
    return [command for command in told() if command.split(" ")[0] in begins]


def test_readme_says_how_it_is_installed_and_started() -> None:
    readme = (ROOT / "README.md").read_text()
    wheel = f"reina-{reina.__version__}-py3-none-any.whl"
    commands = (f"pip install {wheel}", f"uvx --from {wheel} reina serve", "reina serve", "make serve")
    for command in (*commands, "docker compose up"):
        assert command in readme
        assert command in told()


@pytest.mark.parametrize("command", of("make"))
def test_make_has_the_target(command: str) -> None:
    target = command.split()[1]
    assert re.search(rf"^{re.escape(target)}:", (ROOT / "Makefile").read_text(), re.MULTILINE)


@pytest.mark.parametrize("command", of("reina", ".venv/bin/reina", "uvx", "python"))
def test_reina_takes_it(command: str) -> None:
    words = shlex.split(command)
    if words[:2] == ["python", "-m"]:
        assert words[2] == "reina" or importlib.util.find_spec(words[2])
        words = words[2:]
    elif words[0] == "python":
        assert (ROOT / words[1]).is_file()
        return
    if words[0] == "uvx":
        assert words[1] == "--from"
        assert words[2] == f"reina-{reina.__version__}-py3-none-any.whl"
        words = words[3:]
    _, name, *arguments = words
    parser = argparse.ArgumentParser(prog="reina", exit_on_error=False)
    importlib.import_module(COMMANDS[name][0]).add_arguments(parser)
    # Where the text names a command to say what it is, nothing follows it.
    if arguments or name == "serve":
        given = parser.parse_args(arguments)
        for path in (value for value in vars(given).values() if isinstance(value, Path)):
            if path.parts[0] == "examples":
                assert (ROOT / path).is_file()


@pytest.mark.parametrize("command", of("pip"))
def test_pip_installs_what_there_is(command: str) -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    for name in shlex.split(command)[2:]:
        if name.endswith(".whl"):
            assert name == f"reina-{reina.__version__}-py3-none-any.whl"
            continue
        found = re.fullmatch(r"(\w+)(?:\[(\w+)\])?", name)
        assert found
        assert found[1] == project["name"]
        assert found[2] is None or found[2] in project["optional-dependencies"]


@pytest.mark.parametrize("command", of("curl", "docker"))
def test_files_and_addresses_that_are_named_are_there(command: str) -> None:
    paths = json.loads((ROOT / "docs" / "openapi.json").read_text())["paths"]
    for word in shlex.split(command):
        if word.startswith("http://localhost:8000"):
            assert word.removeprefix("http://localhost:8000") in paths
        elif word.endswith(".yml"):
            assert (ROOT / word).is_file()
        elif word.startswith("score=@"):
            assert (ROOT / word.removeprefix("score=@")).is_file()
        elif word.startswith("python:"):
            assert re.search(
                rf"^ARG PYTHON={re.escape(word.split('@')[0])}$", (ROOT / "Dockerfile").read_text(), re.M
            )
