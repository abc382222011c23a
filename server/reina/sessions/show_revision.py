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
KEYFRAME_BYTES = 450
"""What a keyframe takes in memory beside its text: an object, and its share of curves that are made ready."""
HELD = 4
"""How many bytes the objects take that a byte of text in the history stands for."""
FEW = 64
"""One keyframe in so many that was replaced is found without looking for it elsewhere in the track."""


@dataclass(frozen=True)
class ShowRevision:
    """The show as it is, how it came to be, and how it is written. Never changed.

    Of a session that was loaded, the states beside the present one are asleep: they are kept, and not in
    memory until somebody walks there.

    Attributes:
        history: The show, its past, and what was taken back, as far as they are awake.
        text: The show, written.
        revision: How many steps led here, since the session was loaded.
        weights: What each step holds beside what its neighbours hold, in bytes of text: one for each state of
            the past, the oldest first, then one for each that was taken back, the latest first; of those that
            are asleep too.
        earlier: How many states are asleep before those of the history.
        later: How many that were taken back are asleep, beyond those of the history.
    """

    history: ShowHistory
    text: ShowText
    revision: int = 0
    weights: tuple[int, ...] = ()
    earlier: int = 0
    later: int = 0

    @classmethod
    def begin(
        cls, show: Show, *, earlier: int = 0, later: int = 0, weights: tuple[int, ...] = ()
    ) -> ShowRevision:
        """A show whose past and future, if there are any, are asleep."""
        return cls(ShowHistory(show), ShowText.of(show), 0, weights, earlier, later)

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
        text, earlier, later, weights = (
            ShowText.of(history.show, self.text),
            self.earlier,
            self.later,
            self.weights,
        )
        if not _walked(self.history, history):
            # An edit: what was taken back before is forgotten, and the oldest where there are too many.
            weights = (*weights[: self.done], _weight(self.text, text))
            earlier, later = max(0, min(earlier, history.longest - len(history.past))), 0
            weights = weights[-(earlier + len(history.past)) :]
            history, weights, earlier = _bounded(history, weights, earlier)
        return ShowRevision(history, text, self.revision + 1, weights, earlier, later)

    @property
    def done(self) -> int:
        """How many steps can be taken back."""
        return self.earlier + len(self.history.past)

    @property
    def undone(self) -> int:
        """How many steps can be done again."""
        return self.later + len(self.history.future)

    def steps_from(self, before: ShowRevision) -> int:
        """How this state came of the one before: -1 by undo, 1 by redo, 0 by an edit."""
        return _walked(before.history, self.history)

    def with_earlier(self, show: Show) -> ShowRevision:
        """The same with the last state awake that was asleep in its past."""
        history = replace(self.history, past=(show, *self.history.past))
        return replace(self, history=history, earlier=self.earlier - 1)

    def with_later(self, show: Show) -> ShowRevision:
        """The same with the first state awake that was taken back and asleep."""
        history = replace(self.history, future=(show, *self.history.future))
        return replace(self, history=history, later=self.later - 1)

    @property
    def weight(self) -> int:
        """About how many bytes show, plan and history take in memory."""
        tracks = self.text.tracks.values()
        texts = sum(len(written.text) for written in tracks)
        return texts + KEYFRAME_BYTES * sum(map(_keyframe_count, tracks)) + HELD * sum(self.weights)

    @property
    def state(self) -> ShowState:
        """Which state this is, and how far it can be walked back and forth."""
        return ShowState(
            revision=self.revision,
            etag=self.text.etag,
            undo=self.done,
            redo=self.undone,
        )


def _walked(before: ShowHistory, after: ShowHistory) -> int:
    """-1 where one history is the other's undo, 1 where it is its redo, else 0."""
    if before.past and after.show is before.past[-1] and after.future and after.future[-1] is before.show:
        return -1
    return int(bool(before.future) and after.show is before.future[-1])


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


def _bounded(
    history: ShowHistory, weights: tuple[int, ...], earlier: int
) -> tuple[ShowHistory, tuple[int, ...], int]:
    """Forget the oldest steps while all together weigh too much; what was taken back goes last."""
    forgotten, too_much = 0, sum(weights) - MAX_BYTES_KEPT
    while forgotten < earlier + len(history.past) and too_much > 0:
        too_much -= weights[forgotten]
        forgotten += 1
    past = history.past[max(0, forgotten - earlier) :]
    return replace(history, past=past), weights[forgotten:], max(0, earlier - forgotten)
