"""A track made ready, whatever else the show holds."""

from dataclasses import dataclass

import numpy as np

from reina.curves.arrays import FloatArray
from reina.curves.channel import Channel
from reina.curves.channel_builder import ChannelBuilder
from reina.curves.parameter import Parameter
from reina.curves.spaces import spaces_of
from reina.show.track import Track


@dataclass(frozen=True, eq=False)
class TrackPlan:
    """A track's keyframes as channels.

    Attributes:
        track: What it was made of.
        parameter: The parameter it drives.
        channels: One after another they hold the parameter's floats; none where there are no keyframes.
    """

    track: Track
    parameter: Parameter
    channels: tuple[Channel, ...]

    @classmethod
    def make(cls, track: Track, parameter: Parameter) -> "TrackPlan":
        """Make a track ready: one channel, or three for a transform."""
        if not track.keyframes:
            return cls(track, parameter, ())
        values = parameter.rows_of_floats([keyframe.value for keyframe in track.keyframes])
        in_tangents, out_tangents = _tangents(track, parameter)
        channels: list[Channel] = []
        first = 0
        for space in spaces_of(parameter, track.color_space):
            part = slice(first, first + space.length)
            builder = ChannelBuilder(
                track.keyframes,
                values[:, part],
                space,
                in_tangents=in_tangents[:, part],
                out_tangents=out_tangents[:, part],
                before=track.before,
                after=track.after,
            )
            channels.append(builder.channel())
            first += space.length
        return cls(track, parameter, tuple(channels))


def _tangents(track: Track, parameter: Parameter) -> tuple[FloatArray, FloatArray]:
    shape = (len(track.keyframes), parameter.length)
    arriving, leaving = np.zeros(shape), np.zeros(shape)
    for index, keyframe in enumerate(track.keyframes):
        if keyframe.in_tangent is not None:
            arriving[index] = keyframe.in_tangent
        if keyframe.out_tangent is not None:
            leaving[index] = keyframe.out_tangent
    return arriving, leaving
