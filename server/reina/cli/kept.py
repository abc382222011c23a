"""What commands do with what is kept: open it, and take over what version 0.1 kept."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

from reina.sessions.storage.session_storage import SessionStorage
from reina.sessions.storage.version_0_1 import TakenOver, has_folders, take_over

if TYPE_CHECKING:
    from reina.api.settings import Settings

TOLD_EVERY = 100
"""Of so many sessions that were taken over one is told."""


def open_storage(settings: Settings) -> SessionStorage:
    """Open what keeps the sessions; those of version 0.1, if there are any, are taken over first.

    Raises:
        InputError: It cannot be used, or they cannot be taken over.
    """
    storage = SessionStorage.open(settings.data_dir, settings.database, settings.files)
    try:
        if has_folders(settings.data_dir):
            take_over_told(storage)
    except BaseException:
        storage.close()
        raise
    return storage


def take_over_told(storage: SessionStorage) -> TakenOver:
    """Take over what version 0.1 kept, and say so on standard error.

    Raises:
        InputError: As `take_over`.
    """

    def told(done: int, count: int) -> None:
        if done % TOLD_EVERY == 0:
            print(f"{done} of {count} sessions of version 0.1 are taken over", file=sys.stderr, flush=True)

    outcome = take_over(storage, told)
    if outcome.taken:
        print(f"{outcome.taken} sessions of version 0.1 were taken over", file=sys.stderr)
    for name, why in outcome.left.items():
        print(f"the session in {storage.data_dir / 'sessions' / name} stays there: {why}", file=sys.stderr)
    return outcome
