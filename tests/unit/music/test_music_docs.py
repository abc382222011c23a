"""docs/music.md: its examples run, its tests are there, its list of warnings is whole."""

import ast
import re
from pathlib import Path

import pytest

from reina.music import read_score

ROOT = Path(__file__).parents[3]
TEXT = (ROOT / "docs" / "music.md").read_text(encoding="utf-8")
TESTS = ROOT / "tests" / "unit"


def test_the_examples_run(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.chdir(ROOT)
    blocks = re.findall(r"```python\n(.*?)```", TEXT, re.DOTALL)
    assert len(blocks) == 3
    exec("\n".join(blocks), {})


def test_the_score_document_can_be_read():
    (block,) = re.findall(r"```json\n(.*?)```", TEXT, re.DOTALL)
    score = read_score(block.encode())
    assert score.notes.sounding_pitch.tolist() == [65, 70]


def test_every_test_that_is_named_is_there():
    there: set[str] = set()
    for path in [*(TESTS / "music").rglob("test_*.py"), *(TESTS / "instruments").rglob("test_*.py")]:
        for node in ast.parse(path.read_text(encoding="utf-8")).body:
            if isinstance(node, ast.FunctionDef):
                there |= {node.name, f"{path.name}::{node.name}"}
    named = set(re.findall(r"`((?:test_\w+\.py::)?test_\w+)`", TEXT))
    assert len(named) > 80
    assert named <= there


def test_every_kind_of_warning_is_listed():
    source = "".join(
        path.read_text(encoding="utf-8")
        for layer in ("music", "instruments")
        for path in (ROOT / "server" / "reina" / layer).rglob("*.py")
    )
    kinds = set(re.findall(r'(?:log\.add|tell|drop)\(\s*"(\w+)"', source))
    assert len(kinds) > 30
    missing = {kind for kind in kinds if f"`{kind}`" not in TEXT}
    assert missing == set()
