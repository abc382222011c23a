"""A part of drums as the instrument plays it."""

from dataclasses import replace

import numpy as np
import pytest
from tests.unit.instruments.drums.scores import drum_score, hands, played
from tests.unit.instruments.scores import score_of

from reina.instruments import StrikeFingering
from reina.instruments.drums.drum_kit import Drums
from reina.instruments.drums.drum_part import drum_fingering
from reina.music import NotInScoreError
from reina.music.controls import Control
from reina.music.texts import ScoreText

KICK, SNARE, CROSS, HAT, PEDAL, OPEN, CRASH, RIDE = 36, 38, 37, 42, 44, 46, 49, 51


def rock(bars: int = 2) -> list[tuple[float, int]]:
    """Eighths on the hi-hat, the snare on 2 and 4, the bass drum on 1 and 3, at 120."""
    strokes = [(0.25 * k, HAT) for k in range(8 * bars)]
    strokes += [(0.5 + 1.0 * k, SNARE) for k in range(2 * bars)] + [(1.0 * k, KICK) for k in range(2 * bars)]
    return sorted(strokes)


def test_drums_go_before_what_sounds_and_after_nothing() -> None:
    score = score_of([(0, 1, 60)], [(0, 1, 38)], [(0, 1, 72)], names=("Trumpet", "Kit", "Violin"), drums=1)
    ranked = Drums().rank_parts(score)
    assert next(ranking.part for ranking in ranked) == 1
    assert ranked[0].score > 0 > ranked[1].score


def test_of_two_parts_of_drums_the_one_for_the_kit_goes_first() -> None:
    congas = [(0.1 * k, 0.1 * k + 0.05, 62) for k in range(40)]
    score = score_of(congas, [(0.5 * k, 0.5 * k + 0.1, 38) for k in range(8)], drums=0)
    both = replace(score, parts=tuple(replace(part, is_drums=True) for part in score.parts))
    ranked = Drums().rank_parts(both)
    assert ranked[0].part == 1
    assert any("8 of its notes are struck on the kit" in reason for reason in ranked[0].reasons)


def test_a_rock_beat_on_the_wire() -> None:
    part = played(drum_score(rock()))
    by_key = dict(zip(part.line.sounding_pitch.tolist(), part.fingering.notes, strict=True))
    assert by_key[HAT] == StrikeFingering(hand="right", piece="hi_hat", zone="bow")
    assert by_key[SNARE] == StrikeFingering(hand="left", piece="snare", zone="centre")
    assert by_key[KICK] == StrikeFingering(foot="right", piece="kick", zone="centre")
    assert part.fingering.playable.all()
    assert not part.warnings
    reasons = dict(zip(part.line.sounding_pitch.tolist(), part.fingering.reasons, strict=True))
    assert reasons[HAT] == "right leads on the hi-hat"
    assert reasons[SNARE].startswith("left on the snare, as the right hand is on")


def test_a_left_handed_player_is_the_mirror() -> None:
    score = drum_score(rock())
    right, left = played(score), played(score, "left")
    assert hands(left) == hands(right).translate(str.maketrans("RLrl", "LRlr"))
    assert "left leads on the hi-hat" in left.fingering.reasons


def test_what_the_kit_lacks_is_told_and_not_mimed() -> None:
    part = played(drum_score([(0.0, KICK), (0.0, 54), (0.5, 70), (1.0, 70)]))
    assert hands(part) == "r---"
    assert part.fingering.notes[1] is None
    assert [warning.kind for warning in part.warnings] == ["not_in_kit"] * 3
    assert part.fingering.reasons[1] == "the kit has no tambourine: it is heard and not played"


def test_the_softest_of_what_three_hands_would_need_is_told() -> None:
    part = played(drum_score([(0.0, SNARE, 0.8), (0.0, HAT, 0.3), (0.0, CRASH, 0.9), (0.0, KICK, 0.9)]))
    assert [warning.kind for warning in part.warnings] == ["too_much_for_limbs"]
    assert part.line.sounding_pitch[~part.fingering.playable].tolist() == [HAT]


def test_two_sounds_of_one_stroke_are_one_hit() -> None:
    strokes = sorted(
        [(0.5 * k, key) for k in range(8) for key in (38, 40)] + [(0.5 * k, HAT) for k in range(8)]
    )
    part = played(drum_score(strokes))
    assert part.fingering.playable.all()
    assert len(part.fingering.hits) == 16
    assert "one stroke with the other sound of the same piece" in part.fingering.reasons


def test_two_strokes_of_one_piece_at_once_take_both_hands() -> None:
    part = played(drum_score([(0.0, 38), (0.0, 40), (0.5, 38), (1.0, 38)]))
    assert sorted(hands(part)[:2]) == ["L", "R"]


def test_techniques_by_key_and_by_velocity() -> None:
    strokes = [(0.5 * k, SNARE, 0.7) for k in range(8)] + [(4.0, SNARE, 0.2), (4.5, SNARE, 1.0), (5.0, CROSS)]
    strokes += [(5.5, OPEN), (6.0, HAT), (6.5, PEDAL)]
    said = [hit.technique for hit in played(drum_score(strokes)).fingering.hits]
    assert said[7:] == [None, "ghost", "accent", "cross_stick", "open", "closed", "chick"]


def test_the_pedals_controller_says_half_open_and_splashed() -> None:
    pedal = [
        Control("controller", at, 2 * at, 9, 4, value) for at, value in ((0.0, 60), (1.0, 127), (1.06, 0))
    ]
    part = played(drum_score([(0.2, OPEN), (1.0, PEDAL), (1.5, OPEN)], controls=pedal))
    assert [hit.technique for hit in part.fingering.hits] == ["half_open", "splash", "open"]


def test_a_crash_that_is_cut_short_among_ringing_ones_is_choked_by_a_free_hand() -> None:
    strokes = [(0.0, CRASH, 0.9, 2.0), (2.0, CRASH, 0.9, 2.0), (4.0, CRASH, 0.9, 0.3), (6.0, CRASH, 0.9, 2.0)]
    fingering = drum_fingering(played(drum_score(strokes)))
    assert [(choke.at_s, choke.piece, choke.limb) for choke in fingering.chokes] == [
        (pytest.approx(4.3), "crash_left", "left_hand")
    ]
    assert [hit.technique for hit in fingering.hits] == [None, None, "choke", None]


def test_no_hand_is_free_for_a_choke_while_both_play() -> None:
    strokes = [(2.0 * k, CRASH, 0.9, 2.0) for k in range(4)] + [(8.0, CRASH, 0.9, 0.3)]
    strokes += [(8.0 + 0.1 * k, SNARE) for k in range(1, 8)]
    assert drum_fingering(played(drum_score(sorted(strokes)))).chokes == ()


def test_one_hand_chokes_one_cymbal_at_a_time() -> None:
    press = [
        Control("key_pressure", at, 2 * at, 9, key, 127) for at, key in ((0.4, 49), (0.42, 57), (0.44, 55))
    ]
    strokes = [(0.0, 49), (0.0, 57), (0.02, 55), (3.0, 49)]
    chokes = drum_fingering(played(drum_score(strokes, controls=press))).chokes
    assert sorted(choke.limb for choke in chokes) == ["left_hand", "right_hand"]


def test_lengths_that_are_all_short_choke_nothing() -> None:
    strokes = [(2.0 * k, CRASH, 0.9, 0.1) for k in range(4)]
    assert drum_fingering(played(drum_score(strokes))).chokes == ()


def test_a_pressed_key_chokes() -> None:
    press = [Control("key_pressure", 0.4, 0.8, 9, CRASH, 127)]
    assert len(drum_fingering(played(drum_score([(0.0, CRASH), (3.0, CRASH)], controls=press))).chokes) == 1


def test_hands_that_stand_under_the_notes_are_kept() -> None:
    signs = "RLLRLRRL"
    texts = [ScoreText("lyric", 0.25 * k, 0.5 * k, sign) for k, sign in enumerate(signs)]
    part = played(drum_score([(0.25 * k, SNARE) for k in range(8)], texts=texts))
    assert hands(part) == signs
    assert part.fingering.reasons[0] == "right: so it is written"


def test_a_hand_that_is_written_is_no_rudiment_that_the_accents_suggest() -> None:
    signs = "RRLLRLLR" * 2
    texts = [ScoreText("text", 0.15 * k, 0.3 * k, sign) for k, sign in enumerate(signs)]
    part = played(drum_score([(0.15 * k, SNARE, 0.9 if k % 4 == 0 else 0.5) for k in range(16)], texts=texts))
    assert hands(part) == signs
    assert {reason.partition(": ")[2] for reason in part.fingering.reasons} == {"so it is written"}


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("Double paradiddle", "RLRLRRLRLRLL"), ("Paradiddle", "RLRRLRLLRLRR"),
        ("Double Strokes", "RRLLRRLLRRLL"),
        ("Paradiddle-diddle", "RLRRLLRLRRLL"), ("Six Stroke Roll", "RLLRRLRLLRRL"), ("Drums", "RLRLRLRLRLRL"),
    ],
)  # fmt: skip
def test_a_rudiment_that_is_named_is_played(name: str, expected: str) -> None:
    part = played(drum_score([(0.125 * k, SNARE) for k in range(12)], name=name))
    assert hands(part) == expected


def test_a_marker_names_what_follows_it() -> None:
    texts = [ScoreText("marker", 0.0, 0.0, "Singles"), ScoreText("marker", 4.0, 8.0, "Paradiddle")]
    strokes = [(0.125 * k, SNARE) for k in range(16)] + [(4.0 + 0.125 * k, SNARE) for k in range(16)]
    assert hands(played(drum_score(strokes, texts=texts))) == "RL" * 8 + "RLRRLRLL" * 2


def test_a_part_that_is_not_there_is_refused() -> None:
    with pytest.raises(NotInScoreError, match="there is no part 3"):
        Drums().play(drum_score(rock()), 3)


def test_the_line_has_every_note_and_phrases_begin_after_a_rest() -> None:
    part = played(drum_score([*rock(), (9.0, CRASH)]))
    assert len(part.line) == len(rock()) + 1
    assert part.line.phrase[-1] == 1
    assert not len(part.line.dropped)
    assert np.array_equal(part.line.onset_s, np.sort(part.line.onset_s))
