"""Say which locked dependencies have known vulnerabilities; the exit status is 1 when one has.

    python release/audit.py

Asks the registries of Python's and the page's packages, by pip-audit and `npm audit`. Where one does not
answer, it says so and nothing is wrong: a machine without a network can be worked at.
"""

from __future__ import annotations

import json
import subprocess
import sys
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

if TYPE_CHECKING:
    from collections.abc import Sequence

ROOT = Path(__file__).parents[1]
LOCKED = ("serve", "storage", "film", "transcribe", "cluster")
"""What is installed where Reina runs: `requirements/NAME.txt`."""
PATIENCE_S = 120.0


@dataclass
class Audited:
    """What a registry said.

    Attributes:
        asked: How many packages it knows.
        vulnerable: Those with known vulnerabilities, each in a line.
    """

    asked: int = 0
    vulnerable: list[str] = field(default_factory=list[str])


def audit_python(program: Sequence[str], locked: Path) -> Audited | None:
    """Ask about one file of locked requirements; None where nobody answers.

    Args:
        program: pip-audit.
        locked: A file of requirements with hashes.
    """
    command = [*program, "--disable-pip", "--require-hashes", "-r", str(locked)]
    said = _json_of([*command, "--format", "json", "--progress-spinner", "off"], ROOT)
    if said is None or "dependencies" not in said:
        return None
    audited = Audited()
    for package in cast("list[dict[str, Any]]", said["dependencies"]):
        # One that the registry does not know is skipped with a reason.
        if "skip_reason" in package:
            continue
        audited.asked += 1
        audited.vulnerable += [
            f"{package['name']} {package['version']}: {found['id']}, mended in "
            f"{', '.join(found['fix_versions']) or 'no version yet'}"
            for found in package["vulns"]
        ]
    return audited if audited.asked else None


def audit_page(program: Sequence[str], folder: Path) -> Audited | None:
    """Ask about what the page is made of; None where nobody answers.

    Args:
        program: npm.
        folder: Where package-lock.json is.
    """
    said = _json_of([*program, "audit", "--omit", "dev", "--json"], folder)
    if said is None or "auditReportVersion" not in said:
        return None
    found = cast("dict[str, dict[str, Any]]", said["vulnerabilities"])
    return Audited(
        asked=said["metadata"]["dependencies"]["total"],
        vulnerable=[f"{name} {package['range']}: {package['severity']}" for name, package in found.items()],
    )


def _json_of(command: Sequence[str], folder: Path) -> dict[str, Any] | None:
    """What a program prints, whatever its exit status; None where that is no JSON object."""
    try:
        done = subprocess.run(
            command, cwd=folder, capture_output=True, text=True, timeout=PATIENCE_S, check=False
        )
        said: object = json.loads(done.stdout)
    except (OSError, subprocess.TimeoutExpired, ValueError):
        return None
    return cast("dict[str, Any]", said) if isinstance(said, dict) else None


def main(python: Sequence[str] | None = None, npm: Sequence[str] = ("npm",)) -> int:
    """Print what is known; returns the exit status."""
    program = python or (str(Path(sys.executable).with_name("pip-audit")),)
    results = {f"requirements/{name}.txt": audit_python(program, _locked(name)) for name in LOCKED}
    results["web/package-lock.json"] = audit_page(npm, ROOT / "web")
    is_sound = True
    for name, audited in results.items():
        if audited is None:
            print(f"{name}: not audited, the registry does not answer")
            continue
        for line in audited.vulnerable:
            print(f"{name}: {line}", file=sys.stderr)
            is_sound = False
        if not audited.vulnerable:
            print(f"{name}: {audited.asked} packages, no known vulnerability")
    return 0 if is_sound else 1


def _locked(name: str) -> Path:
    return ROOT / "requirements" / f"{name}.txt"


if __name__ == "__main__":
    sys.exit(main())
