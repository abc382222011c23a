"""What kind of audio a file holds, told from its first bytes and never from its name."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO

from reina.errors import InputError
from reina.sessions import sound_flac, sound_mp3, sound_mp4, sound_ogg, sound_wav, sound_webm
from reina.sessions.sound_facts import AudioFacts, BrokenAudioError

HEAD_BYTES = 16
"""How many bytes of a file are looked at to tell its format."""
LONGEST_S = 24 * 3600.0
"""A song that lasts longer is none: a header of a few bytes can claim two thousand years."""


@dataclass(frozen=True)
class AudioInfo:
    """A song file, as far as its headers tell.

    Attributes:
        format: Name for people: ``"WAV"``, ``"MP3"``, ``"Ogg"``, ``"FLAC"``, ``"MP4"``, ``"WebM"``.
        media_type: To be served with, such as ``"audio/mpeg"``.
        suffix: Of a file name, with its dot.
        duration_s: Length in seconds, or None where only decoding would tell.
        sample_rate: Samples a second, or None.
        channels: 1 for mono, 2 for stereo, or None.
    """

    format: str
    media_type: str
    suffix: str
    duration_s: float | None = None
    sample_rate: int | None = None
    channels: int | None = None


@dataclass(frozen=True)
class AudioFormat:
    """One row of the table of formats: how it is recognized, called and read."""

    name: str
    media_type: str
    suffix: str
    recognizes: Callable[[bytes], bool]
    read: Callable[[BinaryIO, int], AudioFacts]


FORMATS = (
    AudioFormat("WAV", "audio/wav", ".wav", sound_wav.is_wav, sound_wav.read_wav),
    AudioFormat("FLAC", "audio/flac", ".flac", sound_flac.is_flac, sound_flac.read_flac),
    AudioFormat("Ogg", "audio/ogg", ".ogg", sound_ogg.is_ogg, sound_ogg.read_ogg),
    AudioFormat("MP4", "audio/mp4", ".m4a", sound_mp4.is_mp4, sound_mp4.read_mp4),
    AudioFormat("WebM", "audio/webm", ".webm", sound_webm.is_webm, sound_webm.read_webm),
    AudioFormat("MP3", "audio/mpeg", ".mp3", sound_mp3.is_mp3, sound_mp3.read_mp3),
)

SUPPORTED = "WAV, MP3, Ogg, FLAC, M4A or WebM"


def probe_audio(path: Path) -> AudioInfo:
    """Tell format and length of an audio file from its headers; nothing is decoded.

    Raises:
        InputError: The file is empty, is no audio that a browser plays, breaks off within its headers, or
            claims to last longer than a day.
    """
    size = path.stat().st_size
    if size == 0:
        raise InputError(f"the song is an empty file; an audio file ({SUPPORTED}) is expected")
    with path.open("rb") as file:
        head = file.read(HEAD_BYTES)
        for audio_format in FORMATS:
            if audio_format.recognizes(head):
                break
        else:
            raise InputError(f"the song is no audio file that is known here; {SUPPORTED} is expected")
        file.seek(0)
        try:
            facts = audio_format.read(file, size)
        except BrokenAudioError as error:
            detail = f"the song looks like {audio_format.name}, but {error}; {SUPPORTED} is expected"
            raise InputError(detail) from error
    if facts.duration_s is not None and not 0 <= facts.duration_s <= LONGEST_S:
        claimed = f"{facts.duration_s / 3600:,.0f} hours"
        raise InputError(
            f"the song's headers say that it lasts {claimed}; at most {LONGEST_S / 3600:.0f} are played"
        )
    return AudioInfo(
        format=audio_format.name,
        media_type=audio_format.media_type,
        suffix=audio_format.suffix,
        duration_s=facts.duration_s,
        sample_rate=facts.sample_rate,
        channels=facts.channels,
    )
