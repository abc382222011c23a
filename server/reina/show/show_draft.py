"""A show while it is being edited."""

from collections.abc import Mapping
from dataclasses import fields, replace
from typing import Any

from reina.curves.parameter import Parameter
from reina.curves.parameter_registry import ParameterRegistry
from reina.show.errors import KeyNotFoundError
from reina.show.show import Show, check_size
from reina.show.show_reader import read_track
from reina.show.time_map import TimeMap
from reina.show.track import Track, UnknownTrack
from reina.show.track_draft import TrackDraft

DEFAULTS: Mapping[str, Any] = {field.name: field.default for field in fields(Show)}


class ShowDraft:
    """A show whose tracks are opened one by one as they are edited; all others stay as they are.

    Args:
        show: What it was; `show` has its own fields as they are now.
        registry: The parameters.
        time_map: How the music's time runs.
    """

    def __init__(self, show: Show, registry: ParameterRegistry, time_map: TimeMap) -> None:
        self.show = show
        self.registry = registry
        self.time_map = time_map
        self._tracks: dict[str, Track | UnknownTrack | TrackDraft] = {
            track.parameter: track for track in show.tracks
        }

    def finished(self) -> Show:
        """The show. A track that has lost its last keyframe and answers no events is gone.

        Raises:
            ShowError: Two keyframes stand at one time, or there are too many.
        """
        before = {track.parameter: track for track in self.show.tracks}
        tracks: list[Track | UnknownTrack] = []
        for path, track in self._tracks.items():
            if isinstance(track, TrackDraft):
                if track.is_empty:
                    continue
                track = track.finished()
            # What came out the same stays the same object, and need not be planned anew.
            tracks.append(before[path] if before.get(path) == track else track)
        show = replace(self.show, tracks=tuple(tracks))
        check_size(show)
        return show

    @property
    def paths(self) -> tuple[str, ...]:
        """The parameters that have a track, unknown ones too."""
        return tuple(self._tracks)

    def track(self, parameter: Parameter) -> TrackDraft:
        """A track to be edited.

        Raises:
            KeyNotFoundError: The show has none of this parameter.
        """
        track = self._tracks.get(parameter.path)
        if track is None or isinstance(track, UnknownTrack):
            raise KeyNotFoundError("the show has no such track", track=parameter.path)
        if isinstance(track, Track):
            track = self._tracks[parameter.path] = TrackDraft(track, parameter)
        return track

    def track_or_new(self, parameter: Parameter) -> TrackDraft:
        """A track to be edited, made where there is none that has an effect."""
        if isinstance(self._tracks.get(parameter.path), UnknownTrack | None):
            self.replace(TrackDraft(Track(parameter.path, (), time=self.show.time), parameter))
        return self.track(parameter)

    def put_track(self, document: Mapping[str, Any], parameter: Parameter) -> None:
        """A track from JSON in the place of the parameter's own."""
        track = read_track(document, parameter, self.show.time, may_be_empty=True)
        self.replace(TrackDraft(track, parameter))

    def put(self, track: Track) -> None:
        """A track in the place of its parameter's own."""
        self._tracks[track.parameter] = track

    def replace(self, draft: TrackDraft) -> None:
        """A track in the place of its parameter's own, or after all others."""
        self._tracks[draft.parameter.path] = draft

    def remove_track(self, path: str) -> None:
        """Take a track out, of an unknown parameter too.

        Raises:
            KeyNotFoundError: The show has none.
        """
        if self._tracks.pop(path, None) is None:
            raise KeyNotFoundError("the show has no such track", track=path)

    def change_head(self, changes: Mapping[str, Any]) -> None:
        """Change what a show has beside its tracks; None takes a field back to its default."""
        given = {name: DEFAULTS[name] if value is None else value for name, value in changes.items()}
        if "markers" in given:
            given["markers"] = tuple(sorted(given["markers"], key=lambda marker: marker.time))
        self.show = replace(self.show, **given)
