"""A recording alone that is dropped on the page: its notes are found and played with it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from tests.integration.test_transcription import wav
from tests.unit.sound.alignment.renditions import RATE, Rendition, record
from tests.unit.sound.transcription.solos import solo

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    import httpx
    from tests.e2e.opened import Opened

    Visit = Callable[..., Opened]

pytestmark = pytest.mark.browser


def test_a_solo_alone_and_a_mix(visit: Visit, client: httpx.Client, tmp_path: Path) -> None:
    lone, mix = tmp_path / "lone.wav", tmp_path / "mix.wav"
    recording = solo("taps", 0)
    lone.write_bytes(wav(recording.samples[: 16 * RATE]))
    mix.write_bytes(wav(record(Rendition("ode-to-joy")).samples[: 8 * RATE]))
    opened = visit()
    opened.until_drawn()
    first = opened.session
    chooser = opened.page.locator("input[type=file]").first

    chooser.set_input_files(mix)
    opened.page.get_by_role("button", name="Find its notes (a solo)").click()
    opened.page.get_by_text("mix.wav is a mix").wait_for()
    assert opened.session == first

    chooser.set_input_files(lone)
    opened.page.get_by_role("button", name="Find its notes (a solo)").click()
    # A word in passing, which a busy machine may show before its first picture.
    opened.page.get_by_text("notes found in lone.wav").wait_for()
    opened.until_another_session(first)
    told = client.get(f"/api/v1/sessions/{opened.session}").json()
    assert (told["song"]["source"], told["alignment"]["status"]) == ("uploaded", "found")
    wanted = int((recording.onset_s < 15).sum())
    assert abs(told["notes"] - wanted) <= 1
    assert not opened.errors
