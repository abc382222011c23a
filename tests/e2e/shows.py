"""A small show in a session of its own, and the show's editor open over it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from tests.integration.scores import scale

if TYPE_CHECKING:
    from collections.abc import Callable

    import httpx
    from tests.e2e.opened import Opened

    Visit = Callable[..., Opened]

WINDOW = (1000, 660)
MIDI = ("scale.mid", "audio/midi", scale(64))
"""Sixteen seconds of 4/4 at 120: a bar is two seconds."""
EXPOSURE, HAZE, COLOR = "stage/exposure", "lights/haze", "blocks/color"
SHOW: dict[str, Any] = {
    "version": 1,
    "title": "Evening",
    "time": "bars",
    "markers": [{"time": 2, "name": "Theme"}],
    "tracks": [
        {
            "parameter": EXPOSURE,
            "keyframes": [
                {"key": "k1", "time": 0, "value": 1.0},
                {"key": "k2", "time": 1, "value": 1.4},
                {"key": "k3", "time": 2, "value": 0.8, "interpolation": "cubic_bezier"},
            ],
        },
        {"parameter": HAZE, "keyframes": [{"key": "h1", "time": 1, "value": 0.2}]},
        {"parameter": COLOR, "keyframes": [{"key": "c1", "time": 0, "value": "#D9A441"}]},
    ],
}


ROOM_MADE = """() => {
  const foot = document.querySelector("footer");
  const known = document.querySelector(".chrome").style.getPropertyValue("--foot");
  return foot.querySelector("[aria-label^=Position]") === null && known === `${foot.clientHeight}px`;
}"""
"""The transport below the editor has become lower for it."""
LAID_OUT = """() => {
  const { show } = window.reina;
  const lanes = document.querySelector(".lanes").getBoundingClientRect();
  return lanes.width > 0 && Math.abs(show.time(show.window[1]).x - lanes.right) < 1;
}"""
"""The timeline knows how wide it is: a browser tells with its next picture."""


class ShowPage:
    """A page with the show's editor open, and the server's own word on its show."""

    def __init__(self, opened: Opened, client: httpx.Client) -> None:
        self.opened = opened
        self.page = opened.page
        self.client = client
        tokens = self.page.evaluate("JSON.parse(localStorage.reina).tokens")
        self.session = {"id": opened.session, "control_token": tokens.get(opened.session, "")}
        self.headers = {"Authorization": f"Bearer {tokens.get(opened.session, '')}"}
        self.path = f"/api/v1/sessions/{opened.session}/show"

    def open(self) -> ShowPage:
        """Open the editor and wait until it shows the show."""
        self.page.keyboard.press("s")
        self.opened.until("window.reina.show !== undefined && window.reina.show.keyframes > 0")
        self.opened.until(ROOM_MADE)
        self.until_laid_out()
        return self

    def until_laid_out(self) -> None:
        """Wait until what the timeline draws stands where its width has it."""
        self.opened.until(LAID_OUT)

    def afresh(self) -> ShowPage:
        """Put the show above there again, and open the editor anew."""
        # What the test before left on its way would come on top of it.
        self.opened.until("window.reina.show === undefined || window.reina.show.waiting === 0")
        self.page.evaluate("document.querySelector('[aria-label=\"Close the show\"]')?.click()")
        self.opened.until("window.reina.show === undefined")
        self.client.put(self.path, json=SHOW, headers=self.headers).raise_for_status()
        self.seek(0.0)
        return self.open()

    def measure(self, name: str) -> Any:
        """A figure of `window.reina.show`."""
        return self.page.evaluate("(name) => window.reina.show[name]", name)

    def key(self, path: str, key: str, component: int = 0) -> tuple[float, float]:
        """Where a keyframe's mark is in the window."""
        point = self.page.evaluate("(asked) => window.reina.show.key(...asked)", [path, key, component])
        assert point is not None, f"{path} shows no keyframe {key}"
        return point["x"], point["y"]

    def ruler(self, song_time_s: float) -> tuple[float, float]:
        """The ruler at a song time."""
        point = self.page.evaluate("(time) => window.reina.show.time(time)", song_time_s)
        return point["x"], point["y"]

    def drag(self, begin: tuple[float, float], end: tuple[float, float]) -> None:
        """Press the mouse at one place and let go at another."""
        self.page.mouse.move(*begin)
        self.page.mouse.down()
        self.page.mouse.move(*end, steps=4)
        self.page.mouse.up()

    def until_saved(self) -> None:
        """Wait for the page's own sign that the server has everything."""
        self.opened.until("window.reina.show.saving === 'saved' && window.reina.show.waiting === 0")

    def track(self, path: str) -> dict[str, Any]:
        """A track as the server has it."""
        return self.client.get(f"{self.path}/tracks/{path}").raise_for_status().json()

    def times(self, path: str) -> dict[str, float]:
        """The times of a track's keyframes on the server, by key."""
        self.until_saved()
        return {keyframe["key"]: keyframe["time"] for keyframe in self.track(path)["keyframes"]}

    def keyframe(self, path: str, key: str) -> dict[str, Any]:
        """A keyframe as the server has it."""
        self.until_saved()
        return self.client.get(f"{self.path}/tracks/{path}/keyframes/{key}").raise_for_status().json()

    def edit(self, *edits: dict[str, Any]) -> None:
        """An edit that does not come from this page."""
        self.client.post(f"{self.path}/edits", json=list(edits), headers=self.headers).raise_for_status()

    def seek(self, song_time_s: float) -> None:
        """Put the playhead somewhere and wait until it is drawn there."""
        path = self.path.removesuffix("/show")
        command = {"action": "seek", "song_time_s": song_time_s}
        answer = self.client.post(f"{path}/transport", json=command, headers=self.headers)
        self.opened.until_at_rest(answer.raise_for_status().json())


def made_session(client: httpx.Client) -> dict[str, Any]:
    """A session of a scale with the show above."""
    made = client.post("/api/v1/sessions", files={"score": (MIDI[0], MIDI[2])}).raise_for_status().json()
    headers = {"Authorization": f"Bearer {made['control_token']}"}
    client.put(f"/api/v1/sessions/{made['id']}/show", json=SHOW, headers=headers).raise_for_status()
    return made


def remembering(session: dict[str, Any], *, token: bool = True) -> dict[str, Any]:
    """What a browser keeps that has been here before, by default with the token that controls a session."""
    tokens = {session["id"]: session["control_token"]} if token else {}
    return {"tokens": tokens, "hasPlayed": True, "editorHeight": 400}


def open_show(
    visit: Visit, client: httpx.Client, session: dict[str, Any], *, token: bool = True, **options: Any
) -> ShowPage:
    """Another browser with a session's editor open in it."""
    remembers = remembering(session, token=token)
    opened = visit(f"/s/{session['id']}", remembers=remembers, **({"size": WINDOW} | options))
    opened.until_drawn()
    return ShowPage(opened, client).open()
