"""A session's show with its history: what was, what can be taken back, what can be done again."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from reina.keyframes import Show, ShowHistory, Track
from reina.protocol.messages import ShowState
from reina.sessions.show_text import ShowText

if TYPE_CHECKING:
    from collections.abc import Callable

    from reina.keyframes import UnknownTrack

MOST_KEYFRAMES_KEPT = 200_000
"""Keyframes that only the history still holds; beyond that, its oldest steps are forgotten."""


@dataclass(frozen=True)
class KeptShow:
    """The show as it is, how it came to be, and how it is written. Never changed.

    The history lives in memory alone: a session that is put away keeps its show, and forgets its past.

    Attributes:
        history: The show, its past, and what was taken back.
        text: The show, written.
        revision: How many steps led here, since the session was loaded.
    """

    history: ShowHistory
    text: ShowText
    revision: int = 0

    @classmethod
    def begin(cls, show: Show) -> KeptShow:
        """A show without a past."""
        return cls(ShowHistory(show), ShowText.of(show))

    @property
    def show(self) -> Show:
        """The show as it is."""
        return self.history.show

    def then(self, step: Callable[[ShowHistory], ShowHistory]) -> KeptShow:
        """One step on or back; the same where it changes nothing.

        Raises:
            ShowError: What the step raises.
        """
        history = step(self.history)
        if history is self.history:
            return self
        return KeptShow(_bounded(history), ShowText.of(history.show, self.text), self.revision + 1)

    @property
    def state(self) -> ShowState:
        """Which state this is, and how far it can be walked back and forth."""
        return ShowState(
            revision=self.revision,
            etag=self.text.etag,
            undo=len(self.history.past),
            redo=len(self.history.future),
        )


def changed_path(before: Show, after: Show) -> str | None:
    """The one parameter whose track differs; None where several do, or the show's own fields."""
    if replace(before, tracks=()) != replace(after, tracks=()):
        return None
    old, new = ({track.parameter: track for track in show.tracks} for show in (before, after))
    paths = [path for path in {**old, **new} if not _same(old.get(path), new.get(path))]
    return paths[0] if len(paths) == 1 else None


def _same(one: Track | UnknownTrack | None, other: Track | UnknownTrack | None) -> bool:
    return one is other or one == other


def _bounded(history: ShowHistory) -> ShowHistory:
    """Forget the oldest steps while the rest holds too many keyframes beside the show's own."""
    seen = {id(track) for track in history.show.tracks}
    left = MOST_KEYFRAMES_KEPT

    def kept(shows: tuple[Show, ...]) -> tuple[Show, ...]:
        nonlocal left
        for number, show in enumerate(reversed(shows)):
            for track in show.tracks:
                if id(track) not in seen and isinstance(track, Track):
                    seen.add(id(track))
                    left -= len(track.keyframes)
            if left < 0:
                return shows[len(shows) - number :]
        return shows

    future = kept(history.future)
    return replace(history, future=future, past=kept(history.past))
