"""Other aligners, each measured where it is installed beside Reina.

synctoolbox (MIT) brings numba, pandas, librosa and music21 and an older NumPy, and so runs in the peers' own
environment (synctoolbox_aligner.py). parangonar (Apache-2.0) is measured where a person has installed it
(`pip install parangonar` beside Reina's own).
"""

from __future__ import annotations

import atexit
import functools
import importlib
import importlib.util
import json
import subprocess
import tempfile
import time
import warnings
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from machine import PEERS, peers_version
from tests.unit.sound.alignment.bed import Result

if TYPE_CHECKING:
    from collections.abc import Callable

    from tests.unit.sound.alignment.renditions import Recording

PROGRAM = Path(__file__).with_name("synctoolbox_aligner.py")


@functools.cache
def _program() -> subprocess.Popen[str]:
    """The program, once for all recordings, so that it compiles itself once; it ends with its input."""
    process = subprocess.Popen(
        [str(PEERS), str(PROGRAM)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    )
    atexit.register(process.communicate)
    return process


def synctoolbox(recording: Recording, rate: int) -> tuple[Result, float]:
    """MrMsDTW over chroma and onsets."""
    process = _program()
    assert process.stdin is not None
    assert process.stdout is not None
    notes = recording.score.notes
    with tempfile.NamedTemporaryFile(suffix=".npz") as file:
        np.savez(
            file,
            samples=recording.samples,
            rate=rate,
            onset_s=notes.onset_s,
            duration_s=notes.duration_s,
            pitch=notes.sounding_pitch.astype(int),
            velocity=notes.velocity,
        )
        file.flush()
        process.stdin.write(f"{file.name}\n")
        process.stdin.flush()
        answer: dict[str, Any] = json.loads(process.stdout.readline())
    heard = ~np.isnan(recording.onset_s)
    at_score, at_song = (np.array(answer[name], dtype=np.float64) for name in ("score_s", "song_s"))
    at_s = np.interp(notes.onset_s[heard], at_score, at_song)
    errors_ms = 1000 * np.abs(at_s - recording.onset_s[heard])
    return Result(errors_ms, errors_ms), float(answer["took_s"])


def parangonar(recording: Recording, rate: int) -> tuple[Result, float]:
    """Its matcher of recordings and scores, which gives a time to every note."""
    module: Any = importlib.import_module("parangonar")
    notes = recording.score.notes
    table = np.array(
        [
            (beat, duration, int(pitch), f"n{index}")
            for index, (beat, duration, pitch) in enumerate(
                zip(notes.onset_beats, notes.duration_beats, notes.sounding_pitch, strict=True)
            )
        ],
        dtype=[("onset_beat", "f8"), ("duration_beat", "f8"), ("pitch", "i4"), ("id", "U16")],
    )
    begin = time.process_time()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        found: list[dict[str, Any]] = module.AudioToScoreMatcher()(recording.samples, table, sample_rate=rate)
    took_s = time.process_time() - begin
    at = np.full(len(notes), np.nan)
    for event in found:
        if event.get("score_id") is not None and event.get("performance_time") is not None:
            at[int(str(event["score_id"])[1:])] = float(event["performance_time"])
    heard = ~np.isnan(recording.onset_s) & ~np.isnan(at)
    errors_ms = 1000 * np.abs(at[heard] - recording.onset_s[heard])
    return Result(errors_ms, errors_ms), took_s


OTHERS: dict[str, Callable[[Recording, int], tuple[Result, float]]] = {}
"""Those that are installed: how far off, and seconds of the processor."""
if peers_version("synctoolbox"):
    OTHERS["synctoolbox"] = synctoolbox
if importlib.util.find_spec("parangonar") is not None:
    OTHERS["parangonar"] = parangonar
