"""A track while it is being edited: of its keyframes only those that change are read again."""

from collections.abc import Iterable, Mapping
from dataclasses import fields, replace
from itertools import count
from typing import Any

import numpy as np

from reina.curves.arrays import FloatArray
from reina.curves.interpolation import interpolation_name
from reina.curves.keyframe import Keyframe
from reina.curves.parameter import Parameter
from reina.curves.value_types import LARGEST
from reina.show.document import ShowKeyframe
from reina.show.errors import KeyNotFoundError, ShowError
from reina.show.show_reader import Json, fitted, read_keyframe
from reina.show.show_writer import json_value, keyframe_document
from reina.show.time_map import TimeMap, TimeUnit
from reina.show.track import Track
from reina.show.track_plan import TrackPlan
from reina.show.track_samples import sample_track
from reina.show.triggers import Triggers

SAME_TIME = 1e-6
"""Keys that are nearer than this, in their track's unit, stand at one time for a person."""
DEFAULTS: Mapping[str, Any] = {field.name: field.default for field in fields(Track)}
RATE_STEP = 1e-4
"""Of a unit: over so much of the time the tempo at a keyframe is measured."""
CUT_S = 0.02
"""What ends in a jump ends so much before it, seconds: within a frame of it, and told apart in an editor."""
DIGITS = 9
"""Decimals of times that are worked out, so that 0.1 + 0.2 is written as 0.3."""


class TrackDraft:
    """One track of a show that is being edited. It need not be a track in between.

    Args:
        track: What it was, or is to begin with; its keyframes may be none.
        parameter: What it moves.
    """

    def __init__(self, track: Track, parameter: Parameter) -> None:
        self._head = track
        self.parameter = parameter
        self._keyframes = {keyframe.key: keyframe for keyframe in track.keyframes}
        self._numbers = count(1)

    @property
    def is_empty(self) -> bool:
        """Whether there is nothing left that would make a track of it."""
        return not self._keyframes and self._head.events is None

    @property
    def time(self) -> TimeUnit:
        """The unit of its keyframes' times."""
        return self._head.time

    def finished(self) -> Track:
        """The track.

        Raises:
            ShowError: Two keyframes stand at one time.
        """
        return replace(self._head, keyframes=tuple(self._keyframes.values()))

    def add(self, document: Json, *, replaces: bool, time_map: TimeMap) -> None:
        """Add a keyframe from JSON; without a key it gets the next free one.

        Args:
            document: The keyframe. Without a value it gets the one that the keyframes have at its time, or
                the parameter's default.
            replaces: Whether one that stands at its time gives way, and leaves it its key.
            time_map: How the music's time runs.
        """
        if "time" in document and "value" not in document:
            document = {**document, "value": json_value(self.parameter.default)}
            time = read_keyframe(document, self.parameter, "k1").time
            document["value"] = self._value_at(time, time_map)
        added = read_keyframe(document, self.parameter, "" if document.get("key") else self._next_key())
        if replaces:
            for key in self._standing_at([added.time]):
                if key != added.key:
                    del self._keyframes[key]
                    added = added if "key" in document else replace(added, key=key)
        if added.key in self._keyframes and not replaces:
            raise ShowError(
                f"the key {added.key} is given twice; every key of a track has its own",
                track=self.parameter.path,
                key=added.key,
                field="key",
            )
        self._keyframes[added.key] = added

    def change(self, key: object, changes: Json) -> None:
        """Change some fields of a keyframe; null takes one back to its default."""
        keyframe = self.keyframe(key)
        if changes.get("key", key) != key:
            raise ShowError(
                "a keyframe's key stays; add another and remove this",
                track=self.parameter.path,
                key=keyframe.key,
                field="changes/key",
            )
        self._keyframes[keyframe.key] = changed_keyframe(keyframe, changes, self.parameter)

    def remove(self, key: object) -> None:
        """Take a keyframe out."""
        del self._keyframes[self.keyframe(key).key]

    def keyframe(self, key: object) -> Keyframe[Any]:
        """The keyframe of a key.

        Raises:
            KeyNotFoundError: There is none.
        """
        found = self._keyframes.get(key) if isinstance(key, str) else None
        if found is None:
            raise KeyNotFoundError("there is no such keyframe", track=self.parameter.path, key=str(key))
        return found

    def move(
        self,
        keys: Iterable[object],
        *,
        by: float,
        about: float,
        factor: float,
        unit: TimeUnit,
        time_map: TimeMap,
        value_by: float | tuple[float, ...] | None,
    ) -> None:
        """Move keyframes to about + factor · (time - about) + by; what stands there gives way.

        Args:
            keys: Theirs.
            by: In `unit`, as `about`.
            about: What stays where it is when they are stretched.
            factor: How far they are stretched, greater than 0; slopes become so much flatter.
            unit: What the times of the move are in.
            time_map: Turns it into the track's unit.
            value_by: What is added to the values of numbers and vectors, held within the parameter's range.
        """
        chosen = [self.keyframe(key) for key in dict.fromkeys(keys)]
        times = np.array([keyframe.time for keyframe in chosen])
        placed = _in_unit(times, self.time, unit, time_map)
        moved = self._turned(about + factor * (placed - about) + by, unit, self.time, time_map)
        for keyframe in chosen:
            del self._keyframes[keyframe.key]
        for key in self._standing_at(moved):
            del self._keyframes[key]
        for keyframe, time in zip(chosen, moved, strict=True):
            changes: dict[str, Any] = {"time": time}
            for tangent in ("in_tangent", "out_tangent"):
                if factor != 1.0:
                    changes[tangent] = _scaled(getattr(keyframe, tangent), 1.0 / factor)
            if value_by is not None:
                changes["value"] = self._value_moved(keyframe.value, value_by)
            self._keyframes[keyframe.key] = replace(keyframe, **changes)

    def jump(self, at_s: float, value: Any, time_map: TimeMap) -> None:
        """Give it a value from a time on, by a jump; what was before stays as it was.

        What was on its way to a keyframe behind is ended just before, straight, where it had come to.

        Args:
            at_s: When, seconds.
            value: What it is from there on, as JSON has it.
            time_map: How the music's time runs.
        """
        at, ended, begin = time_map.from_seconds(np.array([at_s, at_s - CUT_S, 0.0]), self.time).tolist()
        at, ended, begin = round(at, DIGITS), round(ended, DIGITS), round(begin, DIGITS)
        times = sorted(keyframe.time for keyframe in self._keyframes.values())
        earlier = [time for time in times if time < at - SAME_TIME]
        if at > begin + SAME_TIME:
            if not earlier:
                self._end(begin, "step", time_map)
            elif earlier[-1] < ended and self._is_moving(at):
                self._end(ended, "linear", time_map)
        document = {"time": at, "value": value, "interpolation": "step"}
        self.add(document, replaces=True, time_map=time_map)

    def take_over(self, other: "TrackDraft", at_s: float, show_time: TimeUnit, time_map: TimeMap) -> None:
        """Move as another track does from a time on; what was before stays, what it stands on gives way.

        Args:
            other: Of the same parameter, with a keyframe at least; its times count from there.
            at_s: When, seconds.
            show_time: The unit of the show.
            time_map: How the music's time runs.
        """
        keys = list(other._keyframes)
        by = float(time_map.from_seconds(np.array([at_s]), other.time)[0])
        other.move(keys, by=by, about=0.0, factor=1.0, unit=other.time, time_map=time_map, value_by=None)
        other.change_head({"time": self.time}, show_time, time_map)
        placed = sorted(other._keyframes.values(), key=lambda keyframe: keyframe.time)
        first, last = placed[0], placed[-1]
        first_s = float(time_map.to_seconds(np.array([first.time]), self.time)[0])
        self.jump(first_s, keyframe_document(first)["value"], time_map)
        for key, keyframe in list(self._keyframes.items()):
            if first.time + SAME_TIME <= keyframe.time <= last.time + SAME_TIME:
                del self._keyframes[key]
        (begun,) = self._standing_at([first.time])
        self._keyframes[begun] = replace(self._keyframes[begun], out_tangent=first.out_tangent)
        for keyframe in placed[1:]:
            key = self._next_key()
            self._keyframes[key] = replace(keyframe, key=key)

    def change_head(self, changes: Mapping[str, Any], show_time: TimeUnit, time_map: TimeMap) -> None:
        """Change what a track has beside its keyframes; None takes a field back to its default.

        With another unit the keyframes stay where they are in the music, and get other numbers. So do their
        slopes, and the lengths of the answer to events unless that is changed too, by the tempo where they
        stand.
        """
        defaults: Json = {**DEFAULTS, "time": show_time}
        given: dict[str, Any] = {
            name: defaults[name] if value is None else value for name, value in changes.items()
        }
        if given.get("events") is not None:
            given["events"] = fitted(given["events"], self.parameter)
        head = replace(self._head, keyframes=(), **given)
        before, self._head = self._head, head
        if head.time == before.time:
            return
        times = np.array([keyframe.time for keyframe in self._keyframes.values()])
        turned = self._turned(times, before.time, head.time, time_map)
        arriving, leaving = (_rates(times, before.time, head.time, time_map, way=way) for way in (-1.0, 1.0))
        for keyframe, time, comes, goes in zip(
            list(self._keyframes.values()), turned, arriving.tolist(), leaving.tolist(), strict=True
        ):
            self._keyframes[keyframe.key] = replace(
                keyframe,
                time=time,
                in_tangent=_scaled(keyframe.in_tangent, 1.0 / comes),
                out_tangent=_scaled(keyframe.out_tangent, 1.0 / goes),
            )
        if head.events is not None and "events" not in changes:
            begin = times[:1] if times.size else np.zeros(1)
            rate = float(_rates(begin, before.time, head.time, time_map, way=1.0)[0])
            events = head.events
            scaled = {
                field: round(getattr(events, field) * rate, DIGITS) for field in ("attack", "hold", "decay")
            }
            self._head = replace(head, events=events.model_copy(update=scaled))

    def copied_to(self, parameter: Parameter) -> "TrackDraft":
        """The same for another parameter of the same type; values are held within its range.

        Raises:
            ShowError: It is of another type.
        """
        own = self.parameter
        if (own.type, own.choices) != (parameter.type, parameter.choices):
            raise ShowError(
                f"{own.path} is a {own.type} and {parameter.path} another kind of value; "
                "a track is copied to a parameter of its own type",
                track=own.path,
                field="to",
            )
        keyframes = tuple(
            replace(keyframe, value=_held(keyframe.value, parameter)) for keyframe in self._keyframes.values()
        )
        return TrackDraft(replace(self._head, parameter=parameter.path, keyframes=keyframes), parameter)

    def _next_key(self) -> str:
        """The next of k1, k2 and so on that no keyframe has."""
        return next(key for n in self._numbers if (key := f"k{n}") not in self._keyframes)

    def _end(self, time: float, interpolation: str, time_map: TimeMap) -> None:
        """Add a keyframe with the value that the others have at its time."""
        usable = interpolation if self.parameter.interpolates else "step"
        self.add({"time": time, "interpolation": usable}, replaces=True, time_map=time_map)

    def _is_moving(self, time: float) -> bool:
        """Whether a time lies before a keyframe that is come to otherwise than by a jump."""
        behind = [keyframe for keyframe in self._keyframes.values() if keyframe.time > time - SAME_TIME]
        if not behind:
            return self._head.after != "hold"
        return interpolation_name(min(behind, key=lambda keyframe: keyframe.time)) != "step"

    def _value_at(self, time: float, time_map: TimeMap) -> Any:
        """What the keyframes say at a time of the track, as JSON has it."""
        track = replace(self._head, keyframes=tuple(self._keyframes.values()))
        times_s = time_map.to_seconds(np.array([time]), track.time)
        curve, _ = sample_track(TrackPlan.make(track, self.parameter), times_s, time_map, Triggers())
        return json_value(self.parameter.value(curve.values[0]))

    def _standing_at(self, times: list[float]) -> list[str]:
        """The keys of the keyframes that stand at one of some times."""
        if not self._keyframes or not times:
            return []
        wanted = np.sort(np.asarray(times, dtype=np.float64))
        own = np.array([keyframe.time for keyframe in self._keyframes.values()])
        after = np.minimum(wanted.searchsorted(own), wanted.size - 1)
        gap = np.minimum(np.abs(wanted[after] - own), np.abs(wanted[np.maximum(after - 1, 0)] - own))
        keys = list(self._keyframes)
        return [keys[index] for index in np.flatnonzero(gap < SAME_TIME)]

    def _turned(self, times: FloatArray, unit: TimeUnit, wanted: TimeUnit, time_map: TimeMap) -> list[float]:
        """Times in another unit, as they are written.

        Raises:
            ShowError: One is further away than a show may say.
        """
        turned = np.round(_in_unit(times, unit, wanted, time_map), DIGITS)
        if np.any(np.abs(turned) > LARGEST):
            raise ShowError(
                f"keyframes would stand beyond ±{LARGEST:g} {wanted}", track=self.parameter.path, field="time"
            )
        return turned.tolist()

    def _value_moved(self, value: Any, by: float | tuple[float, ...]) -> Any:
        moved = np.round(np.asarray(value, dtype=np.float64) + np.asarray(by), DIGITS)
        return _held(float(moved) if moved.ndim == 0 else tuple(moved.tolist()), self.parameter)


def changed_keyframe(keyframe: Keyframe[Any], changes: Json, parameter: Parameter) -> Keyframe[Any]:
    """A keyframe with some fields changed, as JSON.

    A field that is null goes back to its default; another interpolation drops the old one's options.

    Raises:
        ShowError: A field is not as it should be.
    """
    document = keyframe_document(keyframe)
    if changes.get("interpolation", document["interpolation"]) != document["interpolation"]:
        document = {name: value for name, value in document.items() if name in ShowKeyframe.model_fields}
    document = {name: value for name, value in {**document, **changes}.items() if value is not None}
    return read_keyframe(document, parameter, "")


def _in_unit(times: FloatArray, unit: TimeUnit, wanted: TimeUnit, time_map: TimeMap) -> FloatArray:
    if unit == wanted:
        return times
    return time_map.from_seconds(time_map.to_seconds(times, unit), wanted)


def _rates(
    times: FloatArray, unit: TimeUnit, wanted: TimeUnit, time_map: TimeMap, *, way: float
) -> FloatArray:
    """How many of the wanted units pass in one, at times: just after them for way 1, before them for -1."""
    step = way * np.maximum(RATE_STEP, 1e-7 * np.abs(times))
    turned = _in_unit(np.stack([times, times + step]), unit, wanted, time_map)
    return (turned[1] - turned[0]) / step


def _scaled(slope: Any, factor: float) -> Any:
    if slope is None:
        return None
    scaled = np.clip(factor * np.asarray(slope, dtype=np.float64), -LARGEST, LARGEST)
    return float(scaled) if scaled.ndim == 0 else tuple(scaled.tolist())


def _held(value: Any, parameter: Parameter) -> Any:
    """A number or a vector within its parameter's range; any other value as it is."""
    if parameter.type not in ("number", "vector"):
        return value
    held = np.clip(
        np.asarray(value, dtype=np.float64),
        -LARGEST if parameter.minimum is None else parameter.minimum,
        LARGEST if parameter.maximum is None else parameter.maximum,
    )
    return float(held) if held.ndim == 0 else tuple(held.tolist())
