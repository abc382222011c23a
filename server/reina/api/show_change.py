"""How the routes of a show change it: under a condition, one after another, and told to everybody."""

from __future__ import annotations

from typing import TYPE_CHECKING

from reina.api.http.conditions import require_match
from reina.system.json_text import Written, json_text

if TYPE_CHECKING:
    from collections.abc import Callable

    from reina.sessions.session import Session
    from reina.sessions.show_revision import ShowRevision
    from reina.sessions.store import SessionStore
    from reina.show import Show, ShowHistory


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
        self.before = session.show_revision
        """The show as it was just before the change."""

    async def edit(self, edit: Callable[[Show], Show]) -> ShowRevision:
        """Make a new state of it.

        Args:
            edit: The show as it is -> as it is to be.

        Raises:
            ProblemError: 412 when the condition does not hold.
            ShowError: The edit cannot be made.
        """
        return await self.step(lambda history: history.then(edit(history.show)))

    async def step(self, step: Callable[[ShowHistory], ShowHistory]) -> ShowRevision:
        """Walk its history; see `edit`."""

        def conditional_step(history: ShowHistory) -> ShowHistory:
            self.before = self._session.show_revision
            text = self.before.text
            own = (text.track_etag(self._path),) if self._path is not None else ()
            require_match(self._if_match, *own, text.etag)
            return step(history)

        return await self._store.edits.change_show(self._session, conditional_step)

    def outcome(self, after: ShowRevision, *, briefly: bool) -> bytes:
        """What the change came to: `ShowEdited` as JSON, with the text of tracks that is written already.

        Args:
            after: What it came to.
            briefly: Whether to leave out the tracks themselves.
        """
        old, new = self.before.text.tracks, after.text.tracks
        changed = [
            written for path, written in new.items() if path not in old or old[path].etag != written.etag
        ]
        return json_text(
            {
                **after.state.model_dump(),
                "head": after.text.head,
                "tracks": [] if briefly else [Written(written.text) for written in changed],
                "removed": [path for path in old if path not in new],
            }
        )
