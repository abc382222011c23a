"""A location in a show that is being read: takes JSON apart, and says where something is wrong."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeVar, cast

from reina.curves.shown import shown
from reina.curves.value_types import parse_number
from reina.show.errors import ShowError

Json = Mapping[str, Any]
Choice = TypeVar("Choice", bound=str)


def is_text(value: str) -> bool:
    """Whether a string can be written as UTF-8: a lone surrogate, half a character, cannot."""
    return value.isascii() or not any("\ud800" <= character <= "\udfff" for character in value)


@dataclass(frozen=True)
class Location:
    """Where in a show something is read; makes the errors.

    Attributes:
        track: Path of the track's parameter, or None.
        key: Key of the keyframe, or None.
    """

    track: str | None = None
    key: str | None = None

    def error(self, detail: str, field: str | None = None) -> ShowError:
        """An error at this location."""
        return ShowError(detail, track=self.track, key=self.key, field=field)

    def fields(self, value: object, known: Iterable[str], *, what: str) -> Json:
        """A JSON object that has only known fields."""
        if not isinstance(value, Mapping):
            raise self.error(f"{what} is a JSON object, not {type(value).__name__}")
        document = cast("Json", value)
        names = tuple(known)
        for name in document:
            if name not in names:
                raise self.error(f"{what} has no such field; its fields are {', '.join(names)}", str(name))
        return document

    def items(self, value: object, field: str) -> Sequence[object]:
        """A JSON list."""
        if isinstance(value, str | bytes) or not isinstance(value, Sequence):
            raise self.error("a list is needed here", field)
        return cast("Sequence[object]", value)

    def choice(self, document: Json, field: str, choices: Sequence[Choice], default: object = None) -> Choice:
        """One of several words."""
        value: object = document.get(field, default)
        for known in choices:
            if value == known:
                return known
        raise self.error(f"{shown(value)} is none of {', '.join(choices)}", field)

    def text(self, document: Json, field: str, default: str = "") -> str:
        """A string."""
        value: object = document.get(field, default)
        if not isinstance(value, str):
            raise self.error("a text in quotes is needed here", field)
        if not is_text(value):
            raise self.error("half a character (a lone surrogate) is no text", field)
        return value

    def flag(self, document: Json, field: str) -> bool:
        """True or false; false where it is not given."""
        value: object = document.get(field, False)
        if not isinstance(value, bool):
            raise self.error(f"{shown(value)} is neither true nor false", field)
        return value

    def number(self, document: Json, field: str) -> float:
        """A finite number that must be given."""
        if field not in document:
            raise self.error("it is missing; a finite number is needed", field)
        try:
            return parse_number(document[field])
        except ValueError as error:
            raise self.error(str(error), field) from None
