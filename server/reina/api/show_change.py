"""How the routes of a show change it: under a condition, one after another, and told to everybody."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

from reina.api.conditions import require_match
from reina.protocol.resources import ShowEdited

if TYPE_CHECKING:
    from collections.abc import Callable

    from reina.keyframes import Show, ShowHistory
    from reina.sessions.kept_show import KeptShow
    from reina.sessions.session import Session
    from reina.sessions.store import SessionStore


class ShowChange:
    """One change of a session's show.

    Args:
        session: Whose.
        store: Keeps it.
        if_match: The condition that the request makes; None for none.
        path: The parameter whose track it writes to, or None for the whole show.
    """

    def __init__(
        self, session: Session, store: SessionStore, if_match: str | None, path: str | None = None
    ) -> None:
        self._session = session
        self._store = store
        self._if_match = if_match
        self._path = path
        self.before = session.kept_show
        """The show as it was just before the change."""

    async def edit(self, edit: Callable[[Show], Show]) -> KeptShow:
        """Make a new state of it.

        Args:
            edit: The show as it is -> as it is to be.

        Raises:
            ProblemError: 412 when the condition does not hold.
            ShowError: The edit cannot be made.
        """
        return await self.step(lambda history: history.then(edit(history.show)))

    async def step(self, step: Callable[[ShowHistory], ShowHistory]) -> KeptShow:
        """Walk its history; see `edit`."""

        def conditional_step(history: ShowHistory) -> ShowHistory:
            self.before = self._session.kept_show
            text = self.before.text
            own = (text.track_etag(self._path),) if self._path is not None else ()
            require_match(self._if_match, *own, text.etag)
            return step(history)

        return await self._store.change_show(self._session, conditional_step)

    def outcome(self, after: KeptShow) -> ShowEdited:
        """What the change came to."""
        old, new = self.before.text.tracks, after.text.tracks
        changed = [
            json.loads(written.text)
            for path, written in new.items()
            if path not in old or old[path].etag != written.etag
        ]
        removed = [path for path in old if path not in new]
        return ShowEdited(**dict(after.state), tracks=changed, removed=removed)
