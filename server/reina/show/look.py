"""Looks: values of many parameters to choose at once, such as a light or a whole stage."""

from typing import Annotated, Any

import numpy as np
from pydantic import Field, Strict

from reina.curves.parameter import Parameter
from reina.curves.value_types import Number
from reina.show.document import ShowTrack
from reina.show.errors import ShowError
from reina.show.model import ShowModel, read_later
from reina.show.show_draft import ShowDraft
from reina.show.show_reader import read_track
from reina.show.show_writer import json_value
from reina.show.time_map import TimeUnit
from reina.show.track_draft import TrackDraft

LookTrack = Annotated[dict[str, Any], read_later(ShowTrack)]


class Look(ShowModel):
    """Values and movements to put into a show; what a show's parameters do not know of it is left out."""

    values: dict[str, Any] = Field(default_factory=dict)
    """By parameter, each as the parameter has it."""
    tracks: Annotated[tuple[LookTrack, ...], Strict(strict=False)] = ()
    """Tracks of keyframes without events; their times count from where the look is put."""
    rest: Annotated[tuple[str, ...], Strict(strict=False)] = ()
    """Parameters, or beginnings of their paths, that go back to their defaults where they have no value and
    no track here: `lights` for all lights."""

    def put_throughout(self, draft: ShowDraft) -> None:
        """Give a show these values from its beginning to its end.

        Raises:
            ShowError: A value or a track is not as it should be.
        """
        own = set(self.values) | {_path(track) for track in self.tracks}
        for path in self._resting(draft, own):
            draft.remove_track(path)
        for path, value in self._known_values(draft):
            keyframe = {"key": "k1", "time": 0, "value": value, "interpolation": "step"}
            draft.put_track({"keyframes": [keyframe], "parameter": path}, draft.registry[path])
        for document, parameter in self._known_tracks(draft):
            draft.replace(_read(document, parameter, draft))

    def put_at(self, draft: ShowDraft, at: Number, unit: TimeUnit) -> None:
        """Give a show these values from a time on.

        What was before stays, and each track goes on to its next keyframe from there.

        Args:
            draft: The show.
            at: When.
            unit: Of `at`.

        Raises:
            ShowError: A value or a track is not as it should be.
        """
        at_s = float(draft.time_map.to_seconds(np.array([at]), unit)[0])
        own = set(self.values) | {_path(track) for track in self.tracks}
        for path in self._resting(draft, own):
            parameter = draft.registry[path]
            draft.track(parameter).jump(at_s, json_value(parameter.default), draft.time_map)
        for path, value in self._known_values(draft):
            draft.track_or_new(draft.registry[path]).jump(at_s, value, draft.time_map)
        for document, parameter in self._known_tracks(draft):
            draft.track_or_new(parameter).take_over(
                _read(document, parameter, draft), at_s, draft.show.time, draft.time_map
            )

    def _resting(self, draft: ShowDraft, own: set[str]) -> list[str]:
        """Paths of the show's tracks that are to go back to their defaults."""
        return [
            path
            for path in draft.paths
            if path not in own
            and path in draft.registry
            and any(path == beginning or path.startswith(f"{beginning}/") for beginning in self.rest)
        ]

    def _known_values(self, draft: ShowDraft) -> list[tuple[str, Any]]:
        return [(path, value) for path, value in self.values.items() if path in draft.registry]

    def _known_tracks(self, draft: ShowDraft) -> list[tuple[dict[str, Any], Parameter]]:
        known = ((track, draft.registry.get(_path(track))) for track in self.tracks)
        return [(track, parameter) for track, parameter in known if parameter is not None]


def _path(track: dict[str, Any]) -> str:
    path = track.get("parameter")
    if not isinstance(path, str):
        raise ShowError("a parameter's path is needed here", field="look/tracks/parameter")
    return path


def _read(document: dict[str, Any], parameter: Parameter, draft: ShowDraft) -> TrackDraft:
    track = read_track(document, parameter, draft.show.time, may_be_empty=True)
    if track.events is not None:
        raise ShowError(
            "a look's track has keyframes alone; an answer to the music has no beginning",
            track=parameter.path,
            field="events",
        )
    if not track.keyframes:
        raise ShowError("a look's track has a keyframe at least", track=parameter.path, field="keyframes")
    return TrackDraft(track, parameter)
