"""How well a song is slowed down and sped up with its pitch kept, by what can do it in a page.

Run as ``python tests/benchmarks/bench_stretch.py [--soundtouch PATH]`` after ``make setup``; PATH is
``soundtouch-processor.js`` of the npm package @soundtouchjs/audio-worklet, which is no part of the project.
Trumpet tones are rendered by the server's synthesizer, and go through each way in Chromium's
OfflineAudioContext. Pitch and onset are measured in what goes in and in what comes out by the same means, and
compared; the attack of a slowed tone is slowed as well, so that its onset is the place where it passes a
tenth of its height. Further blocks and intervals are tried with ``--blocks 120/30 60/15``, in milliseconds.
"""

from __future__ import annotations

import argparse
import base64
import io
import sys
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from threading import Thread
from typing import TYPE_CHECKING, Any

import midirenderer
import numpy as np
import soundfile
from machine import ROOT, heading, verdict
from playwright.sync_api import sync_playwright

from reina.cli.browser import find_browser
from reina.sound.font import find_soundfont
from reina.sound.midi import write_midi

if TYPE_CHECKING:
    from collections.abc import Generator

    from numpy.typing import NDArray
    from playwright.sync_api import Page

SAMPLE_RATE = 48000
TRUMPET = 56
KEYS = (52, 57, 62, 67, 72, 77, 82)
"""E3 to B flat 5: the instrument's compass but its last tones."""
TONE_S, GAP_S, FIRST_S = 0.7, 0.8, 0.5
REACH_S = 0.15
"""So far around its place an onset is looked for; what rings of the tone before has died away there."""
RATES = (0.25, 0.5, 0.75, 1.25, 1.5, 2.0)
PITCH_CENTS, ONSET_MS = 2.0, 10.0
STRETCH = ROOT / "web" / "node_modules" / "signalsmith-stretch" / "SignalsmithStretch.mjs"

PAGE = """
const { default: makeStretch } = await import("/stretch.mjs");
function floats(text) {
  const bytes = Uint8Array.from(atob(text), (character) => character.charCodeAt(0));
  return new Float32Array(bytes.buffer);
}
function text(samples) {
  const bytes = new Uint8Array(samples.buffer, samples.byteOffset, samples.byteLength);
  let all = "";
  for (let at = 0; at < bytes.length; at += 32768) {
    all += String.fromCharCode(...bytes.subarray(at, at + 32768));
  }
  return btoa(all);
}
window.through = async (encoded, rate, { way, block, interval, sampleRate }) => {
  const samples = floats(encoded);
  const context = new OfflineAudioContext(2, Math.ceil(samples.length / rate) + sampleRate, sampleRate);
  const buffer = new AudioBuffer({ length: samples.length, sampleRate, numberOfChannels: 2 });
  buffer.copyToChannel(samples, 0);
  buffer.copyToChannel(samples, 1);
  const began = performance.now();
  let node, latency = 0;
  if (way === "soundtouch") {
    await context.audioWorklet.addModule("/soundtouch.js");
    node = new AudioWorkletNode(context, "soundtouch-processor", { outputChannelCount: [2] });
    node.parameters.get("playbackRate").value = rate;
  } else {
    node = await makeStretch(context, {
      numberOfInputs: way === "shift" ? 1 : 0, numberOfOutputs: 1, outputChannelCount: [2],
    });
    if (block > 0) await node.configure({ blockMs: block, intervalMs: interval });
    latency = way === "shift" ? await node.latency() : 0;
    if (way === "shift") {
      const semitones = -12 * Math.log2(rate);
      await node.schedule({ output: 0, active: true, semitones, tonalityHz: sampleRate / 2 });
    } else {
      await node.addBuffers([buffer.getChannelData(0), buffer.getChannelData(1)]);
      await node.schedule({ output: 0, active: true, input: 0, rate });
    }
  }
  node.connect(context.destination);
  const made = performance.now();
  if (way !== "stretch") {
    const source = new AudioBufferSourceNode(context, { buffer, playbackRate: rate });
    source.connect(node);
    source.start(0);
  }
  const out = await context.startRendering();
  return {
    samples: text(out.getChannelData(0)), latency, made: made - began, took: performance.now() - made,
    length: out.length / sampleRate,
  };
};
window.ready = true;
"""


@dataclass(frozen=True)
class Way:
    """A way to keep the pitch: `stretch` what is given, or `shift` what is played faster or slower.

    Its blocks are so long and so far apart, in milliseconds.
    """

    way: str
    block: float = 100.0
    interval: float = 10.0

    @property
    def name(self) -> str:
        """For people."""
        if self.way == "soundtouch":
            return "SoundTouch, shifts what is played faster or slower"
        does = "stretches" if self.way == "stretch" else "shifts what is played faster or slower"
        return f"Signalsmith {does}, blocks of {self.block:g} ms every {self.interval:g}"


CHOSEN = Way("stretch")
"""What the page does (`blocksFor` in web/src/sound/stretcher.ts), but below SLOW of the tempo."""
SLOW = 0.3
CHOSEN_SLOW = Way("stretch", interval=5.0)


def tones() -> NDArray[np.float32]:
    """The tones one after another, (F,)."""
    events: list[tuple[int, bytes]] = [(0, bytes((0xC0, TRUMPET))), (0, bytes((0xB0, 91, 0)))]
    for number, key in enumerate(KEYS):
        on = round((FIRST_S + number * (TONE_S + GAP_S)) * SAMPLE_RATE)
        events += [(on, bytes((0x90, key, 100))), (on + round(TONE_S * SAMPLE_RATE), bytes((0x80, key, 0)))]
    end = events[-1][0] + SAMPLE_RATE
    wav = midirenderer.render_wave_from(
        find_soundfont(ROOT / "data").read_bytes(), write_midi(events, end_tick=end)
    )
    samples, _ = soundfile.read(io.BytesIO(wav), always_2d=True)
    return np.ascontiguousarray(samples.mean(axis=1))


def pitch(samples: NDArray[np.float32], near_hz: float) -> float:
    """The frequency of a steady tone in Hz, by its first harmonics' peaks."""
    windowed = samples * np.hanning(len(samples))
    size = 8 * len(samples)
    spectrum = np.abs(np.fft.rfft(windowed, size))
    found: list[tuple[float, float]] = []
    for harmonic in range(1, 7):
        low, high = (
            round(near_hz * harmonic * 2 ** (cents / 1200) * size / SAMPLE_RATE) for cents in (-60, 60)
        )
        peak = low + int(np.argmax(spectrum[low:high]))
        a, b, c = np.log(spectrum[peak - 1 : peak + 2] + 1e-12)
        place = peak + 0.5 * (a - c) / (a - 2 * b + c)
        found.append((place * SAMPLE_RATE / size / harmonic, float(spectrum[peak])))
    frequencies, weights = np.array(found).T
    return float(np.average(frequencies, weights=weights))


def onset(samples: NDArray[np.float32], near: int, reach: int) -> float:
    """Where the level first passes a tenth of its height around a sample, in samples."""
    around = samples[max(near - reach, 0) : near + 3 * reach].astype(np.float64) ** 2
    window = SAMPLE_RATE // 200
    level = np.sqrt(np.convolve(around, np.ones(window) / window, mode="same"))
    return max(near - reach, 0) + float(np.argmax(level > 0.1 * level.max()))


def compare(before: NDArray[np.float32], after: NDArray[np.float32], rate: float) -> NDArray[np.float64]:
    """Of each tone (T, 2): its pitch's error in cents, and its onset's in ms."""
    rows: list[tuple[float, float]] = []
    for number, key in enumerate(KEYS):
        on = round((FIRST_S + number * (TONE_S + GAP_S)) * SAMPLE_RATE)
        near = 440 * 2 ** ((key - 69) / 12)
        was, became = (
            pitch(part[round((on + 0.2 * SAMPLE_RATE) / by) : round((on + 0.62 * SAMPLE_RATE) / by)], near)
            for part, by in ((before, 1.0), (after, rate))
        )
        reach = round(REACH_S * SAMPLE_RATE)
        due = onset(before, on, reach) / rate
        late = onset(after, round(on / rate), round(reach / rate)) - due
        rows.append((1200 * np.log2(became / was), late / SAMPLE_RATE * 1000))
    return np.array(rows)


def through(
    page: Page, samples: NDArray[np.float32], rate: float, way: Way
) -> tuple[NDArray[np.float32], dict[str, Any]]:
    """What comes out, its latency taken off, and what else is known of it."""
    said: dict[str, Any] = page.evaluate(
        "([samples, rate, how]) => through(samples, rate, how)",
        [
            base64.b64encode(samples.tobytes()).decode(),
            rate,
            {"way": way.way, "block": way.block, "interval": way.interval, "sampleRate": SAMPLE_RATE},
        ],
    )
    out = np.frombuffer(base64.b64decode(said.pop("samples")), dtype=np.float32)
    return out[round(said["latency"] * SAMPLE_RATE) :], said


@contextmanager
def serving(files: dict[str, tuple[str, str]]) -> Generator[str]:
    """Serve texts by their paths; the address of it all."""

    class Answer(BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            media, content = files.get(self.path, ("text/plain", ""))
            self.send_response(200 if self.path in files else 404)
            self.send_header("Content-Type", media)
            self.end_headers()
            self.wfile.write(content.encode())

        def log_message(self, format: str, *args: object) -> None:  # noqa: A002
            """Nobody reads it."""

    server = ThreadingHTTPServer(("127.0.0.1", 0), Answer)
    Thread(target=server.serve_forever, daemon=True).start()
    yield f"http://127.0.0.1:{server.server_address[1]}/"
    server.shutdown()


def served(soundtouch: Path | None) -> dict[str, tuple[str, str]]:
    """What stands at each address: media type, text."""
    files = {"/": ("text/html", "<!doctype html><script type=module src=/page.js></script>")}
    files["/page.js"] = ("text/javascript", PAGE)
    files["/stretch.mjs"] = ("text/javascript", STRETCH.read_text())
    if soundtouch is not None:
        files["/soundtouch.js"] = ("text/javascript", soundtouch.read_text())
    return files


def main() -> int:
    """Measure every way at every rate; 1 where the one that the page takes misses a bound."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--soundtouch", type=Path)
    parser.add_argument("--blocks", nargs="*", default=["120/30"])
    arguments = parser.parse_args()
    print(heading(__file__))
    samples = tones()
    ways = [CHOSEN, Way("shift")]
    for pair in arguments.blocks:
        block, interval = map(float, pair.split("/"))
        ways += [Way("stretch", block, interval), Way("shift", block, interval)]
    if arguments.soundtouch is not None:
        ways.append(Way("soundtouch"))
    missed = False
    with sync_playwright() as playwright, ExitStack() as stack:
        browser = playwright.chromium.launch(executable_path=str(find_browser()), args=["--no-sandbox"])
        page = browser.new_page()
        page.goto(stack.enter_context(serving(served(arguments.soundtouch))))
        page.wait_for_function("window.ready")
        for way in ways:
            print(f"\n{way.name}")
            for rate in RATES:
                does = CHOSEN_SLOW if way == CHOSEN and rate < SLOW else way
                out, said = through(page, samples, rate, does)
                cents, late = np.abs(compare(samples, out, rate)).max(axis=0)
                speed = said["length"] / said["took"] * 1000
                print(
                    f"  {rate:4}: pitch within {cents:5.2f} cents, onsets within {late:6.1f} ms, "
                    f"{speed:3.0f} x real time, latency {said['latency'] * 1000:.0f} ms"
                )
                if way == CHOSEN:
                    for figure, bound, unit in ((cents, PITCH_CENTS, "cents"), (late, ONSET_MS, "ms")):
                        line = verdict(f"at {rate} of the tempo", float(figure), bound, unit)
                        missed |= "MISSED" in line
                        print(f"    {line}")
        browser.close()
    return int(missed)


if __name__ == "__main__":
    sys.exit(main())
