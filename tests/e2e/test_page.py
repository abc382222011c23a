"""The page in a real Chromium, against a real server."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest
from tests.e2e.opened import FPS
from tests.integration.scores import scale, song

from reina.performance import BLOCK_FRAMES
from reina.protocol import Manifest, unpack

if TYPE_CHECKING:
    from collections.abc import Callable

    import httpx
    from numpy.typing import NDArray
    from tests.e2e.opened import Opened

    Visit = Callable[..., Opened]

pytestmark = pytest.mark.browser

MIDI = ("scale.mid", "audio/midi", scale(32))
WAV = ("scale.wav", "audio/wav", song(12.0))


def open_scale(visit: Visit) -> Opened:
    """A page with a session of its own: a scale and its recording, uploaded through the file input."""
    return visit(files=(MIDI, WAV))


def streamed_rotations(client: httpx.Client, session: str, index: int) -> dict[str, NDArray[np.float32]]:
    """Joint rotations of one frame, by joint name, as the server packs them."""
    path = f"/api/v1/sessions/{session}"
    hello = client.get(f"{path}/manifest").json()
    manifest = Manifest.model_validate({name: hello[name] for name in Manifest.model_fields})
    block = client.get(f"{hello['blocks']['href']}/{index // BLOCK_FRAMES}").raise_for_status()
    frames = unpack(manifest, block.content)
    (frame,) = frames[frames["index"] == index]
    names = [name for skeleton in manifest.skeletons for name in skeleton.joints]
    return dict(zip(names, frame["rotations"], strict=True))


def test_first_visit_opens_the_bundled_piece_and_comes_back_to_where_it_was(
    visit: Visit, client: httpx.Client
) -> None:
    opened = visit()
    opened.until_drawn()
    session = opened.session
    assert len(session) >= 22, "the session has an address of its own"
    assert opened.page.get_by_role("button", name="Drop your MIDI").is_visible()
    assert opened.page.get_by_role("region", name="Transport").is_visible()
    opened.page.keyboard.press("Shift+ArrowRight")
    opened.until("window.reina.drawnIndex > 0")
    left = client.get(f"/api/v1/sessions/{session}/transport").json()
    index = opened.until_at_rest(left)
    assert index > FPS, "the second bar"
    bones = opened.bone_quaternions()
    for come_back in (lambda: opened.go("/"), opened.page.reload):
        come_back()
        opened.until_drawn()
        assert opened.session == session
        assert opened.until_at_rest(left) == index
        assert opened.bone_quaternions() == bones


def test_an_uploaded_score_plays_with_its_song_and_the_streamed_bones(
    visit: Visit, client: httpx.Client
) -> None:
    opened = open_scale(visit)
    page = opened.page
    page.keyboard.press("Space")
    opened.until("window.reina.playing && window.reina.sound === 'ready' && window.reina.sync.readings > 5")
    opened.until("window.reina.songTime > 1.5")
    # The song is heard, and where it should be; a busy machine's sound falls behind and is brought back.
    opened.until("Math.abs(window.reina.soundAhead ?? 1) < 0.06")
    page.keyboard.press("Space")
    opened.until("!window.reina.playing")
    paused = client.get(f"/api/v1/sessions/{opened.session}/transport").json()
    index = opened.until_at_rest(paused)
    drawn = opened.bone_quaternions()
    streamed = streamed_rotations(client, opened.session, index)
    assert set(drawn) == set(streamed)
    for name, rotation in streamed.items():
        np.testing.assert_allclose(drawn[name], rotation, atol=1e-6, err_msg=name)
    turned = [name for name, rotation in streamed.items() if abs(rotation[3]) < 0.999]
    assert len(turned) > 10, "the player stands in a pose, not at rest"


def test_two_tabs_of_a_session_move_play_and_stop_together(visit: Visit, client: httpx.Client) -> None:
    first = open_scale(visit)
    second = visit(f"/s/{first.session}", beside=first)
    second.until_drawn()
    second.page.keyboard.press("Shift+ArrowRight")
    opened = (first, second)
    for one in opened:
        one.until("window.reina.drawnIndex > 0 && !window.reina.playing")
    state = client.get(f"/api/v1/sessions/{first.session}/transport").json()
    for one in opened:
        assert one.until_at_rest(state) == 2 * FPS, "the second bar of the scale"
    assert first.bone_quaternions() == second.bone_quaternions()
    first.page.keyboard.press("Space")
    for one in opened:
        one.until("(left) => window.reina.playing && window.reina.drawnIndex > left", 2 * FPS)
    second.page.keyboard.press("Space")
    for one in opened:
        one.until("!window.reina.playing")
    state = client.get(f"/api/v1/sessions/{first.session}/transport").json()
    for one in opened:
        assert one.until_at_rest(state) > 2 * FPS
    assert first.bone_quaternions() == second.bone_quaternions()


def test_without_the_token_one_watches(visit: Visit) -> None:
    owner = open_scale(visit)
    watcher = visit(f"/s/{owner.session}", sound_waits=True)
    watcher.until_drawn()
    assert watcher.page.get_by_text("Watching", exact=True).is_visible()
    assert watcher.page.get_by_role("button", name="Play", exact=True).first.is_disabled()
    owner.page.keyboard.press("l")
    watcher.page.wait_for_selector(".loop")
    owner.page.keyboard.press("Space")
    sound_on = watcher.page.get_by_role("button", name="Turn the sound on")
    sound_on.click()
    watcher.until("window.reina.sound === 'ready' && window.reina.soundAhead !== null")
    sound_on.wait_for(state="detached")
    owner.page.keyboard.press("End")
    watcher.until("window.reina.songTime > 7")


def test_the_picture_shows_a_player_with_brass_in_her_hands(visit: Visit) -> None:
    opened = visit()
    opened.until_drawn()
    opened.hide_panels()
    whole = opened.picture()
    assert whole.std() > 30, "the picture is not blank"
    height, width = whole.shape[:2]
    middle = whole[height // 6 : -height // 6, width // 4 : -width // 4]
    red, green, blue = np.moveaxis(middle, 2, 0)
    lit_metal = (red > 130) & (red - green > 20) & (green - blue > 45)
    dark_blue_cloth = (blue - red > 4) & (blue < 110)
    for what, pixels in (("brass", lit_metal), ("uniform", dark_blue_cloth)):
        assert 0.004 < pixels.mean() < 0.5, f"{pixels.mean():.4f} of the picture's middle is {what}"


@pytest.mark.parametrize("size", [(390, 844), (1440, 900)], ids=["phone", "wide"])
def test_nothing_overflows_the_window(visit: Visit, size: tuple[int, int]) -> None:
    opened = visit(size=size)
    opened.until("window.reina?.session")
    page = opened.page
    for key, panel in (("p", "the piece"), ("s", "The show"), ("r", "the film"), ("?", "Keys")):
        page.keyboard.press(key)
        page.get_by_role("region", name=panel, exact=True).wait_for()
        opened.until_nothing_overflows()


def test_what_cannot_be_read_is_said_and_nothing_is_lost(visit: Visit) -> None:
    opened = visit(refusals=("400", "415", "422"))
    opened.until_drawn()
    session = opened.session
    opened.choose_files(("broken.mid", "audio/midi", b"this is no MIDI file"))
    alert = opened.page.get_by_role("alert")
    alert.wait_for()
    assert "MIDI" in alert.inner_text()
    assert opened.session == session
    assert opened.measure("session") == session


def test_an_unknown_session_says_what_to_do(visit: Visit) -> None:
    opened = visit("/s/no-such-session-0000000", refusals=("404",))
    opened.page.get_by_role("heading", name="This session is not here").wait_for()
    assert opened.page.get_by_role("link", name="Open Reina's piece").is_visible()
    opened.page.get_by_role("link", name="Open Reina's piece").click()
    opened.until_drawn()
    assert opened.session != ""
