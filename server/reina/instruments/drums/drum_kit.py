"""The drum kit as an instrument: it chooses the part of drums and gives every note a piece and a limb."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from typing import TYPE_CHECKING, Final

import numpy as np

from reina.instruments.drums.body import KIT, STICKS, DrumsBody
from reina.instruments.drums.drum_map import drum_map, kit_of
from reina.instruments.drums.drum_part import DrumPart, Handedness, mirrored_part
from reina.instruments.drums.finger_drums import finger_drums
from reina.instruments.drums.hit import PIECES
from reina.instruments.drums.motion.kit_pose import PARAMETERS
from reina.instruments.instrument import Instrument
from reina.instruments.joined_parts import check_parts, notes_of_parts
from reina.instruments.line import BREATH_S
from reina.instruments.played import Line
from reina.instruments.player.mirrored_body import MirroredBody
from reina.instruments.player.phrasing import phrases_of, plan_breath, plan_phrasing
from reina.instruments.ranking import PartRanking, Suitability, rank_parts
from reina.music.arrays import read_only
from reina.music.warnings import WarningLog

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from reina.instruments.played import PlayedPart
    from reina.instruments.player.engagement import Engagement
    from reina.instruments.player.instrument_body import InstrumentBody
    from reina.kinematics import Curve, MotionCurves
    from reina.music.arrays import IntArray
    from reina.music.score import Score

SUITABILITY: Final = Suitability(programs={}, names={}, lowest=0, highest=127, drums=12.0)
"""A part of drums goes before every other, whatever it is called."""

NO_DRUMS: Final = -12.0
"""What speaks against a part whose pitches are tones."""

MIDDLE_KEY: Final = 45
"""On drums no key asks for more effort than another."""

STRUCK: Final = 4.0
"""What speaks for the part with the most notes that are struck on the kit; for others in proportion."""

MAX_TOLD: Final = 200
"""How many notes that are not mimed are told of one by one."""


class Drums(Instrument):
    """A drum kit and its player."""

    name, title, rig = "drums", "drum kit", "drumkit"
    handedness, left_handed_rig = ("right", "left"), "drumkit_left_handed"
    seat = "drums"
    plays_drums = True
    parameters = PARAMETERS
    pieces = PIECES

    @property
    def skeletons(self) -> Mapping[str, str]:
        """The kit and both sticks."""
        return {KIT: self.rig, **{stick: stick for stick in STICKS}}

    def can_play_of(self, score: Score, part: int) -> bool:
        """Return whether any of a part's notes is struck on the kit."""
        return struck_notes(score, part) > 0

    def rank_parts(self, score: Score) -> tuple[PartRanking, ...]:
        """Rank the parts of a score: drums first, and of them the one with the most notes for the kit."""
        struck = {part.index: struck_notes(score, part.index) for part in score.parts if part.is_drums}
        most = max(struck.values(), default=0)
        ranked: list[PartRanking] = []
        for ranking in rank_parts(score, SUITABILITY):
            if not score.parts[ranking.part].is_drums:
                reasons = (f"no drums ({NO_DRUMS:+.1f})", *ranking.reasons)
                ranked.append(replace(ranking, score=round(ranking.score + NO_DRUMS, 3), reasons=reasons))
                continue
            count = struck[ranking.part]
            weight = STRUCK * count / most if most else 0.0
            reasons = (*ranking.reasons, f"{count} of its notes are struck on the kit ({weight:+.1f})")
            ranked.append(replace(ranking, score=round(ranking.score + weight, 3), reasons=reasons))
        return tuple(sorted(ranked, key=lambda ranking: (-ranking.score, ranking.part)))

    def play(
        self,
        score: Score,
        part: int,
        transposition: int = 0,  # noqa: ARG002
        *,
        written: bool = False,  # noqa: ARG002
        octave_fit: bool = False,  # noqa: ARG002
        joined_parts: Sequence[int] = (),
        usual_fingerings: bool = False,  # noqa: ARG002
        handedness: str = "right",
    ) -> DrumPart:
        """As `Instrument.play`; a key is a drum and no pitch, so nothing is transposed."""
        led_by: Handedness = "left" if handedness == "left" else "right"
        return self.play_with(score, part, joined_parts=joined_parts, handedness=led_by)

    def play_with(
        self,
        score: Score,
        part: int,
        *,
        joined_parts: Sequence[int] = (),
        handedness: Handedness = "right",
    ) -> DrumPart:
        """Play a part with the right or with the left hand leading.

        Raises:
            NotInScoreError: If the score has no such part, or one of `joined_parts` cannot be joined.
        """
        joined = check_parts(score, part, joined_parts)
        indices = notes_of_parts(score, (part, *joined))
        log = WarningLog(MAX_TOLD)
        fingering = finger_drums(score, indices, part, log, handedness=handedness)
        return DrumPart(part, 0, _line(score, indices), fingering, log.warnings(), joined)

    def plan_gestures(self, played: PlayedPart, *, seed: int = 0) -> dict[str, Curve]:
        """Breath and phrasing; what hands and feet do is planned by `body`."""
        phrases = phrases_of(played)
        phrased = plan_phrasing(played, phrases, middle_pitch=MIDDLE_KEY, seed=seed)
        return {name: phrased[name] for name in ("playing", "lean", "turn")} | plan_breath(phrases)

    def body(self, engagement: Engagement, curves: MotionCurves) -> InstrumentBody:  # noqa: ARG002
        """What turns strokes into poses; who leads with the left hand is a right-hander's reflection."""
        right_handed = engagement.right_handed
        if right_handed is None:
            return DrumsBody(engagement)
        played = mirrored_part(engagement.played)
        return MirroredBody(DrumsBody(replace(right_handed, played=played)), engagement)


def struck_notes(score: Score, part: int) -> int:
    """How many notes of a part are struck on the kit."""
    return sum(_strokes(score, part).values())


def spread_parts(score: Score, part: int) -> tuple[int, ...]:
    """The other parts of the kit that a part is one of, ascending.

    A kit is often written out as a part for the bass drum, one for the snare, one for the cymbals. Each
    has keys that no other has, most of its notes on them: hand percussion has a player of its own.
    """
    taken = set(_strokes(score, part))
    others = {each.index: _strokes(score, each.index) for each in score.parts if each.is_drums}
    spread: list[int] = []
    for other in sorted(others.keys() - {part}, key=lambda other: (-others[other].total(), other)):
        strokes = others[other]
        if taken.isdisjoint(strokes) and 2 * strokes.total() > len(score.note_indices(other)):
            spread.append(other)
            taken |= strokes.keys()
    return tuple(sorted(spread))


def _strokes(score: Score, part: int) -> Counter[int]:
    """How often each key of a part is struck on the kit."""
    keys: list[int] = score.notes.sounding_pitch[score.note_indices(part)].tolist()
    kit = drum_map(kit_of(score, part, set(keys)))
    return Counter(key for key in keys if key in kit and kit[key].piece)


def _line(score: Score, indices: IntArray) -> Line:
    """All notes of a drum part: none is cut, and several are struck at once."""
    notes = score.notes
    onset_s = notes.onset_s[indices]
    rests = np.diff(onset_s, prepend=onset_s[:1]) >= 4.0 * BREATH_S
    return Line(
        note_index=read_only(indices.astype(np.int32)),
        onset_s=read_only(onset_s),
        end_s=read_only(notes.end_s[indices]),
        sounding_pitch=read_only(notes.sounding_pitch[indices].astype(np.int32)),
        velocity=read_only(notes.velocity[indices]),
        phrase=read_only(np.cumsum(rests).astype(np.int32)),
        dropped=read_only(np.zeros(0, dtype=np.int64)),
        shortened=read_only(np.zeros(0, dtype=np.int64)),
        tongued=None,
    )


DRUMS: Final = Drums()
