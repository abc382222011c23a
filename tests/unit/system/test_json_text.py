"""JSON text that is put together."""

from __future__ import annotations

import json

from reina.system.json_text import with_list


def test_a_list_that_is_written_already_comes_last() -> None:
    assert with_list({"version": 1, "title": 'a "b"'}, "tracks", [b'{"x":1}', b"2"]) == (
        b'{"version":1,"title":"a \\"b\\"","tracks":[{"x":1},2]}'
    )
    assert json.loads(with_list({"version": 1}, "tracks", [])) == {"version": 1, "tracks": []}
