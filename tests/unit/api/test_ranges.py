"""Ranges of bytes, read as RFC 9110 has them."""

from __future__ import annotations

import pytest

from reina.api.http.ranges import MAX_RANGES, byte_ranges

SIZE = 100


@pytest.mark.parametrize(
    ("header", "ranges"),
    [
        ("bytes=0-0", [(0, 0)]),
        ("bytes=10-", [(10, 99)]),
        ("bytes=-5", [(95, 99)]),
        ("bytes=-1000", [(0, 99)]),
        ("bytes=90-1000", [(90, 99)]),
        ("bytes=90-" + "9" * 5000, [(90, 99)]),
        ("bytes=00000000000000000000005-6", [(5, 6)]),
        ("BYTES=1-2", [(1, 2)]),
        ("bytes= 1-2 , ,5-6,", [(1, 2), (5, 6)]),
        ("bytes=1-2,500-", [(1, 2)]),
    ],
)
def test_what_is_asked_for(header: str, ranges: list[tuple[int, int]]) -> None:
    assert byte_ranges(header, SIZE) == ranges


@pytest.mark.parametrize(
    "header", ["bytes=100-", "bytes=500-600,700-", "bytes=-0", "bytes=" + "9" * 5000 + "-"]
)
def test_what_cannot_be_satisfied(header: str) -> None:
    assert byte_ranges(header, SIZE) == []


@pytest.mark.parametrize(
    "header",
    [
        "",
        "items=0-9",
        "bytes",
        "bytes=",
        "bytes=,",
        "bytes=-",
        "bytes=5",
        "bytes=a-b",
        "bytes=5-2",
        "bytes=0-1,5-2",
        "bytes=+1-2",
        "bytes=1--2",
        "bytes=\u0661-\u0662",
        "bytes=" + ",".join(["0-"] * (MAX_RANGES + 1)),
    ],
)
def test_what_is_ignored(header: str) -> None:
    assert byte_ranges(header, SIZE) is None


def test_an_empty_file_has_an_end_and_no_byte() -> None:
    assert byte_ranges("bytes=0-", 0) == []
    assert byte_ranges("bytes=-5", 0) is None
