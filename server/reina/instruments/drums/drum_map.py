"""The drum map: what each key of a drum part strikes, as drum_map.toml says for each kind of kit."""

import tomllib
from collections.abc import Container, Mapping
from dataclasses import dataclass
from functools import cache
from importlib import resources
from typing import cast

from reina.instruments.drums.hit import PIECES, Technique
from reina.music.score import Score

ORCHESTRA, BRUSH = 48, 40
"""The programs of GM2's and GS's drum parts whose keys strike something else than the standard kit's."""

_BANKS = {120: "gm2", 126: "xg", 127: "xg"}
"""Kits by the coarse bank (controller 0) that asks for them."""

CLOSED_EDGE, OPEN_EDGE = 22, 26
"""What the edge of an electronic kit's hi-hat sends."""

PEDAL_CONTROLLER = 4
"""Where an electronic kit tells how far its hi-hat is closed."""


@dataclass(frozen=True)
class Strike:
    """What a key strikes.

    Attributes:
        piece: Of `PIECES`; empty if no piece of the kit makes this sound.
        zone: Where on it.
        technique: How, where it is no plain stroke.
        sound: The sound's name, where no piece makes it.
    """

    piece: str
    zone: str
    technique: Technique | None = None
    sound: str = ""


@cache
def drum_map(kit: str) -> Mapping[int, Strike]:
    """Return what each key of a kind of kit strikes.

    Args:
        kit: ``gm``, ``gm2``, ``gs``, ``orchestra``, ``brush``, ``xg`` or ``electronic``.

    Raises:
        KeyError: There is no such kind.
        ValueError: The table names a piece that the kit does not hold.
    """
    row = _tables()[kit]
    strikes = dict(drum_map(cast("str", row["like"]))) if "like" in row else {}
    for key, said in row.items():
        if key != "like":
            strikes[int(key)] = _strike(kit, key, cast("list[str]", said))
    return strikes


def strike(kit: str, key: int) -> Strike:
    """Return what a key strikes; a key that the kit's table lacks is a sound without a name."""
    return drum_map(kit).get(key) or Strike("", "", None, f"key {key}")


def kit_of(score: Score, part: int, keys: Container[int]) -> str:
    """Return which kind of kit a part of drums is written for.

    Args:
        score: The score.
        part: Index of the part.
        keys: The keys that it uses.
    """
    spoken = score.parts[part]
    controls = [control for control in score.controls if control.channel == spoken.channel]
    banks = {c.value for c in controls if c.kind == "controller" and c.number == 0}
    named = next((_BANKS[bank] for bank in sorted(banks) if bank in _BANKS), None)
    if named == "xg":
        return named
    if spoken.program in (ORCHESTRA, BRUSH):
        return "orchestra" if spoken.program == ORCHESTRA else "brush"
    has_pedal = any(c.kind == "controller" and c.number == PEDAL_CONTROLLER for c in controls)
    if CLOSED_EDGE in keys or (OPEN_EDGE in keys and has_pedal):
        return "electronic"
    if named is not None:
        return named
    # A finger snap among the other sounds below the bass drum is GS; alone the key is a hi-hat's edge.
    return "gs" if any(key in keys for key in range(27, 35)) else "gm"


@cache
def _tables() -> Mapping[str, Mapping[str, object]]:
    text = (resources.files("reina.instruments.drums") / "drum_map.toml").read_text("utf-8")
    return tomllib.loads(text)


def _strike(kit: str, key: str, said: list[str]) -> Strike:
    piece, zone, *technique = said
    if not piece:
        return Strike("", "", None, zone)
    if piece not in PIECES:
        raise ValueError(f"drum_map.toml, {kit}, key {key}: there is no piece {piece!r}")
    return Strike(piece, zone, cast("Technique", technique[0]) if technique else None)
