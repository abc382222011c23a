"""What is said when a show cannot be used."""

from collections.abc import Sequence

from reina.curves.shown import shortened
from reina.errors import InputError

MAX_FAULTS = 20
"""So many are told of one document."""


class ShowError(InputError):
    """A show that cannot be used.

    Attributes:
        track: Path of the parameter whose track is meant, or None for the show itself.
        key: The keyframe's key, or None.
        field: The field that is wrong, or None.
        others: What else is wrong in the same document, as far as it is told.
        more: How many more faults there are, at least.
    """

    def __init__(
        self, detail: str, *, track: str | None = None, key: str | None = None, field: str | None = None
    ) -> None:
        places = (("track", track), ("key", key), ("field", field))
        where = ", ".join(f"{name} {shortened(value)}" for name, value in places if value is not None)
        super().__init__(detail, location=where or None)
        self.track = track
        self.key = key
        self.field = field
        self.others: tuple[ShowError, ...] = ()
        self.more = 0

    def within(self, place: str) -> "ShowError":
        """The same of what is itself a part: its fields, and those of the others, begin with a place."""
        field = "/".join(part for part in (place, self.field) if part)
        error = type(self)(self.detail, track=self.track, key=self.key, field=field)
        error.others = tuple(other.within(place) for other in self.others)
        error.more = self.more
        return error


class KeyNotFoundError(ShowError):
    """A track or a keyframe was asked for that the show does not hold."""


def together(errors: Sequence[ShowError], more: int = 0) -> ShowError:
    """One error of several, one at least: the first, which knows of the others, `MAX_FAULTS` at most.

    Args:
        errors: What is wrong.
        more: How many faults there are that stand in none of them.
    """
    found = [known for error in errors for known in (error, *error.others)]
    more += sum(error.more for error in errors)
    first = found[0]
    first.others = tuple(found[1:MAX_FAULTS])
    first.more = more + max(len(found) - MAX_FAULTS, 0)
    return first
