"""docs/adding-an-instrument.md, followed to the letter: a package's instrument on a running server."""

from __future__ import annotations

import io
import json
import re
import shutil
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import httpx
import mido
import numpy as np
import pytest
from tests.integration.scores import song
from tests.integration.server import serve, upload
from tests.integration.stranger import take
from websockets.sync.client import connect

if TYPE_CHECKING:
    from collections.abc import Generator

    from tests.integration.server import Owned, Running

ROOT = Path(__file__).parents[2]
TEXT = (ROOT / "docs" / "adding-an-instrument.md").read_text(encoding="utf-8")
DRUMS, TRUMPET = 0, 1


def blocks(language: str) -> list[str]:
    return re.findall(rf"```{language}\n(.*?)```", TEXT, re.DOTALL)


def install(folder: Path, point: str = blocks("toml")[0]) -> None:
    """Put the page's module and its entry point where Python finds packages."""
    (module,) = blocks("python")
    metadata = folder / "desk_bell-1.0.dist-info"
    metadata.mkdir(parents=True)
    (folder / "desk_bell.py").write_text(module, encoding="utf-8")
    (metadata / "METADATA").write_text("Metadata-Version: 2.1\nName: desk-bell\nVersion: 1.0\n")
    entry = re.fullmatch(r'\[.*"(.*)"\]\n(\w+) = "(.*)"\n', point)
    assert entry is not None
    group, name, value = entry.groups()
    (metadata / "entry_points.txt").write_text(f"[{group}]\n{name} = {value}\n")


def score() -> bytes:
    """Drums, and a trumpet beside them."""
    midi = mido.MidiFile(ticks_per_beat=480)
    for channel, name, pitches in ((9, "Drums", (38, 38, 42, 38)), (0, "Trumpet", (65, 67, 69, 70))):
        track = mido.MidiTrack([mido.MetaMessage("track_name", name=name)])
        for pitch in pitches:
            track.append(mido.Message("note_on", note=pitch, velocity=90, channel=channel))
            track.append(mido.Message("note_off", note=pitch, time=480, channel=channel))
        midi.tracks.append(track)
    file = io.BytesIO()
    midi.save(file=file)
    return file.getvalue()


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Generator[Running]:
    """A server with the package installed and its rig and hold in the folder of rigs."""
    tmp = tmp_path_factory.mktemp("desk_bell")
    install(tmp / "package")
    rig, hold, _ = blocks("json")
    shutil.copytree(ROOT / "rigs", tmp / "rigs", ignore=shutil.ignore_patterns("build", "*.glb"))
    (tmp / "rigs" / "desk_bell").mkdir()
    (tmp / "rigs" / "desk_bell" / "rig.json").write_text(rig, encoding="utf-8")
    (tmp / "rigs" / "trumpeter" / "holds" / "desk_bell.json").write_text(hold, encoding="utf-8")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("PYTHONPATH", str(tmp / "package"), prepend=":")
        patch.setenv("REINA_RIGS", str(tmp / "rigs"))
        with serve(tmp / "data") as running:
            yield running


@pytest.fixture(scope="module")
def played(server: Running) -> Generator[Owned]:
    with httpx.Client(base_url=server.address, timeout=30) as client:
        yield upload(client, score(), song=("s.wav", song()), cast=blocks("json")[2])


def test_it_is_listed_with_whoever_has_a_hold(played: Owned) -> None:
    listed = played.client.get("/api/v1/instruments").json()["instruments"]
    bell = next(one for one in listed if one["name"] == "desk_bell")
    assert (bell["title"], bell["rig"], bell["players"]) == ("desk bell", "desk_bell", ["trumpeter"])


def test_the_cast_names_it_with_the_part_that_suits_it(played: Owned) -> None:
    castings = played.client.get(f"{played.path}/cast").raise_for_status().json()["castings"]
    assert [(one["instrument"], one["part"], one["playable"]) for one in castings] == [
        ("desk_bell", DRUMS, 4),
        ("trumpet", TRUMPET, 4),
    ]
    assert any("drums" in reason for reason in castings[0]["reasons"])


def test_its_notes_have_fingerings_of_its_kind(played: Owned) -> None:
    notes = played.client.get(f"{played.path}/score").json()["notes"]
    struck = {"type": "strike", "hand": "right", "foot": None, "piece": "button", "zone": "centre"}
    for note in notes:
        if note["part"] == DRUMS:
            assert (note["player"], note["fingering"], note["valves"]) == (0, struck, None)
        else:
            assert (note["player"], note["fingering"]["type"]) == (1, "valves")


def test_hello_has_its_skeletons_and_parameters(server: Running, played: Owned) -> None:
    with connect(server.stream(played.id), subprotocols=["reina.v1"]) as socket:  # pyright: ignore[reportArgumentType]
        hello: dict[str, Any] = json.loads(socket.recv())
    assert [(one["name"], one["rig"], one["player"]) for one in hello["skeletons"]] == [
        ("player", "trumpeter", 0),
        ("desk_bell", "desk_bell", 0),
        ("players/2/player", "soloist", 1),
        ("players/2/trumpet", "trumpet", 1),
    ]
    assert hello["skeletons"][1]["joints"] == ["desk_bell", "dome"]
    paths = {parameter["path"] for parameter in hello["parameters"]}
    assert {"desk_bell/button", "face/smile", "player/sway", "players/2/trumpet/valve/1"} <= paths
    # What a brass player alone has is the second's.
    assert "players/2/player/mute" in paths
    assert "player/mute" not in paths
    assert hello["links"]["rigs"]["desk_bell"] == "/api/v1/rigs/desk_bell"


def test_its_player_strikes_every_note_and_touches_what_is_struck(played: Owned) -> None:
    one = take(played.client, played.id, 0.0, 3.0)
    bell, player = one.skeleton("desk_bell"), one.skeleton("trumpeter")
    down = one.parameters["desk_bell/button"][:, 0]
    onsets = np.round(np.array([0.5, 1.0, 1.5]) * 60).astype(int)
    assert (down[onsets] == 1.0).all()
    between = np.round(np.array([0.25, 0.75, 1.25]) * 60).astype(int)
    assert (down[between] == 0.0).all()
    travel = np.array(bell.rig["parts"][0]["travel"])
    top = bell.named("contacts", "button") + bell.rotations["desk_bell"].apply(down[:, None] * travel)
    apart = np.linalg.norm(player.named("effectors", "rightMiddleTip") - top, axis=1)
    assert apart[down > 0].max() <= 0.0005
    assert apart[between].min() > 0.02
    # The dome, a joint of its own, gives way with the button.
    turned = np.abs(one.local["desk_bell"][:, 1, 0])
    assert turned[onsets].min() > 0.01
    assert turned[between].max() < 1e-6


def test_it_is_drawn_out_as_any_skeleton(played: Owned) -> None:
    answer = played.client.get(f"{played.path}/export.bvh", params={"skeleton": "desk_bell"})
    assert answer.raise_for_status().text.startswith("HIERARCHY\nROOT desk_bell")


@pytest.mark.parametrize(
    ("point", "told"),
    [
        ('[a."reina.instruments"]\ntrumpet = "desk_bell:DESK_BELL"\n', "is there already; rename it"),
        ('[a."reina.instruments"]\nbell = "desk_bell:DESK_BELL"\n', "has the name 'desk_bell'"),
        ('[a."reina.instruments"]\ndesk_bell = "desk_bell:GONG"\n', "cannot be loaded"),
        ('[a."reina.instruments"]\ndesk_bell = "desk_bell:DeskBell"\n', "names one, not its class"),
    ],
)
def test_one_that_cannot_be_used_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, point: str, told: str
) -> None:
    from reina.instruments.registry import InstrumentError, discover_instruments

    install(tmp_path, point)
    monkeypatch.setattr(sys, "path", [str(tmp_path), *sys.path])
    monkeypatch.delitem(sys.modules, "desk_bell", raising=False)
    with pytest.raises(InstrumentError, match=re.escape(told)):
        discover_instruments()
