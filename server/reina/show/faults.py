"""Where in a show something is wrong, and what, from what its models refuse."""

from collections.abc import Callable, Iterable, Mapping
from typing import Any, cast, get_args

from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails

from reina.curves.faults import fault_words
from reina.curves.shown import shown
from reina.show.errors import MAX_FAULTS, ShowError, together

Location = tuple[int | str, ...]
LISTS = ("edits", "keyframes", "markers", "tracks")
"""What is told with the number of an item; another list is wrong as a whole."""


def show_error(
    error: ValidationError,
    model: Any,
    *,
    unit: str = "",
    at: Callable[[Location], tuple[str | None, str | None, str | None]] | None = None,
) -> ShowError:
    """What a model has refused: the outermost fault, and with it the others.

    Args:
        error: What pydantic found.
        model: What it was read with.
        unit: The unit of values.
        at: Location -> track, key and field; the location alone where it is not given.
    """
    found = sorted(error.errors(include_url=False), key=_rank)[:MAX_FAULTS]
    errors: list[ShowError] = []
    for fault in found:
        location = _location(fault)
        track, key, field = at(location) if at is not None else (None, None, field_name(location))
        errors.append(ShowError(_words(fault, model, unit), track=track, key=key, field=field))
    return together(errors, error.error_count() - len(found))


def _rank(fault: ErrorDetails) -> tuple[int, bool]:
    """The outermost first; of a keyframe the interpolation, on which its other fields depend."""
    return len(fault["loc"]), fault["loc"][-1:] != ("interpolation",)


def field_name(location: Location) -> str | None:
    """A location as it is told: markers/0/name."""
    return "/".join(str(part) for part in location) or None


def _location(fault: ErrorDetails) -> Location:
    """Where a fault is, without what is no field: a union's tag, a number within a value."""
    parts = [part for part in fault["loc"] if not str(part).startswith("<")]
    if fault["type"].startswith("union_tag") and isinstance(fault["input"], Mapping):
        parts.append("interpolation")
    while len(parts) > 1 and isinstance(parts[-1], int) and parts[-2] not in LISTS:
        parts.pop()
    return tuple(parts)


def _words(fault: ErrorDetails, model: Any, unit: str) -> str:
    if fault["loc"] == ("version",):
        given = None if fault["type"] == "missing" else fault["input"]
        return f"this is version {shown(given)}; version 1 is read here"
    if fault["type"] == "extra_forbidden":
        models = _models_at(model, fault["loc"][:-1])
        names = (field.alias or name for kind in models for name, field in kind.model_fields.items())
        return f"there is no such field; its fields are {', '.join(dict.fromkeys(names))}"
    if fault["type"].startswith("union_tag"):
        given = fault["input"]
        if not isinstance(given, Mapping):
            return f"a keyframe is a JSON object, not {type(given).__name__}"
        models = _models_at(model, fault["loc"])
        names = (name for kind in models for name in _interpolations(kind))
        name = cast("Mapping[str, object]", given).get("interpolation")
        return f"{shown(name)} is none of {', '.join(dict.fromkeys(names))}"
    return fault_words(fault, unit if "value" in fault["loc"] else "")


def _models_at(model: Any, location: Location) -> list[type[BaseModel]]:
    """The models that read what stands at a location."""
    kinds = _members(model)
    for part in location:
        if isinstance(part, int):
            continue
        if part.startswith("<"):
            kinds = [kind for kind in kinds if part[1:-1] in _interpolations(kind)]
        else:
            inner = [kind.model_fields[part].annotation for kind in kinds if part in kind.model_fields]
            kinds = [member for annotation in inner for member in _members(annotation)]
    return kinds


def _members(annotation: Any) -> list[type[BaseModel]]:
    """The models that a type is made of."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return [annotation]
    return [member for part in get_args(annotation) for member in _members(part)]


def _interpolations(model: type[BaseModel]) -> Iterable[str]:
    declared = model.model_fields.get("interpolation")
    return get_args(declared.annotation) if declared is not None else ()
