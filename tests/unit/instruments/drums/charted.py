"""Charts as the tests have them: lines of steps, with the hand of each hit."""

import json
import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from reina.instruments.drums.feet import choose_feet
from reina.instruments.drums.hit import FEET, HANDS, PIECES, DrumHit
from reina.instruments.drums.motion.kit_places import KitPlaces, ZonePlace
from reina.instruments.drums.sticking.hands import choose_hands
from reina.instruments.drums.sticking.struck import Struck

SOFT, PLAIN = 0.35, 0.7
ZONES = {
    "hi_hat": "bow",
    "ride": "bow",
    "crash_left": "edge",
    "crash_right": "edge",
    "china": "edge",
    "splash": "edge",
}
_PIECES = {"hi_hat_open": "hi_hat", "ride_bell": "ride", "cross_stick": "snare"}


@dataclass(frozen=True)
class Chart:
    """A pattern, played a number of times."""

    name: str
    struck: Struck
    kick_s: "np.ndarray[Any, np.dtype[np.float64]]"
    hands: str
    """R or L of each hit."""


def chart_of(name: str, row: dict[str, Any], *, times: int | None = None) -> Chart:
    """Read one chart."""
    steps, tempo = row["steps"], row["tempo"]
    lines = {key: line for key, line in row.items() if isinstance(line, str)}
    (length,) = {len(line) for line in lines.values()}
    repeats = times or row.get("times", 2)
    hits: list[tuple[int, int, str, float, bool]] = []
    kicks: list[int] = []
    for key, line in lines.items():
        for step, sign in enumerate(line * repeats):
            if sign == "-" or (sign == "x" and key != "kick"):
                continue
            if key == "kick":
                kicks.append(step)
                continue
            piece = PIECES.index(_PIECES.get(key, key))
            loud = SOFT if sign.islower() else PLAIN
            hits.append((step, piece, sign.upper(), loud, key == "cross_stick"))
    hits.sort()
    step = np.array([hit[0] for hit in hits], dtype=np.float64)
    step_s = 60.0 / tempo / steps
    assert length > 0
    struck = Struck(
        onset_s=step * step_s,
        beat=np.mod(step / steps, 4.0),
        piece=np.array([hit[1] for hit in hits], dtype=np.int64),
        velocity=np.array([hit[3] for hit in hits]),
        is_cross_stick=np.array([hit[4] for hit in hits], dtype=np.bool_),
    )
    return Chart(
        name, struck, np.sort(np.array(kicks, dtype=np.float64)) * step_s, "".join(hit[2] for hit in hits)
    )


def charts() -> dict[str, Chart]:
    """All charts of charts.toml."""
    table = tomllib.loads((Path(__file__).parent / "charts.toml").read_text("utf-8"))
    return {name: chart_of(name, row) for name, row in table.items()}


def kit_places() -> KitPlaces:
    """The kit that tests play: the zones of the shipped rig at rest, in the kit's frame."""
    rows = json.loads((Path(__file__).parent / "kit_places.json").read_text("utf-8"))
    return KitPlaces(
        ZonePlace(
            row["piece"],
            row["zone"],
            np.array(row["position"]),
            np.array(row["normal"]),
            row["radius"],
            np.array(row["pivot"]),
            np.array(row["axis"]),
        )
        for row in rows
    )


def hits_of(chart: Chart) -> list[DrumHit]:
    """The hits of a chart with the hands and feet that are chosen for it."""
    struck = chart.struck
    hands: list[int] = choose_hands(struck, chart.kick_s).hand.tolist()
    at: list[float] = struck.onset_s.tolist()
    pieces: list[int] = struck.piece.tolist()
    loud: list[float] = struck.velocity.tolist()
    hits = [
        DrumHit(
            at[index], at[index], PIECES[piece], ZONES.get(PIECES[piece], "centre"), HANDS[hand], loud[index]
        )
        for index, (piece, hand) in enumerate(zip(pieces, hands, strict=True))
        if hand >= 0
    ]
    kicks: list[float] = chart.kick_s.tolist()
    level = np.full(len(kicks), 0.8)
    feet: list[int] = choose_feet(chart.kick_s, np.zeros(len(kicks)), level, np.zeros(0)).foot.tolist()
    hits += [
        DrumHit(kick, kick, "kick", "centre", FEET[foot], 0.8)
        for kick, foot in zip(kicks, feet, strict=True)
        if foot >= 0
    ]
    return sorted(hits, key=lambda hit: hit.onset_s)
