"""Lyrics, markers and other words of MIDI files."""

from __future__ import annotations

from tests.unit.music.midi_bytes import meta, midi, name, off, on, tempo

from reina.music import Score, read_score
from reina.music.lyrics import lyric_lines
from reina.music.midi.writer import write_midi
from reina.music.texts import ScoreText

NOTES = [on(0, 60), off(4800, 60)]


def words(kind: int, *texts: tuple[int, str | bytes]) -> list[tuple[int, bytes]]:
    return [meta(delta, kind, text if isinstance(text, bytes) else text.encode()) for delta, text in texts]


def told(score: Score, kind: str) -> list[tuple[float, str]]:
    return [(text.onset_s, text.text) for text in score.texts if text.kind == kind]


def lines(score: Score) -> list[str]:
    return [line.text for line in lyric_lines(score.texts)]


def kar(*sung: tuple[int, str | bytes]) -> bytes:
    head = words(1, (0, "@KMIDI KARAOKE FILE"), (0, "@V0100"))
    text = [name("Words"), *words(1, (0, "@LENGL"), (0, "@TA Song"), (0, "@TSomebody"), *sung)]
    return midi([name("Soft Karaoke"), *head], text, [name("Piano"), *NOTES])


def test_a_karaoke_file_has_lines_and_a_title():
    score = read_score(kar((480, "\\Hel"), (480, "lo"), (480, " world"), (480, "/Good"), (0, " night")))
    assert score.title == "A Song"
    assert lines(score) == ["Hello world", "Good night"]
    assert told(score, "lyric")[:2] == [(0.5, "\n\nHel"), (1.0, "lo")]
    assert told(score, "text") == []


def test_lyrics_in_the_character_set_of_the_file():
    sung = [(480, word.encode("cp1252")) for word in ("\\für", " schöne", " Mädchen", " überall", " süß")]
    assert lines(read_score(kar(*sung))) == ["für schöne Mädchen überall süß"]
    japanese = [(480, word.encode("shift_jis")) for word in ("\\さくら", "/さくら", "/やよいのそらは")]
    assert lines(read_score(kar(*japanese))) == ["さくら", "さくら", "やよいのそらは"]


def test_lyric_events_with_line_ends():
    sung = words(5, (0, "Twin"), (480, "kle "), (480, "star\r"), (480, "How "), (480, "I\n"))
    score = read_score(midi([tempo(0, 1_000_000), *sung], NOTES))
    assert lines(score) == ["Twinkle star", "How I"]
    assert [(line.start_s, line.end_s) for line in lyric_lines(score.texts)] == [(0.0, 3.0), (3.0, 8.0)]


def test_lyric_events_without_blanks_are_words_unless_hyphens_join_them():
    sung = words(5, (0, "Twin-"), (480, "kle"), (480, "star"))
    assert lines(read_score(midi(sung, NOTES))) == ["Twinkle star"]


def test_of_several_tracks_with_lyrics_the_fullest_is_read():
    few, many = words(5, (0, "ah ")), words(5, (0, "one "), (480, "two "))
    assert lines(read_score(midi(few, many, NOTES))) == ["one two"]


def test_markers_cues_and_texts_of_any_track():
    marks = [*words(6, (960, "Verse")), *words(7, (0, "lights")), *words(1, (0, "  by hand "), (0, " "))]
    score = read_score(midi(marks, NOTES))
    assert told(score, "marker") == [(1.0, "Verse")]
    assert told(score, "text") == [(1.0, "lights"), (1.0, "by hand")]
    assert lines(score) == []


def test_words_are_written_again():
    score = read_score(kar((480, "\\Hel"), (480, "lo"), (480, " world"), (480, "/Good")))
    again = read_score(write_midi(score))
    assert lines(again) == lines(score) == ["Hello world", "Good"]
    assert again.texts == score.texts


def test_a_file_without_words_has_none():
    assert read_score(midi(NOTES)).texts == ()


def test_long_lines_and_silences_are_broken():
    def sung(*pairs: tuple[float, str]) -> list[str]:
        return [line.text for line in lyric_lines([ScoreText("lyric", at, at, text) for at, text in pairs])]

    assert sung((0, "one "), (1, "two "), (9, "three ")) == ["one two", "three"]
    assert [len(line) for line in sung(*[(number / 2, "word ") for number in range(30)])] == [64, 64, 19]
    assert sung((0, "\n"), (1, " "), (2, "\n\nword")) == ["word"]
