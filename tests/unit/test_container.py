"""The Dockerfile against the repository, since not every machine that runs the tests has Docker."""

import re
import shlex
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


def instructions() -> list[list[str]]:
    """Each instruction's words, continued lines joined."""
    text = (ROOT / "Dockerfile").read_text().replace("\\\n", " ")
    return [shlex.split(line) for line in text.splitlines() if line and not line.startswith("#")]


def copied_from_context() -> list[str]:
    """What the Dockerfile copies out of the repository."""
    copies = [words[1:] for words in instructions() if words[0] == "COPY"]
    return [source for words in copies if not words[0].startswith("--from") for source in words[:-1]]


def is_sent(path: str) -> bool:
    """Whether .dockerignore lets a path through: the last pattern that fits it or a folder above decides."""
    sent = True
    for line in (ROOT / ".dockerignore").read_text().splitlines():
        pattern = line.strip()
        if not pattern or pattern.startswith("#"):
            continue
        kept, pattern = pattern.startswith("!"), pattern.removeprefix("!")
        expression = re.escape(pattern).replace(r"\*\*/", "(.*/)?").replace(r"\*", "[^/]*")
        if re.fullmatch(f"{expression}(/.*)?", path):
            sent = kept
    return sent


@pytest.mark.parametrize("source", copied_from_context())
def test_what_is_copied_is_there_and_sent(source: str) -> None:
    assert (ROOT / source).exists()
    assert is_sent(source.rstrip("/"))


@pytest.mark.parametrize(
    "path",
    [
        "data/soundfont.sf2",
        ".venv/bin/python",
        ".git/config",
        "web/node_modules/three/package.json",
        "web/dist/index.html",
        "rigs/build/build.py",
        "server/reina/__pycache__/x.pyc",
        "tests/conftest.py",
    ],
)
def test_what_is_built_or_private_is_not_sent(path: str) -> None:
    assert not is_sent(path)


def test_stages_are_declared_before_they_are_copied_from() -> None:
    declared: set[str] = set()
    for words in instructions():
        if words[0] == "FROM" and "AS" in words:
            declared.add(words[-1])
        if words[0] == "COPY" and words[1].startswith("--from="):
            assert words[1].removeprefix("--from=") in declared


def test_it_runs_as_nobody_in_particular_and_asks_for_its_health() -> None:
    words = instructions()
    last_stage = words[max(index for index, line in enumerate(words) if line[0] == "FROM") :]
    named = {line[0]: line for line in last_stage}
    assert named["USER"][1] != "root"
    assert named["VOLUME"][1] == "/data"
    assert "HEALTHCHECK" in named
    assert "REINA_DATA_DIR=/data" in named["ENV"]


@pytest.mark.parametrize(
    "line",
    [
        r"    mem_limit: \"\$\{REINA_MEMORY:-\d+g\}\"",
        r"    pids_limit: \d{3}",
        r"    ulimits:\n      nofile: \d{4,5}",
        r"    logging:\n      driver: json-file\n      options: \{max-size: \d+m, max-file: \"\d\"\}",
    ],
)
def test_memory_processes_files_and_logs_of_a_container_are_bounded(line: str) -> None:
    text = (ROOT / "docker-compose.yml").read_text()
    assert re.search(rf"^{line}$", text, re.MULTILINE)
