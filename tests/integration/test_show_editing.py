"""Several hands on one show: conditions, edits as one step, and the way back."""

from __future__ import annotations

import asyncio
import re
import struct
import time
from typing import TYPE_CHECKING, Any

import httpx
import pytest
from tests.integration.scores import scale, song
from tests.integration.server import upload
from tests.integration.watching import Watcher, watch

from reina.protocol import FrameFlag

if TYPE_CHECKING:
    from collections.abc import Callable

    from tests.integration.server import Owned, Running

LIGHT, FOV, RIM = "lights/key/intensity", "camera/fov", "lights/rim/intensity"
TRACK, OTHER_TRACK = f"/show/tracks/{LIGHT}", f"/show/tracks/{FOV}"
KEYS = f"{TRACK}/keyframes"
SHOW = {
    "version": 1,
    "tracks": [
        {"parameter": LIGHT, "keyframes": [{"key": "k1", "time": 0.0, "value": 1.0}]},
        {"parameter": FOV, "keyframes": [{"key": "k1", "time": 0.0, "value": 0.5}]},
    ],
}


@pytest.fixture
def shown(owned: Owned) -> Owned:
    """A session with a show of two tracks."""
    owned.change("PUT", "/show", json=SHOW).raise_for_status()
    return owned


def etag(owned: Owned, below: str = "/show") -> str:
    return owned.client.get(f"{owned.path}{below}").raise_for_status().headers["etag"]


def request(owned: Owned, method: str, below: str, etag: str, body: object = None) -> httpx.Response:
    """A write under a condition."""
    headers = {**owned.headers, "If-Match": etag}
    content: dict[str, Any] = {} if body is None else {"json": body}
    return owned.client.request(method, f"{owned.path}{below}", headers=headers, **content)


WRITES: list[tuple[str, str, object]] = [
    ("PUT", "/show", {"version": 1, "tracks": []}),
    ("POST", "/show/edits", [{"edit": "remove_track", "parameter": LIGHT}]),
    ("POST", "/show/undo", None),
    ("PUT", TRACK, {"keyframes": [{"time": 1.0, "value": 2.0}]}),
    ("DELETE", TRACK, None),
    ("POST", KEYS, {"time": 5.0, "value": 1.0}),
    ("PATCH", f"{KEYS}/k1", {"value": 2.5}),
    ("DELETE", f"{KEYS}/k1", None),
]
IDS = [f"{method} {below.removeprefix('/show')}" for method, below, _ in WRITES]


@pytest.mark.parametrize(("method", "below", "body"), WRITES, ids=IDS)
def test_a_stale_write_is_refused_and_a_fresh_one_made(
    shown: Owned, method: str, below: str, body: object
) -> None:
    known = etag(shown)
    shown.change("PATCH", f"{KEYS}/k1", json={"value": 1.5}).raise_for_status()
    before = shown.client.get(f"{shown.path}/show")
    refused = request(shown, method, below, known, body)
    assert refused.status_code == 412
    assert refused.headers["content-type"] == "application/problem+json"
    assert refused.json()["type"] == "urn:reina:problem:stale-write"
    assert shown.client.get(f"{shown.path}/show").text == before.text
    for condition in ('W/"x", "y"', f"W/{before.headers['etag']}", "nonsense", ""):
        assert request(shown, method, below, condition, body).status_code == 412
    made = request(shown, method, below, f'"other", {before.headers["etag"]}', body)
    assert made.is_success, made.text
    assert etag(shown) != before.headers["etag"]


def test_a_track_has_a_validator_of_its_own(shown: Owned) -> None:
    known = etag(shown, TRACK)
    assert known == etag(shown, KEYS) == etag(shown, f"{KEYS}/k1") != etag(shown, OTHER_TRACK)
    shown.change("PATCH", f"{OTHER_TRACK}/keyframes/k1", json={"value": 0.6}).raise_for_status()
    assert etag(shown, TRACK) == known, "another track is no matter"
    added = request(shown, "POST", KEYS, known, {"time": 2.0, "value": 3.0})
    assert added.status_code == 201
    assert added.headers["etag"] == etag(shown, TRACK) != known
    assert added.headers["location"] == f"{shown.path}{KEYS}/k2"
    assert shown.client.get(added.headers["location"]).json() == added.json()
    assert request(shown, "DELETE", f"{KEYS}/k2", known).status_code == 412
    assert request(shown, "DELETE", f"{KEYS}/k2", added.headers["etag"]).status_code == 204
    assert etag(shown, TRACK) == known, "the same track again"


def test_a_batch_is_one_step_and_its_answer_is_the_show_that_came_of_it(shown: Owned) -> None:
    edits = [
        {"edit": "move_keyframes", "keyframes": {LIGHT: ["k1"], FOV: ["k1"]}, "by": 1, "value_by": 0.1},
        {"edit": "change_track", "parameter": FOV, "changes": {"muted": True}},
        {"edit": "copy_track", "parameter": LIGHT, "to": "lights/rim/intensity"},
        {"edit": "change_show", "changes": {"markers": [{"time": 1, "name": "Here"}]}},
    ]
    before = shown.client.get(f"{shown.path}/show").json()
    answer = request(shown, "POST", "/show/edits", etag(shown), edits).raise_for_status()
    told = answer.json()
    assert answer.headers["etag"] == told["etag"] == etag(shown)
    now = shown.client.get(f"{shown.path}/show").json()
    assert told["tracks"] == now.pop("tracks")
    assert told["head"] == now
    assert now["markers"] == [{"time": 1, "name": "Here"}]
    assert told["removed"] == []
    undone = request(shown, "POST", "/show/undo", told["etag"]).raise_for_status().json()
    assert undone["removed"] == ["lights/rim/intensity"]
    assert shown.client.get(f"{shown.path}/show").json() == before


def test_a_brief_answer_leaves_the_tracks_out(shown: Owned) -> None:
    headers = {**shown.headers, "Prefer": "respond-async, return=minimal"}
    edits = [{"edit": "change_keyframe", "parameter": FOV, "key": "k1", "changes": {"value": 0.4}}]
    answer = shown.client.post(f"{shown.path}/show/edits", json=edits, headers=headers).raise_for_status()
    assert answer.headers["preference-applied"] == "return=minimal"
    assert answer.json()["tracks"] == []
    assert answer.json()["etag"] == etag(shown)
    some = shown.client.get(f"{shown.path}/show", params={"parameter": [FOV, "no/such"]}).json()
    assert [track["keyframes"][0]["value"] for track in some["tracks"]] == [0.4]


def test_what_is_muted_rests_and_what_is_solo_is_heard_alone(shown: Owned) -> None:
    paths = (LIGHT, FOV)

    def values() -> tuple[float, ...]:
        manifest = shown.client.get(f"{shown.path}/manifest").json()
        frame = shown.client.get(f"{shown.path}/frames", params={"start_s": 1, "end_s": 1.01}).content
        offsets = {entry["path"]: entry["offset"] for entry in manifest["parameters"]}
        return tuple(round(struct.unpack_from("<f", frame, offsets[path])[0], 5) for path in paths)

    def change(path: str, **changes: object) -> None:
        edit = {"edit": "change_track", "parameter": path, "changes": changes}
        shown.change("POST", "/show/edits", json=[edit]).raise_for_status()

    parameters = shown.client.get("/api/v1/parameters").json()["parameters"]
    defaults = {entry["path"]: entry["default"] for entry in parameters}
    rests = tuple(round(defaults[path], 5) for path in paths)
    own = (1.0, 0.5)
    assert values() == own
    change(LIGHT, muted=True)
    assert values() == (rests[0], own[1])
    change(LIGHT, muted=None, solo=True)
    assert values() == (own[0], rests[1])
    change(FOV, solo=True)
    assert values() == own
    change(FOV, muted=True)
    assert values() == (own[0], rests[1]), "a muted track stays so"
    change(LIGHT, solo=None)
    assert values() == rests, "what is solo and muted alone leaves nothing"


def test_who_watches_hears_which_tracks_changed(server: Running, shown: Owned) -> None:
    async def scenario() -> list[object]:
        async with watch(server, shown.id) as watcher:
            for edits in (
                [
                    {"edit": "remove_keyframe", "parameter": LIGHT, "key": "k1"},
                    {"edit": "change_keyframe", "parameter": FOV, "key": "k1", "changes": {"value": 0.4}},
                ],
                [{"edit": "change_show", "changes": {"title": "Other"}}],
            ):
                answer = await asyncio.to_thread(shown.change, "POST", "/show/edits", json=edits)
                answer.raise_for_status()
            await watcher.until(lambda: len(watcher.of_type("show_changed")) == 2)
            return [told["paths"] for told in watcher.of_type("show_changed")]

    assert asyncio.run(scenario()) == [[LIGHT, FOV], None]


def test_of_two_who_add_the_first_keyframe_one_is_refused(shown: Owned) -> None:
    below = "/show/tracks/camera/roll/keyframes"
    known = etag(shown, below)
    statuses = [
        request(shown, "POST", below, known, {"time": float(n), "value": 0.1}).status_code for n in range(2)
    ]
    assert statuses == [201, 412]


def test_what_is_known_is_not_sent_again(shown: Owned) -> None:
    for below in ("/show", TRACK, KEYS, f"{KEYS}/k1"):
        first = shown.client.get(f"{shown.path}{below}")
        again = {"If-None-Match": first.headers["etag"]}
        assert shown.client.get(f"{shown.path}{below}", headers=again).status_code == 304
        assert shown.client.get(f"{shown.path}{below}", headers={"If-None-Match": '"x"'}).text == first.text


def test_writes_at_the_same_time_under_one_condition_leave_one(server: Running, shown: Owned) -> None:
    headers = {**shown.headers, "If-Match": etag(shown)}

    async def scenario() -> list[int]:
        async with httpx.AsyncClient(base_url=server.address, timeout=30) as client:
            url = f"{shown.path}{KEYS}"
            bodies = [{"time": float(n), "value": 1.0} for n in range(1, 9)]
            answers = await asyncio.gather(*(client.post(url, json=b, headers=headers) for b in bodies))
        return sorted(answer.status_code for answer in answers)

    assert asyncio.run(scenario()) == [201] + [412] * 7
    assert len(shown.client.get(f"{shown.path}{KEYS}").json()["keyframes"]) == 2


def test_a_whole_track_is_put_read_and_removed(shown: Owned) -> None:
    document = {
        "time": "beats",
        "after": "loop",
        "keyframes": [
            {"key": "a", "time": 0.0, "value": 1.0, "interpolation": "linear"},
            {"key": "b", "time": 4.0, "value": 2.0, "interpolation": "sine_in_out"},
        ],
    }
    put = shown.change("PUT", TRACK, json=document)
    assert put.json() == {"parameter": LIGHT, **document}
    assert shown.client.get(f"{shown.path}{TRACK}").json() == put.json()
    assert put.headers["etag"] == etag(shown, TRACK)
    refused: list[tuple[dict[str, Any], int]] = [
        ({"parameter": FOV, "keyframes": []}, 422),
        ({"keyframes": []}, 422),
        ({"keyframes": [{"time": "now", "value": 1}]}, 422),
        ({"muted": "yes", **document}, 422),
    ]
    for body, status in refused:
        assert shown.change("PUT", TRACK, json=body).status_code == status
    assert shown.change("PUT", "/show/tracks/no/such", json=document).status_code == 404
    assert shown.client.get(f"{shown.path}{TRACK}").json() == put.json()
    assert shown.change("DELETE", TRACK).status_code == 204
    assert shown.client.get(f"{shown.path}{TRACK}").status_code == 404
    assert shown.change("DELETE", TRACK).status_code == 404


def test_a_key_of_no_letters_is_refused(shown: Owned) -> None:
    keyframe = {"key": "", "time": 3, "value": 1}
    for method, below, body in (
        ("POST", "/show/tracks/lights/key/intensity/keyframes", keyframe),
        ("PUT", "/show/tracks/lights/key/intensity", {"keyframes": [keyframe]}),
        (
            "POST",
            "/show/edits",
            [{"edit": "add_keyframe", "parameter": "lights/key/intensity", "keyframe": keyframe}],
        ),
    ):
        answer = shown.change(method, below, json=body)
        assert answer.status_code == 422, (method, below)
        assert "a key has 1 to 64 letters" in answer.json()["detail"]


def test_several_edits_are_one_step_and_all_or_none(shown: Owned) -> None:
    before = shown.client.get(f"{shown.path}/show").json()
    edits: list[dict[str, Any]] = [
        {"edit": "add_keyframe", "parameter": LIGHT, "keyframe": {"key": "k2", "time": 4.0, "value": 3.0}},
        # Two keyframes change places: in between they stand at one time.
        {"edit": "change_keyframe", "parameter": LIGHT, "key": "k1", "changes": {"time": 4.0}},
        {"edit": "change_keyframe", "parameter": LIGHT, "key": "k2", "changes": {"time": 0.0}},
        {"edit": "remove_track", "parameter": FOV},
        {"edit": "put_track", "track": {"parameter": "blocks/glow", "keyframes": [{"time": 0, "value": 2}]}},
    ]
    done = shown.change("POST", "/show/edits", json=edits).raise_for_status()
    told = done.json()
    assert told["removed"] == [FOV]
    assert [track["parameter"] for track in told["tracks"]] == [LIGHT, "blocks/glow"]
    assert [key["key"] for key in told["tracks"][0]["keyframes"]] == ["k2", "k1"]
    assert told["etag"] == done.headers["etag"] == etag(shown)
    history = shown.client.get(f"{shown.path}/show/history").json()
    assert history == {name: told[name] for name in ("revision", "etag", "undo", "redo")}
    after = shown.client.get(f"{shown.path}/show").json()
    assert after["tracks"] == told["tracks"]
    undone = shown.change("POST", "/show/undo").raise_for_status().json()
    assert shown.client.get(f"{shown.path}/show").json() == before
    assert (undone["undo"], undone["redo"]) == (told["undo"] - 1, 1)
    assert undone["removed"] == ["blocks/glow"]
    assert {track["parameter"] for track in undone["tracks"]} == {LIGHT, FOV}
    shown.change("POST", "/show/redo").raise_for_status()
    assert shown.client.get(f"{shown.path}/show").json() == after


@pytest.mark.parametrize(
    ("edits", "status", "told"),
    [
        ([{"edit": "paint", "parameter": LIGHT}], 422, "'paint' is none of"),
        ([{"edit": "add_keyframe", "parameter": LIGHT}], 422, "edits/0/keyframe"),
        ({"edit": "remove_track"}, 422, "list"),
        ([{"edit": "remove_track", "parameter": "camera/roll"}], 409, "no such track"),
        ([{"edit": "remove_keyframe", "parameter": LIGHT, "key": "k9"}], 409, "k9"),
        (
            [{"edit": "add_keyframe", "parameter": LIGHT, "keyframe": {"time": 0, "value": 2}}],
            422,
            "stands at",
        ),
    ],
)
def test_one_edit_that_cannot_be_undoes_the_others(shown: Owned, edits: Any, status: int, told: str) -> None:
    before = shown.client.get(f"{shown.path}/show").text
    good = {"edit": "change_keyframe", "parameter": FOV, "key": "k1", "changes": {"value": 0.7}}
    answer = shown.change("POST", "/show/edits", json=[*edits, good] if isinstance(edits, list) else edits)
    assert answer.status_code == status, answer.text
    assert told in answer.json()["detail"]
    assert shown.client.get(f"{shown.path}/show").text == before
    no_json = shown.change("POST", "/show/edits", content=b"[")
    assert no_json.status_code == 422


def test_undo_and_redo_end_where_the_history_does(shown: Owned) -> None:
    fresh = shown.client.get(f"{shown.path}/show/history").json()
    states = [shown.client.get(f"{shown.path}/show").text]
    for number in range(3):
        shown.change("PATCH", f"{KEYS}/k1", json={"value": 2.0 + number}).raise_for_status()
        states.append(shown.client.get(f"{shown.path}/show").text)
    for state in reversed(states[:-1]):
        shown.change("POST", "/show/undo").raise_for_status()
        assert shown.client.get(f"{shown.path}/show").text == state
    for state in states[1:]:
        shown.change("POST", "/show/redo").raise_for_status()
        assert shown.client.get(f"{shown.path}/show").text == state
    refused = shown.change("POST", "/show/redo")
    assert (refused.status_code, refused.json()["type"]) == (409, "urn:reina:problem:nothing-to-redo")
    for _ in range(fresh["undo"] + 3):
        shown.change("POST", "/show/undo").raise_for_status()
    refused = shown.change("POST", "/show/undo")
    assert (refused.status_code, refused.json()["type"]) == (409, "urn:reina:problem:nothing-to-undo")
    shown.change("PATCH", "", json={"title": "An edit ends what could be done again"})
    assert shown.client.get(f"{shown.path}/show/history").json()["redo"] == fresh["undo"] + 3
    shown.change("PUT", "/show", json={"version": 1, "title": "Other", "tracks": []}).raise_for_status()
    assert shown.client.get(f"{shown.path}/show/history").json()["redo"] == 0


def test_what_changes_nothing_is_no_edit(server: Running, shown: Owned) -> None:
    async def scenario() -> None:
        async with watch(server, shown.id) as watcher:
            before = shown.client.get(f"{shown.path}/show/history").json()
            same = await asyncio.to_thread(shown.change, "PUT", "/show", json=SHOW)
            assert same.headers["etag"] == before["etag"]
            assert shown.client.get(f"{shown.path}/show/history").json() == before
            await asyncio.to_thread(lambda: shown.change("PATCH", f"{KEYS}/k1", json={"value": 9.0}))
            await watcher.until(lambda: watcher.of_type("show_changed"))
            [told] = watcher.of_type("show_changed")
            assert told["revision"] == before["revision"] + 1

    asyncio.run(scenario())


def parameter(watcher: Watcher, path: str) -> list[float]:
    """A parameter's first float in all frames so far."""
    entry = next(entry for entry in watcher.manifest.parameters if entry.path == path)
    column = (entry.offset - min(other.offset for other in watcher.manifest.parameters)) // 4
    return [float(value) for value in watcher.frames["parameters"][:, column]]


def test_every_kind_of_change_is_in_everybodys_frames_within_two_frames(
    server: Running, shown: Owned
) -> None:
    def edits(*listed: dict[str, Any]) -> Callable[[], httpx.Response]:
        return lambda: shown.change("POST", "/show/edits", json=list(listed))

    parameters = shown.client.get("/api/v1/parameters").json()["parameters"]
    at_rest = next(entry["default"] for entry in parameters if entry["path"] == LIGHT)
    changes: list[tuple[Callable[[], httpx.Response], float, str | None]] = [
        (lambda: shown.change("PATCH", f"{KEYS}/k1", json={"value": 2.0}), 2.0, LIGHT),
        (lambda: shown.change("PUT", TRACK, json={"keyframes": [{"time": 0, "value": 3.0}]}), 3.0, LIGHT),
        (
            lambda: shown.change(
                "POST",
                "/show/edits",
                json=[
                    {"edit": "change_keyframe", "parameter": LIGHT, "key": "k1", "changes": {"value": 4.0}},
                    {"edit": "change_keyframe", "parameter": FOV, "key": "k1", "changes": {"value": 0.6}},
                ],
            ),
            4.0,
            None,
        ),
        (lambda: shown.change("POST", "/show/undo"), 3.0, None),
        (lambda: shown.change("POST", "/show/redo"), 4.0, None),
        (edits({"edit": "change_track", "parameter": LIGHT, "changes": {"muted": True}}), at_rest, LIGHT),
        (edits({"edit": "change_track", "parameter": LIGHT, "changes": {"muted": None}}), 4.0, LIGHT),
        (edits({"edit": "move_keyframes", "keyframes": {LIGHT: ["k1"]}, "value_by": 0.5}), 4.5, LIGHT),
        (
            edits(
                {"edit": "put_track", "track": {"parameter": RIM, "keyframes": [{"time": 0, "value": 1.5}]}},
                {"edit": "copy_track", "parameter": RIM, "to": LIGHT},
            ),
            1.5,
            None,
        ),
        (lambda: shown.change("PUT", "/show", json=SHOW), 1.0, None),
    ]

    async def scenario() -> None:
        async with watch(server, shown.id) as one, watch(server, shown.id) as two:
            state = await asyncio.to_thread(shown.control, "play")
            for number, (change, value, path) in enumerate(changes, start=1):
                epoch = state["epoch"] + number
                # More than what is sent ahead at once: it plays.
                await one.until(lambda now=epoch - 1: (one.frames["epoch"] == now % 256).sum() > 8)
                asked_s = time.monotonic()
                answer = (await asyncio.to_thread(change)).raise_for_status()
                answered_s = time.monotonic()
                for watcher in (one, two):
                    await watcher.frame(0, epoch=epoch)
                    told = watcher.of_type("show_changed")[-1]
                    assert told["path"] == path
                    assert told["etag"] == etag(shown)
                    frames, values = watcher.frames, parameter(watcher, LIGHT)
                    edited = frames["epoch"] == epoch % 256
                    seen = {round(v, 5) for v, new in zip(values, edited, strict=True) if new}
                    assert seen == {value}
                    first = frames[edited][0]
                    assert first["flags"] & FrameFlag.FIRST
                    # Nothing of the old show comes after the new; so the old frames that are shown once the
                    # answer is there are those due between then and the first edited one.
                    old = frames[~edited]
                    late = (old["due_time_s"] >= answered_s) & (old["due_time_s"] < first["due_time_s"])
                    assert late.sum() <= 2
                    # What is on screen when the edit is asked for is the earliest that can show it.
                    assert first["due_time_s"] >= asked_s - 2 / 60
                assert answer.is_success
            await asyncio.to_thread(shown.control, "pause")

    asyncio.run(scenario())


def test_the_library_holds_shows_that_can_be_put_on(shown: Owned) -> None:
    listed = shown.client.get("/api/v1/shows").json()["shows"]
    assert {"default", "prince-of-denmarks-march"} <= {entry["name"] for entry in listed}
    for entry in listed:
        assert entry["title"]
        document = shown.client.get(entry["href"]).raise_for_status().json()
        put = shown.change("PUT", "/show", json=document).raise_for_status()
        assert len(put.json()["tracks"]) == len(document["tracks"])


def test_the_schema_is_of_this_servers_parameters(shown: Owned) -> None:
    schema = shown.client.get("/api/v1/shows/schema").json()
    known = {entry["path"] for entry in shown.client.get("/api/v1/parameters").json()["parameters"]}
    described = [rule["if"]["properties"]["parameter"] for rule in schema["$defs"]["track"]["allOf"]]
    patterns = [name.get("pattern") or f"^{name['const']}$" for name in described]
    for path in known:
        assert sum(re.search(pattern, path) is not None for pattern in patterns) == 1, path
    # One rule each for the stage's and for the first player's; the others' have the same by a pattern.
    assert len(described) == len([path for path in known if not path.startswith("players/")])


def test_a_track_may_answer_the_notes(shown: Owned) -> None:
    flash = {"on": "notes", "decay": 0.1, "amount": 2.0, "blend": "add"}
    keyframes = [{"time": 0, "value": 1.0}]
    shown.change("PUT", "/show/tracks/blocks/glow", json={"events": flash, "keyframes": keyframes})
    answer = shown.client.get(f"{shown.path}/frames", params={"end_s": 1.0})
    manifest = shown.client.get(f"{shown.path}/manifest").json()
    entry = next(entry for entry in manifest["parameters"] if entry["path"] == "blocks/glow")
    size, offset = manifest["frame_size"], entry["offset"]
    glow = [struct.unpack_from("<f", answer.content, k * size + offset)[0] for k in range(60)]
    # Notes begin every quarter of a second, every 15 frames.
    assert [round(glow[k], 4) for k in (0, 15, 30, 45)] == [3.0] * 4
    assert [round(glow[k], 4) for k in (7, 14, 29, 44)] == [1.0] * 4
    assert 1.0 < glow[3] < glow[1] < 3.0


def test_a_show_of_one_piece_is_put_on_another_and_what_does_not_fit_is_told(
    client: httpx.Client, shown: Owned
) -> None:
    """Two seconds of 4/4 at 120 here (and four more to settle); there 8 seconds at 60."""
    document = {
        "version": 1,
        "time": "bars",
        "markers": [{"time": 0, "name": "Begin"}, {"time": 9, "name": "Coda"}],
        "tracks": [
            {
                "parameter": LIGHT,
                "keyframes": [
                    {"key": "k1", "time": 0, "value": 1.0},
                    {"key": "k2", "time": 1, "value": 3.0},
                    {"key": "k3", "time": 50, "value": 2.0},
                ],
            },
            {"parameter": FOV, "events": {"on": "notes", "where": {"part": 4}, "amount": 1, "decay": 1}},
            {"parameter": "smoke/density", "keyframes": [{"time": 0, "value": 1, "colour": "grey"}]},
        ],
    }
    shown.change("PUT", "/show", json=document).raise_for_status()
    exported = shown.client.get(f"{shown.path}/show").content
    other = upload(client, scale(16, bpm=60.0), song=("song.wav", song()), show=("show.json", exported))
    try:
        assert client.get(f"{other.path}/show").json() == shown.client.get(f"{shown.path}/show").json()
        told = client.get(f"{other.path}/show/warnings").raise_for_status().json()["warnings"]
        assert [(warning["kind"], warning["place"]) for warning in told] == [
            ("show-unknown-parameter", "smoke/density"),
            ("show-keyframes-after-the-end", LIGHT),
            ("show-markers-after-the-end", "markers"),
            ("show-never-answers", FOV),
        ]
        assert "1 of its 3 keyframes stands after the end, which is at 3 bars" in told[1]["message"]
        assert "Coda" in told[2]["message"]
        assert "part 4, and the parts are 0 to 0" in told[3]["message"]
        assert [w for w in other.body["warnings"] if w["kind"].startswith("show-")] == told
        curve = {"parameter": LIGHT, "start_s": 0, "end_s": 4, "points": 3}
        for session, values in ((shown, [1, 3.0, 3.0]), (other, [1, 2, 3])):
            answer = client.get(f"{session.path}/show/curves", params=curve).json()
            assert answer["curves"][0]["keys"]["values"][0] == pytest.approx(values, abs=0.1)
    finally:
        other.change("DELETE")


def test_a_show_that_fits_has_no_warnings(shown: Owned) -> None:
    assert shown.client.get(f"{shown.path}/show/warnings").json() == {"warnings": []}


def test_the_shows_of_bundled_pieces_fit_them(client: httpx.Client) -> None:
    examples = client.get("/api/v1/examples").json()["examples"]
    assert examples[0]["name"] == "prince-of-denmarks-march"
    with_show = [example for example in examples if example["show"]]
    assert examples[: len(with_show)] == with_show
    assert len(with_show) >= 2
    for example in with_show:
        score, show = (client.get(example[file]).raise_for_status().content for file in ("score", "show"))
        name = example["score"].rpartition("/")[2]
        session = upload(client, score, name, song=("song.wav", song()), show=("show.json", show))
        try:
            assert client.get(f"{session.path}/show/warnings").json() == {"warnings": []}, example["name"]
        finally:
            session.change("DELETE")
