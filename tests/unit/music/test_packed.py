"""Scores that come gzip'd or zipped, and files that are no scores."""

import gzip
import io
import random
import struct
import zipfile
import zlib
from pathlib import Path

import pytest

from reina.music import DEFAULT_LIMITS, Limits, Score, ScoreError, ScoreLimitError, read_score
from reina.music.file_kinds import SIGNATURES, WORDS, ZIPPED
from reina.music.packed import MAX_FILES

EXAMPLES = Path(__file__).parents[3] / "examples" / "scores"
MIDI = (EXAMPLES / "chromatic-scale.mid").read_bytes()
JSON = (EXAMPLES / "ode-to-joy.json").read_bytes()
UNTITLED = b"MThd\0\0\0\6\0\0\0\1\0\x60MTrk\0\0\0\x0c\0\x90\x3c\x40\x60\x80\x3c\0\0\xff\x2f\0"


def zipped(files: dict[str, bytes], method: int = zipfile.ZIP_DEFLATED) -> bytes:
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", method) as archive:
        for name, data in files.items():
            archive.writestr(name, data)
    return stream.getvalue()


def told(score: Score) -> list[tuple[str, str]]:
    return [(warning.kind, warning.message) for warning in score.warnings]


@pytest.mark.parametrize("score", [MIDI, JSON])
def test_gzipd_scores_are_read(score: bytes):
    plain, packed = read_score(score), read_score(gzip.compress(score))
    assert packed.title == plain.title
    assert packed.notes.onset_s.tolist() == plain.notes.onset_s.tolist()
    assert told(packed) == [("unpacked", "a gzip'd file was unpacked")]


def test_several_gzipd_pieces_one_after_another_are_one_file():
    data = gzip.compress(MIDI[:100]) + gzip.compress(MIDI[100:]) + bytes(64)
    assert len(read_score(data).notes) == len(read_score(MIDI).notes)


@pytest.mark.parametrize(
    ("filename", "title"),
    [("Taps.mid.gz", "Taps"), ("Taps.GZ", "Taps"), ("Taps.mid", "Taps"), (None, "Untitled")],
)
def test_the_title_of_a_gzipd_file(filename: str | None, title: str):
    assert read_score(gzip.compress(UNTITLED), filename=filename).title == title


def test_the_one_score_of_a_zip_is_read():
    score = read_score(zipped({"A March.mid": UNTITLED}), filename="download.zip")
    assert score.title == "A March"
    assert told(score) == [("unpacked", "A March.mid was taken out of a ZIP archive")]
    assert len(read_score(zipped({"ode.json": JSON}, zipfile.ZIP_STORED)).notes) > 0


def test_what_stands_beside_the_score_in_a_zip_is_left_aside():
    files = {
        "Band/": b"",
        "Band/March.mid": UNTITLED,
        "__MACOSX/Band/._March.mid": b"\0\5\x16\7",
        ".DS_Store": b"x",
        "Band/.git/other.mid": MIDI,
        "Thumbs.db": b"x",
        "Band/cover.png": b"\x89PNG\r\n\x1a\n",
        "Band/info.json": b'{"artist": "anon"}',
        "Band/take.mp3": b"ID3\4",
    }
    score = read_score(zipped(files))
    assert score.title == "March"
    assert told(score) == [
        ("unpacked", "March.mid was taken out of a ZIP archive; 3 other files in it left aside")
    ]


@pytest.mark.parametrize(
    ("files", "said"),
    [
        ({}, "is empty"),
        ({"a/": b"", ".DS_Store": b"x"}, "is empty"),
        ({"a.mid": UNTITLED, "b.kar": UNTITLED}, r"2 scores \(a.mid, b.kar\); send one"),
        ({f"{n}.mid": UNTITLED for n in range(9)}, r"9 scores \(0.mid, .*4.mid and 4 more\)"),
        ({"a.mid": UNTITLED, "b.json": JSON}, "2 scores"),
        ({"a.mp3": b"ID3", "b.txt": b"hi"}, r"no score, but a.mp3 \(an MP3 recording\), b.txt;"),
        ({"a.zip": zipped({"a.mid": UNTITLED})}, "a ZIP archive inside another"),
        ({"a.mid.gz": gzip.compress(UNTITLED)}, "a gzip'd file inside another"),
        ({"song.xml": b'<?xml version="1.0"?><score-partwise>'}, "no MusicXML that can be read"),
        ({"a.musicxml": b"<score-partwise>", "b.mid": UNTITLED}, "2 scores"),
        ({"notes.txt": b"do re mi"}, "no MIDI file"),
        ({"empty.mid": b""}, "the file is empty"),
    ],
)
def test_a_zip_without_one_score_is_refused(files: dict[str, bytes], said: str):
    with pytest.raises(ScoreError, match=said):
        read_score(zipped(files))


def test_a_gzipd_file_inside_a_gzipd_one_is_refused():
    with pytest.raises(ScoreError, match="a gzip'd file inside another"):
        read_score(gzip.compress(gzip.compress(MIDI)))


def test_an_encrypted_zip_is_named_as_such():
    data = bytearray(zipped({"Secret.mid": UNTITLED}))
    for magic, at in ((b"PK\3\4", 6), (b"PK\1\2", 8)):
        data[data.index(magic) + at] |= 1
    with pytest.raises(ScoreError, match=r"Secret\.mid: is encrypted"):
        read_score(bytes(data))


@pytest.mark.parametrize("method", [zipfile.ZIP_BZIP2, zipfile.ZIP_LZMA])
def test_other_methods_of_compression_are_named_and_never_unpacked(method: int):
    with pytest.raises(ScoreError, match="by a method that is not read"):
        read_score(zipped({"a.mid": bytes(5_000_000)}, method))


def test_bombs_are_refused_at_the_limit():
    most = DEFAULT_LIMITS.size_bytes
    bomb = gzip.compress(bytes(2 * most))
    assert len(bomb) < most // 100
    with pytest.raises(ScoreLimitError, match="unpacks to more than 33,554,432 bytes"):
        read_score(bomb)
    with pytest.raises(ScoreLimitError, match=r"a\.mid: unpacks to more than 33,554,432 bytes"):
        read_score(zipped({"a.mid": bytes(most + 1)}))
    with pytest.raises(ScoreLimitError, match="unpacks to more"):
        read_score(gzip.compress(MIDI) * 20, limits=Limits(size_bytes=10 * len(MIDI)))
    with pytest.raises(ScoreLimitError, match="more than 1,000 gzip'd files in one"):
        read_score(gzip.compress(b"") * 200_000)
    with pytest.raises(ScoreLimitError, match="holds 1,001 files"):
        read_score(zipped({f"{n}": b"" for n in range(MAX_FILES + 1)}))


def test_the_size_that_a_zip_claims_is_not_trusted():
    most = 1_000_000
    data = bytearray(zipped({"a.mid": bytes(4 * most)}))
    for magic, at in ((b"PK\3\4", 22), (b"PK\1\2", 24)):
        where = data.index(magic) + at
        data[where : where + 4] = struct.pack("<I", 100)
    with pytest.raises(ScoreError, match="is damaged"):
        read_score(bytes(data), limits=Limits(size_bytes=most))
    # One that lies on many entries at once: all claim the same compressed bytes.
    whole = zipped({"a.mid": UNTITLED, "b.png": b"\x89PNG"})
    assert read_score(whole.replace(struct.pack("<I", 4), struct.pack("<I", 2**31))).title == "a"


@pytest.mark.parametrize("cut", [2, 9, 15, 40, -30, -9, -1])
def test_a_cut_archive_is_refused(cut: int):
    for data in (gzip.compress(MIDI), zipped({"a.mid": MIDI})):
        with pytest.raises(ScoreError):
            read_score(data[:cut])


def test_damaged_archives_give_a_score_or_the_readers_own_error():
    rng = random.Random(20_261_129)
    whole = [gzip.compress(MIDI), zipped({"a.mid": MIDI, "b/ä.png": b"\x89PNG"}), zipped({"j.json": JSON})]
    refused = 0
    for _ in range(3000):
        data = bytearray(rng.choice(whole))
        for _ in range(rng.randint(1, 4)):
            data[rng.randrange(len(data))] = rng.choice((0, 1, 0x7F, 0x80, 0xFF, rng.randrange(256)))
        try:
            read_score(bytes(data))
        except ScoreError:
            refused += 1
    assert 1000 < refused < 3000


def framed(at: int, magic: bytes) -> bytes:
    """A file with bytes at a place; what stands before is no other kind's."""
    return b"\1" * at + magic + b"\1" * 100


@pytest.mark.parametrize(("at", "magic", "kind"), SIGNATURES)
def test_other_files_are_named_by_their_bytes(at: int, magic: bytes, kind: object):
    with pytest.raises(ScoreError) as caught:
        read_score(gzip.compress(framed(at, magic)))
    assert caught.value.detail == str(kind)


@pytest.mark.parametrize(("word", "kind"), WORDS)
@pytest.mark.parametrize("encoding", ["utf-8", "utf-16"])
def test_other_files_are_named_by_their_words(word: bytes, kind: object, encoding: str):
    text = f"<!-- made by a program -->\n {word.decode().upper()} 1\n"
    for data in (text.encode(encoding), gzip.compress(text.encode(encoding))):
        with pytest.raises(ScoreError) as caught:
            read_score(data)
        assert caught.value.detail == str(kind)


@pytest.mark.parametrize(("end", "kind"), ZIPPED)
def test_zipped_files_of_other_programs_are_named(end: str, kind: object):
    with pytest.raises(ScoreError) as caught:
        read_score(zipped({f"x{end}" if end.startswith(".") else end: b"<xml>", "song.mid": UNTITLED}))
    assert caught.value.detail == str(kind)


def test_every_kind_says_what_would_be_right():
    kinds = [kind for *_, kind in (*SIGNATURES, *WORDS, *ZIPPED)]
    assert all(kind.advice and not kind.advice.endswith(".") for kind in kinds)


def test_inflating_is_by_pieces_and_not_by_what_is_claimed():
    compressor = zlib.compressobj(wbits=31)
    data = compressor.compress(MIDI) + compressor.flush()
    claims_four_gigabytes = data[:-4] + b"\xff\xff\xff\xff"
    with pytest.raises(ScoreError, match="is damaged"):
        read_score(claims_four_gigabytes)
