"""synctoolbox's alignment of a recording and a score, for other_aligners.py to ask.

Run by the peers' own Python (requirements/peers.in), which has no Reina. Reads the path of an ``.npz`` a line
(samples, rate, and of the notes onset_s, duration_s, pitch, velocity) and answers each with a line of JSON:
what times of the recording and of the score belong together, and the processor time that it took. What
compiles itself has been compiled before.
"""

from __future__ import annotations

import importlib
import json
import sys
import time
import warnings
from contextlib import redirect_stdout
from io import StringIO
from typing import Any

import numpy as np

FRAMES_PER_S = 50
RATE = 22_050


def imported(name: str) -> Any:
    """A module of synctoolbox."""
    return importlib.import_module(f"synctoolbox.{name}")


def features(pitch: Any, peaks: Any) -> tuple[Any, Any]:
    """Chroma, and where they begin."""
    chroma, onset = imported("feature.chroma"), imported("feature.dlnco")
    tones = chroma.quantize_chroma(f_chroma=chroma.pitch_to_chroma(f_pitch=pitch))
    begins = onset.pitch_onset_features_to_DLNCO(
        f_peaks=peaks, feature_sequence_length=tones.shape[1], feature_rate=FRAMES_PER_S
    )
    return tones, begins


def align(asked: Any) -> tuple[list[float], list[float]]:
    """MrMsDTW over chroma and onsets, as its authors' notebook has it; leading silence is left out before."""
    pandas: Any = importlib.import_module("pandas")
    samples: np.ndarray[Any, np.dtype[np.float64]] = asked["samples"]
    rate = int(asked["rate"])
    loud = np.flatnonzero(np.abs(samples) > 0.1 * np.abs(samples).max())
    first = max(0, int(loud[0]) - rate // 50)
    size = int((len(samples) - first) * RATE / rate)
    audio = np.interp(np.arange(size) * rate / RATE, np.arange(len(samples) - first), samples[first:])
    table = pandas.DataFrame(
        {
            "start": asked["onset_s"],
            "duration": asked["duration_s"],
            "pitch": asked["pitch"],
            "velocity": asked["velocity"],
            "instrument": "piano",
        }
    )
    table["end"] = table["start"] + table["duration"]
    of_pitch, of_tables = imported("feature.pitch"), imported("feature.csv_tools")
    heard = features(
        of_pitch.audio_to_pitch_features(f_audio=audio, Fs=RATE, feature_rate=FRAMES_PER_S),
        imported("feature.pitch_onset").audio_to_pitch_onset_features(f_audio=audio, Fs=RATE),
    )
    written = features(
        of_tables.df_to_pitch_features(table, feature_rate=FRAMES_PER_S),
        of_tables.df_to_pitch_onset_features(table),
    )
    steps = imported("dtw.mrmsdtw").sync_via_mrmsdtw(
        f_chroma1=heard[0],
        f_onset1=heard[1],
        f_chroma2=written[0],
        f_onset2=written[1],
        input_feature_rate=FRAMES_PER_S,
        step_weights=np.array([1.5, 1.5, 2.0]),
        threshold_rec=10**6,
    )
    path: Any = imported("dtw.utils").make_path_strictly_monotonic(steps)
    at_song, at_score = (np.asarray(row, dtype=np.float64) / FRAMES_PER_S for row in path)
    return (at_song + first / rate).tolist(), at_score.tolist()


def main() -> None:
    """Answer line by line."""
    warnings.simplefilter("ignore")
    warm = False
    for line in sys.stdin:
        with np.load(line.strip()) as file:
            asked = dict(file)
        with redirect_stdout(StringIO()):
            if not warm:
                align(asked)
                warm = True
            begin = time.process_time()
            song_s, score_s = align(asked)
            took_s = time.process_time() - begin
        print(json.dumps({"song_s": song_s, "score_s": score_s, "took_s": took_s}), flush=True)


if __name__ == "__main__":
    main()
