"""The show: everything that a person has programmed around the player, as tracks of keyframes."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, cast

from reina.curves.keyframe import Keyframe
from reina.curves.parameter import Parameter
from reina.curves.parameter_registry import ParameterRegistry
from reina.curves.shown import shown
from reina.show.errors import KeyNotFoundError, ShowError
from reina.show.location import Json, Location
from reina.show.plain_json import check_plain
from reina.show.show_plan import ShowPlan
from reina.show.show_reader import read_keyframe, read_track
from reina.show.show_writer import json_value, track_document
from reina.show.time_map import TIME_UNITS, TimeMap, TimeUnit
from reina.show.track import Track, UnknownTrack
from reina.show.track_draft import changed_keyframe
from reina.show.triggers import Triggers

if TYPE_CHECKING:
    from collections.abc import Iterator

VERSION = 1
SHOW_FIELDS = ("$schema", "version", "title", "description", "time", "markers", "tracks")
MAX_KEYFRAMES = 500_000


@dataclass(frozen=True)
class Marker:
    """A named place on the time axis, for the person who edits.

    Attributes:
        time: Where, in the show's unit.
        name: What to call it.
    """

    time: float
    name: str


@dataclass(frozen=True)
class Show:
    """Tracks of keyframes. Never changed: an edit gives a new show that shares every track it does not touch.

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

        A track of a parameter that the registry does not know is kept and named in `unknown_parameters`.

        Raises:
            ShowError: The document is no show; the error names track, key and field, and what would be right.
        """
        location = Location()
        fields = location.fields(document, SHOW_FIELDS, what="a show")
        if fields.get("version") != VERSION:
            version = shown(fields.get("version"))
            raise location.error(f"this is version {version}; version {VERSION} is read here", "version")
        unit = location.choice(fields, "time", TIME_UNITS, "seconds")
        tracks: list[Track | UnknownTrack] = []
        for index, entry in enumerate(location.items(fields.get("tracks", ()), "tracks")):
            if not isinstance(entry, Mapping):
                raise location.error(
                    f"a track is a JSON object, not {type(entry).__name__}", f"tracks/{index}"
                )
            track = cast("Json", entry)
            path = track.get("parameter")
            if not isinstance(path, str) or not path:
                raise location.error("a parameter's path is needed here", f"tracks/{index}/parameter")
            parameter = registry.get(path)
            if parameter is None:
                check_plain(track, location, f"tracks/{index}")
                tracks.append(UnknownTrack(path, dict(track)))
            else:
                tracks.append(read_track(track, parameter, unit))
        show = cls(
            tracks=tuple(tracks),
            title=location.text(fields, "title"),
            description=location.text(fields, "description"),
            time=unit,
            markers=tuple(_read_markers(fields, location)),
            schema=location.text(fields, "$schema") or None,
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
            track_document(track, self.time) if isinstance(track, Track) else json_value(track.document)
            for track in self.tracks
        ]
        return document

    @property
    def unknown_parameters(self) -> tuple[str, ...]:
        """Paths of the tracks that are kept but have no effect, because nothing here has such a parameter."""
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
        return ShowPlan.make(self, registry, time_map, triggers=triggers, fps=fps, earlier=earlier)

    def with_keyframe(self, path: str, keyframe: Keyframe[Any], *, time: TimeUnit | None = None) -> "Show":
        """The show with a keyframe more, or with another in the place of the one with its key.

        Args:
            path: The parameter. Where it has no track yet, one is made.
            keyframe: From `read_keyframe`, or made by hand with a value as JSON writes it. Without a key it
                gets the next.
            time: The unit of a track that has to be made; else the show's.

        Raises:
            ShowError: Another keyframe stands at its time.
        """
        if any(track.parameter == path for track in self.tracks):
            track = self.track(path)
            named = keyframe if keyframe.key else replace(keyframe, key=track.next_key())
            return self.with_track(track.with_keyframe(named))
        named = keyframe if keyframe.key else replace(keyframe, key="k1")
        return self.with_track(Track(path, (named,), time=time or self.time))

    def without_keyframe(self, path: str, key: str) -> "Show":
        """The show with a keyframe less; a track that loses its last and answers no events goes with it.

        Raises:
            KeyNotFoundError: There is no such track or keyframe.
        """
        track = self.track(path)
        if track.keyframe(key) and len(track.keyframes) == 1 and track.events is None:
            return self.without_track(path)
        return self.with_track(track.without_keyframe(key))

    def with_changed(self, parameter: Parameter, key: str, changes: Mapping[str, Any]) -> "Show":
        """The show with some fields of a keyframe changed, as JSON.

        A field that is null goes back to its default; another interpolation drops the old one's options.

        Raises:
            KeyNotFoundError: There is no such track or keyframe.
            ShowError: A field is not as it should be.
        """
        track = self.track(parameter.path)
        keyframe = changed_keyframe(track.keyframe(key), changes, parameter)
        return self.with_track(track.without_keyframe(key).with_keyframe(keyframe))

    def new_keyframe(self, parameter: Parameter, document: object) -> Keyframe[Any]:
        """Read a keyframe from JSON, to be given to `with_keyframe`; without a key it gets the next free one.

        Raises:
            ShowError: A field is not as it should be.
        """
        tracks: Iterator[Track] = (
            t for t in self.tracks if t.parameter == parameter.path and isinstance(t, Track)
        )
        track = next(tracks, None)
        return read_keyframe(document, parameter, ("k1" if track is None else track.next_key(),))

    def with_track(self, track: Track | UnknownTrack) -> "Show":
        """The show with a track more, or with another in the place of the one of the same parameter."""
        tracks = list(self.tracks)
        for index, other in enumerate(tracks):
            if other.parameter == track.parameter:
                tracks[index] = track
                return replace(self, tracks=tuple(tracks))
        return replace(self, tracks=(*tracks, track))

    def with_new_track(self, track: Track) -> "Show":
        """`with_track` of a track that may be large, or be the very one that is there.

        Raises:
            ShowError: The show would be too large.
        """
        if any(other == track for other in self.tracks):
            return self
        show = self.with_track(track)
        check_size(show)
        return show

    def without_track(self, path: str) -> "Show":
        """The show without the track of a parameter.

        Raises:
            KeyNotFoundError: The show has none.
        """
        if all(track.parameter != path for track in self.tracks):
            raise KeyNotFoundError("the show has no such track", track=path)
        return replace(self, tracks=tuple(track for track in self.tracks if track.parameter != path))


def check_size(show: Show) -> None:
    """Refuse a show that is too large.

    Raises:
        ShowError: It has more than `MAX_KEYFRAMES`.
    """
    count = sum(len(track.keyframes) for track in show.tracks if isinstance(track, Track))
    if count > MAX_KEYFRAMES:
        raise ShowError(f"{count} keyframes are more than a show may have, {MAX_KEYFRAMES}", field="tracks")


def _read_markers(document: Json, location: Location) -> list[Marker]:
    markers: list[Marker] = []
    for index, entry in enumerate(location.items(document.get("markers", ()), "markers")):
        fields = location.fields(entry, ("time", "name"), what="a marker")
        if not location.text(fields, "name"):
            raise location.error("a marker has a name", f"markers/{index}/name")
        markers.append(Marker(location.number(fields, "time"), location.text(fields, "name")))
    return sorted(markers, key=lambda marker: marker.time)
