"""A recording as FLAC: what browsers play in the place of kinds that they do not play."""

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import soundfile
from numpy.typing import NDArray

from reina.sound.recording.decode import Decoded, decode
from reina.system.checked_file import checked_file

if TYPE_CHECKING:
    from collections.abc import Iterable

    from reina.sound.recording.stream import SoundStream

MEDIA_TYPE, SUFFIX = "audio/flac", ".flac"
MOST_CHANNELS, HIGHEST_RATE = 8, 655_350
"""What FLAC can hold (RFC 9639)."""
SHORT_CODINGS = frozenset(
    (
        "PCM_S8",
        "PCM_U8",
        "PCM_16",
        "ALAW",
        "ULAW",
        "IMA_ADPCM",
        "MS_ADPCM",
        "GSM610",
        "G721_32",
        "NMS_ADPCM_16",
    )
)
"""libsndfile's names of what has 16 bits at most; of the rest 24 are kept."""


def fits(decoded: Decoded) -> bool:
    """Whether FLAC can hold it."""
    return decoded.channels <= MOST_CHANNELS and decoded.sample_rate <= HIGHEST_RATE


def write_as_flac(path: Path, streams: "Iterable[SoundStream]", decoded: Decoded) -> None:
    """Decode streams again and write them, without loss up to 24 bits; louder than full scale is full scale.

    Args:
        path: Where to.
        streams: As `decode` takes them.
        decoded: What decoding them told before; FLAC can hold it.

    Raises:
        OSError: The disk does not take it.
    """
    bits = 16 if decoded.coding in SHORT_CODINGS else 24
    left = round(decoded.duration_s * decoded.sample_rate)
    with (
        checked_file(path) as written,
        soundfile.SoundFile(
            written, "w", decoded.sample_rate, decoded.channels, subtype=f"PCM_{bits}", format="FLAC"
        ) as file,
    ):

        def take(block: NDArray[np.float32], _: int) -> None:
            nonlocal left
            block = block[:left]
            left -= len(block)
            scaled = np.rint(np.nan_to_num(block).astype(np.float64) * 2 ** (bits - 1))
            limit = 2 ** (bits - 1)
            whole = np.clip(scaled, -limit, limit - 1).astype(np.int32)
            # libsndfile takes integers of 32 bits and keeps the upper ones.
            file.write(whole << (32 - bits))

        decode(streams, take)
