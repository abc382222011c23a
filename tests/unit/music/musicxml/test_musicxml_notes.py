"""MusicXML: pitches and times of notes, by golden values in seconds and MIDI numbers."""

from __future__ import annotations

import pytest
from tests.unit.music.musicxml.musicxml_text import (
    B_FLAT,
    articulations,
    attributes,
    direction,
    document,
    dynamic,
    listed,
    measure,
    measures,
    note,
    slur,
    tempo,
    tied,
    wedge,
    words,
)

from reina.music import Score, read_score


def read(data: bytes) -> Score:
    return read_score(data, filename="Test.musicxml")


def sounding(score: Score) -> list[tuple[int, float, float]]:
    """Pitch, onset and length in seconds of every note, to the microsecond."""
    return [(one.sounding_pitch, round(one.onset_s, 6), round(one.duration_s, 6)) for one in score.notes]


def velocities(score: Score) -> list[int]:
    return [round(one.velocity * 127) for one in score.notes]


def kinds(score: Score) -> list[str]:
    return [warning.kind for warning in score.warnings]


def test_quarter_notes_at_the_written_tempo() -> None:
    score = read(document(measures(attributes() + tempo(90) + note("C4") + note("F#4", 2) + note("Bb4"))))
    assert sounding(score) == [(60, 0.0, 0.666667), (66, 0.666667, 1.333333), (70, 2.0, 0.666667)]
    assert [part.name for part in score.parts] == ["Trumpet"]
    assert (score.parts[0].program, score.parts[0].is_drums) == (56, False)
    assert kinds(score) == []


def test_a_trumpet_in_b_flat_sounds_a_tone_lower_in_a_key_of_two_flats_more() -> None:
    score = read(document(measures(attributes(fifths=2, extra=B_FLAT) + note("D5", 4))))
    assert sounding(score) == [(72, 0.0, 2.0)]
    assert [(key.fifths, key.onset_beats) for key in score.key_signatures] == [(0, 0.0)]


@pytest.mark.parametrize(
    ("transpose", "pitch", "fifths"),
    [
        ("<chromatic>-2</chromatic>", 58, -2),
        ("<diatonic>-5</diatonic><chromatic>-9</chromatic>", 51, -3),
        ("<diatonic>-1</diatonic><chromatic>-2</chromatic><octave-change>-1</octave-change>", 46, -2),
        ("<diatonic>0</diatonic><chromatic>0</chromatic><double/>", 48, 0),
        ("<diatonic>1</diatonic><chromatic>2</chromatic>", 62, 2),
    ],
)
def test_transposing_instruments(transpose: str, pitch: int, fifths: int) -> None:
    extra = f"<transpose>{transpose}</transpose>"
    score = read(document(measures(attributes(extra=extra) + note("C4", 4))))
    assert sounding(score)[0][0] == pitch
    assert [key.fifths for key in score.key_signatures] == [fifths]


def test_a_transposition_changes_within_the_piece() -> None:
    to_c = "<attributes><transpose><diatonic>0</diatonic><chromatic>0</chromatic></transpose></attributes>"
    score = read(document(measures(attributes(extra=B_FLAT) + note("C5", 4), to_c + note("C5", 4))))
    assert [pitch for pitch, _, _ in sounding(score)] == [70, 72]


def test_chords_voices_backup_and_forward() -> None:
    chord = note("E4", 2, before="<chord/>")
    second = note("C3", 1, inner="<voice>2</voice>")
    backup = "<backup><duration>48</duration></backup>"
    forward = "<forward><duration>12</duration></forward>"
    score = read(
        document(measures(attributes() + note("C4", 2) + chord + note("D4", 2) + backup + forward + second))
    )
    assert sounding(score) == [(60, 0.0, 1.0), (64, 0.0, 1.0), (48, 0.5, 0.5), (62, 1.0, 1.0)]


def test_tuplets_and_dots_keep_their_exact_places() -> None:
    third = 2 / 3
    score = read(document(measures(attributes() + note("C4", third) * 3 + note("D4", 1.5) + note("E4", 0.5))))
    assert [one.onset_beats for one in score.notes] == pytest.approx([0, third, 2 * third, 2, 3.5], abs=1e-9)


def test_tied_notes_are_one_across_bar_lines() -> None:
    score = read(
        document(
            measures(
                attributes() + note("r", 2) + note("C4", 2, inner=tied("start")),
                note("C4", 4, inner=tied("stop", "start")),
                note("C4", 1, inner=tied("stop")) + note("C4", 3),
            )
        )
    )
    assert sounding(score) == [(60, 1.0, 3.5), (60, 4.5, 1.5)]


def test_short_grace_notes_sound_before_the_beat_and_take_of_the_note_before() -> None:
    grace = note("D4", 0.5, before='<grace slash="yes"/>')
    score = read(document(measures(attributes() + note("C4", 2) + grace + note("E4", 2))))
    assert sounding(score) == [(60, 0.0, 0.9375), (62, 0.9375, 0.0625), (64, 1.0, 1.0)]


def test_a_long_grace_note_sounds_on_the_beat_and_takes_of_its_note() -> None:
    grace = note("D4", 0.5, before="<grace/>")
    score = read(document(measures(attributes() + note("C4", 2) + grace + note("E4", 2))))
    assert sounding(score) == [(60, 0.0, 1.0), (62, 1.0, 0.25), (64, 1.25, 0.75)]


def test_a_grace_note_says_how_much_it_takes() -> None:
    grace = note("D4", 0.5, before='<grace steal-time-following="50"/>')
    score = read(document(measures(attributes() + note("C4", 2) + grace + note("E4", 2))))
    assert sounding(score) == [(60, 0.0, 1.0), (62, 1.0, 0.5), (64, 1.5, 0.5)]


def test_grace_notes_at_the_very_beginning_begin_the_piece() -> None:
    graces = note("D4", 0.25, before="<grace/>") + note("E4", 0.25, before="<grace/>")
    score = read(document(measures(attributes() + graces + note("F4", 4))))
    assert sounding(score) == [(62, 0.0, 0.0625), (64, 0.0625, 0.0625), (65, 0.125, 1.875)]


def test_articulations_shorten_and_accent() -> None:
    score = read(
        document(
            measures(
                attributes()
                + note("C4", inner=articulations("staccato"))
                + note("C4", inner=articulations("accent"))
                + note("C4", inner=articulations("staccato", "tenuto"))
                + note("C4", inner=articulations("strong-accent"))
            )
        )
    )
    assert [length for _, _, length in sounding(score)] == [0.25, 0.5, 0.375, 0.425]
    assert velocities(score) == [80, 95, 80, 105]


def test_slurred_notes_are_not_tongued() -> None:
    score = read(
        document(
            measures(
                attributes()
                + note("C4")
                + note("D4", inner=slur("start"))
                + note("E4")
                + note("F4", inner=slur("stop") + slur("start", number=2)),
                note("G4", 2, inner=slur("stop", number=2)) + note("A4", 2),
            )
        )
    )
    assert score.notes.tongued.tolist() == [1, 1, 0, 0, 0, 1]
    assert kinds(score) == []


def test_a_slur_in_one_voice_leaves_the_other_alone() -> None:
    backup = "<backup><duration>48</duration></backup>"
    lower = note("C3", 2, inner="<voice>2</voice>") * 2
    upper = note("C5", 2, inner=slur("start")) + note("D5", 2, inner=slur("stop"))
    score = read(document(measures(attributes() + upper + backup + lower)))
    assert dict(zip(score.notes.sounding_pitch.tolist(), score.notes.tongued.tolist(), strict=True)) == {
        72: 1,
        48: 1,
        74: 0,
    }


def test_a_slur_that_never_ends_is_told_and_left_out() -> None:
    score = read(document(measures(attributes() + note("C4", 2, inner=slur("start")) + note("D4", 2))))
    assert score.notes.tongued.tolist() == [1, 1]
    assert [(w.kind, w.place) for w in score.warnings] == [("unmatched_slur", "part P1, measure 1, line 9")]


def test_dynamics_are_velocities_and_hairpins_lead_from_one_to_the_next() -> None:
    score = read(
        document(
            measures(
                attributes() + dynamic("p") + wedge("crescendo") + note("C4") * 4,
                wedge("stop") + dynamic("f") + note("C4") * 2 + dynamic("sfz") + note("C4") * 2,
            )
        )
    )
    assert velocities(score) == [49, 61, 72, 84, 96, 96, 112, 96]


def test_a_hairpin_without_a_dynamic_changes_by_one_step() -> None:
    score = read(document(measures(attributes() + wedge("diminuendo") + note("C4") * 4 + wedge("stop"))))
    assert velocities(score) == [80, 76, 72, 68]


def test_dynamics_of_sounds_and_of_notes_are_per_cent_of_midi_s_90() -> None:
    sound = direction("<dynamics><f/></dynamics>", '<sound dynamics="100"/>')
    loud = note("C4", attributes='dynamics="120"')
    score = read(document(measures(attributes() + sound + note("C4") + loud + note("C4", 2))))
    assert velocities(score) == [90, 108, 90]


def test_fp_is_loud_and_then_soft() -> None:
    score = read(document(measures(attributes() + dynamic("fp") + note("C4") * 4)))
    assert velocities(score) == [96, 49, 49, 49]


def test_tempos_by_sound_by_metronome_and_by_note_values() -> None:
    dotted = direction(
        "<metronome><beat-unit>quarter</beat-unit><beat-unit-dot/><per-minute>60</per-minute></metronome>"
    )
    same = direction(
        "<metronome><beat-unit>quarter</beat-unit><beat-unit-dot/><beat-unit>quarter</beat-unit></metronome>"
    )
    score = read(
        document(
            measures(
                attributes() + direction("<words>Slow</words>", '<sound tempo="45"/>') + note("C4", 4),
                dotted + note("C4", 4),
                same + note("C4", 4),
            )
        )
    )
    assert [round(t.beats_per_minute, 6) for t in score.tempo_map.tempos] == [45, 90, 60]
    assert score.duration_s == pytest.approx(4 * 60 / 45 + 4 * 60 / 90 + 4 * 60 / 60)


def test_drums_by_midi_unpitched_and_by_name() -> None:
    entry = listed(
        "P1",
        "Drumset",
        inner='<score-instrument id="A"><instrument-name>Kick</instrument-name></score-instrument>'
        '<score-instrument id="B"><instrument-name>Closed Hi-Hat</instrument-name></score-instrument>'
        '<score-instrument id="C"><instrument-name>Thing</instrument-name></score-instrument>'
        '<midi-instrument id="A"><midi-channel>10</midi-channel><midi-unpitched>37</midi-unpitched>'
        "</midi-instrument>",
    )
    hit = (
        "<note><unpitched><display-step>C</display-step><display-octave>5</display-octave></unpitched>"
        '<duration>12</duration><instrument id="{}"/></note>'
    )
    score = read(document(measures(attributes() + "".join(map(hit.format, "ABC"))), parts_listed=entry))
    assert [one.sounding_pitch for one in score.notes] == [36, 42, 38]
    assert [(part.name, part.is_drums, part.channel) for part in score.parts] == [("Drumset", True, 9)]
    assert kinds(score) == ["unknown_drum"]


def test_instruments_change_within_a_part_and_a_mute_goes_in() -> None:
    change = '<sound><midi-instrument id="P1-I1"><midi-program>61</midi-program></midi-instrument></sound>'
    score = read(
        document(
            measures(
                attributes() + note("C4", 2) + words("con sord.") + note("D4", 2),
                words("senza sord.") + note("E4", 2) + change + note("F4", 2),
            )
        )
    )
    assert score.notes.program.tolist() == [56, 59, 56, 60]
    channels = score.notes.channel.tolist()
    assert len(score.parts) == 1
    assert channels[0] == channels[2]
    assert len(set(channels)) == 3
    assert {(c.channel, c.value) for c in score.controls if c.kind == "program"} == set(
        zip(channels, [56, 59, 56, 60], strict=True)
    )


def test_a_part_of_several_instruments_names_one_at_each_note() -> None:
    entry = listed(
        inner='<score-instrument id="A"><instrument-name>Trumpet</instrument-name></score-instrument>'
        '<score-instrument id="B"><instrument-name>Horn</instrument-name>'
        "<instrument-sound>brass.french-horn</instrument-sound></score-instrument>"
        '<midi-instrument id="A"><midi-program>57</midi-program><volume>100</volume><pan>-90</pan>'
        "</midi-instrument>"
    )
    horn = note("C4", 2, inner='<instrument id="B"/>')
    score = read(document(measures(attributes() + note("C5", 2) + horn), parts_listed=entry))
    assert score.notes.program.tolist() == [56, 60]
    assert [(c.kind, c.number, c.value) for c in score.controls] == [
        ("program", 0, 56),
        ("controller", 7, 127),
        ("controller", 10, 0),
        ("program", 0, 60),
    ]


def test_parts_begin_their_bars_together() -> None:
    first = measures(attributes() + note("C5", 4), note("D5", 4))
    second = measures(attributes() + note("C4", 2) + note("C4", 2), note("D4", 4))
    score = read(document(first, second, parts_listed=listed("P1", "A") + listed("P2", "B", 1)))
    assert [(p.name, p.program) for p in score.parts] == [("A", 56), ("B", 0)]
    assert [(one.part, one.onset_s) for one in score.notes] == [
        (0, 0.0),
        (1, 0.0),
        (1, 1.0),
        (0, 2.0),
        (1, 2.0),
    ]


def test_a_pickup_is_bar_0_and_measures_of_their_own_length_begin_bars() -> None:
    score = read(
        document(
            measure(attributes() + note("C4"), 0, 'implicit="yes"')
            + measure(note("D4", 4), 1)
            + measure(note("E4", 3), 2)
            + measure(note("F4"), "X1", 'implicit="yes"')
            + measure(note("G4", 4), 3)
        )
    )
    assert score.metre_map.pickup_beats == 1.0
    assert score.metre_map.bar_lines(13.0).tolist() == [0, 1, 5, 8, 9]


def test_a_measure_that_is_not_full_is_filled_up_and_told() -> None:
    score = read(document(measures(attributes() + note("C4", 4), note("D4"), note("E4", 4), note("F4", 4))))
    assert [onset for _, onset, _ in sounding(score)] == [0.0, 2.0, 4.0, 6.0]
    assert kinds(score) == ["short_measure"]


def test_an_empty_measure_is_as_long_as_its_metre() -> None:
    score = read(document(measures(attributes("3/4") + note("C4", 3), "", note("E4", 3))))
    assert [onset for _, onset, _ in sounding(score)] == [0.0, 3.0]


def test_metres_of_sums_and_free_time() -> None:
    senza = "<attributes><time><senza-misura/></time></attributes>"
    score = read(
        document(measures(attributes("3+2/8") + note("C4", 2.5), senza + note("D4", 7), note("E4", 1)))
    )
    assert [(s.onset_beats, s.numerator, s.denominator) for s in score.metre_map.signatures] == [
        (0.0, 5, 8),
        (2.5, 7, 4),
        (9.5, 1, 4),
    ]


def test_microtones_are_rounded_and_pitches_beyond_midi_left_out() -> None:
    quarter = note("C4").replace("<octave>", "<alter>0.5</alter><octave>")
    high = note("C9").replace("<octave>9", "<octave>12")
    score = read(document(measures(attributes() + quarter + high + note("D4", 2))))
    assert [pitch for pitch, _, _ in sounding(score)] == [60, 62]
    assert sorted(kinds(score)) == ["bad_pitch", "microtone"]


def test_cue_notes_are_not_played() -> None:
    cue = note("C4", 2, before="<cue/>")
    assert sounding(read(document(measures(attributes() + cue + note("D4", 2))))) == [(62, 1.0, 1.0)]
