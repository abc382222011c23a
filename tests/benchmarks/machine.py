"""What a figure was measured on, and a server to measure."""

from __future__ import annotations

import os
import platform
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT))


def machine() -> str:
    """The processor, its cores and the Python, on one line."""
    model = platform.processor() or platform.machine()
    cpuinfo = Path("/proc/cpuinfo")
    if cpuinfo.exists():
        names = [line for line in cpuinfo.read_text().splitlines() if line.startswith("model name")]
        model = names[0].split(":", 1)[1].strip() if names else model
    load = os.getloadavg()[0]
    return f"{model}, {os.cpu_count()} cores, load {load:.1f}; Python {platform.python_version()}"


def heading(file: str) -> str:
    """The machine and the command, to stand above the figures."""
    command = " ".join(["python", str(Path(file).relative_to(ROOT)), *sys.argv[1:]])
    return f"{machine()}\n$ {command}"


def verdict(what: str, value: float, bound: float, unit: str) -> str:
    """A figure beside its bound."""
    return (
        f"{what:44} {value:9.2f} {unit:4} (at most {bound:g}) {'' if value <= bound else ' MISSED'}".rstrip()
    )
