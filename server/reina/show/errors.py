"""What is said when a show cannot be used."""

from reina.curves.shown import shortened
from reina.errors import InputError


class ShowError(InputError):
    """A show that cannot be used.

    Attributes:
        track: Path of the parameter whose track is meant, or None for the show itself.
        key: The keyframe's key, or None.
        field: The field that is wrong, or None.
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


class KeyNotFoundError(ShowError):
    """A track or a keyframe was asked for that the show does not hold."""
