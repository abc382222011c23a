"""A recording's samples, one channel at the rate at which it is listened to."""

import numpy as np
from numpy.typing import NDArray

from reina.errors import InputError
from reina.sound.recording.decode import decode
from reina.sound.recording.facts import AudioFacts, BrokenAudioError
from reina.sound.recording.probe import SUPPORTED, recognize
from reina.sound.recording.stream import Data
from reina.sound.recording.tags import skip_tags

LOWEST_KEPT_RATE = 20_000
"""Every n-th sample is kept, as long as so many a second are: what is above 10 kHz says little of notes."""
TAPS_A_STEP = 16
"""Half the length of the filter before that, for every sample left out: a windowed sinc."""


def read_mono(data: Data) -> tuple[NDArray[np.float32], int]:
    """Decode a recording, its channels' mean.

    Args:
        data: The whole file; it may hold anything.

    Returns:
        (S,) float32 with full scale 1 whose first sample is at 0 s, and samples a second.

    Raises:
        InputError: It is no audio, or of a format that is not decoded here (MP4, WebM), or holds no sound.
    """
    if not len(data):
        raise InputError(f"the song is an empty file; an audio file ({SUPPORTED}) is expected")
    start = skip_tags(data)
    audio_format = recognize(data, start)
    try:
        streams = audio_format.read(data, start)
        if isinstance(streams, AudioFacts):
            raise InputError(
                f"{audio_format.name} is not decoded here, only in the page, which plays it; convert it to "
                "WAV, AIFF, FLAC, MP3, Ogg Vorbis or Opus, as by "
                f"`ffmpeg -i song{audio_format.suffix} song.flac`"
            )
        thinner = Thinner()
        decoded = decode(streams, thinner.take)
    except BrokenAudioError as error:
        raise InputError(
            f"the song looks like {audio_format.name}, but {error}; {SUPPORTED} is expected"
        ) from error
    samples, rate = thinner.whole()
    return samples[: round(decoded.duration_s * rate)], rate


class Thinner:
    """Makes one channel of sound that comes in blocks, and keeps every n-th sample of it, filtered before."""

    def __init__(self) -> None:
        self._pieces: list[NDArray[np.float32]] = []
        self._before: NDArray[np.float32] = np.zeros(0, dtype=np.float32)
        self._taps: NDArray[np.float32] = np.ones(1, dtype=np.float32)
        self._step = 0
        self._rate = 0

    def take(self, block: NDArray[np.float32], rate: int) -> None:
        """Take in ``(F, C)`` at `rate` samples a second; what is no number counts as silence."""
        if not self._step:
            self._rate, self._step = rate, max(1, rate // LOWEST_KEPT_RATE)
            self._taps = _low_pass(self._step)
            # So many zeros stand before the first sample that the first output is centred on it.
            self._before = np.zeros(len(self._taps) // 2, dtype=np.float32)
        self._add(np.nan_to_num(block).mean(axis=1, dtype=np.float32))

    def whole(self) -> tuple[NDArray[np.float32], int]:
        """All that was taken in, (S,), and samples a second."""
        self._add(np.zeros(len(self._taps) // 2, dtype=np.float32))
        return np.concatenate(self._pieces), self._rate // max(1, self._step)

    def _add(self, samples: NDArray[np.float32]) -> None:
        waiting = np.concatenate((self._before, samples))
        count = (len(waiting) - len(self._taps)) // max(1, self._step) + 1
        if count <= 0:
            self._before = waiting
            return
        windows = np.lib.stride_tricks.sliding_window_view(waiting, len(self._taps))
        self._pieces.append(windows[:: max(1, self._step)][:count] @ self._taps)
        self._before = waiting[count * max(1, self._step) :]


def _low_pass(step: int) -> NDArray[np.float32]:
    """What leaves in what a step-th of the rate can hold; nothing where the step is 1."""
    if step == 1:
        return np.ones(1, dtype=np.float32)
    reach = TAPS_A_STEP * step
    places = np.arange(-reach, reach + 1)
    taps = np.sinc(places / step * 0.95) * np.hanning(2 * reach + 3)[1:-1]
    return (taps / taps.sum()).astype(np.float32)
