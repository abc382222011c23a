"""Why a score was refused."""

from collections.abc import Sequence

from reina.errors import InputError


class ScoreError(InputError):
    """A score that cannot be read.

    Attributes:
        problems: Every fault as ``(place, what)``, the first being the one in ``detail``; several only for a
            document whose shape is wrong in several places.
    """

    def __init__(
        self, detail: str, *, location: str | None = None, problems: Sequence[tuple[str, str]] = ()
    ) -> None:
        super().__init__(detail, location=location)
        self.problems: tuple[tuple[str, str], ...] = tuple(problems) or ((location or "", detail),)


class NotInScoreError(ScoreError):
    """A part or a sequence was asked for that a score, which is sound itself, does not hold."""


class ScoreLimitError(ScoreError):
    """A score that is larger, longer or deeper than Reina reads (`reina.music.limits`)."""
