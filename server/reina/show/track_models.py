"""Models of the tracks of one parameter: its values, and keyframes told apart by their interpolations."""

import re
from collections.abc import Iterable, Mapping
from functools import lru_cache
from typing import Annotated, Any, Union, cast

from pydantic import AfterValidator, ConfigDict, Discriminator, Strict, Tag, create_model

from reina.curves.interpolation import interpolations
from reina.curves.keyframe import Keyframe
from reina.curves.options import Option, options_of
from reina.curves.parameter import Parameter
from reina.curves.value_types import VALUE_TYPES, Bounds, Number, TypeName, numbers, one_of
from reina.show.document import ShowKeyframe, ShowTrack


class _Keyframe(ShowKeyframe):
    """What is read as a keyframe of one interpolation has its options, and no other field."""

    model_config = ConfigDict(extra="forbid")


Kinds = tuple[tuple[str, type[Keyframe[Any]]], ...]


def track_model(
    parameter: Parameter, kinds: Mapping[str, type[Keyframe[Any]]] | None = None
) -> type[ShowTrack]:
    """The model that reads a parameter's tracks; one for all parameters with the same values.

    Args:
        parameter: The parameter.
        kinds: The interpolations; those of this process where they are not given.
    """
    return _models(parameter.type, parameter.bounds, _usable(parameter, kinds))[1]


def keyframe_type(parameter: Parameter) -> Any:
    """The type that reads one keyframe of a parameter: a model an interpolation, or one for several."""
    return _models(parameter.type, parameter.bounds, _usable(parameter, None))[0]


def _usable(parameter: Parameter, kinds: Mapping[str, type[Keyframe[Any]]] | None) -> Kinds:
    known = interpolations() if kinds is None else kinds
    return tuple((name, kind) for name, kind in known.items() if parameter.interpolates or name == "step")


@lru_cache(maxsize=1024)
def _models(kind: TypeName, bounds: Bounds, kinds: Kinds) -> tuple[Any, type[ShowTrack]]:
    """The type of a keyframe, and the model of a track."""
    name = _name(kind, bounds)
    interpolates = VALUE_TYPES[kind].interpolates
    slope: Any = Number if kind == "number" else numbers(VALUE_TYPES[kind].length)
    slope_or_none: Any = slope | None if interpolates else None
    values = create_model(
        f"keyframe_{name}",
        __base__=_Keyframe,
        value=(VALUE_TYPES[kind].annotation(bounds), ...),
        in_tangent=(slope_or_none, None),
        out_tangent=(slope_or_none, None),
    )
    default = "linear" if interpolates else "step"
    groups: dict[tuple[Option, ...], list[str]] = {}
    for interpolation, keyframe in kinds:
        groups.setdefault(options_of(keyframe), []).append(interpolation)
    members = {
        names[0]: _keyframe_model(values, options, names, default) for options, names in groups.items()
    }
    table = dict(kinds)

    def made(read: ShowKeyframe) -> Keyframe[Any]:
        # At once: thousands of models that live until the last is read keep the garbage collector busy.
        fields = dict(read.__dict__)
        return table[fields.pop("interpolation")](**fields)

    tags = {name: names[0] for names in groups.values() for name in names}
    item: Any = _told_apart(
        {name: Annotated[model, AfterValidator(made)] for name, model in members.items()}, tags, default
    )
    keyframes: Any = Annotated[tuple[item, ...], Strict(strict=False)]
    track = create_model(f"track_{name}", __base__=ShowTrack, keyframes=(keyframes, ()))
    return item, track


def _keyframe_model(
    base: type[ShowKeyframe], options: Iterable[Option], names: list[str], default: str
) -> type[ShowKeyframe]:
    fields: dict[str, Any] = {option.name: (option.annotation, option.default) for option in options}
    fields["interpolation"] = (one_of(tuple(names)), default if default in names else ...)
    return create_model(f"{base.__name__}_{names[0]}", __base__=base, **fields)


def _told_apart(members: Mapping[str, Any], tags: Mapping[str, str], default: str) -> Any:
    """The union of models of keyframes, by their interpolations; an error's location has tags in brackets."""
    if len(members) == 1:
        return next(iter(members.values()))

    def tag(document: object) -> str | None:
        if not isinstance(document, dict):
            return None
        name: object = cast("dict[str, object]", document).get("interpolation", default)
        group = tags.get(name) if isinstance(name, str) else None
        return None if group is None else f"<{group}>"

    tagged = tuple(Annotated[model, Tag(f"<{group}>")] for group, model in members.items())
    return Annotated[Union[tagged], Discriminator(tag)]  # noqa: UP007


def _name(kind: TypeName, bounds: Bounds) -> str:
    """Of a model: number_0_to_10, choice_physical_toon."""
    held = [] if bounds.minimum is None and bounds.maximum is None else [bounds.minimum, "to", bounds.maximum]
    words = [kind, *(f"{part:g}" if isinstance(part, float) else str(part or "any") for part in held)]
    return re.sub(r"[^A-Za-z0-9_+-]", "_", "_".join([*words, *bounds.choices]))
