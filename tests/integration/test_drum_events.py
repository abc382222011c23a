"""A show that answers a drummer: by piece and limb, seen in frames alone; what the kit lacks is told."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from tests.integration.scores import song
from tests.integration.server import upload
from tests.integration.stranger import take

if TYPE_CHECKING:
    import httpx

SAINTS = Path(__file__).parents[2] / "examples" / "scores" / "when-the-saints.mid"
LIGHT = "lights/key/intensity"
SPAN_S = 20.0
FLASH_S = 0.02
"""Longer than a frame of 60 a second: each flash is seen, and none from one stroke to the next."""


def put(where: dict[str, Any], client: httpx.Client) -> Any:
    """A session of the example whose key light flashes at some of the strokes."""
    session = upload(client, SAINTS.read_bytes(), SAINTS.name, song=("s.wav", song()))
    events = {"on": "notes", "where": where, "amount": 9.0, "hold": FLASH_S}
    track = {"parameter": LIGHT, "keyframes": [{"time": 0, "value": 1.0}], "events": events}
    session.change("PUT", "/show", json={"version": 1, "tracks": [track]}).raise_for_status()
    return session


def test_a_light_flashes_at_every_stroke_of_the_snare_and_at_nothing_else(client: httpx.Client) -> None:
    session = put({"pieces": ["snare"]}, client)
    notes: list[dict[str, Any]] = client.get(f"{session.path}/score").json()["notes"]
    fingered = [note for note in notes if note["fingering"] is not None]
    onsets = np.array([note["onset_s"] for note in fingered if note["fingering"].get("piece") == "snare"])
    motion = take(client, session.id, 0.0, SPAN_S)
    since = motion.song_time_s[:, None] - onsets[None, :]
    struck = np.any((since > -1e-9) & (since < FLASH_S - 1e-9), axis=1)
    lit = motion.parameters[LIGHT][:, 0] > 8.9
    assert np.count_nonzero(onsets < SPAN_S - 1) > 80
    assert np.array_equal(lit, struck)
    assert not lit.all()
    session.change("DELETE")


def test_a_piece_that_the_kit_lacks_is_told(client: httpx.Client) -> None:
    session = put({"pieces": ["gong"]}, client)
    (told,) = client.get(f"{session.path}/show/warnings").json()["warnings"]
    assert (told["kind"], told["place"]) == ("show-unknown-piece", LIGHT)
    assert "gong; the kit has snare, kick, tom_high" in told["message"]
    session.change("DELETE")
