"""Sessions that nobody has seen for long are ended, quietly, where the operator wants it so."""

from __future__ import annotations

import asyncio
import logging
from typing import TYPE_CHECKING

from reina.errors import InputError
from reina.sessions.sightings import DAY_S

if TYPE_CHECKING:
    from reina.sessions.store import SessionStore

SWEEP_S = 3600.0
"""How often it is looked, and when sessions were seen is kept; more often where less than a day is waited."""
SWEEPS = 24
"""At least so many times within the time that is waited."""

_log = logging.getLogger(__name__)


async def sweep_unseen(store: SessionStore, after_s: float) -> None:
    """Keep when sessions were seen, and end those that were not, until cancelled.

    Args:
        store: Where they are.
        after_s: How long after it was seen last a session is ended; 0 for never.
    """
    every_s = min(SWEEP_S, after_s / SWEEPS) if after_s else SWEEP_S
    while True:
        try:
            if after_s:
                ended = await store.end_unseen(after_s)
                if ended:
                    _log.info("ended %d sessions that nobody had seen for %g days", ended, after_s / DAY_S)
            else:
                await store.sightings.keep(store.loaded.watched)
        except (InputError, OSError) as error:
            _log.warning("sessions that nobody sees could not be ended: %s", error)
        await asyncio.sleep(every_s)
