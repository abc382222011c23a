"""What a timeline editor reads and need not work out: curves, the music's time, the sound's shape."""

from typing import Annotated, Any

from reina.protocol.model import RequestModel, WireModel
from reina.show.document import ShowTrack
from reina.show.model import read_later


class CurveLine(WireModel):
    """A parameter's values over the times of a `ShowCurves`."""

    values: list[list[float]]
    """A list a component, each as long as `times_s`: colours linear sRGB, choices indices, as in frames."""
    jumps: list[int]
    """Indices i where the value jumps between `times_s[i - 1]` and `times_s[i]`; a line is broken there."""


class ShowCurve(WireModel):
    """One parameter's curve, whether its track is muted or not."""

    parameter: str
    etag: str
    """The `ETag` of the track that it was sampled from; `"none"` where there is none, and of a preview."""
    keys_s: list[float]
    """Song time of each of the track's keyframes, in their order, those out of sight included."""
    keys: CurveLine
    """What the keyframes alone say; the default where there are none."""
    with_events: CurveLine | None
    """What comes of it with the track's answer to events, where it has one."""


class ShowCurves(WireModel):
    """Curves of parameters, sampled at the same times."""

    times_s: list[float]
    curves: list[ShowCurve]
    """In the order in which they were asked for."""


class CurvePreview(RequestModel):
    """A track whose curve is asked for; it is not kept."""

    track: Annotated[dict[str, Any], read_later(ShowTrack)]
    """As a show has it, with its `parameter`; times without a unit of their own are in the show's."""


class TimeKnots(WireModel):
    """Places of the music's time in all three units: between two, and beyond both ends, it runs straight."""

    seconds: list[float]
    beats: list[float]
    bars: list[float]


class MusicTime(WireModel):
    """The music's time, for rulers, snapping, and the time of a key in its track's unit."""

    duration_s: float
    knots: TimeKnots
    beats_s: list[float]
    """Every beat (quarter note) of the score."""
    bars_s: list[float]
    """Every bar line of the score."""
    onsets_s: list[float]
    """Every onset of a note that the player plays, each once."""


class SongPeaks(WireModel):
    """The shape of a song's sound: its lowest and highest sample, all channels together, by stretches."""

    duration_s: float
    """The song's length, which all stretches together fill evenly."""
    lowest: list[float]
    """-1..1, a number a stretch."""
    highest: list[float]
    """-1..1."""
    complete: bool
    """False while the song is being rendered: what is missing stands as silence, and comes."""
