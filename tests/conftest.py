"""What holds for all tests."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import pytest

# What tests call by name may be in .venv alone: Node, where `make` brought it.
os.environ["PATH"] = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"


@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Put the browser's tests last.

    Playwright keeps an event loop running in the main thread for as long as its browser lives, in which no
    test could run a loop of its own.
    """
    items.sort(key=lambda item: item.get_closest_marker("browser") is not None)
