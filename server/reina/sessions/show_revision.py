"""A session's show with its history: what was, what can be taken back, what can be done again."""

from __future__ import annotations

from dataclasses import dataclass, replace
from operator import is_not
from typing import TYPE_CHECKING

from reina.protocol.messages import ShowState
from reina.sessions.show_text import ShowText
from reina.show import Show, ShowHistory, Track
from reina.system.json_text import json_text

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from typing import Any

    from reina.curves import Keyframe
    from reina.sessions.show_text import TrackText
    from reina.show import UnknownTrack

MAX_BYTES_KEPT = 16_000_000
"""Text that only the history still holds; beyond that, its oldest steps are forgotten."""
REFERENCE_BYTES = 1
"""A track that was edited holds its unchanged keyframes by reference alone: each weighs so much."""
STEP_BYTES = 100
"""What a step weighs of itself."""
WRITTEN = 2
"""A track's text is there as a whole, and keyframe by keyframe."""
KEYFRAME_BYTES = 700
"""What a keyframe takes in memory beside its text: an object, and its share of curves that are made ready."""
HELD = 6
"""How many bytes the objects take that a byte of text in the history stands for."""
FEW = 64
"""One keyframe in so many that was replaced is found without looking for it elsewhere in the track."""


@dataclass(frozen=True)
class ShowRevision:
    """The show as it is, how it came to be, and how it is written. Never changed.

    The history lives in memory alone: a session that is unloaded keeps its show, and forgets its past.

    Attributes:
        history: The show, its past, and what was taken back.
        text: The show, written.
        revision: How many steps led here, since the session was loaded.
        weights: What each step holds beside what its neighbours hold, in bytes of text: one for each state of
            the past, the oldest first, then one for each that was taken back, the latest first.
    """

    history: ShowHistory
    text: ShowText
    revision: int = 0
    weights: tuple[int, ...] = ()

    @classmethod
    def begin(cls, show: Show) -> ShowRevision:
        """A show without a past."""
        return cls(ShowHistory(show), ShowText.of(show))

    @property
    def show(self) -> Show:
        """The show as it is."""
        return self.history.show

    def then(self, step: Callable[[ShowHistory], ShowHistory]) -> ShowRevision:
        """One step on or back; the same where it changes nothing.

        Raises:
            ShowError: What the step raises.
        """
        history = step(self.history)
        if history is self.history:
            return self
        text, weights = ShowText.of(history.show, self.text), self.weights
        if history.past and history.past[-1] is self.show and not history.future:
            # An edit, and what was taken back before is forgotten; or the last such, which weighs the same.
            done = len(self.history.past)
            weights = (*weights[:done], _weight(self.text, text))[-len(history.past) :]
        history, weights = _bounded(history, weights)
        return ShowRevision(history, text, self.revision + 1, weights)

    @property
    def weight(self) -> int:
        """About how many bytes show, plan and history take in memory."""
        tracks = self.text.tracks.values()
        texts = sum(len(written.text) for written in tracks)
        return WRITTEN * texts + KEYFRAME_BYTES * sum(map(_keyframe_count, tracks)) + HELD * sum(self.weights)

    @property
    def state(self) -> ShowState:
        """Which state this is, and how far it can be walked back and forth."""
        return ShowState(
            revision=self.revision,
            etag=self.text.etag,
            undo=len(self.history.past),
            redo=len(self.history.future),
        )


def changed_paths(before: Show, after: Show) -> list[str] | None:
    """The parameters whose tracks differ; None where more than those differ, or their order."""
    if replace(before, tracks=()) != replace(after, tracks=()):
        return None
    old, new = ({track.parameter: track for track in show.tracks} for show in (before, after))
    if [path for path in old if path in new] != [path for path in new if path in old]:
        return None
    return [path for path in {**old, **new} if not _same(old.get(path), new.get(path))]


def _same(one: Track | UnknownTrack | None, other: Track | UnknownTrack | None) -> bool:
    return one is other or one == other


def _weight(before: ShowText, after: ShowText) -> int:
    """What two states of a show hold that the other does not, in bytes of text."""
    paths = {**before.tracks, **after.tracks}
    tracks = sum(_weight_of_tracks(before.tracks.get(path), after.tracks.get(path)) for path in paths)
    heads = 0 if before.head == after.head else max(len(json_text(text.head)) for text in (before, after))
    return STEP_BYTES + heads + tracks


def _weight_of_tracks(old: TrackText | None, new: TrackText | None) -> int:
    written = [text for text in (old, new) if text is not None]
    if old is not None and new is not None and old.track is new.track:
        return 0
    whole = max(len(text.text) for text in written)
    one, other = map(_keyframes, (old, new))
    most = max(len(one), len(other))
    if not most:
        return whole
    if len(one) == len(other):
        # At their own places, as mostly: no need to look for those that moved.
        apart = sum(map(is_not, one, other))
        if apart * FEW > most:
            apart = most - _shared(one, other)
    else:
        apart = most - _shared(one, other)
    return most * REFERENCE_BYTES + whole * apart // most


def _keyframes(written: TrackText | None) -> tuple[Keyframe[Any], ...]:
    return written.track.keyframes if written is not None and isinstance(written.track, Track) else ()


def _keyframe_count(written: TrackText) -> int:
    return len(_keyframes(written))


def _shared(one: Sequence[Keyframe[Any]], other: Sequence[Keyframe[Any]]) -> int:
    """How many keyframes both hold."""
    return len(set(map(id, one)) & set(map(id, other)))


def _bounded(history: ShowHistory, weights: tuple[int, ...]) -> tuple[ShowHistory, tuple[int, ...]]:
    """Forget the oldest steps while all together weigh too much; what was taken back goes last."""
    past = history.past
    too_much = sum(weights) - MAX_BYTES_KEPT
    while past and too_much > 0:
        too_much -= weights[0]
        past, weights = past[1:], weights[1:]
    return replace(history, past=past), weights
