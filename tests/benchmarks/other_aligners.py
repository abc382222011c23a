"""Other aligners, each measured where it is installed beside Reina; none is part of `make bench`'s own set.

synctoolbox (MIT) and parangonar (Apache-2.0) bring numba, pandas, librosa and music21, most of a gigabyte:
they are measured where a person has installed them (`pip install synctoolbox parangonar` beside Reina's own).
"""

from __future__ import annotations

import importlib
import importlib.util
import warnings
from typing import TYPE_CHECKING, Any

import numpy as np
from tests.unit.sound.alignment.bed import Result

if TYPE_CHECKING:
    from collections.abc import Callable

    from tests.unit.sound.alignment.renditions import Recording

FRAMES_PER_S = 50
SYNCTOOLBOX_RATE = 22_050


def synctoolbox(recording: Recording, rate: int) -> Result:
    """MrMsDTW over chroma and onsets, as its authors' notebook has it; leading silence is left out before."""
    module: Callable[[str], Any] = lambda name: importlib.import_module(f"synctoolbox.{name}")  # noqa: E731
    pandas: Any = importlib.import_module("pandas")
    samples = recording.samples
    loud = np.flatnonzero(np.abs(samples) > 0.1 * np.abs(samples).max())
    first = max(0, int(loud[0]) - rate // 50)
    size = int((len(samples) - first) * SYNCTOOLBOX_RATE / rate)
    audio = np.interp(
        np.arange(size) * rate / SYNCTOOLBOX_RATE, np.arange(len(samples) - first), samples[first:]
    )
    notes = recording.score.notes
    table = pandas.DataFrame(
        {
            "start": notes.onset_s,
            "duration": notes.duration_s,
            "pitch": notes.sounding_pitch.astype(int),
            "velocity": notes.velocity,
            "instrument": "piano",
        }
    )
    table["end"] = table["start"] + table["duration"]
    chroma, onset = module("feature.chroma"), module("feature.dlnco")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        pairs: list[tuple[Any, Any]] = []
        for pitch, peaks in (
            (
                module("feature.pitch").audio_to_pitch_features(
                    f_audio=audio, Fs=SYNCTOOLBOX_RATE, feature_rate=FRAMES_PER_S
                ),
                module("feature.pitch_onset").audio_to_pitch_onset_features(
                    f_audio=audio, Fs=SYNCTOOLBOX_RATE
                ),
            ),
            (
                module("feature.csv_tools").df_to_pitch_features(table, feature_rate=FRAMES_PER_S),
                module("feature.csv_tools").df_to_pitch_onset_features(table),
            ),
        ):
            tones = chroma.quantize_chroma(f_chroma=chroma.pitch_to_chroma(f_pitch=pitch))
            begins = onset.pitch_onset_features_to_DLNCO(
                f_peaks=peaks, feature_sequence_length=tones.shape[1], feature_rate=FRAMES_PER_S
            )
            pairs.append((tones, begins))
        steps = module("dtw.mrmsdtw").sync_via_mrmsdtw(
            f_chroma1=pairs[0][0],
            f_onset1=pairs[0][1],
            f_chroma2=pairs[1][0],
            f_onset2=pairs[1][1],
            input_feature_rate=FRAMES_PER_S,
            step_weights=np.array([1.5, 1.5, 2.0]),
            threshold_rec=10**6,
        )
    path: Any = module("dtw.utils").make_path_strictly_monotonic(steps)
    heard = ~np.isnan(recording.onset_s)
    at_song, at_score = (np.asarray(row, dtype=np.float64) for row in path)
    frames = np.interp(notes.onset_s[heard] * FRAMES_PER_S, at_score, at_song)
    errors_ms = 1000 * np.abs(frames / FRAMES_PER_S + first / rate - recording.onset_s[heard])
    return Result(errors_ms, errors_ms)


def parangonar(recording: Recording, rate: int) -> Result:
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
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        found: list[dict[str, Any]] = module.AudioToScoreMatcher()(recording.samples, table, sample_rate=rate)
    at = np.full(len(notes), np.nan)
    for event in found:
        if event.get("score_id") is not None and event.get("performance_time") is not None:
            at[int(str(event["score_id"])[1:])] = float(event["performance_time"])
    heard = ~np.isnan(recording.onset_s) & ~np.isnan(at)
    errors_ms = 1000 * np.abs(at[heard] - recording.onset_s[heard])
    return Result(errors_ms, errors_ms)


OTHERS: dict[str, Callable[[Recording, int], Result]] = {
    name: aligner
    for name, aligner in {"synctoolbox": synctoolbox, "parangonar": parangonar}.items()
    if importlib.util.find_spec(name) is not None
}
"""Those that are installed."""
