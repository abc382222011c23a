"""Writes a show for a piece from its form: ordinary keyframes, which a person can go on from.

Deterministic: the same form gives the same show. Times are in bars, so that it follows the tempo.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

from reina.keyframes.interpolation import BUILT_IN
from reina.keyframes.keyframe import Keyframe
from reina.keyframes.music_form import MusicForm, Passage, passages
from reina.keyframes.shots import SHOTS, Pose
from reina.keyframes.show import Marker, Show
from reina.keyframes.track import Track

REST_BEFORE_CUT = 0.02
"""How long before a cut a move is over, in bars."""


@dataclass(frozen=True)
class Piece:
    """What a passage is compared with: the means of all passages, weighted by their bars."""

    notes_per_second: float
    loudness: float
    height: float

    @classmethod
    def of(cls, all_passages: Sequence[Passage]) -> "Piece":
        """The means of passages, one at least."""
        bars = sum(passage.end_bar - passage.start_bar for passage in all_passages)

        def mean(value: Callable[[Passage], float]) -> float:
            return sum(value(p) * (p.end_bar - p.start_bar) for p in all_passages) / bars

        return cls(mean(lambda p: p.notes_per_second), mean(lambda p: p.loudness), mean(lambda p: p.height))


@dataclass(frozen=True)
class Choice:
    """When a shot is chosen.

    Attributes:
        shot: A name of `SHOTS`.
        name: What the marker says.
        suits: Whether a passage of a piece asks for it.
    """

    shot: str
    name: str
    suits: Callable[[Passage, Piece], bool]


CHOICES = (
    Choice("room", "Rest", lambda p, _: p.sounding < 0.25),
    Choice("fingers", "Fast", lambda p, piece: p.notes_per_second >= max(3.5, 1.15 * piece.notes_per_second)),
    Choice("low", "Loud", lambda p, piece: p.loudness >= piece.loudness + 0.05),
    Choice("portrait", "High", lambda p, piece: p.height >= piece.height + 2.5),
    Choice("profile", "Soft", lambda p, piece: p.loudness <= piece.loudness - 0.05),
)
"""The first that suits is taken, unless the passage before had the same shot."""

IN_TURN = ("figure", "portrait", "profile", "fingers", "low")
"""What is shown where nothing asks for something else, or asks for the same again."""

COLORS = (("#D9A441", "#FFE3A6"), ("#4C6A9A", "#CFE0FF"), ("#E2B866", "#FFF0C9"), ("#8C7BA8", "#EBDDFF"))
"""The note blocks' colour, and that of the note that sounds, phrase by phrase."""


def write_default_show(form: MusicForm, *, title: str = "") -> Show:
    """A show for a piece.

    It cuts on bar lines by phrase, comes close to the valves in fast passages, and lights by loudness.

    Args:
        form: The piece.
        title: What to call the show.
    """
    found = passages(form)
    piece = Piece.of(found)
    shots = _choose(found, piece)
    tracks = [*_camera(found, [shot for shot, _ in shots]), *_colors(found), *_lights(found, piece)]
    markers = tuple(Marker(float(p.start_bar), name) for p, (_, name) in zip(found, shots, strict=True))
    return Show(tuple(tracks), title=title, time="bars", markers=markers)


def _choose(found: Sequence[Passage], piece: Piece) -> list[tuple[str, str]]:
    """Each passage's shot, and why."""
    chosen: list[tuple[str, str]] = []
    turn = 0
    for index, passage in enumerate(found):
        last = chosen[-1][0] if chosen else None
        name = "Beginning" if index == 0 else "End" if index == len(found) - 1 else f"Phrase {passage.phrase}"
        shot = "room" if index == 0 and len(found) > 1 else None
        for choice in CHOICES:
            if shot is None and choice.suits(passage, piece):
                shot, name = choice.shot, choice.name
        while shot is None or shot == last:
            shot = IN_TURN[turn % len(IN_TURN)]
            turn += 1
        chosen.append((shot, name))
    return chosen


def _camera(found: Sequence[Passage], shots: Sequence[str]) -> list[Track]:
    lines: list[tuple[str, Callable[[Pose], Any]]] = [
        ("camera/position", lambda pose: pose.position),
        ("camera/target", lambda pose: pose.target),
        ("camera/fov", lambda pose: pose.fov),
    ]
    tracks: list[Track] = []
    for path, part in lines:
        keyframes: list[Keyframe[Any]] = []
        for passage, name in zip(found, shots, strict=True):
            shot = SHOTS[name]
            keyframes.append(Keyframe(float(passage.start_bar), part(shot.start)))
            if part(shot.end) != part(shot.start):
                end = passage.end_bar - REST_BEFORE_CUT
                keyframes.append(BUILT_IN["sine_in_out"](end, part(shot.end)))
        tracks.append(_track(path, keyframes))
    return tracks


def _colors(found: Sequence[Passage]) -> list[Track]:
    """The blocks' colours: each phrase has its own, reached in the bar before it begins.

    A piece of one phrase changes them passage by passage.
    """
    one_phrase = len({passage.phrase for passage in found}) < 2
    turns = [index if one_phrase else max(passage.phrase - 1, 0) for index, passage in enumerate(found)]
    tracks: list[Track] = []
    for path, column in (("blocks/color", 0), ("blocks/sounding_color", 1)):
        colors = [COLORS[turn % len(COLORS)][column] for turn in turns]
        keyframes: list[Keyframe[Any]] = [Keyframe(float(found[0].start_bar), colors[0])]
        for passage, (before, color) in zip(found[1:], pairwise(colors), strict=True):
            if color == before:
                continue
            if passage.start_bar - 1.0 > keyframes[-1].time:
                keyframes.append(Keyframe(passage.start_bar - 1.0, before))
            keyframes.append(BUILT_IN["sine_in_out"](float(passage.start_bar), color))
        tracks.append(_track(path, keyframes))
    return tracks


def _lights(found: Sequence[Passage], piece: Piece) -> list[Track]:
    """Light by phrase: the louder, the more sun; the higher, the more light from behind."""

    def line(path: str, least: float, greatest: float, value: Callable[[Passage], float]) -> Track:
        keyframes = [
            BUILT_IN["clamped"](float(p.start_bar), round(min(max(value(p), least), greatest), 3))
            for p in found
        ]
        return _track(path, keyframes)

    return [
        line("lights/key/intensity", 2.4, 4.2, lambda p: 3.2 + 6.0 * (p.loudness - piece.loudness)),
        line("lights/fill/intensity", 0.4, 0.9, lambda p: 0.55 - 2.0 * (p.loudness - piece.loudness)),
        line("lights/rim/intensity", 1.6, 3.4, lambda p: 2.2 + 0.15 * (p.height - piece.height)),
        line("blocks/glow", 0.9, 2.4, lambda p: 1.3 + 4.0 * (p.loudness - piece.loudness)),
    ]


def _track(path: str, keyframes: Sequence[Keyframe[Any]]) -> Track:
    named = [
        type(keyframe)(keyframe.time, keyframe.value, f"k{number}")
        for number, keyframe in enumerate(keyframes, start=1)
    ]
    return Track(path, tuple(named), time="bars")
