"""The show: everything that a person has programmed around the player, as tracks of keyframes."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated, Any

from pydantic import Field, Strict, ValidationError

from reina.curves.parameter_registry import ParameterRegistry
from reina.show.document import Marker, ShowHead
from reina.show.errors import MAX_FAULTS, KeyNotFoundError, ShowError, together
from reina.show.faults import show_error
from reina.show.plain_json import check_plain
from reina.show.show_plan import ShowPlan
from reina.show.show_reader import read_track
from reina.show.show_writer import track_document
from reina.show.time_map import TimeMap, TimeUnit
from reina.show.track import Track, UnknownTrack
from reina.show.triggers import Triggers
from reina.show.unknown_choices import choices_of
from reina.system.json_text import json_text

VERSION = 1
MAX_KEYFRAMES = 500_000


class _UnreadShow(ShowHead):
    """A show whose tracks are still to be read, each as its parameter has it."""

    tracks: Annotated[tuple[dict[str, Any], ...], Strict(strict=False)] = Field(default=())


@dataclass(frozen=True)
class Show:
    """Tracks of keyframes. Never changed: an edit (`reina.show.with_edits`) gives a new show.

    Shows share every track that an edit does not touch.

    Attributes:
        tracks: In the order in which the person keeps them, one a parameter.
        title: What the person calls it.
        description: What else there is to say.
        time: The unit of times where a track names no other.
        markers: Named places, in order.
        schema: The ``$schema`` that the document named, or None.
    """

    tracks: tuple[Track | UnknownTrack, ...] = ()
    title: str = ""
    description: str = ""
    time: TimeUnit = "seconds"
    markers: tuple[Marker, ...] = ()
    schema: str | None = None

    @classmethod
    def from_document(cls, document: object, registry: ParameterRegistry) -> "Show":
        """Read a show from JSON.

        A track of a parameter that the registry does not know is kept and named in `unknown_parameters`; so
        is one of a parameter with `open_choices` that names a choice which is not there.

        Raises:
            ShowError: The document is no show; the error names track, key and field, and what would be
                right, and knows of what else is wrong.
        """
        try:
            read = _UnreadShow.model_validate(document)
        except ValidationError as error:
            raise show_error(error, _UnreadShow) from None
        tracks: list[Track | UnknownTrack] = []
        errors: list[ShowError] = []
        for index, entry in enumerate(read.tracks):
            try:
                tracks.append(_read_track(entry, index, registry, read.time))
            except ShowError as error:
                errors.append(error)
                if len(errors) == MAX_FAULTS:
                    break
        if errors:
            raise together(errors)
        show = cls(
            tracks=tuple(tracks),
            title=read.title,
            description=read.description,
            time=read.time,
            markers=tuple(sorted(read.markers, key=lambda marker: marker.time)),
            schema=read.schema_ or None,
        )
        check_size(show)
        return show

    def __post_init__(self) -> None:
        seen: set[str] = set()
        for track in self.tracks:
            if track.parameter in seen:
                raise ShowError("it has two tracks; put their keyframes into one", track=track.parameter)
            seen.add(track.parameter)

    def to_document(self) -> dict[str, Any]:
        """The show as JSON; `from_document` gives the same show again."""
        document: dict[str, Any] = {} if self.schema is None else {"$schema": self.schema}
        document |= {"version": VERSION, "title": self.title}
        if self.description:
            document["description"] = self.description
        document["time"] = self.time
        if self.markers:
            document["markers"] = [{"time": marker.time, "name": marker.name} for marker in self.markers]
        document["tracks"] = [
            track_document(track, self.time) if isinstance(track, Track) else track.document
            for track in self.tracks
        ]
        return document

    @property
    def unknown_parameters(self) -> tuple[str, ...]:
        """Paths of tracks that are kept without effect: their parameter, or what they choose, is not here."""
        return tuple(track.parameter for track in self.tracks if isinstance(track, UnknownTrack))

    def track(self, path: str) -> Track:
        """The track of a parameter.

        Raises:
            KeyNotFoundError: The show has none.
        """
        for track in self.tracks:
            if track.parameter == path and isinstance(track, Track):
                return track
        raise KeyNotFoundError("the show has no such track", track=path)

    def plan(
        self,
        registry: ParameterRegistry,
        time_map: TimeMap | None = None,
        *,
        triggers: Triggers | None = None,
        fps: float = 60.0,
        earlier: ShowPlan | None = None,
    ) -> ShowPlan:
        """Make the show ready to be evaluated.

        Args:
            registry: The parameters, in the order of the values.
            time_map: How the music's time runs; 120 beats a minute in 4/4 where it is not given.
            triggers: What happens in the music, for tracks that answer it; those of `earlier` where it is
                not given.
            fps: The grid on which `ShowPlan.evaluate` looks for cuts.
            earlier: A plan of an earlier state of this show: tracks that both share are taken from it.
        """
        time_map = time_map or TimeMap.steady()
        return ShowPlan.make(self.tracks, registry, time_map, triggers=triggers, fps=fps, earlier=earlier)


def check_size(show: Show) -> None:
    """Refuse a show that is too large.

    Raises:
        ShowError: It has more than `MAX_KEYFRAMES`.
    """
    count = sum(len(track.keyframes) for track in show.tracks if isinstance(track, Track))
    if count > MAX_KEYFRAMES:
        raise ShowError(f"{count} keyframes are more than a show may have, {MAX_KEYFRAMES}", field="tracks")


def _read_track(
    document: Mapping[str, Any], index: int, registry: ParameterRegistry, unit: TimeUnit
) -> Track | UnknownTrack:
    path = document.get("parameter")
    if not isinstance(path, str) or not path:
        raise ShowError("a parameter's path is needed here", field=f"tracks/{index}/parameter")
    parameter = registry.get(path)
    choices = () if parameter is None else choices_of(document, parameter)
    if parameter is not None and all(choice in parameter.choices for choice in choices):
        return read_track(document, parameter, unit)
    try:
        check_plain(document)
    except ValueError as error:
        raise ShowError(str(error), field=f"tracks/{index}") from None
    return UnknownTrack(path, json_text(document), choices)
