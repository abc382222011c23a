"""Decodes sound block by block: its length and its peaks. libsndfile does the work, through `soundfile`."""

from __future__ import annotations

import os
import shutil
import threading
from collections import deque
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
import soundfile

from reina.errors import InputError
from reina.sound.recording.facts import BrokenAudioError
from reina.sound.recording.peaks import PeakMeter, Peaks

if TYPE_CHECKING:
    from collections.abc import Callable, Generator, Iterable

    from numpy.typing import NDArray

    from reina.sound.recording.stream import SoundStream, Splice

    Listener = Callable[[NDArray[np.float32], int], None]

LONGEST_S = 4 * 3600.0
"""A song may last as long as a score: a small file can hold days of silence."""
BLOCK_FRAMES = 4096
"""Samples of each channel that are decoded at once: a frame of most FLAC files, so that a broken one takes no
other with it."""
PIPE_BYTES = 1 << 16
MAX_ERRORS = 1000
"""How often in a row decoding may fail without a sample. It goes on behind what could not be read, for MP3 a
kilobyte further each time."""
UNKNOWN_FRAMES = 1 << 56
"""libsndfile's word for a length that it does not know is larger than that."""
HIGHEST_RATE, MAX_CHANNELS = 768_000, 32
"""What browsers play at most, as measured in Chromium."""


@dataclass
class Decoded:
    """What came of decoding.

    Attributes:
        coding: libsndfile's name of the coding, such as ``"PCM_16"`` or ``"VORBIS"``.
        sample_rate: Samples a second, at the beginning.
        channels: At the beginning.
        duration_s: Length in seconds.
        claimed_s: Length as the container says, or None where it does not.
        damaged_s: Where something could not be decoded though sound follows: seconds from the beginning.
        peaks: The sound's shape.
        other_form: What the sound would go on with, such as ``"48000 samples a second, 1 channel"``, where
            decoding stopped for it; None where it did not.
    """

    coding: str = ""
    sample_rate: int = 0
    channels: int = 0
    duration_s: float = 0.0
    claimed_s: float | None = 0.0
    damaged_s: list[float] = field(default_factory=list[float])
    peaks: Peaks | None = None
    other_form: str | None = None


class _Reading(soundfile.SoundFile):
    """A file that is read forward only: `soundfile` would seek after each block, and stop at a claim."""

    def seekable(self) -> bool:
        return False


def decode(streams: Iterable[SoundStream], listener: Listener | None = None) -> Decoded:
    """Decode streams that follow one another, in the memory that a block takes, whatever they claim.

    It ends before a stream of another sample rate or number of channels, as Chromium does.

    Args:
        streams: What is decoded.
        listener: Is given every block that is decoded: ``(F, C)`` float32, which is overwritten afterwards,
            and samples a second. What encoders add at the end is among it, beyond the length returned.

    Raises:
        BrokenAudioError: There is no sound in them.
        InputError: They last longer than `LONGEST_S`.
    """
    decoded = Decoded()
    meter: PeakMeter | None = None
    complaint = "it holds no sound"
    waiting = deque(streams)
    while waiting:
        stream = waiting.popleft()
        try:
            with _opened(stream) as file:
                if meter is None:
                    _check(file)
                    decoded.coding = file.subtype
                    decoded.sample_rate, decoded.channels = file.samplerate, file.channels
                    meter = PeakMeter(file.samplerate, file.channels)
                elif (file.samplerate, file.channels) != (decoded.sample_rate, decoded.channels):
                    decoded.other_form = f"{file.samplerate} samples a second, {file.channels} channels"
                    break
                stopped_after = _decode_stream(stream, file, meter, decoded, listener)
            if stopped_after is not None and stream.resume and (rest := stream.resume(stopped_after)):
                decoded.damaged_s.append(decoded.duration_s)
                waiting.appendleft(rest)
        except soundfile.LibsndfileError as error:
            complaint = f"it cannot be decoded ({error.error_string.strip().rstrip('.')})"
            if decoded.duration_s:
                decoded.damaged_s.append(decoded.duration_s)
    if meter is None or decoded.duration_s <= 0:
        raise BrokenAudioError(complaint)
    decoded.peaks = meter.peaks(decoded.duration_s)
    return decoded


def _check(file: soundfile.SoundFile) -> None:
    for what, found, most in (
        ("samples a second", file.samplerate, HIGHEST_RATE),
        ("channels", file.channels, MAX_CHANNELS),
    ):
        if found > most:
            raise BrokenAudioError(f"it has {found:,} {what}, of which {most:,} at most are played")


def _decode_stream(
    stream: SoundStream,
    file: soundfile.SoundFile,
    meter: PeakMeter,
    decoded: Decoded,
    listener: Listener | None,
) -> int | None:
    """Decode to the end, or to where the decoder stops for good; after how many frames, in that case."""
    rate, begin_s = file.samplerate, decoded.duration_s
    buffer = np.empty((BLOCK_FRAMES, file.channels), dtype=np.float32)
    frames, skip, errors, failed_at = 0, stream.leading, 0, -1
    while errors < MAX_ERRORS:
        # What is still no number after a failure was not decoded.
        buffer.fill(np.nan)
        failed = False
        try:
            count = len(file.read(out=buffer))
        except soundfile.LibsndfileError:
            failed = True
            missing = np.isnan(buffer[:, 0])
            count = int(missing.argmax()) if missing.any() else len(buffer)
        if count == 0 and not failed:
            break
        if count > 0 and failed_at >= 0:
            decoded.damaged_s.append(begin_s + failed_at / rate)
            failed_at = -1
        skipped = min(skip, count)
        skip -= skipped
        frames += count - skipped
        meter.take(buffer[skipped:count])
        if listener is not None:
            listener(buffer[skipped:count], rate)
        decoded.duration_s = begin_s + frames / rate
        if decoded.duration_s > LONGEST_S:
            raise InputError(f"the song lasts over {LONGEST_S / 3600:.0f} hours; at most so much is played")
        errors = errors + 1 if failed and count == 0 else 0
        if failed and failed_at < 0:
            failed_at = frames
    claimed = _ogg_claim(stream) if stream.is_ogg else stream.claimed_frames
    if claimed is not None and 0 < frames - claimed <= stream.trailing:
        decoded.duration_s = begin_s + claimed / rate
    if claimed is None:
        decoded.claimed_s = None
    elif decoded.claimed_s is not None:
        decoded.claimed_s += claimed / rate
    return frames if failed_at >= 0 else None


def _ogg_claim(stream: SoundStream) -> int | None:
    """How many frames an Ogg link has by the positions on its pages; None where they do not tell."""
    stream.splice.seek(0)
    try:
        with soundfile.SoundFile(stream.splice) as file:
            return file.frames if 0 < file.frames < UNKNOWN_FRAMES else None
    except soundfile.LibsndfileError:
        return None


@contextmanager
def _opened(stream: SoundStream) -> Generator[soundfile.SoundFile]:
    if not stream.piped:
        with _Reading(stream.splice) as file:
            yield file
        return
    reading_end, writing_end = os.pipe()
    feeder = threading.Thread(target=_feed, args=(stream.splice, writing_end), daemon=True)
    feeder.start()
    try:
        with _Reading(reading_end, closefd=False) as file:
            yield file
    finally:
        # The feeder's next write fails, and it ends.
        os.close(reading_end)
        feeder.join()


def _feed(splice: Splice, writing_end: int) -> None:
    with suppress(BrokenPipeError), open(writing_end, "wb") as pipe:
        shutil.copyfileobj(splice, pipe, PIPE_BYTES)
