"""What a score itself says of the hands: R and L under the notes, and rudiments by name."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from reina.instruments.drums.sticking.figures import named_rudiment
from reina.instruments.drums.sticking.habits import LEFT, RIGHT

if TYPE_CHECKING:
    from reina.instruments.drums.sticking.figures import Rudiment
    from reina.music.score import Score
    from reina.rotations.arrays import FloatArray

SIGNS: Final = {
    "r": RIGHT,
    "l": LEFT,
    "right": RIGHT,
    "left": LEFT,
    "rh": RIGHT,
    "lh": LEFT,
    "d": RIGHT,
    "g": LEFT,
}
"""How a hand is written, in English and in French (droite, gauche)."""

SAME_S: Final = 0.005

LEAST_SIGNS: Final = 4
"""So many signs make a sticking; a syllable that is one letter is none."""

LEAST_SHARE: Final = 0.9
"""The part of a kind of texts that has to be signs for them to be a sticking."""


def written_hands(score: Score, onset_s: FloatArray) -> list[int | None]:
    """Return the hand that stands at each of N onsets, 0 right or 1 left; [] if the score has no sticking."""
    for kind in ("lyric", "text"):
        texts = [text for text in score.texts if text.kind == kind and text.text.strip()]
        signs = [(text.onset_s, SIGNS.get(text.text.strip().casefold().strip("-_"))) for text in texts]
        told = [(at, sign) for at, sign in signs if sign is not None]
        if len(told) < LEAST_SIGNS or len(told) < LEAST_SHARE * len(texts):
            continue
        at = np.array([at for at, _ in told])
        nearest = np.clip(np.searchsorted(at, onset_s - SAME_S), 0, len(at) - 1)
        is_there = np.abs(at[nearest] - onset_s) <= SAME_S
        return [
            told[place][1] if there else None
            for place, there in zip(nearest.tolist(), is_there.tolist(), strict=True)
        ]
    return []


def named_rudiments(score: Score, part: int, onset_s: FloatArray) -> list[Rudiment | None]:
    """Return the rudiment that each of N onsets is named after; [] if none is.

    A marker or a text names what follows it, up to the next; a part's name, or the title, all of it.
    """
    whole = named_rudiment(score.parts[part].name) or named_rudiment(score.title)
    marks = [text for text in score.texts if text.kind != "lyric"]
    if not any(named_rudiment(mark.text) for mark in marks):
        return [whole] * len(onset_s) if whole is not None else []
    at = np.array([mark.onset_s for mark in marks])
    place = np.searchsorted(at, onset_s + SAME_S, side="right") - 1
    rudiments = [named_rudiment(mark.text) for mark in marks]
    return [rudiments[index] if index >= 0 else whole for index in place.tolist()]
