"""Where a rendered song lies: a folder of its own, with its segments beside the whole."""

from dataclasses import dataclass
from pathlib import Path

from reina.sound.recording.peaks import peaks_path
from reina.system.durable import write_durably

SONG = "song.flac"
"""It appears when everything else is there."""


@dataclass(frozen=True)
class RenderedFiles:
    """A rendered song that was made on another machine.

    Attributes:
        song: The whole.
        peaks: Its peaks.
        segments: Its segments, in order.
    """

    song: bytes
    peaks: bytes
    segments: tuple[bytes, ...]

    def write(self, song: Path) -> None:
        """Put them where a song is rendered to, the whole last.

        Raises:
            OSError: They cannot be written.
        """
        beside = {segment_path(song, number): data for number, data in enumerate(self.segments)}
        for path, data in {**beside, peaks_path(song): self.peaks, song: self.song}.items():
            write_durably(path, data)


def segment_path(song: Path, number: int) -> Path:
    """Where a segment of a rendered song lies, beside the song."""
    return song.with_name(f"{number}.opus")
