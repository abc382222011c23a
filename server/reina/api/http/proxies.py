"""Who asks, where proxies stand between: told by those that the operator trusts, and by nobody else."""

from __future__ import annotations

import ipaddress
from dataclasses import dataclass
from typing import TYPE_CHECKING

from reina.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from starlette.types import ASGIApp, Receive, Scope, Send

Address = ipaddress.IPv4Address | ipaddress.IPv6Address
Network = ipaddress.IPv4Network | ipaddress.IPv6Network
SECURE = {"http": "https", "https": "https", "ws": "wss", "wss": "wss"}
PLAIN = {"http": "http", "https": "http", "ws": "ws", "wss": "ws"}
MOST_HOPS = 20
"""So many are looked at, from the server outwards."""
BY_PROXY = "reina.by_proxy"
"""Stands in the scope of what comes through a trusted proxy, whose other headers mean something then too."""
OWN_NETWORK_BITS = 64
"""What one household or machine has of IPv6 (RFC 6177): all of it counts as one."""


@dataclass(frozen=True)
class TrustedProxies:
    """The proxies whose word is taken for who asks, and whether by TLS.

    Attributes:
        networks: Where they are; none by default.
    """

    networks: tuple[Network, ...] = ()

    @classmethod
    def named(cls, texts: Iterable[str]) -> TrustedProxies:
        """Proxies by addresses and networks: ``10.0.0.1``, ``10.0.0.0/8``, ``fd00::/8``.

        Raises:
            InputError: One is neither.
        """
        networks: list[Network] = []
        for text in texts:
            try:
                networks.append(ipaddress.ip_network(text))
            except ValueError as error:
                raise InputError(
                    f"a trusted proxy is an address or a network such as 10.0.0.1 or 10.0.0.0/8, not {text!r}"
                ) from error
        return cls(tuple(networks))

    def trusts(self, address: str) -> bool:
        """Whether this is one of them."""
        found = _address(address)
        return found is not None and any(found in network for network in self.networks)

    def client_of(self, peer: str, headers: Sequence[tuple[bytes, bytes]]) -> str:
        """The address of who asks.

        From the connection's other end outwards, the first address that is no trusted proxy's: everything
        beyond it may be made up. `X-Forwarded-For` is believed where it is there, else `Forwarded`; a proxy
        passes on whichever of them it does not write itself, so that it must write the first or remove it.

        Args:
            peer: The connection's other end.
            headers: Of the request, with lower-case names.
        """
        address = _plain(peer)
        if not self.trusts(address):
            return address
        for told in reversed(_hops(headers)[-MOST_HOPS:]):
            hop = _address(told)
            if hop is None:
                break
            address = str(hop)
            if not self.trusts(address):
                break
        return address

    def scheme_of(self, peer: str, headers: Sequence[tuple[bytes, bytes]], scheme: str) -> str:
        """The scheme by which it was asked: what the nearest proxy says, where it is trusted.

        Args:
            peer: The connection's other end.
            headers: Of the request, with lower-case names.
            scheme: Of the connection: ``"http"``, ``"ws"`` and the like.
        """
        if not self.trusts(peer):
            return scheme
        told = _listed(headers, b"x-forwarded-proto") or [
            fields["proto"] for fields in _forwarded(headers) if "proto" in fields
        ]
        return {"https": SECURE, "wss": SECURE, "http": PLAIN, "ws": PLAIN}.get(
            told[-1].lower() if told else "", {}
        ).get(scheme, scheme)


class BehindProxies:
    """ASGI middleware: from here on, `client` and `scheme` are those that a trusted proxy tells."""

    def __init__(self, app: ASGIApp, proxies: TrustedProxies) -> None:
        self._app = app
        self._proxies = proxies

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass on."""
        client = scope.get("client")
        if client and scope["type"] in {"http", "websocket"} and self._proxies.trusts(client[0]):
            address = self._proxies.client_of(client[0], scope["headers"])
            scheme = self._proxies.scheme_of(client[0], scope["headers"], scope["scheme"])
            scope = {**scope, "client": (address, client[1]), "scheme": scheme, BY_PROXY: True}
        await self._app(scope, receive, send)


def client_address(scope: Scope) -> str:
    """The address of who asks, which everything that is counted or shared out by address goes by.

    Args:
        scope: Of a request or a WebSocket, as it comes through `BehindProxies`.

    Returns:
        An address without a zone; an IPv4 address in its own form; "" where there is none.
    """
    client = scope.get("client")
    return _plain(client[0]) if client else ""


def comes_by_proxy(scope: Scope) -> bool:
    """Whether who is connected is a trusted proxy: only then its headers mean anything."""
    return bool(scope.get(BY_PROXY))


def is_secure(scope: Scope) -> bool:
    """Whether the browser speaks TLS, to this server or to the proxy before it."""
    return scope["scheme"] in {"https", "wss"}


def only_header(scope: Scope, name: bytes) -> str | None:
    """A header's value; None where there is none, or more than one, of which one may be a stranger's."""
    values = [value for header, value in scope["headers"] if header == name]
    return values[0].decode("latin-1").strip() if len(values) == 1 else None


def counted_as(address: str) -> str | None:
    """Under which name an address is counted; None for this machine's own, which are not.

    All that comes from loopback is one person's, or comes through a proxy that tells nothing.
    """
    found = _address(address)
    if found is None:
        return address or None
    if found.is_loopback:
        return None
    if found.version == 6:
        return str(ipaddress.ip_network((int(found), OWN_NETWORK_BITS), strict=False))
    return str(found)


def _hops(headers: Sequence[tuple[bytes, bytes]]) -> list[str]:
    """Who asked whom, the first first."""
    told = _listed(headers, b"x-forwarded-for")
    return told or [fields.get("for", "") for fields in _forwarded(headers)]


def _listed(headers: Sequence[tuple[bytes, bytes]], wanted: bytes) -> list[str]:
    values = [value.decode("latin-1") for name, value in headers if name == wanted]
    return [entry.strip() for value in values for entry in value.split(",") if entry.strip()]


def _forwarded(headers: Sequence[tuple[bytes, bytes]]) -> list[dict[str, str]]:
    """The fields of each hop (RFC 7239)."""
    hops: list[dict[str, str]] = []
    for entry in _listed(headers, b"forwarded"):
        fields = (field.partition("=") for field in entry.split(";"))
        hops.append({name.strip().lower(): value.strip().strip('"') for name, _, value in fields})
    return hops


def _plain(text: str) -> str:
    found = _address(text)
    return text if found is None else str(found)


def _address(text: str) -> Address | None:
    """An address of a header or a socket: with a port or without, in brackets or without."""
    text = text.strip().strip('"')
    if text.startswith("["):
        text = text[1:].partition("]")[0]
    elif text.count(":") == 1:
        text = text.partition(":")[0]
    try:
        found = ipaddress.ip_address(text.partition("%")[0])
    except ValueError:
        return None
    # A socket of both families tells IPv4 so.
    return found.ipv4_mapped or found if isinstance(found, ipaddress.IPv6Address) else found
