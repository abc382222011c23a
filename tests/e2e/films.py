"""Films that the page makes, and what is in them."""

from __future__ import annotations

import base64
import io
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import av
import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray
    from playwright.sync_api import Page

FILM = """
async (commission) => {
  const chunks = [];
  const made = await window.reina.film(
    commission,
    {
      write: async ({ data, position }) => void chunks.push([data.slice(), position]),
      tell: () => undefined,
    },
    new AbortController().signal,
  );
  const size = Math.max(...chunks.map(([data, position]) => position + data.length));
  const whole = new Uint8Array(size);
  for (const [data, position] of chunks) whole.set(data, position);
  let text = "";
  for (let at = 0; at < size; at += 32768) text += String.fromCharCode(...whole.subarray(at, at + 32768));
  return [made, btoa(text)];
}
"""
SQUARE = 8
COMMISSION: dict[str, Any] = {
    "start": 0,
    "end": None,
    "aspect": "16:9",
    "height": 144,
    "fps": 60,
    "quality": "best",
    "detail": "low",
    "camera": "show",
    "sound": True,
    "container": None,
}


@dataclass(frozen=True)
class Decoded:
    """A film's tracks.

    Attributes:
        container: How its format is called.
        codecs: Of its tracks.
        pictures: (F, height, width, 3), 0 to 255.
        times_s: (F,) when each is shown.
        sound: (S,) the mean of its channels; empty without sound.
        sound_from_s: When the first of them is heard.
        rate: Samples a second.
    """

    container: str
    codecs: tuple[str, ...]
    pictures: NDArray[np.int16]
    times_s: NDArray[np.float64]
    sound: NDArray[np.float32]
    sound_from_s: float
    rate: int

    @property
    def size(self) -> tuple[int, int]:
        """Width and height."""
        return self.pictures.shape[2], self.pictures.shape[1]


def film(page: Page, **wanted: Any) -> tuple[dict[str, Any], bytes]:
    """Have an open page make a film; what it says of it, and the file."""
    made, text = page.evaluate(FILM, COMMISSION | wanted)
    return made, base64.b64decode(text)


def decode(data: bytes) -> Decoded:
    """Decode a film by FFmpeg's libraries, as players do."""
    pictures: list[NDArray[np.uint8]] = []
    times: list[float] = []
    sound: list[NDArray[np.float32]] = []
    starts: list[float] = []
    rate = 1
    with av.open(io.BytesIO(data), "r") as container:
        name = container.format.name
        codecs = tuple(stream.codec_context.name for stream in container.streams)
        audible = len(container.streams.audio) > 0
        for picture in container.decode(video=0):
            assert picture.time is not None
            pictures.append(np.asarray(picture.to_ndarray(format="rgb24"), np.uint8))
            times.append(picture.time)
    with av.open(io.BytesIO(data), "r") as container:
        for heard in container.decode(audio=0) if audible else ():
            assert heard.time is not None
            rate = heard.sample_rate
            starts.append(heard.time)
            sound.append(np.asarray(heard.to_ndarray(), np.float32).mean(axis=0))
    return Decoded(
        container=name,
        codecs=codecs,
        pictures=np.stack(pictures).astype(np.int16),
        times_s=np.array(times),
        sound=np.concatenate(sound) if sound else np.zeros(0, np.float32),
        sound_from_s=starts[0] if starts else 0.0,
        rate=rate,
    )


def difference(one: NDArray[np.int16], other: NDArray[np.int16]) -> float:
    """The largest difference of two pictures, of 255, over squares of 8 × 8 pixels.

    A square's mean hardly changes by coding, which blurs edges and halves the colours' resolution.
    """
    return float(np.abs(_squares(one) - _squares(other)).max())


def _squares(picture: NDArray[np.int16]) -> NDArray[np.float64]:
    height, width = (side // SQUARE for side in picture.shape[:2])
    cut = picture[: height * SQUARE, : width * SQUARE]
    return cut.reshape(height, SQUARE, width, SQUARE, 3).mean(axis=(1, 3))
