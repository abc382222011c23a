"""What a recording is: its format by its content and never its name, its length and peaks by decoding."""

import io
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO, cast

from reina.errors import InputError
from reina.music import ScoreWarning
from reina.sound.recording import aiff as sound_aiff
from reina.sound.recording import flac as sound_flac
from reina.sound.recording import mp3 as sound_mp3
from reina.sound.recording import mp4 as sound_mp4
from reina.sound.recording import ogg as sound_ogg
from reina.sound.recording import wav as sound_wav
from reina.sound.recording import webm as sound_webm
from reina.sound.recording.as_flac import MEDIA_TYPE as FLAC_MEDIA_TYPE
from reina.sound.recording.as_flac import fits, write_as_flac
from reina.sound.recording.decode import LONGEST_S, Decoded, decode
from reina.sound.recording.facts import AudioFacts, BrokenAudioError
from reina.sound.recording.peaks import Peaks
from reina.sound.recording.stream import Data, SoundStream, Splice
from reina.sound.recording.tags import skip_tags

HEAD_BYTES = 16
"""How many bytes are looked at to tell a format."""
CLAIM_TOLERANCE_S = 0.1
"""By how much what a container says may differ from what is decoded without a warning."""
LOWEST_RATE = 3000
"""Samples a second that Chromium plays at least."""
PLAYED_CODINGS = frozenset(
    ("PCM_U8", "PCM_16", "PCM_24", "PCM_32", "FLOAT", "ALAW", "ULAW", "VORBIS", "OPUS", "MPEG_LAYER_III")
)
"""libsndfile's names of what Chromium plays; FLAC has the names of what it was made of."""


@dataclass(frozen=True)
class AudioInfo:
    """What a song file is.

    Attributes:
        format: Name for people: ``"WAV"``, ``"AIFF"``, ``"MP3"``, ``"Ogg"``, ``"FLAC"``, ``"MP4"`` or
            ``"WebM"``.
        media_type: To be served with, such as ``"audio/mpeg"``.
        suffix: Of a file name, with its dot.
        duration_s: Length in seconds as decoded, for MP4 and WebM as they say; None where they do not.
        sample_rate: Samples a second, or None.
        channels: 1 for mono, 2 for stereo, or None.
        warnings: What its sender should know.
        is_converted: Whether it is served as FLAC, as most browsers do not play its kind; `media_type` is
            FLAC's then, `suffix` still that of the file as it came.
    """

    format: str
    media_type: str
    suffix: str
    duration_s: float | None = None
    sample_rate: int | None = None
    channels: int | None = None
    warnings: tuple[ScoreWarning, ...] = ()
    is_converted: bool = False


@dataclass(frozen=True)
class AudioFormat:
    """One row of the table of formats: how it is called and recognized, and how it is read.

    Attributes:
        read: Finds the sound in it, from an offset, to be decoded; or what its headers say, where it is not
            decoded here.
        is_played: Whether most browsers play it.
    """

    name: str
    media_type: str
    suffix: str
    recognizes: Callable[[bytes], bool]
    read: Callable[[Data, int], list[SoundStream] | AudioFacts]
    is_played: bool = True


def _headers(read: Callable[[BinaryIO, int], AudioFacts]) -> Callable[[Data, int], AudioFacts]:
    def read_from(data: Data, start: int) -> AudioFacts:
        file = io.BufferedReader(Splice(data, range(start, len(data))))
        return read(file, len(data) - start)

    return read_from


MP3 = AudioFormat("MP3", "audio/mpeg", ".mp3", lambda head: head.startswith(b"ID3"), sound_mp3.mp3_streams)
FORMATS = (
    AudioFormat("WAV", "audio/wav", ".wav", sound_wav.is_wav, sound_wav.wav_streams),
    AudioFormat("AIFF", "audio/aiff", ".aiff", sound_aiff.is_aiff, sound_aiff.aiff_streams, is_played=False),
    AudioFormat("FLAC", "audio/flac", ".flac", sound_flac.is_flac, sound_flac.flac_streams),
    AudioFormat("Ogg", "audio/ogg", ".ogg", sound_ogg.is_ogg, sound_ogg.ogg_streams),
    AudioFormat("MP4", "audio/mp4", ".m4a", sound_mp4.is_mp4, _headers(sound_mp4.read_mp4)),
    AudioFormat("WebM", "audio/webm", ".webm", sound_webm.is_webm, _headers(sound_webm.read_webm)),
)

SUPPORTED = "WAV, AIFF, MP3, Ogg, FLAC, M4A or WebM"


@dataclass(frozen=True)
class Conversion:
    """Where a recording is to be written as FLAC.

    Attributes:
        path: Where to.
        is_forced: Whether that is to be done even if browsers play it as it is.
    """

    path: Path
    is_forced: bool = False


def probe_recording(data: Data, conversion: Conversion | None = None) -> tuple[AudioInfo, Peaks | None]:
    """Tell what a recording is, and decode it, but for MP4 and WebM, of which only headers are read.

    The decoder is foreign code: files from outside are probed in a process of its own
    (`reina.sound.recording.worker`).

    Args:
        data: The whole file.
        conversion: Where what most browsers do not play is written as FLAC; None: it is not.

    Returns:
        What it is, and its peaks if it was decoded.

    Raises:
        InputError: It is empty, is no audio that a browser plays, holds no sound, or lasts too long.
    """
    if not len(data):
        raise InputError(f"the song is an empty file; an audio file ({SUPPORTED}) is expected")
    start = skip_tags(data)
    audio_format = recognize(data, start)
    try:
        streams = audio_format.read(data, start)
        if isinstance(streams, AudioFacts):
            return _undecoded(audio_format, streams), None
        decoded = decode(streams)
        is_played = audio_format.is_played and (
            audio_format.name == "FLAC" or decoded.coding in PLAYED_CODINGS
        )
        if conversion is not None and (not fits(decoded) or (is_played and not conversion.is_forced)):
            conversion = None
        if conversion is not None:
            # What was decoded once has been read to its end.
            write_as_flac(conversion.path, cast("list[SoundStream]", audio_format.read(data, start)), decoded)
    except BrokenAudioError as error:
        detail = f"the song looks like {audio_format.name}, but {error}; {SUPPORTED} is expected"
        raise InputError(detail) from error
    info = AudioInfo(
        audio_format.name,
        FLAC_MEDIA_TYPE if conversion else audio_format.media_type,
        audio_format.suffix,
        decoded.duration_s,
        decoded.sample_rate,
        decoded.channels,
        tuple(_warnings(decoded, audio_format, is_played=is_played or conversion is not None)),
        is_converted=conversion is not None,
    )
    return info, decoded.peaks


def recognize(data: Data, start: int) -> AudioFormat:
    """The format of a file whose tags end at `start`.

    Raises:
        InputError: It is no audio that is known.
    """
    head = data[start : start + HEAD_BYTES]
    for audio_format in FORMATS:
        if audio_format.recognizes(head):
            return audio_format
    # MP3 has no mark of its own: it is what has frames, and zeros or other bytes may stand before the first.
    if MP3.recognizes(data[:HEAD_BYTES]) or sound_mp3.find_first_frame(data, start):
        return MP3
    raise InputError(f"the song is no audio file that is known here; {SUPPORTED} is expected")


def media_type_of(suffix: str) -> str:
    """What files of a suffix, as `AudioInfo` has it, are served with."""
    return next(each.media_type for each in (*FORMATS, MP3) if each.suffix == suffix)


def _undecoded(audio_format: AudioFormat, facts: AudioFacts) -> AudioInfo:
    if facts.duration_s is not None and not 0 <= facts.duration_s <= LONGEST_S:
        claimed = f"{facts.duration_s / 3600:,.0f} hours"
        raise InputError(
            f"the song's headers say that it lasts {claimed}; at most {LONGEST_S / 3600:.0f} are played"
        )
    return AudioInfo(
        audio_format.name,
        audio_format.media_type,
        audio_format.suffix,
        facts.duration_s,
        facts.sample_rate,
        facts.channels,
    )


def _warnings(decoded: Decoded, audio_format: AudioFormat, *, is_played: bool) -> Iterator[ScoreWarning]:
    claimed_s = decoded.claimed_s
    if claimed_s is not None and abs(claimed_s - decoded.duration_s) > CLAIM_TOLERANCE_S:
        yield ScoreWarning(
            "song_length",
            "song",
            f"the file says that it lasts {claimed_s:.2f} s, and what is in it lasts "
            f"{decoded.duration_s:.2f} s, which counts",
        )
    if decoded.damaged_s:
        first_s, others = decoded.damaged_s[0], len(decoded.damaged_s) - 1
        more = f" and at {others} other places" if others else ""
        yield ScoreWarning(
            "song_damaged",
            f"song, {first_s:.1f} s",
            f"the file is damaged here{more}: what cannot be decoded is left out",
        )
    if decoded.other_form is not None:
        yield ScoreWarning(
            "song_form",
            f"song, {decoded.duration_s:.1f} s",
            f"the file goes on here with {decoded.other_form}, which browsers do not play after what came "
            "before; the song ends here",
        )
    if not is_played:
        yield ScoreWarning(
            "song_not_played",
            "song",
            f"most browsers do not play this kind of {audio_format.name} ({decoded.coding}); 16-bit WAV, "
            "MP3, FLAC, Ogg Vorbis or Opus would be played",
        )
    if decoded.sample_rate < LOWEST_RATE:
        yield ScoreWarning(
            "song_not_played",
            "song",
            f"most browsers do not play {decoded.sample_rate} samples a second; {LOWEST_RATE} or more would "
            "be played",
        )
