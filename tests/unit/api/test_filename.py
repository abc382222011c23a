"""File names of a form, as programs write them."""

from __future__ import annotations

import pytest
from python_multipart.multipart import parse_options_header

from reina.api.http.filename import MAX_CHARACTERS, filename_of


def read(disposition: bytes) -> str | None:
    header = b'form-data; name="score"; ' + disposition
    return filename_of(parse_options_header(header)[1].get(b"filename"), header)


@pytest.mark.parametrize(
    ("disposition", "name"),
    [
        (b'filename="My %22song%22.mid"', 'My "song".mid'),
        (b'filename="100%25.mid"', "100%25.mid"),
        (b'filename="50%2C.mid"', "50%2C.mid"),
        (b'filename="two%0D%0Alines%0A.mid"', "two lines .mid"),
        (b'filename="My \\"song\\".mid"', 'My "song".mid'),
        (b'filename="a;b.mid"', "a;b.mid"),
        (b"filename=plain.mid", "plain.mid"),
        ('filename="Für Elise.mid"'.encode(), "Für Elise.mid"),
        ('filename="月光.mid"'.encode(), "月光.mid"),
        ('filename="Für Elise.mid"'.encode("latin-1"), "Für Elise.mid"),
        (b'filename="C:\\fakepath\\song.mid"', "song.mid"),
        (b'filename="\\\\\\\\host\\\\share\\\\song.mid"', "song.mid"),
        (b'filename="/home/x/song.mid"', "song.mid"),
        (b'filename="../../etc/song.mid"', "song.mid"),
        (b'filename="AC\\DC.mid"', "AC\\DC.mid"),
        (b'filename="a\x00b\x07.mid"', "ab.mid"),
        (b'filename="  song.mid "', "song.mid"),
        (b'filename=""', None),
        (b'filename="/"', None),
        (b"", None),
        (b"filename*=UTF-8''F%C3%BCr%20Elise.mid", "Für Elise.mid"),
        (b"filename*=ISO-8859-1'de'F%FCr.mid", "Für.mid"),
        (b"filename=\"plain.mid\"; filename*=UTF-8''other.mid", "plain.mid"),
        (b"filename*=nonsense", None),
    ],
)
def test_a_name_is_read_as_a_person_does(disposition: bytes, name: str | None) -> None:
    assert read(disposition) == name


def test_a_long_name_keeps_its_ending() -> None:
    name = read(b'filename="' + b"a" * 5000 + b'.mid"')
    assert name is not None
    assert len(name) == MAX_CHARACTERS
    assert name.endswith("a.mid")
