"""Browser tests that fail are tried once more, and few may be."""

from __future__ import annotations

import os
import subprocess
import sys
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from pathlib import Path

SUITE = """
import pytest

@pytest.mark.browser
@pytest.mark.parametrize("number", range({late}))
def test_late(number, tmp_path_factory, pytestconfig):
    been = pytestconfig.rootpath / f"been-{{number}}"
    tried = been.exists()
    been.touch()
    assert tried, "not drawn yet"

@pytest.mark.browser
def test_wrong():
    assert {right}

def test_without_a_browser(pytestconfig):
    been = pytestconfig.rootpath / "been"
    tried = been.exists()
    been.touch()
    assert tried or {right}
"""


@pytest.mark.parametrize(
    ("late", "right", "status", "told"),
    [
        (2, True, 0, "4 passed, 2 rerun"),
        (3, True, 1, "5 passed, 3 rerun"),
        (1, False, 1, "2 failed, 1 passed, 2 rerun"),
    ],
    ids=["few", "too many", "wrong twice"],
)
def test_few_tests_may_take_a_second_try(
    tmp_path: Path, late: int, right: bool, status: int, told: str
) -> None:
    (tmp_path / "test_suite.py").write_text(SUITE.format(late=late, right=right))
    (tmp_path / "pytest.ini").write_text("[pytest]\nmarkers = browser: a browser\n")
    environment = {**os.environ, "PYTEST_ADDOPTS": "", "PYTHONPATH": os.pathsep.join(sys.path)}
    run = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "-p", "tests.second_try", "-p", "no:cacheprovider"],
        cwd=tmp_path,
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )
    assert run.returncode == status, run.stdout + run.stderr
    assert told in run.stdout
    assert ("not drawn yet" in run.stdout) == (late > 0)
