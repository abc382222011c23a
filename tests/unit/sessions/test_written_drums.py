"""A drummer's part as the wire tells it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from tests.unit.notation.drum_tabs import Hit, drum_score, tab

from reina.sessions.written_drums import written_drum_part

if TYPE_CHECKING:
    from reina.protocol.written_part import WrittenPart


def part_of(hits: list[Hit]) -> WrittenPart:
    return written_drum_part(
        drum_score(),
        hits,
        note_index=[10 + number for number in range(len(hits))],
        reasons=[f"why {number}" for number in range(len(hits))],
        title="Beat",
        part_name="Drums",
        player=1,
        instrument="drum_kit",
        instrument_title="drum kit",
    )


BEAT = {"hi_hat R": "x-x-x-x-", "snare L": "----X-g-", "kick k": "x-------"}


def test_two_voices_their_heads_and_the_notes_that_they_stand_for() -> None:
    part = part_of(tab(BEAT))
    assert (part.clef, part.written_above_sounding, part.keys, part.player) == ("percussion", 0, [], 1)
    (measure,) = part.measures
    voices = {voice: [e for e in measure.entries if e.voice == voice] for voice in ("hands", "feet")}
    assert {name: sum(entry.ticks for entry in voice) for name, voice in voices.items()} == {
        "hands": 192,
        "feet": 192,
    }
    snare, hat = voices["hands"][2].heads
    assert [(head.letter, head.octave, head.shape, head.mark, head.hand) for head in (snare, hat)] == [
        ("C", 5, "plain", "accent", "L"),
        ("G", 5, "cross", None, "R"),
    ]
    assert voices["hands"][2].note == hat.note
    assert voices["hands"][3].heads[0].is_ghost
    assert [part.notes[head.note].piece for head in (snare, hat)] == ["snare", "hi_hat"]
    assert [part.notes[head.note].limb for head in (snare, hat)] == ["left_hand", "right_hand"]
    assert part.notes[hat.note].written_name == "hi-hat"
    assert [note.index for note in part.notes] == [10 + number for number in range(len(part.notes))]
    assert all(entry.heads == [] for entry in voices["feet"] if entry.note is None)


def test_hits_light_up_together_until_the_next_ones() -> None:
    part = part_of(tab(BEAT))
    spans = [(note.onset_s, round(note.end_s, 6)) for note in part.notes]
    assert spans == sorted(spans)
    assert {end for onset, end in spans if onset == 0.0} == {0.25}
    assert spans[-1] == (0.75, 1.15)


def test_a_flam_is_a_grace_note_with_its_own_head_and_hand() -> None:
    flam = Hit(0.47, 0.94, "snare", "centre", "left_hand", technique="flam_grace")
    part = part_of([flam, Hit(0.5, 1.0, "snare", "centre", "right_hand")])
    (entry,) = [entry for entry in part.measures[0].entries if entry.note is not None]
    (grace,) = entry.graces
    assert grace.note == 0
    assert grace.head is not None
    assert (grace.head.hand, grace.written.letter, entry.heads[0].hand) == ("L", "C", "R")


def test_bars_without_a_hit_are_joined() -> None:
    hits = [Hit(at, 2 * at, "kick", "centre", "right_foot") for at in (0.0, 8.0)]
    assert [(measure.number, measure.bars) for measure in part_of(hits).measures] == [(1, 1), (2, 3), (5, 1)]


def test_no_hits_are_a_bar_of_rest() -> None:
    part = part_of([])
    assert [entry.is_bar_rest for measure in part.measures for entry in measure.entries] == [True]
    assert part.notes == []
