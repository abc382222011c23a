"""The edits and the music's time that the page is held to are still what the server says."""

from __future__ import annotations

import json
from typing import Any, cast

import pytest
from tests.contract.golden_edits import EDITS, FILE, golden

from reina.show import EDITS as KINDS

COMMITTED: dict[str, Any] = json.loads(FILE.read_text(encoding="utf-8"))


def _leaves(value: Any, place: str = "") -> dict[str, Any]:
    if isinstance(value, dict):
        fields = cast("dict[str, Any]", value)
        return {k: v for name, item in fields.items() for k, v in _leaves(item, f"{place}/{name}").items()}
    if isinstance(value, list) and value:
        items = cast("list[Any]", value)
        return {
            k: v for index, item in enumerate(items) for k, v in _leaves(item, f"{place}/{index}").items()
        }
    return {place: value}


def test_the_committed_file_is_what_the_server_says() -> None:
    said, written = _leaves(json.loads(json.dumps(golden()))), _leaves(COMMITTED)
    assert list(said) == list(written)
    for place, value in written.items():
        # The last bit of a float differs between processors.
        number = isinstance(value, float)
        assert said[place] == (pytest.approx(value, rel=1e-9, abs=1e-9) if number else value), place


def test_every_edit_that_the_page_works_out_is_there() -> None:
    sent = {edit["edit"] for edits in EDITS.values() for edit in edits}
    # The page sends no copy of a track, and shows a look when the server has put it in.
    assert sent == set(KINDS) - {"copy_track", "apply_look"}


def test_places_lie_on_every_side_of_every_change() -> None:
    onsets = [tempo["onset_s"] for tempo in COMMITTED["score"]["tempi"]]
    places = [place["seconds"] for place in COMMITTED["places"]]
    for before, after in zip(onsets, [*onsets[1:], max(places)], strict=True):
        assert any(before < place < after for place in places)
