"""How often somebody may try a password."""

from __future__ import annotations

import ipaddress
from collections import OrderedDict, deque
from typing import TYPE_CHECKING

from reina.api.http.problems import ProblemError

if TYPE_CHECKING:
    from collections.abc import Callable

MOST, WITHIN_S = 5, 300.0
"""So many wrong passwords from one address, in so many seconds."""
MOST_ADDRESSES = 10_000
"""Of so many addresses is kept when they tried; of more, the ones that tried last."""
NETWORK_BITS = 64
"""One customer has as many IPv6 addresses as follow these bits, and counts as one."""


class Attempts:
    """Counts tries by address.

    Args:
        now: Seconds; never goes back.
    """

    def __init__(self, now: Callable[[], float]) -> None:
        self._now = now
        self._tried: OrderedDict[str, deque[float]] = OrderedDict()

    def begin(self, address: str) -> None:
        """Count a try, before it is looked at: of many at once none goes uncounted.

        Raises:
            ProblemError: 429, there were too many.
        """
        key, now = _network(address), self._now()
        tried = self._tried.setdefault(key, deque(maxlen=MOST))
        self._tried.move_to_end(key)
        while len(self._tried) > MOST_ADDRESSES:
            self._tried.popitem(last=False)
        while tried and tried[0] <= now - WITHIN_S:
            tried.popleft()
        if len(tried) == MOST:
            wait_s = int(tried[0] + WITHIN_S - now) + 1
            raise ProblemError(
                429,
                "too-many-attempts",
                "Too many passwords were tried",
                f"{MOST} passwords may be tried in {WITHIN_S / 60:g} minutes; wait {wait_s} s",
                headers={"Retry-After": str(wait_s)},
            )
        tried.append(now)

    def succeeded(self, address: str) -> None:
        """Forget what was tried before it was right."""
        self._tried.pop(_network(address), None)


def _network(address: str) -> str:
    try:
        known = ipaddress.ip_address(address.partition("%")[0])
    except ValueError:
        return address
    if known.version == 6 and known.ipv4_mapped is None:
        return str(ipaddress.ip_network(f"{known}/{NETWORK_BITS}", strict=False))
    return str(known)
