"""Who asks, behind proxies."""

from __future__ import annotations

import pytest

from reina.api.http.proxies import TrustedProxies, client_address, counted_as
from reina.errors import InputError

PROXIES = TrustedProxies.named(["10.0.0.0/8", "fd00::1"])


def told(**headers: str) -> list[tuple[bytes, bytes]]:
    return [(name.replace("_", "-").encode(), value.encode()) for name, value in headers.items()]


@pytest.mark.parametrize(
    ("peer", "headers", "client"),
    [
        ("10.0.0.1", told(x_forwarded_for="203.0.113.9"), "203.0.113.9"),
        ("10.0.0.1", told(x_forwarded_for="1.2.3.4, 203.0.113.9"), "203.0.113.9"),
        ("10.0.0.1", told(x_forwarded_for="1.2.3.4, 203.0.113.9, 10.9.9.9"), "203.0.113.9"),
        ("10.0.0.1", told(x_forwarded_for="10.1.1.1, 10.9.9.9"), "10.1.1.1"),
        ("10.0.0.1", told(x_forwarded_for="203.0.113.9:5123"), "203.0.113.9"),
        ("10.0.0.1", told(x_forwarded_for="1.2.3.4, unknown"), "10.0.0.1"),
        ("10.0.0.1", [], "10.0.0.1"),
        ("::ffff:10.0.0.1", told(x_forwarded_for="203.0.113.9"), "203.0.113.9"),
        ("fd00::1", told(forwarded='for="[2001:db8::7]:4711";proto=https'), "2001:db8::7"),
        ("fd00::1", told(forwarded="for=1.2.3.4, for=203.0.113.9;by=10.0.0.1"), "203.0.113.9"),
        ("10.0.0.1", told(x_forwarded_for="203.0.113.9", forwarded="for=1.2.3.4"), "203.0.113.9"),
        ("203.0.113.1", told(x_forwarded_for="1.2.3.4", forwarded="for=1.2.3.4"), "203.0.113.1"),
        ("127.0.0.1", told(x_forwarded_for="1.2.3.4"), "127.0.0.1"),
    ],
)
def test_the_nearest_address_that_is_no_proxy(
    peer: str, headers: list[tuple[bytes, bytes]], client: str
) -> None:
    assert PROXIES.client_of(peer, headers) == client


@pytest.mark.parametrize(
    ("peer", "headers", "scheme", "found"),
    [
        ("10.0.0.1", told(x_forwarded_proto="https"), "http", "https"),
        ("10.0.0.1", told(x_forwarded_proto="https"), "ws", "wss"),
        ("10.0.0.1", told(x_forwarded_proto="https, http"), "http", "http"),
        ("10.0.0.1", told(forwarded="for=1.2.3.4;proto=https"), "http", "https"),
        ("10.0.0.1", told(x_forwarded_proto="gopher"), "http", "http"),
        ("203.0.113.1", told(x_forwarded_proto="https"), "http", "http"),
    ],
)
def test_the_scheme_that_a_proxy_tells(
    peer: str, headers: list[tuple[bytes, bytes]], scheme: str, found: str
) -> None:
    assert PROXIES.scheme_of(peer, headers, scheme) == found


@pytest.mark.parametrize("text", ["proxy", "10.0.0.1/8", "10.0.0.0/33", ""])
def test_what_is_no_address_is_refused(text: str) -> None:
    with pytest.raises(InputError, match="trusted proxy"):
        TrustedProxies.named([text])


def test_addresses_that_are_counted() -> None:
    assert counted_as("203.0.113.9") == "203.0.113.9"
    assert counted_as("2001:db8:1:2::7") == counted_as("2001:db8:1:2:ff::") == "2001:db8:1:2::/64"
    assert counted_as("127.0.0.1") is None
    assert counted_as("::1") is None
    assert counted_as("") is None


def test_the_address_of_a_request() -> None:
    assert client_address({"type": "http", "client": ("::ffff:203.0.113.9", 5)}) == "203.0.113.9"
    assert client_address({"type": "http"}) == ""
