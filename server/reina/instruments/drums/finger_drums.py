"""From the notes of a drum part to hits: which piece, which hand or foot, how, and what cannot be mimed."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING, Final, Literal

import numpy as np

from reina.instruments.coded_column import coded
from reina.instruments.drums.chokes import find_chokes
from reina.instruments.drums.drum_map import PEDAL_CONTROLLER, drum_map, kit_of, strike
from reina.instruments.drums.drum_part import DrumFingering, Handedness
from reina.instruments.drums.feet import choose_feet
from reina.instruments.drums.hit import FEET, HANDS, PIECES, DrumHit, Limb, Technique
from reina.instruments.drums.sticking.hands import choose_hands
from reina.instruments.drums.sticking.struck import Struck
from reina.instruments.drums.sticking.written_hands import named_rudiments, written_hands
from reina.instruments.note_fingerings import StrikeFingering
from reina.music.arrays import read_only

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reina.instruments.drums.drum_map import Strike
    from reina.instruments.note_fingerings import NoteFingering
    from reina.music.arrays import FloatArray, IntArray
    from reina.music.score import Score
    from reina.music.warnings import WarningLog

LAYERED_S: Final = 0.005
LAYERED_SHARE: Final = 0.6
LAYERED_LEAST: Final = 4
"""Two keys of one piece that mostly sound together are two sounds of one stroke."""

GHOST: Final = (0.45, 0.65)
"""A stroke on the snare this soft, and this part of its usual velocity, is a ghost note."""

ACCENT: Final = 1.25
"""A stroke so many times louder than is usual on its piece is an accent."""

HALF_OPEN: Final = (32, 88)
"""Where the pedal's controller (0 open, 127 closed) leaves a hi-hat half open."""

SPLASH_S: Final = 0.18
"""A pedal that is up again so soon after it was struck has splashed the hi-hat."""

_SNARE: Final = PIECES.index("snare")


def finger_drums(
    score: Score, indices: IntArray, part: int, log: WarningLog, *, handedness: Handedness = "right"
) -> DrumFingering:
    """Give every note of a drum part its piece and its limb.

    Args:
        score: The score.
        indices: (M,) the notes, by onset.
        part: Index of the part, whose name and kit count.
        log: Is told of what is heard and not mimed.
        handedness: Which hand leads; of a left-handed player the kit and all limbs are mirrored.
    """
    notes = score.notes
    onset_s, keys = notes.onset_s[indices], notes.sounding_pitch[indices].tolist()
    velocity: FloatArray = notes.velocity[indices]
    kit = kit_of(score, part, set(keys))
    strikes = [drum_map(kit).get(key) or strike(kit, key) for key in keys]
    count = len(strikes)
    limbs: list[Limb | None] = [None] * count
    reasons = [_not_mounted(said) if not said.piece else "" for said in strikes]
    piece = np.array([PIECES.index(said.piece) if said.piece else -1 for said in strikes], dtype=np.int64)
    beat = np.array([place.beat for place in score.metre_map.positions(notes.onset_beats[indices])])
    technique: list[Technique | None] = [said.technique for said in strikes]
    one_with = _layers(onset_s, piece, keys, velocity)

    is_foot = np.array(
        [said.piece == "kick" or said.technique == "chick" for said in strikes], dtype=np.bool_
    )
    stroke = (piece >= 0) & (one_with < 0)
    kicks = np.flatnonzero(stroke & is_foot & (piece == PIECES.index("kick")))
    pedals = np.flatnonzero(stroke & is_foot & (piece != PIECES.index("kick")))
    hand_hits = np.flatnonzero(stroke & ~is_foot)

    feet = choose_feet(onset_s[kicks], beat[kicks], velocity[kicks], onset_s[pedals])
    for place, hit in enumerate(kicks.tolist()):
        side = int(feet.foot[place])
        limbs[hit], reasons[hit] = FEET[side] if side >= 0 else None, feet.reasons[place]
    for hit in pedals.tolist():
        limbs[hit], reasons[hit] = "left_foot", "left foot on the hi-hat's pedal"
    struck = Struck(
        onset_s[hand_hits],
        beat[hand_hits],
        piece[hand_hits],
        velocity[hand_hits],
        np.array([technique[hit] == "cross_stick" for hit in hand_hits.tolist()], dtype=np.bool_),
    )
    written = written_hands(score, struck.onset_s)
    hands = choose_hands(
        struck,
        onset_s[kicks],
        named=named_rudiments(score, part, struck.onset_s),
        written=[None if side is None else _mirrored(side, handedness) for side in written],
    )
    for place, hit in enumerate(hand_hits.tolist()):
        side = int(hands.hand[place])
        limbs[hit], reasons[hit] = HANDS[side] if side >= 0 else None, hands.reasons[place]
        if hands.graces.main[place] >= 0:
            technique[hit] = "drag_grace" if hands.graces.drag[place] else "flam_grace"
    for hit in np.flatnonzero(one_with >= 0).tolist():
        limbs[hit] = limbs[int(one_with[hit])]
        reasons[hit] = "one stroke with the other sound of the same piece"
    _dynamics(piece, velocity, technique)
    _pedal(score, part, onset_s, strikes, technique)
    chokes, choked = find_chokes(score, part, indices, piece, limbs)
    for hit in choked:
        technique[hit] = "choke"

    mimed: list[tuple[int, Limb]] = [
        (hit, limb) for hit, limb in enumerate(limbs) if limb is not None and one_with[hit] < 0
    ]
    hits = tuple(
        DrumHit(
            onset_s=float(onset_s[hit]),
            onset_beats=float(notes.onset_beats[indices[hit]]),
            piece=strikes[hit].piece,
            zone=strikes[hit].zone,
            limb=limb,
            velocity=float(velocity[hit]),
            technique=technique[hit],
        )
        for hit, limb in mimed
    )
    fingerings = coded(
        None if limb is None else _fingering(limb, said.piece, said.zone)
        for limb, said in zip(limbs, strikes, strict=True)
    )
    fingering = DrumFingering(
        notes=fingerings,
        playable=read_only(np.array([limb is not None for limb in limbs], dtype=np.bool_)),
        reasons=coded(reasons),
        hits=hits,
        hit_notes=tuple(hit for hit, _ in mimed),
        chokes=chokes,
        handedness="right",
    )
    if handedness == "left":
        fingering = fingering.mirrored()
    _tell(score, indices, strikes, limbs, fingering.reasons, log)
    return fingering


def _fingering(limb: Limb, piece: str, zone: str) -> NoteFingering:
    side: Literal["left", "right"] = "right" if limb.startswith("right") else "left"
    if limb.endswith("hand"):
        return StrikeFingering(hand=side, piece=piece, zone=zone)
    return StrikeFingering(foot=side, piece=piece, zone=zone)


def _mirrored(side: int, handedness: Handedness) -> int:
    return side if handedness == "right" else 1 - side


def _not_mounted(said: Strike) -> str:
    return f"the kit has no {said.sound}: it is heard and not played"


def _layers(onset_s: FloatArray, piece: IntArray, keys: list[int], velocity: FloatArray) -> IntArray:
    """Of each note the louder sound of its piece that it is one stroke with; -1 of others."""
    one_with = np.full(len(keys), -1, dtype=np.int64)
    uses = Counter(keys)
    together: list[tuple[int, int]] = []
    begin = 0
    for end in range(1, len(keys) + 1):
        if end < len(keys) and onset_s[end] - onset_s[begin] <= LAYERED_S:
            continue
        by_piece: dict[int, int] = {}
        for hit in sorted(range(begin, end), key=lambda hit: -velocity[hit]):
            if piece[hit] < 0:
                continue
            first = by_piece.setdefault(int(piece[hit]), hit)
            if first != hit:
                together.append((hit, first))
        begin = end
    pairs = Counter(frozenset((keys[a], keys[b])) for a, b in together)
    kick = PIECES.index("kick")
    for softer, louder in together:
        pair = frozenset((keys[softer], keys[louder]))
        often = pairs[pair] >= max(LAYERED_LEAST, LAYERED_SHARE * min(uses[key] for key in pair))
        if len(pair) == 1 or often or piece[softer] == kick:
            one_with[softer] = louder
    return one_with


def _dynamics(piece: IntArray, velocity: FloatArray, technique: list[Technique | None]) -> None:
    """Mark ghost notes and accents, by what is usual on each piece."""
    for struck in sorted({index for index in piece.tolist() if index >= 0}):
        own = np.flatnonzero(piece == struck)
        usual = float(np.median(velocity[own]))
        loudest = float(np.quantile(velocity[own], 0.9))
        for hit in own.tolist():
            if technique[hit] is not None or PIECES[struck] == "kick":
                continue
            if velocity[hit] >= ACCENT * usual:
                technique[hit] = "accent"
            elif struck == _SNARE and velocity[hit] <= min(GHOST[0], GHOST[1] * loudest):
                technique[hit] = "ghost"


def _pedal(
    score: Score, part: int, onset_s: FloatArray, strikes: list[Strike], technique: list[Technique | None]
) -> None:
    """What the hi-hat's pedal tells where a file has its controller: half open, and splashed by the foot."""
    channel = score.parts[part].channel
    told = [
        (control.onset_s, control.value)
        for control in score.controls
        if control.kind == "controller" and control.number == PEDAL_CONTROLLER and control.channel == channel
    ]
    if not told:
        return
    at = np.array([time for time, _ in told])
    closed = [value for _, value in told]
    for hit, said in enumerate(strikes):
        if said.piece != "hi_hat" or technique[hit] not in ("open", "closed", "chick"):
            continue
        place = int(np.searchsorted(at, float(onset_s[hit]) + 1e-3, side="right")) - 1
        if place < 0:
            continue
        if technique[hit] == "chick":
            soon = int(np.searchsorted(at, float(onset_s[hit]) + SPLASH_S)) - 1
            if soon >= place and closed[soon] < HALF_OPEN[0]:
                technique[hit] = "splash"
        elif HALF_OPEN[0] <= closed[place] <= HALF_OPEN[1]:
            technique[hit] = "half_open"


def _tell(
    score: Score,
    indices: IntArray,
    strikes: list[Strike],
    limbs: list[Limb | None],
    reasons: Sequence[str],
    log: WarningLog,
) -> None:
    """Tell of what is heard and not mimed."""
    for hit, (said, limb) in enumerate(zip(strikes, limbs, strict=True)):
        if limb is None:
            note = int(indices[hit])
            where = f"part {score.notes.part[note]}, note {note} at {score.notes.onset_s[note]:.3f} s"
            log.add("too_much_for_limbs" if said.piece else "not_in_kit", where, reasons[hit])
