"""Which character set the texts of a MIDI file are in, and what they say."""

import subprocess
import sys
from collections import defaultdict
from collections.abc import Iterable
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.unit.music.midi_bytes import meta, midi, name, off, on
from tests.unit.music.midi_texts import Texts, read_texts

from reina.instruments.part_names import kinds_of_name
from reina.music import read_score
from reina.music.midi.encoding import SAMPLE_BYTES, decide_encoding
from reina.music.midi.text import decode_text
from reina.music.midi.track import TEXT_BYTES, read_track
from reina.music.midi.unicode_text import LONGEST_BYTES
from reina.music.warnings import WarningLog

CASES = Path(__file__).parents[2] / "cases"
NOTE = (on(0, 60), off(480, 60))
LYRIC = 0x05
SETS = ("cp932", "gb18030", "cp950", "cp949", "cp1250", "cp1251", "cp1252", "cp1253", "cp1255", "mac_roman")

TABLE, LATER = read_texts("midi_texts.txt"), read_texts("midi_texts_later.txt")
IN_ASCII = ("Piano", "(c) 2001", "Track 4")


def decoded(texts: Iterable[bytes]) -> tuple[str, ...]:
    texts = tuple(texts)
    encoding = decide_encoding(texts)
    return tuple(decode_text(text, encoding) for text in texts)


def titles(files: Iterable[Texts]) -> list[Texts]:
    """The files' titles alone, those of three characters or more that are not ASCII."""
    return [file.first(1) for file in files if len(file.texts[0]) > 2 and not file.texts[0].isascii()]


def of_several(files: Iterable[Texts]) -> list[Texts]:
    return [file for file in files if len(file.texts) > 1 and not "".join(file.texts).isascii()]


def wrong(files: Iterable[Texts], beside: tuple[str, ...] = ()) -> list[tuple[str, ...]]:
    """What is wrongly read, with `beside` in the same file."""
    others = tuple(text.encode() for text in beside)
    return [
        found for file in files if (found := decoded(file.encoded + others))[: len(file.texts)] != file.texts
    ]


def by_language() -> list[list[Texts]]:
    files: defaultdict[tuple[str, str], list[Texts]] = defaultdict(list)
    for file in TABLE:
        files[file.language, file.encoding].append(file)
    return list(files.values())


@pytest.mark.parametrize("files", by_language(), ids=lambda files: f"{files[0].language}-{files[0].encoding}")
def test_the_texts_of_each_language(files: list[Texts]):
    assert len(files) >= 15
    several = of_several(files)
    assert len(wrong(several)) <= 0.05 * len(several)
    assert len(wrong(several, beside=IN_ASCII)) <= 0.06 * len(several)
    assert len(wrong(titles(files))) <= 0.1 * len(titles(files))


def test_texts_written_after_the_tables():
    several = of_several(LATER)
    assert len(several) > 200
    assert len(wrong(several)) <= 0.02 * len(several)
    assert len(wrong(several, beside=IN_ASCII)) <= 0.02 * len(several)
    assert len(wrong(titles(LATER))) <= 0.05 * len(titles(LATER))


@pytest.mark.parametrize(
    ("rare", "missed"), [("koi8_r", 0.3), ("cp866", 0.0), ("iso8859_5", 0.1), ("euc_jp", 0.15)]
)
def test_rarer_character_sets_are_told_where_no_other_fits(rare: str, missed: float):
    written = ("russian",) if rare != "euc_jp" else ("japanese with kana", "japanese in kanji")
    files = [Texts(rare, rare, file.texts) for file in TABLE if file.language in written]
    assert len(wrong(of_several(files))) <= missed * len(files)


@pytest.mark.parametrize(
    ("case", "title", "part"), [("mid-sjis", "第一楽章", "トランペット"), ("mid-gbk", "红梅花", "小号")]
)
def test_a_title_that_the_other_names_explain(case: str, title: str, part: str):
    score = read_score((CASES / f"{case}.mid").read_bytes(), filename=f"{case}.mid")
    assert score.title == title
    assert [p.name for p in score.parts] == ["Piano", part]
    assert "trumpet" in kinds_of_name(score.parts[1].name)


def test_lyrics_tell_the_character_set_of_a_short_name():
    lyrics = [meta(0, LYRIC, syllable.encode("gbk")) for syllable in "在那遥远的地方有位好姑娘"]
    title, part = (name(text.encode("gbk")) for text in ("鸽", "瑟"))
    score = read_score(midi((title, *lyrics), (part, *NOTE)))
    assert (score.title, score.parts[0].name) == ("鸽", "瑟")


def test_ascii_is_utf_8():
    assert decide_encoding([b"Trumpet", b"", b"Piano"]) == "utf-8"
    assert decide_encoding([]) == "utf-8"


def test_utf_8_in_any_language():
    for file in TABLE:
        data = [text.encode() for text in file.texts]
        assert decide_encoding(data) == "utf-8"
        assert decoded(data) == file.texts


@pytest.mark.parametrize("encoding", ["utf-16-le", "utf-16-be", "utf-8"])
def test_a_byte_order_mark_tells_of_its_own_text_alone(encoding: str):
    texts = ("\ufeff第一楽章".encode(encoding), "トランペット".encode("cp932"), b"Piano")
    assert decoded(texts) == ("第一楽章", "トランペット", "Piano")
    cut = texts[0][:-1]
    assert decoded([cut]) == ("第一楽",)


def test_a_file_may_mix_utf_8_with_another_set():
    texts = ("茉莉花".encode(), "小提琴".encode("gbk"), "钢琴".encode("gbk"))
    assert decoded(texts) == ("茉莉花", "小提琴", "钢琴")
    assert decoded(["Für Elise".encode(), "Flöte".encode("cp1252")]) == ("Für Elise", "Flöte")


def test_two_bytes_that_might_be_utf_8_are_read_as_the_rest_of_the_file():
    short = "小".encode("gbk")
    assert short.decode("utf-8") == "С"
    assert decoded([short, "红梅花".encode("gbk")]) == ("小", "红梅花")


@pytest.mark.parametrize("file", TABLE[::7], ids=lambda file: f"{file.texts[0]}-{file.encoding}")
def test_a_text_cut_within_a_character_spoils_nothing(file: Texts):
    if file.encoding not in {"cp932", "gbk", "big5", "euc_kr"} or len(file.texts) < 2:
        return
    whole = file.encoded
    last = file.texts[-1][-1].encode(file.encoding)
    if len(last) == 2:
        cut = (*whole[:-1], whole[-1][:-1])
        assert decoded(cut) == (*file.texts[:-1], file.texts[-1][:-1])


@pytest.mark.parametrize("encoding", ["utf-8", "cp932", "gb18030", "utf-16-le"])
def test_a_long_name_is_cut_between_characters(encoding: str):
    mark = b"\xff\xfe" if encoding == "utf-16-le" else b""
    (text,) = decoded([mark + ("a" + "音" * 1000).encode(encoding)])
    assert set(text[1:]) == {"音"}
    assert len(text.encode(encoding)) in range(LONGEST_BYTES - 4, LONGEST_BYTES + 1)


def test_nul_and_blanks_about_a_name():
    assert decoded(["  トランペット\0\0".encode("cp932")]) == ("トランペット",)
    assert decoded(["トランペッ".encode("cp932") + b"\x83\0\0 "]) == ("トランペッ",)
    assert decoded([b"Tpt\0\x07 1\n"]) == ("Tpt 1",)


def test_the_order_of_texts_does_not_matter_where_all_are_examined():
    for file in TABLE[::5]:
        assert decide_encoding(file.encoded) == decide_encoding(file.encoded[::-1])


@given(st.lists(st.binary(max_size=40), max_size=6), st.sampled_from((*SETS, "euc_jp", "utf-8")))
def test_any_bytes_become_text_that_can_be_sent(texts: list[bytes], encoding: str):
    for given_encoding in (decide_encoding(texts), encoding):
        for data in texts:
            text = decode_text(data, given_encoding)
            assert text.encode("utf-8").decode("utf-8") == text
            assert all(character >= " " and not "\x7f" <= character <= "\x9f" for character in text)
            assert text == text.strip()
            assert len(text) <= LONGEST_BYTES


@given(st.sampled_from(TABLE), st.data())
def test_damaged_texts_are_read(file: Texts, data: st.DataObject):
    texts = list(file.encoded)
    at = data.draw(st.integers(0, len(texts) - 1))
    damaged = bytearray(texts[at])
    damaged[data.draw(st.integers(0, len(damaged) - 1))] = data.draw(st.integers(0, 255))
    texts[at] = bytes(damaged)
    assert all(isinstance(text.encode(), bytes) for text in decoded(texts))


def test_of_much_text_a_bounded_sample_is_examined(monkeypatch: pytest.MonkeyPatch):
    from reina.music.midi import encoding as module

    examined: list[int] = []
    whole = module.decode_whole

    def counted(data: bytes, encoding: str) -> tuple[str, int]:
        examined.append(len(data))
        return whole(data, encoding)

    monkeypatch.setattr(module, "decode_whole", counted)
    texts = [f"слово {number} ".encode("cp1251") * 1000 for number in range(5000)]
    assert decide_encoding(texts) == "cp1251"
    assert sum(examined) <= SAMPLE_BYTES * len(SETS)


def test_many_lyrics_are_bounded_and_change_nothing():
    lyrics = [meta(0, LYRIC, "らりるれろ"[index % 5].encode("cp932")) for index in range(110_000)]
    data = midi((name("歌".encode("cp932")), *lyrics, *NOTE))
    track = read_track(data, 22, len(data), number=1, offset=0, most_events=1_000_000, log=WarningLog())
    assert sum(map(len, track.texts)) <= TEXT_BYTES
    assert len(track.metas) == 1
    assert read_score(data).parts[0].name == "歌"


def test_charset_normalizer_is_loaded_only_where_it_is_needed():
    script = (
        "import sys\n"
        "from reina.music.midi.encoding import decide_encoding\n"
        "decide_encoding([b'Piano', 'Flöte'.encode('cp1252'), 'ふるさと'.encode('cp932')])\n"
        "assert 'charset_normalizer' not in sys.modules\n"
        "assert decide_encoding(['Подмосковные вечера'.encode('cp866')]) == 'cp866'\n"
        "assert 'charset_normalizer' in sys.modules\n"
    )
    subprocess.run([sys.executable, "-c", script], check=True)
