"""Where the page holds a note to be looked at, its valves are down as its fingering says."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import pytest
from tests.golden.example_frames import FPS, Example, examples, fetch, session_of

if TYPE_CHECKING:
    import httpx


def held_frame(onset_s: float) -> int:
    """The frame at which the page holds a note: the first on the grid at its onset or later."""
    return math.ceil(onset_s * FPS - 1e-6)


TRUMPETERS = [example for example in examples() if example.player == "trumpeter"]


@pytest.mark.parametrize("example", TRUMPETERS, ids=lambda example: example.name)
def test_the_valves_of_a_held_note_are_its_fingering(client: httpx.Client, example: Example) -> None:
    with session_of(client, example) as session:
        score = client.get(f"/api/v1/sessions/{session['id']}/score").raise_for_status().json()
        notes = [note for note in score["notes"] if note["player"] == 0 and note["valves"] is not None]
        last_s = max(note["onset_s"] for note in notes) + 0.1
        fields = fetch(client, session["id"], [(0.0, last_s)]).fields()
    assert notes
    unlike = [
        (note["index"], note["onset_s"], note["duration_s"], note["valves"], valve, float(down))
        for note in notes
        for valve in (1, 2, 3)
        for down in fields[f"trumpet/valve/{valve}"][held_frame(note["onset_s"])]
        if abs(down - (valve in note["valves"])) > 0.01
    ]
    assert unlike == []
