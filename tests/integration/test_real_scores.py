"""Score files as programs write them: uploaded, and judged by what the server says of each."""

from __future__ import annotations

import io
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
import soundfile
from tests.integration.server import upload
from tests.integration.stranger import take
from tests.unit.music.midi_bytes import midi, off, on, program

if TYPE_CHECKING:
    from collections.abc import Iterator

    import httpx
    from numpy.typing import NDArray
    from tests.integration.server import Owned

CASES = Path(__file__).parents[1] / "cases"


@pytest.fixture
def session(request: pytest.FixtureRequest, client: httpx.Client) -> Iterator[Owned]:
    """A session of the case that the test names."""
    name: str = request.param
    made = upload(client, (CASES / name).read_bytes(), name)
    yield made
    made.change("DELETE")


def notes_of(session: Owned, part: int | None = None) -> list[dict[str, Any]]:
    asked = {} if part is None else {"part": part}
    notes = session.client.get(f"{session.path}/score", params=asked).raise_for_status().json()["notes"]
    return list(notes)


def played(session: Owned) -> list[dict[str, Any]]:
    return [note for note in notes_of(session) if note["valves"] is not None]


def song(session: Owned) -> NDArray[np.float64]:
    """The rendered song, both sides together."""
    deadline = time.monotonic() + 60
    while (answer := session.client.get(f"{session.path}/song")).status_code == 202:
        assert time.monotonic() < deadline
        time.sleep(0.05)
    samples, _ = soundfile.read(io.BytesIO(answer.raise_for_status().content), dtype="int16")
    return samples.mean(axis=1)


@pytest.mark.parametrize("session", ["mid-mutechannel.mid"], indirect=True)
def test_a_muted_channel_is_the_same_staff_and_the_mute_goes_in_where_it_plays(session: Owned) -> None:
    staff = session.body["parts"][0]
    assert (staff["name"], staff["notes"]) == ("B♭ Trumpet", 24)
    assert len(played(session)) == 24
    frames = take(session.client, session.id, 0.0, 12.0, fps=60)
    muted = frames.song_time_s[frames.parameters["trumpet/mute"][:, 0] == 1.0]
    assert muted.min() == pytest.approx(4.0, abs=0.05)
    assert muted.max() == pytest.approx(8.0, abs=0.05)
    assert len(muted) == pytest.approx(4.0 * 60, abs=3)


@pytest.mark.parametrize("session", ["mid-topout.mid"], indirect=True)
def test_of_a_chord_the_top_note_that_the_instrument_has_is_played(session: Owned) -> None:
    assert len(played(session)) == 8
    assert (played(session)[0]["sounding_pitch"], played(session)[0]["valves"]) == (60, [1, 3])
    dropped = [one for one in session.body["warnings"] if one["kind"] == "out_of_range_dropped"]
    assert len(dropped) == len(notes_of(session)) - 8


@pytest.mark.parametrize("session", ["mid-zerograce.mid"], indirect=True)
def test_a_note_without_length_is_an_ornament(session: Owned) -> None:
    assert [note["sounding_pitch"] for note in played(session)] == [72] * 4
    assert [note["duration_s"] for note in played(session)] == pytest.approx([470 / 960] * 4)
    assert sum(one["kind"] == "ornament_dropped" for one in session.body["warnings"]) == 4


@pytest.mark.parametrize("session", ["mid-missingoff.mid"], indirect=True)
def test_a_missing_note_off_shifts_no_other_end(session: Owned) -> None:
    assert [note["duration_s"] for note in notes_of(session)][1:] == pytest.approx([0.5] * 8)


@pytest.mark.parametrize("session", ["mid-setupprogram.mid"], indirect=True)
def test_a_program_set_in_another_track_counts(session: Owned) -> None:
    assert session.body["parts"][0]["program"] == 56
    assert session.body["part"] == 0


@pytest.mark.parametrize("session", ["mid-gm2.mid"], indirect=True)
def test_general_midi_2_says_by_bank_which_channel_is_drums(session: Owned) -> None:
    assert [part["is_drums"] for part in session.body["parts"]] == [True, False]
    assert session.body["parts"][1]["program"] == 56
    assert session.body["part"] == 1
    assert len(played(session)) == session.body["parts"][1]["notes"]


@pytest.mark.parametrize("session", ["mid-ports.mid"], indirect=True)
def test_channels_of_two_ports_are_heard_apart(session: Owned) -> None:
    sound = song(session)[4800:19200]
    spectrum = np.abs(np.fft.rfft(sound * np.hanning(len(sound))))
    strongest_hz = np.argmax(spectrum) * 48000 / len(sound)
    # A partial of the trumpet's C4, not of the soft bass below it.
    assert strongest_hz / 261.63 == pytest.approx(round(strongest_hz / 261.63), abs=0.05)
    assert strongest_hz == pytest.approx(1570, rel=0.01)


@pytest.mark.parametrize("session", ["mid-xgdrums.mid"], indirect=True)
def test_xg_says_by_bank_which_channel_is_drums(session: Owned) -> None:
    assert session.body["parts"][0]["is_drums"]
    hits = ((36, 42, 38, 42) * 8)[: session.body["notes"]]

    def of_channel(channel: int) -> NDArray[np.float64]:
        track = [program(0, 0, channel)]
        for hit in hits:
            track += [on(0, hit, 90, channel), off(120, hit, channel), (360, bytes([0xB0 | channel, 64, 0]))]
        made = upload(session.client, midi(track), "kit.mid")
        sound = song(made)
        made.change("DELETE")
        return sound

    heard = song(session)

    def like(other: NDArray[np.float64]) -> float:
        length = min(len(heard), len(other))
        return float(np.corrcoef(heard[:length], other[:length])[0, 1])

    assert like(of_channel(9)) > 0.99
    assert like(of_channel(0)) < 0.2


def test_a_controller_long_after_the_music_costs_no_sound(client: httpx.Client) -> None:
    # 24.9 hours at 480 ticks a beat of half a second, in steps that a delta time can hold.
    late = [(0x0FFFFFF, b"\xb0\x07\x64") for _ in range(6)]
    made = upload(client, midi([on(0, 60), off(480, 60), *late]), "late.mid")
    assert made.body["duration_s"] < 10
    assert 48000 * 0.5 < len(song(made)) < 48000 * 10
    made.change("DELETE")
