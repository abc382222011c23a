"""Files that are dragged from outside of the browser and dropped on the page."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest
from tests.e2e.conftest import SMALL
from tests.integration.scores import scale, song

if TYPE_CHECKING:
    from collections.abc import Callable

    import httpx
    from playwright.sync_api import Route
    from tests.e2e.opened import Opened

    Visit = Callable[..., Opened]

pytestmark = pytest.mark.browser

JSON_SCORE = Path(__file__).parents[2] / "examples" / "scores" / "ode-to-joy.json"


def drag(opened: Opened, *kinds: str, files: tuple[Path, ...]) -> None:
    """Let the browser's own drag and drop pass over the middle of the window, as a file manager would."""
    devtools: Any = opened.page.context.new_cdp_session(opened.page)
    place = {"x": SMALL[0] / 2, "y": SMALL[1] / 2}
    data = {"items": [], "files": [str(file) for file in files], "dragOperationsMask": 1}
    for kind in kinds:
        devtools.send("Input.dispatchDragEvent", {"type": kind, **place, "data": data})
    devtools.detach()


def drop(opened: Opened, *files: Path) -> None:
    """Drag files over the page, which says that it takes them, and let go."""
    first = opened.session
    veil = opened.page.get_by_text("Let go")
    drag(opened, "dragEnter", "dragOver", files=files)
    veil.wait_for()
    drag(opened, "drop", files=files)
    opened.until_another_session(first)
    veil.wait_for(state="detached")


def test_a_score_chosen_before_the_first_piece_is_open_stays(visit: Visit, client: httpx.Client) -> None:
    opened = visit("/lab")
    page = opened.page
    held: list[Route] = []
    # The bundled piece's session is under way while a file is chosen.
    page.route("**/api/v1/sessions", lambda route: held.append(route), times=1)
    with page.expect_request(lambda asked: asked.method == "POST" and asked.url.endswith("/sessions")):
        opened.go("/", wait_until="commit")
    opened.choose_files(("scale.mid", "audio/midi", scale(32)))
    opened.until("window.reina?.session && window.reina.drawn")
    own = opened.session
    with page.expect_response(lambda answer: answer.request.method == "DELETE"):
        held[0].continue_()
    page.get_by_text("Opening").wait_for(state="detached")
    assert opened.session == opened.measure("session") == own
    assert client.get(f"/api/v1/sessions/{own}").json()["notes"] == 32


def until_played(opened: Opened) -> None:
    """Play, until the picture has gone on and the song is heard."""
    assert opened.measure("playing") is False
    opened.page.keyboard.press("Space")
    opened.until("window.reina.playing && window.reina.drawnIndex > 20 && window.reina.sound === 'ready'")


def test_dropped_scores_play_at_addresses_of_their_own(
    visit: Visit, client: httpx.Client, tmp_path: Path
) -> None:
    midi, wav = tmp_path / "scale.mid", tmp_path / "scale.wav"
    midi.write_bytes(scale(32))
    wav.write_bytes(song(12.0))
    opened = visit()
    opened.until_drawn()
    addresses = [opened.session]

    drop(opened, midi, wav)
    addresses.append(opened.session)
    told = client.get(f"/api/v1/sessions/{opened.session}").json()
    assert (told["song"]["source"], told["parts"][told["part"]]["notes"]) == ("uploaded", 32)
    until_played(opened)

    drop(opened, Path(shutil.copy(JSON_SCORE, tmp_path)))
    addresses.append(opened.session)
    told = client.get(f"/api/v1/sessions/{opened.session}").json()
    assert (told["song"]["source"], told["title"]) == ("rendered", "Ode to Joy")
    until_played(opened)

    assert len(set(addresses)) == 3
    opened.page.go_back()
    opened.until("(session) => window.reina?.session === session && window.reina.drawn", addresses[1])
