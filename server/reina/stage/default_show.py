"""Writes a show for a piece from its form: ordinary keyframes, which a person can go on from.

Deterministic: the same form gives the same show. Times are in bars, so that it follows the tempo.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

from reina.curves.interpolation import BUILT_IN
from reina.curves.keyframe import Keyframe
from reina.show.document import Marker
from reina.show.show import Show
from reina.show.track import Track
from reina.stage.cast_form import CastForm, leads_of
from reina.stage.cast_lights import SideSpot, side_spots
from reina.stage.cast_shots import cast_shot
from reina.stage.music_form import MusicForm, Passage, passages
from reina.stage.shot_choice import ALONE, TOGETHER, WITH_DRUMS, Piece, choose_shots
from reina.stage.shots import SHOTS, Pose, Shot

REST_BEFORE_CUT = 0.02
"""How long before a cut a move is over, in bars."""


@dataclass(frozen=True)
class Mood:
    """The light and the colours of a phrase.

    Attributes:
        block: Colour of the notes to come.
        sounding: Colour of the note that sounds.
        colors: Colours of lights by their parameters.
        levels: Strengths of lights by their parameters, where the phrase is as loud as the piece.
    """

    block: str
    sounding: str
    colors: dict[str, str]
    levels: dict[str, float]


def _mood(block: str, sounding: str, **lights: tuple[str | None, float]) -> Mood:
    """Each light's colour and strength."""
    return Mood(
        block,
        sounding,
        {f"lights/{name}/color": color for name, (color, _) in lights.items() if color is not None},
        {f"lights/{name}/intensity": level for name, (_, level) in lights.items()},
    )


MOODS = (
    _mood(
        "#D9A441",
        "#FFE3A6",
        key=("#FFDFBE", 3.2),
        fill=("#9FB6DC", 0.55),
        rim=("#FFE6C4", 2.2),
        back_wash=("#B8742E", 0.5),
        environment=(None, 0.66),
    ),
    _mood(
        "#4C6A9A",
        "#CFE0FF",
        key=("#D8E2FF", 2.5),
        fill=("#6E8FD6", 0.8),
        rim=("#A9C4FF", 3.6),
        back_wash=("#2A55B8", 2.6),
        environment=(None, 0.4),
    ),
    _mood(
        "#E2B866",
        "#FFF0C9",
        key=("#FFBE80", 3.6),
        fill=("#B49AD0", 0.5),
        rim=("#FFD9A0", 3.0),
        back_wash=("#C8641E", 1.8),
        environment=(None, 0.48),
    ),
    _mood(
        "#8C7BA8",
        "#EBDDFF",
        key=("#FFC9B8", 2.7),
        fill=("#8C86D0", 0.7),
        rim=("#E6BCEC", 3.4),
        back_wash=("#5B3F96", 1.7),
        environment=(None, 0.42),
    ),
)
"""Phrase by phrase."""

LOUDER: dict[str, float] = {
    "lights/key/intensity": 6.0,
    "lights/fill/intensity": -2.0,
    "lights/rim/intensity": 2.0,
    "lights/back_wash/intensity": 3.0,
    "lights/environment/intensity": 0.5,
}
"""What is added to a light for each unit of loudness beyond the piece's."""

HIGHER = 0.15
"""What is added to the light from behind for each semitone beyond the piece's mean."""

LEAST, GREATEST = 0.12, 5.0
"""No light of a mood is weaker or stronger."""


def write_default_show(form: MusicForm, *, title: str = "", cast: CastForm | None = None) -> Show:
    """A show for a piece.

    It cuts on bar lines by phrase, comes close to the valves in fast passages, and lights by loudness. Of a
    cast it sees everybody, or who has the tune, and each side of the stage has a spot of its own.

    Args:
        form: The piece; of a cast the tune, whoever has it.
        title: What to call the show.
        cast: Where several players stand, and who has the tune; None of one player.
    """
    found = passages(form)
    piece = Piece.of(found)
    if cast is None:
        chosen = choose_shots(found, piece, ALONE)
        shots = [SHOTS[name] for name, _ in chosen]
        spots: list[Track] = []
    else:
        at_drums = {place.at_drums for place in cast.places}
        chosen = choose_shots(found, piece, WITH_DRUMS if len(at_drums) > 1 else TOGETHER)
        leads = leads_of(form, found, cast)
        shots = [cast_shot(name, lead, cast.places) for (name, _), lead in zip(chosen, leads, strict=True)]
        spots = _spots(found, side_spots(leads, cast.places))
    tracks = [*_camera(found, shots), *_colors(found), *_lights(found, piece), *spots]
    markers = tuple(Marker(time=p.start_bar, name=name) for p, (_, name) in zip(found, chosen, strict=True))
    return Show(tuple(tracks), title=title, time="bars", markers=markers)


def _camera(found: Sequence[Passage], shots: Sequence[Shot]) -> list[Track]:
    lines: list[tuple[str, Callable[[Pose], Any]]] = [
        ("camera/position", lambda pose: pose.position),
        ("camera/target", lambda pose: pose.target),
        ("camera/fov", lambda pose: pose.fov),
    ]
    tracks: list[Track] = []
    for path, part in lines:
        keyframes: list[Keyframe[Any]] = []
        for passage, shot in zip(found, shots, strict=True):
            keyframes.append(Keyframe(float(passage.start_bar), part(shot.start)))
            if part(shot.end) != part(shot.start):
                end = passage.end_bar - REST_BEFORE_CUT
                keyframes.append(BUILT_IN["sine_in_out"](end, part(shot.end)))
        tracks.append(_track(path, keyframes))
    return tracks


def _moods(found: Sequence[Passage]) -> list[Mood]:
    """Each passage's mood: its phrase's, or its own in a piece of one phrase."""
    one_phrase = len({passage.phrase for passage in found}) < 2
    turns = [index if one_phrase else max(passage.phrase - 1, 0) for index, passage in enumerate(found)]
    return [MOODS[turn % len(MOODS)] for turn in turns]


def _colors(found: Sequence[Passage]) -> list[Track]:
    moods = _moods(found)
    return [
        _changes("blocks/color", found, [mood.block for mood in moods]),
        _changes("blocks/sounding_color", found, [mood.sounding for mood in moods]),
    ]


def _lights(found: Sequence[Passage], piece: Piece) -> list[Track]:
    """Light by phrase: the louder, the more of it; the higher, the more from behind."""
    moods = _moods(found)

    def level(path: str, passage: Passage, mood: Mood) -> float:
        value = mood.levels[path] + LOUDER[path] * (passage.loudness - piece.loudness)
        if path == "lights/rim/intensity":
            value += HIGHER * (passage.height - piece.height)
        return round(min(max(value, LEAST), GREATEST), 3)

    glow = [round(min(max(1.3 + 4.0 * (p.loudness - piece.loudness), 0.9), 2.4), 3) for p in found]
    return [
        *(
            _changes(path, found, [level(path, p, mood) for p, mood in zip(found, moods, strict=True)])
            for path in LOUDER
        ),
        *(_changes(path, found, [mood.colors[path] for mood in moods]) for path in MOODS[0].colors),
        _changes("blocks/glow", found, glow),
    ]


def _spots(found: Sequence[Passage], spots: Sequence[SideSpot]) -> list[Track]:
    """Each side's spot rests on its players, and changes with who has the tune."""
    tracks: list[Track] = []
    for spot in spots:
        path = f"lights/spots/{spot.number}"
        tracks += [
            _track(f"{path}/target", [Keyframe(0.0, spot.target)]),
            _track(f"{path}/angle", [Keyframe(0.0, spot.angle)]),
            _changes(f"{path}/intensity", found, spot.levels),
        ]
    return tracks


def _changes(path: str, found: Sequence[Passage], values: Sequence[Any]) -> Track:
    """A value a passage, each reached in the bar before it begins."""
    keyframes: list[Keyframe[Any]] = [Keyframe(float(found[0].start_bar), values[0])]
    for passage, (before, value) in zip(found[1:], pairwise(values), strict=True):
        if value == before:
            continue
        if passage.start_bar - 1.0 > keyframes[-1].time:
            keyframes.append(Keyframe(passage.start_bar - 1.0, before))
        keyframes.append(BUILT_IN["sine_in_out"](float(passage.start_bar), value))
    return _track(path, keyframes)


def _track(path: str, keyframes: Sequence[Keyframe[Any]]) -> Track:
    named = [
        type(keyframe)(keyframe.time, keyframe.value, f"k{number}")
        for number, keyframe in enumerate(keyframes, start=1)
    ]
    return Track(path, tuple(named), time="bars")
