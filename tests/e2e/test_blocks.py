"""The note blocks' colour, which the bundled show changes by keyframes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

if TYPE_CHECKING:
    from collections.abc import Callable

    import httpx
    from numpy.typing import NDArray
    from tests.e2e.opened import Opened

    Visit = Callable[..., Opened]

pytestmark = pytest.mark.browser


def linear(colour: str) -> NDArray[np.float64]:
    """`#RRGGBB` as linear sRGB (IEC 61966-2-1)."""
    encoded = np.array([int(colour[place : place + 2], 16) for place in (1, 3, 5)]) / 255
    return np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)


def warmth(colour: NDArray[Any]) -> float:
    """How much more red than blue there is, as a share of both."""
    red, _, blue = colour.tolist()
    return (red - blue) / (red + blue)


def test_the_blocks_change_colour_by_keyframes(visit: Visit, client: httpx.Client) -> None:
    opened = visit()
    opened.until_drawn()
    path = f"/api/v1/sessions/{opened.session}"
    bar_lines_s = client.get(f"{path}/score").json()["bar_lines_s"]
    show = client.get(f"{path}/show").json()
    assert show["time"] == "bars"
    (track,) = [track for track in show["tracks"] if track["parameter"] == "blocks/color"]
    heard = [keyframe for keyframe in track["keyframes"] if keyframe["time"] < len(bar_lines_s)]
    by_warmth = sorted(heard, key=lambda keyframe: warmth(linear(keyframe["value"])))
    cold, warm = by_warmth[0], by_warmth[-1]
    opened.hide_panels()
    opened.page.locator("canvas[role=application]").press("ArrowUp")

    def at(keyframe: dict[str, Any]) -> NDArray[np.int16]:
        """The picture at a keyframe's bar, seen from where the camera was taken."""
        seek = {"action": "seek", "song_time_s": bar_lines_s[int(keyframe["time"])]}
        answer = client.post(f"{path}/transport", json=seek, headers=opened.headers)
        opened.until_at_rest(answer.json())
        return opened.picture()

    seen: list[NDArray[np.int16]] = []
    for keyframe in (warm, cold):
        seen.append(at(keyframe))
        np.testing.assert_allclose(opened.parameter("blocks/color"), linear(keyframe["value"]), atol=0.01)

    hidden = {"time": 0, "value": False, "interpolation": "step"}
    answer = client.post(f"{path}/show/tracks/blocks/visible/keyframes", json=hidden, headers=opened.headers)
    assert answer.status_code == 201, answer.text
    without = [at(keyframe) for keyframe in (warm, cold)]
    assert opened.parameter("blocks/visible") == [0]

    colours: list[NDArray[np.float64]] = []
    for shown, room in zip(seen, without, strict=True):
        blocks = np.abs(shown - room).max(axis=2) > 40
        assert blocks.mean() > 0.002, "the blocks are in the picture"
        colours.append(shown[blocks].mean(axis=0))
    assert warmth(colours[0]) > warmth(colours[1]) + 0.2, f"mean colours of the blocks: {colours}"
