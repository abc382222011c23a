"""A part alone, without it, and everything higher or lower, by the plan."""

from __future__ import annotations

import numpy as np
import pytest
from tests.unit.sound.material import Row, a_part, a_score

from reina.errors import InputError
from reina.sound.hearing import Hearing, heard_notes, only_heard
from reina.sound.passages import cut_into_passages
from reina.sound.plan import PlayedParts, plan_sound

PARTS = [a_part(0), a_part(1, "Organ", 19, channel=1), a_part(2, "Drums", is_drums=True), a_part(3, "Tacet")]
ROWS: list[Row] = [
    (1, 0.0, 1.0, 48, 0.5),
    (0, 0.5, 0.5, 60, 0.8),
    # The same key again while it sounds, and twice at once: the plan has them once each.
    (0, 0.8, 0.5, 60, 0.8),
    (0, 0.8, 0.2, 60, 0.4),
    (2, 1.0, 0.1, 38, 0.9),
    (1, 14.0, 1.0, 50, 0.5),
    (0, 30.0, 1.0, 62, 0.5),
]


def test_every_note_of_a_plan_is_known_by_its_part() -> None:
    plan = plan_sound(a_score(ROWS, PARTS))
    keys = plan.notes["key"].astype(int).tolist()
    assert dict(zip(keys, plan.parts.tolist(), strict=True)) == {48: 1, 60: 0, 38: 2, 50: 1, 62: 0}
    assert len(plan.notes) == len(ROWS) - 1


@pytest.mark.parametrize("parts", [(0,), (1, 2), (3,)])
def test_a_part_and_the_rest_are_the_whole_in_the_same_passages(parts: tuple[int, ...]) -> None:
    plan = plan_sound(a_score(ROWS, PARTS))
    passages = cut_into_passages(plan)
    part, rest = (heard_notes(plan, parts, stem) for stem in ("part", "rest"))
    assert np.array_equal(part, ~rest)
    assert set(plan.parts[part].tolist()) <= set(parts)
    found = [only_heard(passages, heard) for heard in (part, rest)]
    for share in found:
        assert all(len(one.notes) for one in share)
        assert {(one.start, one.end, one.length) for one in share} <= {
            (one.start, one.end, one.length) for one in passages
        }
    notes = sorted(note for share in found for one in share for note in one.notes.tolist())
    assert notes == list(range(len(plan.notes)))


def test_all_but_the_drums_is_moved() -> None:
    score = a_score(ROWS, PARTS)
    played = [PlayedParts((0,), transposition=-12)]
    before, after = plan_sound(score, played), plan_sound(score, played, transposition=3)
    moved = after.notes["key"].astype(int) - before.notes["key"].astype(int)
    assert moved.tolist() == [0 if part == 2 else 3 for part in before.parts.tolist()]
    assert np.array_equal(before.controls, after.controls)
    assert plan_sound(score, played, transposition=0).digest() == before.digest()


def test_what_is_moved_beyond_all_pitches_is_refused_in_words() -> None:
    with pytest.raises(InputError, match="moved by 12 semitones"):
        plan_sound(a_score([(0, 0.0, 1.0, 120, 0.5)]), [PlayedParts((0,))], transposition=12)


def test_only_the_whole_at_its_pitch_is_the_whole() -> None:
    assert Hearing().is_whole
    assert not Hearing("rest").is_whole
    assert not Hearing(transposition=1).is_whole
