"""How large a score may be: what bounds the time and the memory that reading one can take."""

from dataclasses import dataclass

from reina.music.errors import ScoreLimitError


@dataclass(frozen=True)
class Limits:
    """The bounds of one reading; a score beyond any of them is refused with `ScoreLimitError`.

    Attributes:
        size_bytes: Size of the file.
        tracks: Tracks of a MIDI file, parts of a JSON or MusicXML document.
        chunks: Chunks of a MIDI file beside its tracks.
        events: Messages of all tracks together, notes and others; objects and lists of a JSON document.
        elements: Elements of a MusicXML document.
        notes: Notes of the score.
        duration_s: Seconds from the beginning to the end of the last note.
        beats: Quarter notes from the beginning to the end of the last note.
        bars: Bars in that time.
    """

    size_bytes: int = 32 * 2**20
    tracks: int = 1024
    chunks: int = 10_000
    events: int = 1_000_000
    elements: int = 2_000_000
    notes: int = 250_000
    duration_s: float = 4 * 3600.0
    beats: float = 1_000_000.0
    bars: int = 100_000

    def check(self, name: str, value: float, *, what: str, location: str | None = None) -> None:
        """Raise `ScoreLimitError` if `value`, which is called `what`, is over the limit called `name`."""
        limit = getattr(self, name)
        if value > limit:
            raise ScoreLimitError(f"{what}: {value:,.0f}; at most {limit:,.0f} are read", location=location)


DEFAULT_LIMITS = Limits()
