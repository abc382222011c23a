"""Each promise in docs/security.md names a test that is there."""

from __future__ import annotations

import ast
import re
from pathlib import Path

ROOT = Path(__file__).parents[2]
NAMED = re.compile(r"`(tests/[\w/]+\.py)(?:::(\w+))?`")


def promises() -> list[tuple[str, list[tuple[str, str]]]]:
    text = (ROOT / "docs/security.md").read_text()
    section = text.partition("## What is promised")[2].partition("\n## ")[0]
    rows = [line for line in section.splitlines() if line.startswith("| ")][2:]
    return [(row.split(" | ")[0], NAMED.findall(row.rpartition(" | ")[2])) for row in rows]


def test_each_promise_names_tests_that_are_there() -> None:
    told = promises()
    assert len(told) > 10
    for promise, tests in told:
        assert tests, f"{promise}: names no test"
        for file, function in tests:
            defined = {
                node.name
                for node in ast.walk(ast.parse((ROOT / file).read_text()))
                if isinstance(node, ast.FunctionDef)
            }
            assert not function or function in defined, f"{promise}: {file} has no {function}"
