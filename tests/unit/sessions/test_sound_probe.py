import io
import struct
import wave
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from reina.errors import InputError
from reina.sessions.sound import probe_audio
from reina.sessions.sound_wav import wav_header


def wav(seconds: float = 1.5, rate: int = 8000) -> bytes:
    out = io.BytesIO()
    with wave.open(out, "wb") as file:
        file.setnchannels(2)
        file.setsampwidth(2)
        file.setframerate(rate)
        file.writeframes(bytes(round(seconds * rate) * 4))
    return out.getvalue()


def flac(samples: int = 66150) -> bytes:
    packed = 44100 << 44 | (2 - 1) << 41 | (16 - 1) << 36 | samples
    return b"fLaC" + b"\x80\0\0\x22" + bytes(10) + packed.to_bytes(8, "big") + bytes(16)


def ogg_page(granule: int, content: bytes) -> bytes:
    return b"OggS\0\0" + struct.pack("<qIIIB", granule, 1, 0, 0, 1) + bytes([len(content)]) + content


def opus(seconds: float = 1.5) -> bytes:
    head = b"OpusHead\x01\x02" + struct.pack("<HIhB", 312, 44100, 0, 0)
    return ogg_page(0, head) + ogg_page(312 + round(seconds * 48000), b"sound")


def vorbis(seconds: float = 1.5) -> bytes:
    head = b"\x01vorbis" + struct.pack("<IBIiiiBB", 0, 1, 22050, 0, 0, 0, 0, 1)
    return ogg_page(0, head) + ogg_page(round(seconds * 22050), b"sound")


def mp3_frames(count: int) -> bytes:
    """MPEG-1 Layer III, 128 kbit/s, 44.1 kHz, stereo: 417 bytes a frame."""
    return (b"\xff\xfb\x90\x00" + bytes(413)) * count


def xing(frames: int) -> bytes:
    side_info = bytes(32)
    body = b"\xff\xfb\x90\x00" + side_info + b"Xing" + struct.pack(">II", 1, frames)
    return body + bytes(417 - len(body))


def id3(content: int) -> bytes:
    return (
        b"ID3\x04\0\0"
        + bytes((content >> 21 & 127, content >> 14 & 127, content >> 7 & 127, content & 127))
        + bytes(content)
    )


def box(name: bytes, content: bytes) -> bytes:
    return struct.pack(">I4s", 8 + len(content), name) + content


def mp4(handler: bytes = b"soun") -> bytes:
    header = box(b"mvhd", bytes(4) + struct.pack(">IIII", 0, 0, 600, 900) + bytes(80))
    track = box(b"trak", box(b"tkhd", bytes(84)) + box(b"mdia", box(b"hdlr", bytes(8) + handler + bytes(13))))
    return box(b"ftyp", b"M4A \0\0\0\0M4A mp42") + box(b"mdat", bytes(50)) + box(b"moov", header + track)


def element(identifier: int, content: bytes) -> bytes:
    name = identifier.to_bytes((identifier.bit_length() + 7) // 8, "big")
    return name + (len(content) | 1 << 56).to_bytes(8, "big") + content


def webm(
    doc_type: bytes = b"webm", track_type: int = 2, duration: bytes = struct.pack(">d", 1500.0)
) -> bytes:
    info = element(0x1549A966, element(0x2AD7B1, (1_000_000).to_bytes(3, "big")) + element(0x4489, duration))
    tracks = element(0x1654AE6B, element(0xAE, element(0xD7, b"\1") + element(0x83, bytes([track_type]))))
    unknown_size = bytes.fromhex("18538067 01ffffffffffffff")
    return (
        element(0x1A45DFA3, element(0x4282, doc_type))
        + unknown_size
        + info
        + tracks
        + element(0x1F43B675, bytes(9))
    )


SONGS = {
    "wav": (wav(), "WAV", "audio/wav", 1.5, 8000, 2),
    "flac": (flac(), "FLAC", "audio/flac", 1.5, 44100, 2),
    "opus": (opus(), "Ogg", "audio/ogg", 1.5, 44100, 2),
    "vorbis": (vorbis(), "Ogg", "audio/ogg", 1.5, 22050, 1),
    "mp3 of constant rate": (mp3_frames(100), "MP3", "audio/mpeg", 100 * 417 * 8 / 128000, 44100, 2),
    "mp3 with a count": (
        id3(300) + xing(50) + mp3_frames(3),
        "MP3",
        "audio/mpeg",
        50 * 1152 / 44100,
        44100,
        2,
    ),
    "mp4": (mp4(), "MP4", "audio/mp4", 1.5, None, None),
    "webm": (webm(), "WebM", "audio/webm", 1.5, None, None),
}


@pytest.mark.parametrize("name", SONGS)
def test_tells_format_and_length(tmp_path: Path, name: str) -> None:
    data, audio_format, media_type, duration_s, sample_rate, channels = SONGS[name]
    song = tmp_path / "named.misleadingly"
    song.write_bytes(data)
    info = probe_audio(song)
    assert (info.format, info.media_type) == (audio_format, media_type)
    assert info.duration_s == pytest.approx(duration_s, rel=1e-6)
    assert (info.sample_rate, info.channels) == (sample_rate, channels)


REFUSED = {
    "empty": (b"", "empty"),
    "text": (b"Not a song at all, only words.", "no audio file"),
    "MIDI": (b"MThd\0\0\0\x06\0\0\0\x01\0\x60", "no audio file"),
    "WAV without samples": (wav(0), "no samples"),
    "WAV without data": (wav()[:36], "no data chunk"),
    "FLAC that breaks off": (flac()[:20], "STREAMINFO"),
    "Ogg with pictures": (ogg_page(0, b"\x80theora" + bytes(40)), "no Vorbis"),
    "tag without frames": (id3(200), "no MP3 frame"),
    "MP4 with pictures only": (mp4(b"vide"), "no track of sound"),
    "MP4 that breaks off": (mp4()[:60], "no moov"),
    "MP4 with an impossible box": (mp4()[:24] + struct.pack(">I4s", 3, b"free"), "impossible length"),
    "Matroska": (webm(doc_type=b"matroska"), "another kind"),
    "WebM with pictures only": (webm(track_type=1), "no track of sound"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_refuses_with_the_fault_and_what_would_be_right(tmp_path: Path, name: str) -> None:
    data, fault = REFUSED[name]
    song = tmp_path / "song.mp3"
    song.write_bytes(data)
    with pytest.raises(InputError, match=fault) as refused:
        probe_audio(song)
    assert "MP3" in refused.value.detail


def test_length_is_unknown_where_a_recorder_leaves_it_out(tmp_path: Path) -> None:
    song = tmp_path / "song"
    song.write_bytes(webm(duration=b""))
    assert probe_audio(song).duration_s is None
    song.write_bytes(flac(samples=0))
    assert probe_audio(song).duration_s is None


@pytest.mark.parametrize("placeholder", [0, 0xFFFFFFFF])
def test_a_streamed_wav_lasts_as_long_as_its_file(tmp_path: Path, placeholder: int) -> None:
    data = bytearray(wav())
    struct.pack_into("<I", data, 40, placeholder)
    song = tmp_path / "song"
    song.write_bytes(data)
    assert probe_audio(song).duration_s == pytest.approx(1.5)


def test_own_wav_header_is_read_back_by_others(tmp_path: Path) -> None:
    song = tmp_path / "song.wav"
    song.write_bytes(wav_header(1000, sample_rate=48000, channels=2) + bytes(4000))
    with wave.open(str(song)) as file:
        assert file.getparams()[:4] == (2, 2, 48000, 1000)


@given(st.sampled_from(sorted(SONGS)), st.data())
def test_broken_songs_are_refused_or_read_but_never_crash(
    tmp_path_factory: pytest.TempPathFactory, name: str, data: st.DataObject
) -> None:
    whole = SONGS[name][0]
    broken = bytearray(whole[: data.draw(st.integers(0, len(whole)))])
    for at, byte in data.draw(st.lists(st.tuples(st.integers(0, 200), st.integers(0, 255)), max_size=5)):
        if at < len(broken):
            broken[at] = byte
    song = tmp_path_factory.getbasetemp() / "broken"
    song.write_bytes(broken)
    try:
        duration_s = probe_audio(song).duration_s
    except InputError:
        return
    assert duration_s is None or duration_s >= 0


def test_a_song_that_claims_to_last_for_weeks_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "song"
    path.write_bytes(flac((1 << 36) - 1))
    with pytest.raises(InputError, match="433 hours"):
        probe_audio(path)
    path.write_bytes(flac(44100 * 3600 * 23))
    assert probe_audio(path).duration_s == 23 * 3600
