"""Motion as a file."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING

import mido
import numpy as np
import pytest
from tests.integration.scores import scale, song
from tests.integration.server import upload
from tests.integration.stranger import take

from reina.rotations import multiply, rotate
from reina.skeleton import read_bvh

if TYPE_CHECKING:
    import httpx
    from tests.integration.server import Owned


@pytest.mark.parametrize(("skeleton", "rig"), [("player", "trumpeter"), ("trumpet", "trumpet")])
def test_a_bvh_file_has_every_joint_where_the_frames_have_it(owned: Owned, skeleton: str, rig: str) -> None:
    span = {"start_s": 0.7, "end_s": 2.4, "fps": 30}
    answer = owned.client.get(f"{owned.path}/export.bvh", params={**span, "skeleton": skeleton})
    assert answer.headers["content-type"].startswith("text/plain")
    clip = read_bvh(answer.content)
    frames = take(owned.client, owned.id, 0.7, 2.4, 30).skeleton(rig)
    rotations, translations = clip.motion()
    positions, world = translations.copy(), rotations.copy()
    for joint, parent in enumerate(clip.parents.tolist()):
        if parent >= 0:
            positions[:, joint] = positions[:, parent] + rotate(world[:, parent], translations[:, joint])
            world[:, joint] = multiply(world[:, parent], rotations[:, joint])
    assert set(clip.names) == set(frames.positions)
    for joint, name in enumerate(clip.names):
        assert np.abs(positions[:, joint] - frames.positions[name]).max() < 1e-5, name


def test_a_bvh_file_is_named_after_the_piece(client: httpx.Client) -> None:
    session = upload(client, scale(2), song=("s.wav", song()), title='Ständchen: "Abend" / 1')
    named = client.get(f"{session.path}/export.bvh", params={"end_s": 0.1}).headers["content-disposition"]
    assert named == "attachment; filename*=UTF-8''St%C3%A4ndchen%20Abend%201%20-%20player.bvh"
    session.change("DELETE")


@pytest.mark.parametrize(
    ("query", "told"),
    [
        ({"skeleton": "drums"}, "player, trumpet, not 'drums'"),
        ({"end_s": 601}, "600"),
        ({"start_s": 2, "end_s": 1}, "end_s"),
        ({"fps": 1000}, "240"),
    ],
)
def test_an_export_that_cannot_be_is_refused(owned: Owned, query: dict[str, str], told: str) -> None:
    answer = owned.client.get(f"{owned.path}/export.bvh", params=query)
    assert answer.status_code == 422
    assert told in answer.json()["detail"]


def test_the_score_is_taken_away_as_it_is_played(client: httpx.Client) -> None:
    session = upload(client, scale(), song=("s.wav", song()), title="Scale", transposition=2)
    answer = client.get(f"{session.path}/export.mid")
    assert answer.status_code == 200
    assert answer.headers["content-type"] == "audio/midi"
    assert answer.headers["content-disposition"] == "attachment; filename*=UTF-8''Scale.mid"
    told = client.get(f"{session.path}/score").json()["notes"]
    assert _struck(answer.content) == [note["sounding_pitch"] for note in told]
    assert _struck(answer.content) == [pitch + 2 for pitch in _struck(scale())]
    session.change("DELETE")


def _struck(data: bytes) -> list[int]:
    """The pitches of a MIDI file's notes, track by track."""
    messages = [message for track in mido.MidiFile(file=io.BytesIO(data)).tracks for message in track]
    return [
        message.note
        for message in messages
        if isinstance(message, mido.Message) and message.type == "note_on"
    ]
