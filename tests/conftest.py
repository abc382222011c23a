"""What holds for all tests."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from tests.servers.postgresql import PostgreSQL, postgresql

if TYPE_CHECKING:
    from collections.abc import Iterator

# What tests call by name may be in .venv alone: Node, where `make` brought it.
os.environ["PATH"] = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"

# Else each of the hundreds of servers and processes that tests start would compile Reina's modules anew.
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)


@pytest.fixture(scope="session")
def postgresql_server() -> Iterator[PostgreSQL]:
    """A PostgreSQL that runs for all tests of this process."""
    with postgresql() as server:
        yield server


@pytest.fixture(params=["sqlite", "postgresql"])
def database(request: pytest.FixtureRequest) -> str:
    """The address of an empty database, as `--database` takes it: of each kind in turn."""
    if request.param == "sqlite":
        return ""
    server: PostgreSQL = request.getfixturevalue("postgresql_server")
    return server.database()


@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Put the browser's tests last.

    Playwright keeps an event loop running in the main thread for as long as its browser lives, in which no
    test could run a loop of its own.
    """
    items.sort(key=lambda item: item.get_closest_marker("browser") is not None)
