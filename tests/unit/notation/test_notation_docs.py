"""docs/notation.md: its example runs, its tests are there."""

import ast
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
TEXT = (ROOT / "docs" / "notation.md").read_text(encoding="utf-8")


def test_the_example_runs(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.chdir(ROOT)
    (block,) = re.findall(r"```python\n(.*?)```", TEXT, re.DOTALL)
    exec(block, {})


def test_every_test_that_is_named_is_there():
    there: set[str] = set()
    for path in [*Path(__file__).parent.glob("test_*.py"), ROOT / "tests" / "e2e" / "test_paper.py"]:
        body = ast.parse(path.read_text(encoding="utf-8")).body
        there |= {node.name for node in body if isinstance(node, ast.FunctionDef)}
    named = set(re.findall(r"(?:`|::)(test_\w+)`", TEXT))
    assert len(named) > 25
    assert named <= there
