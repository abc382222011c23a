"""What a figure was measured on, and the versions of what was measured."""

from __future__ import annotations

import importlib.metadata
import json
import os
import platform
import shutil
import subprocess
import sys
from dataclasses import asdict
from pathlib import Path

from table import Bound, collect

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT))
PEERS = ROOT / ".venv/.peers/bin/python"
"""The Python of peers whose dependencies do not go with Reina's (requirements/peers.in)."""


def processor() -> str:
    """The processor's name."""
    cpuinfo = Path("/proc/cpuinfo")
    lines = cpuinfo.read_text().splitlines() if cpuinfo.exists() else []
    names = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.processor() or platform.machine()


def machine() -> str:
    """The processor, its cores and the Python, on one line."""
    load = os.getloadavg()[0]
    return f"{processor()}, {os.cpu_count()} cores, load {load:.1f}; Python {platform.python_version()}"


def said(*command: str) -> str:
    """What a command prints; empty where there is no such program, or it fails."""
    if shutil.which(command[0]) is None:
        return ""
    ran = subprocess.run(command, capture_output=True, text=True, check=False, cwd=ROOT)
    return ran.stdout.strip() if ran.returncode == 0 else ""


def version(package: str) -> str:
    """The version of a Python package; empty where it is not installed."""
    try:
        return importlib.metadata.version(package)
    except importlib.metadata.PackageNotFoundError:
        return ""


def peers_version(package: str) -> str:
    """The version of a package in the peers' own environment; empty where it is not installed."""
    code = f"import importlib.metadata; print(importlib.metadata.version({package!r}))"
    return said(str(PEERS), "-c", code)


def node_version(package: Path) -> str:
    """The version of a package of npm, by its folder; empty where it is not installed."""
    described = package / "package.json"
    return str(json.loads(described.read_text())["version"]) if described.exists() else ""


def about() -> dict[str, str]:
    """The machine, the versions of what everything runs by, and the commit."""
    memory = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") / 2**30
    changed = said("git", "status", "--porcelain", "--untracked-files=no", "--", ":!docs/benchmarks.*")
    return {
        "processor": f"{processor()}, {os.cpu_count()} cores",
        "memory": f"{memory:.0f} GiB",
        "system": f"{platform.system()} {platform.release()}, {platform.machine()}",
        "Python": platform.python_version(),
        "NumPy": version("numpy"),
        "Node": said("node", "--version").removeprefix("v"),
        "Reina": version("reina"),
        "commit": said("git", "rev-parse", "--short", "HEAD") + (", with changes" if changed else ""),
    }


def heading(file: str) -> str:
    """The machine and the command, to stand above the figures."""
    command = " ".join(["python", str(Path(file).relative_to(ROOT)), *sys.argv[1:]])
    return f"{machine()}\n$ {command}"


def verdict(what: str, value: float, bound: float, unit: str) -> str:
    """A figure beside its bound, which is collected too."""
    collect("bounds", asdict(Bound(Path(sys.argv[0]).name, what, value, bound, unit)))
    return (
        f"{what:44} {value:9.2f} {unit:4} (at most {bound:g}) {'' if value <= bound else ' MISSED'}".rstrip()
    )
