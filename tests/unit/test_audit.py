"""What `release/audit.py` makes of what the registries say; the programs that ask them are replaced."""

from __future__ import annotations

import json
import sys
from typing import TYPE_CHECKING, Any

import pytest
from release import audit

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    Says = Callable[[object], list[str]]

KNOWN: dict[str, Any] = {"name": "known", "version": "1.0", "vulns": []}
UNKNOWN = {"name": "unknown", "skip_reason": "Dependency not found on PyPI"}
BAD = KNOWN | {"vulns": [{"id": "CVE-2024-1", "fix_versions": ["1.1"]}]}
PAGE = {"auditReportVersion": 2, "metadata": {"dependencies": {"total": 3}}, "vulnerabilities": {}}
BAD_PAGE = PAGE | {"vulnerabilities": {"three": {"range": "<1", "severity": "high"}}}


@pytest.fixture
def says(tmp_path: Path) -> Says:
    """Makes a program that prints something, as JSON unless it is a text, and ends with status 1."""

    def program(said: object) -> list[str]:
        path = tmp_path / f"{len(list(tmp_path.iterdir()))}.py"
        text = said if isinstance(said, str) else json.dumps(said)
        path.write_text(f"print({text!r})\nraise SystemExit(1)\n")
        return [sys.executable, str(path)]

    return program


def test_vulnerabilities_are_told_with_what_mends_them(
    says: Says, capsys: pytest.CaptureFixture[str]
) -> None:
    python, npm = says({"dependencies": [KNOWN, BAD, UNKNOWN]}), says(BAD_PAGE)
    assert audit.main(python, npm) == 1
    told = capsys.readouterr().err.splitlines()
    assert told == [
        *(f"requirements/{name}.txt: known 1.0: CVE-2024-1, mended in 1.1" for name in audit.LOCKED),
        "web/package-lock.json: three <1: high",
    ]


def test_what_has_none_is_counted(says: Says, capsys: pytest.CaptureFixture[str]) -> None:
    assert audit.main(says({"dependencies": [KNOWN, UNKNOWN]}), says(PAGE)) == 0
    assert "requirements/serve.txt: 1 packages, no known vulnerability" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("python", "npm"),
    [
        ("ERROR: no network", '{"error": "ENOTFOUND"}'),
        ({"dependencies": [UNKNOWN]}, {"message": "405"}),
        ("[]", ""),
    ],
)
def test_a_registry_that_does_not_answer_is_told_and_nothing_is_wrong(
    says: Says, capsys: pytest.CaptureFixture[str], python: object, npm: object
) -> None:
    assert audit.main(says(python), says(npm)) == 0
    told = capsys.readouterr().out.splitlines()
    assert len(told) == len(audit.LOCKED) + 1
    assert all("not audited" in line for line in told)


def test_every_file_that_is_installed_to_serve_is_asked_about() -> None:
    for name in audit.LOCKED:
        assert (audit.ROOT / "requirements" / f"{name}.txt").is_file()
