"""What recordings are, and how long: by decoding, whatever their headers say."""

from __future__ import annotations

import io
import struct
import wave
from typing import TYPE_CHECKING

import pytest
import soundfile
from tests.unit.sound.recording.recordings import (
    RATE,
    element,
    first_frame_bytes,
    flac_in_ogg,
    flac_with_length,
    id3,
    mp4,
    ogg_page,
    ogg_pages,
    ogg_shifted,
    patched,
    recording,
    riff,
    wav,
    webm,
)

from reina.errors import InputError
from reina.sound.recording import decode as sound_decode
from reina.sound.recording.probe import Conversion, probe_recording
from reina.sound.recording.wav import wav_header

if TYPE_CHECKING:
    from pathlib import Path

WAV = wav()
AIFF = recording("AIFF", "PCM_16")
FLAC = recording("FLAC", "PCM_16")
MP3 = recording("MP3", "MPEG_LAYER_III")
VORBIS = recording("OGG", "VORBIS")
LONG_VORBIS = recording("OGG", "VORBIS", seconds=6.0)
OPUS = recording("OGG", "OPUS", rate=48_000)
BARE_MP3 = MP3[first_frame_bytes(MP3) :]
"""Without the encoder's own frame, which holds the number of the others."""
AS_ENCODED_S = 1.05
"""As a coded MP3 lasts with what the encoder put before and behind, at most."""

PLAIN = {
    "WAV": (WAV, "WAV", "audio/wav", ".wav"),
    "FLAC": (FLAC, "FLAC", "audio/flac", ".flac"),
    "MP3": (MP3, "MP3", "audio/mpeg", ".mp3"),
    "Vorbis": (VORBIS, "Ogg", "audio/ogg", ".ogg"),
    "Opus": (OPUS, "Ogg", "audio/ogg", ".ogg"),
    "FLAC in Ogg": (flac_in_ogg(FLAC), "Ogg", "audio/ogg", ".ogg"),
    "RF64": (recording("RF64", "PCM_16"), "WAV", "audio/wav", ".wav"),
    "extensible WAV": (recording("WAVEX", "PCM_24"), "WAV", "audio/wav", ".wav"),
}


@pytest.mark.parametrize("tag", [b"", id3(300), id3(300) + id3(70_000)], ids=["", "ID3", "two ID3"])
@pytest.mark.parametrize("name", PLAIN)
def test_tells_format_and_length(name: str, tag: bytes) -> None:
    data, audio_format, media_type, suffix = PLAIN[name]
    info, peaks = probe_recording(tag + data)
    assert (info.format, info.media_type, info.suffix) == (audio_format, media_type, suffix)
    assert info.duration_s == pytest.approx(1.0, abs=1e-4)
    assert (info.sample_rate, info.channels) == (48_000 if name == "Opus" else RATE, 2)
    assert info.warnings == ()
    assert peaks is not None
    assert peaks.duration_s == info.duration_s
    drawn = peaks.reduced(10)
    assert drawn.highest == pytest.approx([0.5] * 10, abs=0.03)
    assert drawn.lowest == pytest.approx([-0.5] * 10, abs=0.03)


QUIET = {
    "zeros before the first frame": (bytes(5000) + MP3, 1.0, 1e-4),
    "an ID3 tag, then zeros": (id3(300) + bytes(4096) + MP3, 1.0, 1e-4),
    "an ID3 tag that is longer than it says": (b"ID3\x04\0\0\0\0\0\5" + bytes(300) + MP3, 1.0, 1e-4),
    "an ID3 tag that claims more than the file": (
        b"ID3\x04\0\0\x7f\x7f\x7f\x7f" + bytes(300) + MP3,
        1.0,
        1e-4,
    ),
    "an ID3v1 tag behind MP3": (MP3 + b"TAG" + b"x" * 125, 1.0, 1e-4),
    "zeros behind MP3": (MP3 + bytes(30_000), 1.0, 1e-4),
    "MP3 without the number of its frames": (BARE_MP3, AS_ENCODED_S, 0.05),
    "MP3 without it, joined": (BARE_MP3 + BARE_MP3, 2 * AS_ENCODED_S, 0.1),
    "FLAC without a length": (flac_with_length(FLAC, 0), 1.0, 1e-4),
    "FLAC, joined": (FLAC + FLAC, 2.0, 1e-4),
    "something behind FLAC": (FLAC + b"TAG" + b"x" * 125, 1.0, 1e-4),
    "Vorbis that begins at one hour": (ogg_shifted(VORBIS, 3600 * RATE), 1.0, 0.02),
    "Opus that begins at one hour": (ogg_shifted(OPUS, 3600 * 48_000), 1.0, 0.01),
    "Vorbis, joined": (VORBIS + VORBIS, 2.0, 1e-4),
    "Opus, joined": (OPUS + OPUS + OPUS, 3.0, 1e-4),
    "something between Ogg's links": (VORBIS + b"OggS and more" + VORBIS, 2.0, 1e-4),
    "WAV at 0 bytes a second": (patched(WAV, "<I", 28, 0), 1.0, 1e-4),
    "WAV at 1 byte a second": (patched(WAV, "<I", 28, 1), 1.0, 1e-4),
    "WAV at twice its bytes a second": (patched(WAV, "<I", 28, 8 * RATE), 1.0, 1e-4),
    "WAV that was streamed, size 0": (patched(WAV, "<I", 40, 0), 1.0, 1e-4),
    "WAV that was streamed, sizes 0": (patched(patched(WAV, "<I", 40, 0), "<I", 4, 0), 1.0, 1e-4),
    "WAV that was streamed, largest size": (patched(WAV, "<I", 40, 0xFFFFFFFF), 1.0, 1e-4),
    "WAV that was streamed, half of it": (patched(WAV, "<I", 40, 0x7FFFFFFF), 1.0, 1e-4),
    "WAV, joined": (WAV + WAV, 1.0, 1e-4),
    "WAV in blocks of 0 bytes": (patched(WAV, "<H", 32, 0), 1.0, 1e-4),
}
"""What browsers play to the end, and what lasts as long there, as measured in Chromium (docs/sound.md)."""


@pytest.mark.parametrize("name", QUIET)
def test_what_is_decoded_counts_and_not_what_headers_say(name: str) -> None:
    data, duration_s, tolerance_s = QUIET[name]
    info, peaks = probe_recording(data)
    assert info.duration_s == pytest.approx(duration_s, abs=tolerance_s)
    assert info.warnings == ()
    assert peaks is not None
    assert peaks.lowest.size == pytest.approx(200 * duration_s, abs=200 * tolerance_s + 3)


XING = MP3.find(b"Xing") if b"Xing" in MP3[:60] else MP3.find(b"Info")
TOLD = {
    "MP3 that claims too many frames": (patched(MP3, ">I", XING + 8, 100_000), 1.0, "lasts 2612.*lasts 1.0"),
    "MP3 that claims too few": (patched(MP3, ">I", XING + 8, 10), 1.0, "lasts 0.2.*lasts 1.0"),
    "MP3, joined": (MP3 + id3(50) + MP3, 2.05, "lasts 1.00 s.*lasts 2.0"),
    "FLAC that claims 433 hours": (flac_with_length(FLAC, (1 << 36) - 1), 1.0, "lasts 1558264.* lasts 1.00"),
    "FLAC that claims too little": (flac_with_length(FLAC, 4410), 1.0, "lasts 0.10 s.*lasts 1.00"),
    "Vorbis that ends late": (ogg_shifted(LONG_VORBIS, 3600 * RATE, last_alone=True), 6.0, "lasts 3606"),
    "Opus that ends late": (ogg_shifted(OPUS, 3600 * 48_000, last_alone=True), 1.0, "lasts 3601"),
    "WAV that breaks off": (WAV[: 44 + RATE * 2], 0.5, "lasts 1.00 s.*lasts 0.50"),
    "FLAC that breaks off": (FLAC[: len(FLAC) * 2 // 3], 0.65, "lasts 1.00 s.*lasts 0.6"),
    "MP3 that breaks off": (MP3[: len(MP3) // 2], 0.39, "lasts 1.00 s.*lasts 0.3"),
}


@pytest.mark.parametrize("name", TOLD)
def test_tells_where_the_file_says_another_length(name: str) -> None:
    data, duration_s, told = TOLD[name]
    info, _ = probe_recording(data)
    assert info.duration_s == pytest.approx(duration_s, abs=0.06)
    assert [(warning.kind, warning.place) for warning in info.warnings] == [("song_length", "song")]
    with pytest.raises(AssertionError, match=told):
        raise AssertionError(info.warnings[0].message)


def test_goes_on_behind_damage_and_tells_it() -> None:
    middle = len(BARE_MP3) // 2
    info, _ = probe_recording(BARE_MP3[:middle] + bytes(20_000) + BARE_MP3[middle:])
    assert info.duration_s == pytest.approx(1.0, abs=0.1)
    assert [warning.kind for warning in info.warnings] == ["song_damaged"]
    assert info.warnings[0].place.startswith("song, 0.")


@pytest.mark.parametrize("channels", [1, 2])
def test_one_broken_frame_of_flac_is_left_out_and_what_follows_is_not(channels: int) -> None:
    flac = recording("FLAC", "PCM_16", seconds=3.0, channels=channels)
    for place in range(len(flac) // 8, len(flac) * 7 // 8, len(flac) // 8):
        broken = flac[:place] + bytes([flac[place] ^ 1]) + flac[place + 1 :]
        info, peaks = probe_recording(broken)
        assert 3.0 - 1.5 * 4096 / RATE < (info.duration_s or 0.0) <= 3.0
        assert [warning.kind for warning in info.warnings if warning.kind != "song_length"] == [
            "song_damaged"
        ]
        assert peaks is not None
        # The tone is as loud at the end as at the beginning: nothing is taken for sound that is none.
        assert peaks.highest.max() == pytest.approx(0.5, abs=0.03)
    hole, _ = probe_recording(flac[:8000] + bytes(20_000) + flac[8000:])
    assert hole.duration_s == pytest.approx(3.0, abs=0.1)


@pytest.mark.parametrize(
    "other",
    [recording("OGG", "VORBIS", rate=48_000), recording("OGG", "VORBIS", channels=1)],
    ids=["rate", "channels"],
)
def test_ends_before_a_link_of_another_form_as_browsers_do(other: bytes) -> None:
    info, peaks = probe_recording(VORBIS + other)
    assert info.duration_s == pytest.approx(1.0)
    assert peaks is not None
    assert peaks.lowest.size == 201
    assert [warning.kind for warning in info.warnings] == ["song_form"]


@pytest.mark.parametrize("coding", ["DOUBLE", "IMA_ADPCM", "MS_ADPCM", "GSM610"])
def test_tells_what_browsers_do_not_play(coding: str) -> None:
    rate = 8000 if coding == "GSM610" else RATE
    info, _ = probe_recording(recording("WAV", coding, channels=1, rate=rate))
    assert info.duration_s == pytest.approx(1.0, abs=0.1)
    assert [warning.kind for warning in info.warnings] == ["song_not_played"]
    assert coding in info.warnings[0].message
    slow, _ = probe_recording(wav(rate=2999))
    assert [warning.kind for warning in slow.warnings] == ["song_not_played"]
    assert probe_recording(wav(rate=3000))[0].warnings == ()


AIFF_CODINGS = ("PCM_S8", "PCM_16", "PCM_24", "PCM_32", "FLOAT", "DOUBLE", "ALAW", "ULAW", "IMA_ADPCM")


@pytest.mark.parametrize("coding", AIFF_CODINGS)
def test_aiff_of_every_coding_is_decoded_and_told_not_to_be_played(coding: str) -> None:
    info, peaks = probe_recording(id3(300) + recording("AIFF", coding))
    assert (info.format, info.media_type, info.suffix) == ("AIFF", "audio/aiff", ".aiff")
    assert info.duration_s == pytest.approx(1.0, abs=2e-3)
    assert [warning.kind for warning in info.warnings] == ["song_not_played"]
    assert peaks is not None
    assert peaks.reduced(10).highest == pytest.approx([0.5] * 10, abs=0.03)


def test_aiff_whose_end_is_missing_or_whose_lengths_are_wrong_is_what_is_decoded() -> None:
    frames, size = AIFF.index(b"COMM") + 10, AIFF.index(b"SSND") + 4
    half, _ = probe_recording(AIFF[: len(AIFF) // 2])
    assert half.duration_s == pytest.approx(0.5, abs=1e-3)
    assert [warning.kind for warning in half.warnings] == ["song_length", "song_not_played"]
    for at, value in ((frames, 0), (frames, 7), (size, 0), (size, 0xFFFFFFFF)):
        assert probe_recording(patched(AIFF, ">I", at, value))[0].duration_s == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("form", "coding", "channels", "kept"),
    [
        ("AIFF", "PCM_16", 2, "PCM_16"),
        ("AIFF", "PCM_24", 1, "PCM_24"),
        ("AIFF", "FLOAT", 8, "PCM_24"),
        ("WAV", "DOUBLE", 2, "PCM_24"),
        ("WAV", "MS_ADPCM", 1, "PCM_16"),
    ],
)
def test_what_browsers_do_not_play_is_written_as_flac_without_loss(
    form: str, coding: str, channels: int, kept: str, tmp_path: Path
) -> None:
    data = recording(form, coding, channels=channels)
    info, _ = probe_recording(data, Conversion(tmp_path / "song.flac"))
    assert (info.media_type, info.is_converted, info.warnings) == ("audio/flac", True, ())
    with soundfile.SoundFile(tmp_path / "song.flac") as flac:
        assert flac.subtype == kept
    written, rate = soundfile.read(tmp_path / "song.flac", always_2d=True)
    wanted, _ = soundfile.read(io.BytesIO(data), always_2d=True)
    assert rate == RATE
    assert written == pytest.approx(wanted, abs=2**-23)
    again, _ = probe_recording((tmp_path / "song.flac").read_bytes())
    assert (again.duration_s, again.warnings) == (info.duration_s, ())


def test_louder_than_full_scale_is_full_scale_in_flac(tmp_path: Path) -> None:
    loud = io.BytesIO()
    soundfile.write(loud, [2.0, -2.0, 0.25, float("nan")], RATE, format="AIFF", subtype="FLOAT")
    probe_recording(loud.getvalue(), Conversion(tmp_path / "song.flac"))
    written, _ = soundfile.read(tmp_path / "song.flac")
    assert written.tolist() == pytest.approx([1.0, -1.0, 0.25, 0.0], abs=1e-6)


def test_what_browsers_play_and_what_flac_does_not_hold_is_left_as_it_is(tmp_path: Path) -> None:
    nine = recording("AIFF", "PCM_16", channels=9)
    for data, told in ((WAV, []), (MP3, []), (nine, ["song_not_played"])):
        info, _ = probe_recording(data, Conversion(tmp_path / "song.flac"))
        assert not info.is_converted
        assert [warning.kind for warning in info.warnings] == told
    assert list(tmp_path.iterdir()) == []
    assert probe_recording(WAV, Conversion(tmp_path / "song.flac", is_forced=True))[0].is_converted


def test_of_mp4_and_webm_the_headers_are_read() -> None:
    for data, audio_format, media_type in ((mp4(), "MP4", "audio/mp4"), (webm(), "WebM", "audio/webm")):
        info, peaks = probe_recording(data)
        assert (info.format, info.media_type, info.duration_s) == (audio_format, media_type, 1.5)
        assert peaks is None
    assert probe_recording(webm(duration=b""))[0].duration_s is None


REFUSED = {
    "empty": (b"", "empty"),
    "text": (b"Not a song at all, only words.", "no audio file"),
    "MIDI": (b"MThd\0\0\0\x06\0\0\0\x01\0\x60", "no audio file"),
    "AIFF without sound": (AIFF[:38], "no chunk of sound"),
    "AIFF that breaks off before its sound": (AIFF[:46], "cannot be decoded|no sound"),
    "AU": (recording("AU", "PCM_16"), "no audio file"),
    "CAF": (recording("CAF", "PCM_16"), "no audio file"),
    "zeros before FLAC": (bytes(5000) + FLAC, "no audio file"),
    "WAV without samples": (WAV[:44], "no samples"),
    "WAV without data": (WAV[:36], "no data chunk"),
    "WAV at 0 samples a second": (patched(WAV, "<I", 24, 0), "usable format chunk"),
    "WAV without channels": (patched(WAV, "<H", 22, 0), "usable format chunk"),
    "WAV of no bits": (riff(struct.pack("<HHIIHH", 1, 1, 8000, 8000, 1, 0), bytes(64)), "cannot be decoded"),
    "WAV of 33 channels": (wav(channels=33, seconds=0.01), "33 channels"),
    "WAV at a million samples a second": (wav(rate=1_000_000, seconds=0.01), "1,000,000 samples"),
    "FLAC that breaks off": (FLAC[:20], "STREAMINFO"),
    "FLAC of another kind": (b"fLaC\x04\0\0\x22" + FLAC[8:], "STREAMINFO"),
    "FLAC without frames": (FLAC[:42], "cannot be decoded|no sound"),
    "Ogg with pictures": (ogg_page(b"\x80theora" + bytes(40), flags=2), "cannot be decoded"),
    "Ogg that breaks off": (VORBIS[:20], "no whole Ogg page"),
    "Ogg without its header": (b"".join(list(ogg_pages(OPUS))[1:]), "cannot be decoded"),
    "FLAC in Ogg that breaks off": (ogg_page(b"\x7fFLAC\x01\0\0\x01fLaC", flags=2), "STREAMINFO"),
    "tag without frames": (id3(200), "no MP3 frame"),
    "MP4 with pictures only": (mp4(b"vide"), "no track of sound"),
    "MP4 that breaks off": (mp4()[:60], "no moov"),
    "MP4 with an impossible box": (mp4()[:24] + struct.pack(">I4s", 3, b"free"), "impossible length"),
    "Matroska": (webm(doc_type=b"matroska"), "another kind"),
    "WebM whose element reaches beyond the one it is in": (
        element(0x1A45DFA3, element(0x4282, b"webm"))
        + element(0x18538067, element(0x1549A966, b"\x2a\xd7\xb1\x08") + bytes(20)),
        "breaks off",
    ),
    "WebM with pictures only": (webm(track_type=1), "no track of sound"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_refuses_with_the_fault_and_what_would_be_right(name: str) -> None:
    data, fault = REFUSED[name]
    with pytest.raises(InputError, match=fault) as refused:
        probe_recording(data)
    assert "MP3" in refused.value.detail


def test_a_song_that_lasts_too_long_is_stopped(monkeypatch: pytest.MonkeyPatch) -> None:
    two_per_second = riff(struct.pack("<HHIIHH", 1, 1, 1, 1, 1, 8), bytes(20_000))
    with pytest.raises(InputError, match="over 4 hours"):
        probe_recording(two_per_second)
    with pytest.raises(InputError, match="lasts 417 hours; at most 4"):
        probe_recording(webm(duration=struct.pack(">d", 1.5e9)))
    monkeypatch.setattr(sound_decode, "LONGEST_S", 0.5)
    for data in (WAV, FLAC, MP3, VORBIS, OPUS):
        with pytest.raises(InputError, match="lasts over"):
            probe_recording(data)


def test_own_wav_header_is_read_back_by_others(tmp_path: Path) -> None:
    song = tmp_path / "song.wav"
    song.write_bytes(wav_header(1000, sample_rate=48000, channels=2) + bytes(4000))
    with wave.open(str(song)) as file:
        assert file.getparams()[:4] == (2, 2, 48000, 1000)
    with wave.open(io.BytesIO(WAV)) as file:
        assert file.getnframes() == RATE
