"""Renders one plan into a WAV; a process of its own, started by `reina.sound.renderer`.

    python -m reina.sound.render SOUNDFONT OUT.wav NOTES CONTROLS

The plan's arrays (NOTES and CONTROLS rows) come on standard input, which stays open: when it is closed, the
one who asked is gone, and the process ends. On standard output it tells, one JSON object a line,
``{"progress": 0.25}`` and at the end ``{"done": true}`` or ``{"error": "..."}``.
"""

import json
import os
import sys
import threading
from collections.abc import Callable
from pathlib import Path

import midirenderer
import numpy as np

from reina.sound.events import CONTROL_DTYPE, NOTE_DTYPE, SoundPlan
from reina.sound.mix import CHANNELS, FULL_SCALE, Mix, Samples
from reina.sound.passages import BLOCK, Passage, cut_into_passages, write_passage
from reina.system.own_process import end_with_parent, yield_to_server

GAINS = (1.0, 1 / 4, 1 / 16, 1 / 64)
"""How loud a passage is rendered: the first at which it does not reach full scale, where the synthesizer
would clip."""
RENDERING = 0.95
"""Share of the work that is rendering; the rest is levelling and writing."""


class RenderError(Exception):
    """The synthesizer could not render; the message says why."""


def render_plan(plan: SoundPlan, soundfont: bytes, out: Path, progress: Callable[[float], None]) -> None:
    """Render a plan; sample 0 of the file is the score's time 0.

    Args:
        plan: What to render.
        soundfont: An SF2 file.
        out: The WAV (16 bits, stereo, 48 kHz), which appears when it is whole.
        progress: Is told the share of the work that is done, 0..1, rising.

    Raises:
        RenderError: The soundfont is none.
    """
    passages = cut_into_passages(plan)
    work = np.cumsum([passage.length + len(passage.notes) * BLOCK for passage in passages])
    partial = out.with_name(f"{out.name}.{os.getpid()}.partial")
    try:
        with Mix(out.with_name(f"{out.name}.{os.getpid()}.mix.partial")) as mix:
            for passage, done in zip(passages, work, strict=True):
                mix.add(passage.start, _render_passage(plan, passage, soundfont))
                progress(float(done / work[-1]) * RENDERING)
            mix.write_wav(partial, at_least=int(plan.notes["off"].max()))
        partial.replace(out)
        progress(1.0)
    finally:
        partial.unlink(missing_ok=True)


def _render_passage(plan: SoundPlan, passage: Passage, soundfont: bytes) -> Samples:
    """Return a passage as (F, 2) samples with full scale 1, which they may exceed."""
    samples = np.zeros((0, CHANNELS), dtype=np.float32)
    for gain in GAINS:
        try:
            wav = midirenderer.render_wave_from(soundfont, write_passage(plan, passage, gain=gain))
        except (RuntimeError, ValueError) as error:
            raise RenderError(f"the synthesizer refused: {error}") from error
        whole = np.frombuffer(wav, dtype="<i2", offset=wav.index(b"data") + 8)
        clipped = bool(np.any((whole >= FULL_SCALE) | (whole <= -FULL_SCALE)))
        samples = whole.reshape(-1, CHANNELS).astype(np.float32) / np.float32(FULL_SCALE * gain)
        if not clipped:
            break
    return samples


def main() -> int:
    """Read the plan and render it."""
    soundfont, out = Path(sys.argv[1]), Path(sys.argv[2])
    note_count, control_count = int(sys.argv[3]), int(sys.argv[4])
    yield_to_server()
    stdin = sys.stdin.buffer
    plan = SoundPlan(
        notes=np.frombuffer(stdin.read(note_count * NOTE_DTYPE.itemsize), dtype=NOTE_DTYPE),
        controls=np.frombuffer(stdin.read(control_count * CONTROL_DTYPE.itemsize), dtype=CONTROL_DTYPE),
    )
    threading.Thread(target=end_with_parent, daemon=True).start()
    try:
        render_plan(plan, soundfont.read_bytes(), out, lambda share: _tell({"progress": round(share, 4)}))
    except (RenderError, OSError) as error:
        _tell({"error": str(error)})
        return 1
    _tell({"done": True})
    return 0


def _tell(message: dict[str, object]) -> None:
    sys.stdout.write(json.dumps(message) + "\n")
    sys.stdout.flush()


if __name__ == "__main__":
    sys.exit(main())
