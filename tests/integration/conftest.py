"""One real server for all tests that do not need their own."""

from __future__ import annotations

from typing import TYPE_CHECKING

import httpx
import pytest
from tests.integration.scores import scale, song
from tests.integration.server import Owned, Running, serve, upload

if TYPE_CHECKING:
    from collections.abc import Iterator


@pytest.fixture(scope="session")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Running]:
    """A server on a free port, with a data directory of its own."""
    with serve(tmp_path_factory.mktemp("data")) as running:
        yield running


@pytest.fixture(scope="session")
def client(server: Running) -> Iterator[httpx.Client]:
    """A client of that server."""
    with httpx.Client(base_url=server.address, timeout=30.0) as client:
        yield client


@pytest.fixture
def owned(client: httpx.Client) -> Iterator[Owned]:
    """A session of its own: a scale, with a song, so that nothing is rendered meanwhile."""
    session = upload(client, scale(), song=("song.wav", song()))
    yield session
    session.change("DELETE")
