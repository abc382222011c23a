"""Installs the servers that the tests start; run by `make`."""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2]))

from tests.servers import seaweed

INSTALLERS = (seaweed.install,)

if __name__ == "__main__":
    for install in INSTALLERS:
        install()
