"""What a person hears to practise by: slower at its own pitch, and without the part that they play."""

from __future__ import annotations

import base64
import io
import wave
from typing import TYPE_CHECKING

import numpy as np
import pytest
from tests.integration.scores import duet, scale

if TYPE_CHECKING:
    from collections.abc import Callable

    import httpx
    from numpy.typing import NDArray
    from tests.e2e.opened import Opened

pytestmark = pytest.mark.browser

TONE_HZ = 441.3
CENTS = 2.0
TAP = """
const connect = AudioNode.prototype.connect;
AudioNode.prototype.connect = function (to, ...rest) {
  if (to === this.context.destination && this.context instanceof AudioContext) {
    if (window.tap?.context !== this.context) window.tap = new AnalyserNode(this.context, { fftSize: 32768 });
    connect.call(this, window.tap);
  }
  return connect.call(this, to, ...rest);
};
"""
"""Hears what leaves the page, two thirds of a second of it."""
HEARD = """(kept) => {
  const samples = kept ? window.full : new Float32Array(tap.fftSize);
  if (!kept) tap.getFloatTimeDomainData(samples);
  let text = "";
  for (const byte of new Uint8Array(samples.buffer)) text += String.fromCharCode(byte);
  return { samples: btoa(text), rate: tap.context.sampleRate };
}"""
FULL = """() => {
  const samples = new Float32Array(tap.fftSize);
  tap.getFloatTimeDomainData(samples);
  const sounds = (from) => samples.subarray(from, from + 8192).some((sample) => sample > 0.03);
  const whole = [0, 8192, 16384, 24576].every(sounds);
  if (whole) window.full = samples;
  return whole;
}"""
"""Whether what is heard now has no gap; it is kept."""
ROUNDS = 20
"""How often it is listened again until what is heard has gone over to what was chosen."""


def tone(seconds: float = 30.0, rate: int = 48000) -> bytes:
    """A recording of one tone that does not end."""
    at = np.arange(round(seconds * rate)) / rate
    sound = sum(np.sin(2 * np.pi * TONE_HZ * harmonic * at) / harmonic for harmonic in (1, 2, 3)) * 0.2
    file = io.BytesIO()
    with wave.open(file, "wb") as out:
        out.setparams((1, 2, rate, 0, "NONE", ""))
        out.writeframes(np.rint(sound * 32767).astype("<i2").tobytes())
    return file.getvalue()


def spectrum(opened: Opened, *, kept: bool = False) -> tuple[NDArray[np.float64], float]:
    """What is heard now, or was kept: the strength of many frequencies, and how far apart those are in Hz."""
    heard = opened.page.evaluate(HEARD, kept)
    samples = np.frombuffer(base64.b64decode(heard["samples"]), dtype=np.float32).astype(np.float64)
    size = 4 * len(samples)
    return np.abs(np.fft.rfft(samples * np.hanning(len(samples)), size)), heard["rate"] / size


def pitch(opened: Opened, near_hz: float) -> float:
    """The strongest frequency of what was kept within a third of an octave of one, Hz."""
    strengths, step = spectrum(opened, kept=True)
    low, high = (round(near_hz * 2 ** (third / 6) / step) for third in (-1, 1))
    peak = low + int(np.argmax(strengths[low:high]))
    before, top, after = np.log(strengths[peak - 1 : peak + 2])
    return float((peak + 0.5 * (before - after) / (before - 2 * top + after)) * step)


def control(opened: Opened, client: httpx.Client, **command: object) -> int:
    """Move the transport; the epoch that begins with it."""
    answer = client.post(
        f"/api/v1/sessions/{opened.session}/transport", json=command, headers=opened.headers
    ).raise_for_status()
    epoch: int = answer.json()["epoch"]
    return epoch


def listening(visit: Callable[..., Opened], *files: tuple[str, str, bytes]) -> Opened:
    """A page of these files whose sound can be heard by the test, with the place to practise."""
    opened = visit("/lab", remembers={"panels": ["practice"]})
    opened.page.add_init_script(TAP)
    return opened.begin_with(*files)


def test_at_half_and_a_quarter_of_the_speed_the_pitch_is_kept(
    visit: Callable[..., Opened], client: httpx.Client
) -> None:
    opened = listening(visit, ("a.mid", "audio/midi", scale(40, bpm=113.0)), ("a.wav", "audio/wav", tone()))
    opened.page.keyboard.press("Space")
    opened.until("window.reina.playing && window.reina.soundLevel > 0.05")
    opened.until(FULL)
    written = pitch(opened, TONE_HZ)
    assert abs(1200 * np.log2(written / TONE_HZ)) < CENTS
    for rate in (0.5, 0.25):
        epoch = control(opened, client, action="rate", rate=rate)
        opened.until("(epoch) => window.reina.epoch >= epoch && window.reina.soundLevel > 0.05", epoch)
        # What was played before is out of the tap, and no gap of the change is in it.
        opened.page.evaluate("window.changed = tap.context.currentTime")
        opened.until("tap.context.currentTime > window.changed + 1.5")
        opened.until(FULL)
        assert abs(1200 * np.log2(pitch(opened, TONE_HZ) / TONE_HZ)) < CENTS
    opened.until("Math.abs(window.reina.soundAhead ?? 1) < 0.06")
    assert opened.page.get_by_text("The pitch goes with the speed").count() == 0
    assert opened.page.get_by_text("A recording is heard as it is").count() == 1


def test_one_plays_along_without_the_part(visit: Callable[..., Opened], client: httpx.Client) -> None:
    opened = listening(visit, ("d.mid", "audio/midi", duet()))
    page = opened.page
    control(opened, client, action="loop", start_s=0.0, end_s=2.0)
    # Panels that no pointer is on leave while the music plays.
    page.get_by_role("region", name="Practice", exact=True).hover()
    page.keyboard.press("Space")
    opened.until("window.reina.playing && window.reina.soundLevel > 0.01")

    def share_of_trumpet() -> float:
        """How much of what is heard lies below the flute's lowest tone, 0..1."""
        opened.page.evaluate("window.changed = tap.context.currentTime")
        opened.until("tap.context.currentTime > window.changed + 1")
        strengths, step = spectrum(opened)
        power = strengths**2
        return float(power[round(300 / step) : round(550 / step)].sum() / power[round(300 / step) :].sum())

    def until_share(fits: Callable[[float], bool]) -> float:
        shares: list[float] = []
        for _ in range(ROUNDS):
            shares.append(share_of_trumpet())
            if fits(shares[-1]):
                return shares[-1]
        pytest.fail(f"of what is heard the trumpet has {shares}")

    def chosen(name: str, stems: int) -> None:
        with page.expect_response(lambda answer: "/song/segments/" in answer.url and answer.status == 200):
            page.get_by_label(name, exact=True).check()
        opened.until("window.reina.soundShare === null && window.reina.sound === 'ready'")
        assert len(stem_states) >= stems

    stem_states: list[str] = []
    page.on("request", lambda asked: stem_states.append(asked.url) if "stem=" in asked.url else None)
    together = share_of_trumpet()
    chosen("Without", 2)
    until_share(lambda without: without < 0.05 * together)
    page.get_by_label("Alone", exact=True).check()
    until_share(lambda alone: alone > together)
    assert page.evaluate("JSON.parse(localStorage['reina-part-sound'])[window.reina.session]") == {
        "balance": 1,
        "semitones": 0,
    }
    opened.until_nothing_overflows()
