"""What a brass player does: valves, breath, air, tongue, phrasing, vibrato, horn up and down.

Every gesture is planned once, as movements on the time axis; a performance only evaluates them. Values are
unit-free: what a full breath or a full lean looks like on a body is the body's to say.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from reina.instruments.brass.fingering import brass_fingering
from reina.instruments.brass.strokes import plan_strokes
from reina.instruments.player.phrasing import (
    Phrases,
    in_order,
    movements,
    phrases_of,
    plan_breath,
    plan_phrasing,
)
from reina.music.notes import UNSAID

if TYPE_CHECKING:
    from reina.instruments.played import PlayedPart
    from reina.kinematics import Curve
    from reina.rotations.arrays import FloatArray

LOWERING_REST_S = 6.0
"""In rests of at least this length the instrument is taken down."""

LOWER_AFTER_S = 1.0
LOWER_S = 1.2
RAISE_S = 1.1
RAISED_BEFORE_S = 0.8
"""The instrument is back at the lips this long before the next note."""

VIBRATO_NOTE_S = 0.7
"""Notes of at least this length are given vibrato."""

TONGUED_REST_S = 0.015
"""Notes of different pitch with less than this between them are slurred."""

LARGEST_SLIDE_SHARE = 0.6
"""Part of the time between two onsets that the slide may take to move, at most."""


def plan_gestures(played: PlayedPart, *, middle_pitch: float, seed: int = 0) -> dict[str, Curve]:
    """Plan everything that the player does.

    Args:
        played: The line and its fingering.
        middle_pitch: The pitch that asks for neither much nor little effort, MIDI number as it sounds.
        seed: Varies what no score says: how far a phrase leans and to which side.

    Returns:
        Curves by name. ``valve/n`` and ``lift/n`` as `plan_strokes`; ``slide/3``; ``raised`` 1 with the
        horn at the lips; ``air`` how hard it blows; ``tongue`` 1 as a note is tongued; ``vibrato`` 1 at its
        widest; and what `plan_phrasing` and `plan_breath` give.
    """
    curves: dict[str, Curve] = {name: (table, 0.0) for name, table in plan_strokes(played).items()}
    phrases = phrases_of(played)
    lowered_first = len(phrases.start_s) == 0 or phrases.start_s[0] > LOWERING_REST_S
    curves |= plan_phrasing(played, phrases, middle_pitch=middle_pitch, seed=seed) | plan_breath(phrases)
    curves |= {
        "slide/3": (_slide(played), 0.0),
        "raised": (_raised(phrases), 0.0 if lowered_first else 1.0),
        "air": (_air(played, phrases), 0.0),
        "tongue": (_tongue(played), 0.0),
        "vibrato": (_vibrato(played), 0.0),
    }
    return curves


def _raised(phrases: Phrases) -> FloatArray:
    """Down in long rests, at the beginning where the first note is far, and after the last."""
    lower = phrases.rest_after_s >= LOWERING_REST_S
    raise_ = (phrases.rest_before_s >= LOWERING_REST_S) & (phrases.start_s > LOWERING_REST_S)
    down, up = phrases.end_s[lower] + LOWER_AFTER_S, phrases.start_s[raise_] - RAISED_BEFORE_S
    return in_order([movements(down, LOWER_S, 0.0), movements(up - RAISE_S, RAISE_S, 1.0)])


def _air(played: PlayedPart, phrases: Phrases) -> FloatArray:
    """Rises to each note's loudness just before it, slackens in short rests, ends with the phrase."""
    sounding = played.fingering.playable
    onset, end = played.line.onset_s[sounding], played.line.end_s[sounding]
    attack = np.minimum(0.05, 0.4 * np.diff(onset, prepend=-np.inf))
    strength = 0.35 + 0.65 * played.line.velocity[sounding]
    slack = end[:-1][onset[1:] - end[:-1] > 0.2]
    slack = slack[~np.isin(slack, phrases.end_s)]
    return in_order(
        [
            movements(onset - attack, attack, strength),
            movements(slack, 0.1, 0.2),
            movements(phrases.end_s, 0.12, 0.0),
        ]
    )


def _tongue(played: PlayedPart) -> FloatArray:
    """A touch before each tongued note; double tonguing is too quick to be seen and left out."""
    line = played.line
    interval = np.diff(line.onset_s, prepend=-np.inf)
    rest = line.onset_s - np.concatenate([[-np.inf], line.end_s[:-1]])
    same = np.concatenate([[False], line.sounding_pitch[1:] == line.sounding_pitch[:-1]])
    following = np.concatenate([interval[1:], [np.inf]])
    room = np.minimum(interval, following) > 0.11
    # Where the score has slurs they say it; else a gap before the note does.
    begun = same | (rest > TONGUED_REST_S)
    if line.tongued is not None:
        begun = np.where(line.tongued == UNSAID, begun, line.tongued == 1)
    tongued = played.fingering.playable & room & begun
    onset = line.onset_s[tongued]
    return in_order([movements(onset - 0.045, 0.035, 1.0), movements(onset - 0.005, 0.05, 0.0)])


def _vibrato(played: PlayedPart) -> FloatArray:
    line = played.line
    length = line.end_s - line.onset_s
    long = played.fingering.playable & (length >= VIBRATO_NOTE_S)
    onset, end, length = line.onset_s[long], line.end_s[long], length[long]
    rise = np.minimum(0.5, 0.35 * length)
    return in_order(
        [movements(onset + 0.3 * np.minimum(length, 1.2), rise, 1.0), movements(end - 0.12, 0.12, 0.0)]
    )


def _slide(played: PlayedPart) -> FloatArray:
    """The third slide is out for the notes that ask for it, moved in the time before them."""
    line, slide = played.line, np.array(brass_fingering(played).slide)
    before = np.concatenate([[0.0], slide[:-1]])
    moves = slide != before
    interval = np.diff(line.onset_s, prepend=-np.inf)
    duration = np.minimum(0.14, LARGEST_SLIDE_SHARE * interval)[moves]
    return np.column_stack([line.onset_s[moves] - duration, line.onset_s[moves], slide[moves]])
