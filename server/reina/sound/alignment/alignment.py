"""Where each place of a score is heard in a recording: a monotone map of two times, and how sure it is."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, overload

import numpy as np
from numpy.typing import NDArray

from reina.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Sequence

Times = NDArray[np.float64]
LEAST_TRUSTED_S = 0.05
"""Where the recording takes less between two places that a person has put, the score says how it goes between
them, and twice that only what was found does."""
SAME_S = 1e-6
"""Times nearer than this are the same."""


class AlignmentError(InputError):
    """A map from score to recording that cannot be; `location` says where in its document."""


@dataclass(frozen=True)
class MapPoint:
    """A place of the score and where it is heard.

    Attributes:
        score_s: Seconds in the score.
        song_s: Seconds in the recording.
        confidence: 0..1, how surely it is heard there; 0 where it is not heard at all.
    """

    score_s: float
    song_s: float
    confidence: float


@dataclass(frozen=True)
class Gap:
    """What one of both has and the other has not.

    Attributes:
        score_from_s: Where in the score what is left out begins.
        score_to_s: Where it ends; the same where nothing is left out.
        song_from_s: Where in the recording what the score has not begins.
        song_to_s: Where it ends; the same where nothing is put in.
    """

    score_from_s: float
    score_to_s: float
    song_from_s: float
    song_to_s: float

    @property
    def score_length_s(self) -> float:
        """How much of the score is not heard."""
        return self.score_to_s - self.score_from_s

    @property
    def song_length_s(self) -> float:
        """How much of the recording is not in the score."""
        return self.song_to_s - self.song_from_s


@dataclass(frozen=True)
class Anchor:
    """A place of the score that a person has put where they hear it.

    Attributes:
        score_s: Seconds in the score.
        song_s: Seconds in the recording, before `Alignment.offset_s` moves everything.
    """

    score_s: float
    song_s: float


@dataclass(frozen=True)
class Alignment:
    """A recording in time with its score: what was found, and what a person has put right.

    The map goes in straight lines from point to point and never backwards. Where the recording leaves
    something of the score out, many places of the score are at one of the recording; where the recording has
    something that the score has not, one place of the score is at many of the recording. At such a place both
    directions say what comes after it. Before the first point and after the last, a second lasts a second.

    What a person has put right stands beside what was found and never replaces it: see `corrected`.

    Attributes:
        points: What was found, at least two; neither time ever falls.
        score_duration_s: Length of the score.
        song_duration_s: Length of the recording.
        gaps: What is left out of either, in order.
        is_same_music: False where the recording is not the score's music; both then begin at 0.
        transposition: Semitones by which the recording sounds higher than the score.
        tuning_cents: By how much it is tuned higher than A4 = 440 Hz beside that, -50 to 50.
        count_in: How many beats are counted in before the music.
        sounds_after: Whether there is sound (applause) after the music, and not only silence.
        anchors: What a person has put where they hear it, in order.
        offset_s: By how much a person has moved everything, later in the recording if positive.
        follows_key: Whether a person has it played in the recording's key, and not in the score's.

    Raises:
        AlignmentError: The points or anchors run backwards or leave the recording.
    """

    points: tuple[MapPoint, ...]
    score_duration_s: float
    song_duration_s: float
    gaps: tuple[Gap, ...] = ()
    is_same_music: bool = True
    transposition: int = 0
    tuning_cents: float = 0.0
    count_in: int = 0
    sounds_after: bool = False
    anchors: tuple[Anchor, ...] = ()
    offset_s: float = 0.0
    follows_key: bool = False

    def __post_init__(self) -> None:
        _check_points(self.points, self.song_duration_s)
        _check_anchors(self.anchors, self.song_duration_s)
        if abs(self.offset_s) > self.song_duration_s:
            raise AlignmentError(
                f"{self.offset_s:g} s moves everything out of the song, which lasts "
                f"{self.song_duration_s:.3f} s",
                location="offset_s",
            )
        score_s, song_s = corrected(self.points, self.anchors)
        object.__setattr__(self, "_score_s", score_s)
        object.__setattr__(self, "_song_s", song_s + self.offset_s)

    @classmethod
    def identity(cls, score_duration_s: float, song_duration_s: float, **found: Any) -> Alignment:
        """Both begin at 0 and go on alike, nothing being known; `found` is what else there is to say."""
        end_s = min(score_duration_s, song_duration_s)
        points = (MapPoint(0.0, 0.0, 0.0), MapPoint(end_s, end_s, 0.0))
        return cls(points, score_duration_s, song_duration_s, **found)

    @property
    def begins_s(self) -> float:
        """Where in the recording the score's first place that is heard is: the lead-in's length."""
        return float(self._map()[1][0])

    @property
    def ends_s(self) -> float:
        """Where in the recording the score's last place that is heard is."""
        return float(self._map()[1][-1])

    @property
    def confidence(self) -> float:
        """The mean confidence of the points that are heard, 0..1."""
        heard = [point.confidence for point in self.points if point.confidence > 0]
        return float(np.mean(heard)) if heard and self.is_same_music else 0.0

    @overload
    def song_times(self, score_s: float) -> float: ...
    @overload
    def song_times(self, score_s: NDArray[Any] | Sequence[float]) -> Times: ...
    def song_times(self, score_s: NDArray[Any] | Sequence[float] | float) -> Times | float:
        """Where in the recording places of the score are, seconds; a float for a number, else an array."""
        known, values = self._map()
        return _interpolated(score_s, known, values)

    @overload
    def score_times(self, song_s: float) -> float: ...
    @overload
    def score_times(self, song_s: NDArray[Any] | Sequence[float]) -> Times: ...
    def score_times(self, song_s: NDArray[Any] | Sequence[float] | float) -> Times | float:
        """Where in the score places of the recording are, seconds; a float for a number, else an array."""
        values, known = self._map()
        return _interpolated(song_s, known, values)

    def confidence_at(self, score_s: NDArray[Any] | Sequence[float]) -> Times:
        """How surely places of the score are heard where the map has them: (N,), 0..1."""
        known = np.array([point.score_s for point in self.points])
        values = np.array([point.confidence for point in self.points])
        return np.where(self.is_heard(score_s), np.interp(score_s, known, values), 0.0)

    def is_heard(self, score_s: NDArray[Any] | Sequence[float]) -> NDArray[np.bool_]:
        """Whether the recording has what stands at places of the score: (N,) bool.

        What a person has anchored within something that was thought to be left out is heard.
        """
        at = np.asarray(score_s, dtype=np.float64)
        song = self.song_times(at)
        heard = (song >= 0) & (song < self.song_duration_s)
        for gap in self.gaps:
            within = (at >= gap.score_from_s - SAME_S) & (at < gap.score_to_s - SAME_S)
            if not any(gap.score_from_s < anchor.score_s < gap.score_to_s for anchor in self.anchors):
                heard &= ~within
        return heard

    @property
    def moves(self) -> bool:
        """Whether anything moves the score: it was found elsewhere, or a person has put something right."""
        by_hand = bool(self.anchors) or self.offset_s != 0 or self.played_higher != 0
        as_written = not self.gaps and all(point.score_s == point.song_s for point in self.points)
        return by_hand or (self.is_same_music and not as_written)

    @property
    def played_higher(self) -> int:
        """Semitones by which all is played higher than the score says; 0 where its key is kept."""
        return self.transposition if self.follows_key else 0

    @property
    def bends_s(self) -> Times:
        """(P,) seconds of the score between which it is heard evenly, never falling."""
        return self._map()[0]

    def with_anchors(self, anchors: Sequence[Anchor]) -> Alignment:
        """The same with other anchors, in any order.

        Raises:
            AlignmentError: Two of them cross, or one leaves the recording.
        """
        return replace(self, anchors=tuple(sorted(anchors, key=lambda anchor: anchor.score_s)))

    def with_offset(self, offset_s: float) -> Alignment:
        """The same with everything moved.

        Raises:
            AlignmentError: It moves everything out of the recording.
        """
        return replace(self, offset_s=offset_s)

    def with_key(self, *, follows: bool) -> Alignment:
        """The same played in the recording's key, or in the score's."""
        return replace(self, follows_key=follows)

    def _map(self) -> tuple[Times, Times]:
        score_s: Times = self.__dict__["_score_s"]
        song_s: Times = self.__dict__["_song_s"]
        return score_s, song_s


def corrected(points: Sequence[MapPoint], anchors: Sequence[Anchor]) -> tuple[Times, Times]:
    """What was found, warped so that it goes through what a person has said.

    Every anchor is where it was put. From one to the next the found map is stretched evenly in the
    recording's time, so that its tempo keeps its shape; where it hardly moves, as in what was thought
    to be left out, it goes in a straight line. Before the first anchor and after the last, all is moved as
    that anchor was.

    Returns:
        (P,) score times and (P,) song times of the points and anchors, neither ever falling.
    """
    found_score = np.array([point.score_s for point in points])
    found_song = np.array([point.song_s for point in points])
    if not anchors:
        return found_score, found_song
    places = np.array([anchor.score_s for anchor in anchors])
    put = np.array([anchor.song_s for anchor in anchors])
    at_places = np.asarray(_interpolated(places, found_score, found_song))
    score_s: list[Times] = []
    song_s: list[Times] = []
    before, after = found_score < places[0] - SAME_S, found_score > places[-1] + SAME_S
    score_s.append(found_score[before])
    song_s.append(np.minimum(found_song[before] + put[0] - at_places[0], put[0]))
    for index, place in enumerate(places):
        score_s.append(np.array([place]))
        song_s.append(put[index : index + 1])
        if index + 1 == len(places):
            break
        inside = (found_score > place + SAME_S) & (found_score < places[index + 1] - SAME_S)
        moved = at_places[index + 1] - at_places[index]
        share = (found_score[inside] - place) / (places[index + 1] - place)
        # Of hardly any time in the recording nothing can be told of how it goes between the two.
        trusted = min(max(moved / LEAST_TRUSTED_S - 1, 0.0), 1.0)
        if trusted:
            share += trusted * ((found_song[inside] - at_places[index]) / moved - share)
        score_s.append(found_score[inside])
        song_s.append(put[index] + np.clip(share, 0, 1) * (put[index + 1] - put[index]))
    score_s.append(found_score[after])
    song_s.append(np.maximum(found_song[after] + put[-1] - at_places[-1], put[-1]))
    return np.concatenate(score_s), np.concatenate(song_s)


def _interpolated(at: NDArray[Any] | Sequence[float] | float, known: Times, values: Times) -> Times | float:
    """In straight lines; of several values at one place the last; a second is a second beyond the ends."""
    wanted = np.asarray(at, dtype=np.float64)
    index = np.clip(np.searchsorted(known, wanted, side="right") - 1, 0, len(known) - 2)
    length = known[index + 1] - known[index]
    # Held within its piece first: beyond one of hardly any length the share would be beyond all numbers.
    within = np.clip(wanted - known[index], 0, length)
    share = np.where(length > 0, within / np.where(length > 0, length, 1), 1.0)
    result = values[index] + share * (values[index + 1] - values[index])
    result = result + np.minimum(wanted - known[0], 0) + np.maximum(wanted - known[-1], 0)
    return result if wanted.ndim else float(result)


def _check_points(points: tuple[MapPoint, ...], song_duration_s: float) -> None:
    if len(points) < 2:
        raise AlignmentError("a map needs two points at least", location="points")
    for index, point in enumerate(points):
        place = f"points/{index}"
        if not -SAME_S <= point.song_s <= song_duration_s + SAME_S:
            raise AlignmentError(
                f"{point.song_s:.3f} s is not within the song, which lasts {song_duration_s:.3f} s",
                location=f"{place}/song_s",
            )
        if index == 0:
            continue
        before = points[index - 1]
        for name, now, then in (
            ("score_s", point.score_s, before.score_s),
            ("song_s", point.song_s, before.song_s),
        ):
            if now < then:
                raise AlignmentError(
                    f"{now:.3f} s lies before {then:.3f} s, the point before it: the map would run backwards",
                    location=f"{place}/{name}",
                )
    if points[-1].score_s <= points[0].score_s:
        raise AlignmentError("all points stand at one place of the score", location="points")


def _check_anchors(anchors: tuple[Anchor, ...], song_duration_s: float) -> None:
    for index, anchor in enumerate(anchors):
        place = f"anchors/{index}"
        if not 0 <= anchor.song_s <= song_duration_s:
            raise AlignmentError(
                f"{anchor.song_s:.3f} s is not within the song, which lasts {song_duration_s:.3f} s",
                location=f"{place}/song_s",
            )
        if index == 0:
            continue
        before = anchors[index - 1]
        if anchor.score_s <= before.score_s:
            raise AlignmentError(
                f"{anchor.score_s:.3f} s of the score has an anchor already or lies before the one at "
                f"{before.score_s:.3f} s; anchors stand in the score's order, each at a place of its own",
                location=f"{place}/score_s",
            )
        if anchor.song_s <= before.song_s:
            raise AlignmentError(
                f"{anchor.song_s:.3f} s is not after {before.song_s:.3f} s, where the anchor before it is: "
                f"the map would run backwards between {before.score_s:.3f} s and {anchor.score_s:.3f} s "
                "of the score",
                location=f"{place}/song_s",
            )
