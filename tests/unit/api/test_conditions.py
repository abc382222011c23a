"""Conditions of a GET: RFC 9110, 13.1 and 13.2.2."""

from __future__ import annotations

import pytest

from reina.api.http.conditions import precondition

ANSWERED = {"etag": '"a"', "last-modified": "Sun, 06 Nov 1994 08:49:37 GMT"}
BEFORE = "Sun, 06 Nov 1994 08:49:36 GMT"
SAME = "Sun, 06 Nov 1994 08:49:37 GMT"


@pytest.mark.parametrize(
    ("asked", "status"),
    [
        ({}, None),
        ({"if-none-match": '"a"'}, 304),
        ({"if-none-match": 'W/"a"'}, 304),
        ({"if-none-match": "*"}, 304),
        ({"if-none-match": '"b", W/"c,d" ,"a"'}, 304),
        ({"if-none-match": '"b"'}, None),
        ({"if-none-match": "a"}, None),
        ({"if-none-match": ""}, None),
        ({"if-modified-since": SAME}, 304),
        ({"if-modified-since": "Sunday, 06-Nov-94 08:49:37 GMT"}, 304),
        ({"if-modified-since": "Sun Nov  6 08:49:37 1994"}, 304),
        ({"if-modified-since": BEFORE}, None),
        ({"if-modified-since": "yesterday"}, None),
        ({"if-modified-since": "9" * 5000}, None),
        ({"if-none-match": '"b"', "if-modified-since": SAME}, None),
        ({"if-match": '"a"'}, None),
        ({"if-match": "*"}, None),
        ({"if-match": 'W/"a"'}, 412),
        ({"if-match": '"b"', "if-none-match": '"a"'}, 412),
        ({"if-match": '"a"', "if-none-match": '"a"'}, 304),
        ({"if-match": '"a"', "if-unmodified-since": BEFORE}, None),
        ({"if-unmodified-since": BEFORE}, 412),
        ({"if-unmodified-since": SAME}, None),
        ({"if-unmodified-since": "soon"}, None),
    ],
)
def test_conditions_are_weighed_in_order(asked: dict[str, str], status: int | None) -> None:
    assert precondition(asked, ANSWERED) == status


def test_what_has_no_validator_is_never_known() -> None:
    for asked in ({"if-none-match": '"a"'}, {"if-modified-since": SAME}, {"if-unmodified-since": BEFORE}):
        assert precondition(asked, {}) is None
    assert precondition({"if-match": '"a"'}, {}) == 412


def test_a_weak_validator_holds_weakly_alone() -> None:
    weak = {"etag": 'W/"a"'}
    assert precondition({"if-none-match": '"a"'}, weak) == 304
    assert precondition({"if-match": 'W/"a"'}, weak) == 412
