"""Where a request comes from: who is connected, or whom a trusted proxy names."""

from __future__ import annotations

import ipaddress
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from starlette.types import Scope

    from reina.api.settings import Settings


def comes_by_proxy(scope: Scope) -> bool:
    """Whether who is connected is a proxy that the settings trust: only then its headers mean anything."""
    settings: Settings = scope["app"].state.settings
    try:
        peer = ipaddress.ip_address((scope.get("client") or ("", 0))[0])
    except ValueError:
        return False
    plain = peer.ipv4_mapped if isinstance(peer, ipaddress.IPv6Address) else None
    return any((plain or peer) in network for network in settings.trusted_proxies)


def client_address(scope: Scope) -> str:
    """The address that a request comes from, as far as it is known: the last that a trusted proxy names."""
    peer: str = (scope.get("client") or ("", 0))[0]
    if not comes_by_proxy(scope):
        return peer
    named = only_header(scope, b"x-forwarded-for")
    return peer if named is None else named.rpartition(",")[2].strip() or peer


def is_secure(scope: Scope) -> bool:
    """Whether the browser speaks TLS, to this server or to the proxy before it."""
    if scope["scheme"] in {"https", "wss"}:
        return True
    return comes_by_proxy(scope) and only_header(scope, b"x-forwarded-proto") == "https"


def only_header(scope: Scope, name: bytes) -> str | None:
    """A header's value; None where there is none, or more than one, of which one may be a stranger's."""
    values = [value for header, value in scope["headers"] if header == name]
    return values[0].decode("latin-1").strip() if len(values) == 1 else None
