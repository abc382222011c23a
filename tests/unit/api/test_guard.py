"""Hosts that the server answers to."""

from __future__ import annotations

import pytest
from tests.unit.api.asking import ask

from reina.api.app import create_app


@pytest.mark.parametrize("host", ["localhost", "localhost:8000", "127.0.0.1", "[::1]:8000", "LOCALHOST"])
def test_hosts_that_were_told(host: str) -> None:
    assert ask(create_app(), "GET", "/api/v1/health", headers={"Host": host}).status_code == 200


@pytest.mark.parametrize(
    "host",
    [
        "example.org",
        "user@localhost",
        "example.org:80@localhost",
        "localhost/example.org",
        "localhost?x",
        "localhost#x",
        "localhost\\x",
        "localhost x",
        "",
        "localhost:x",
    ],
)
def test_other_hosts_and_what_is_none(host: str) -> None:
    answer = ask(create_app(), "GET", "/api/v1/health", headers={"Host": host})
    assert answer.status_code == 421
    assert answer.json()["type"] == "urn:reina:problem:unknown-host"
