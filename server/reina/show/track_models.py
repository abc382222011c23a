"""Models of the tracks of one parameter: its values, and keyframes told apart by their interpolations.

A parameter's tracks are declared once, as models; the JSON Schema of shows follows from them, and so does
what is told of a fault. What reads a track has the models' own fields, but makes keyframes of them at once,
without a model of each in between, which takes half of the time.
"""

import re
from collections.abc import Iterable, Mapping
from functools import lru_cache
from typing import Annotated, Any, NamedTuple, Union, cast

from pydantic import (
    ConfigDict,
    Discriminator,
    GetCoreSchemaHandler,
    Strict,
    Tag,
    TypeAdapter,
    create_model,
)
from pydantic_core import CoreConfig, CoreSchema, core_schema

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


class TrackModels(NamedTuple):
    """What reads and describes the tracks of parameters with the same values."""

    track: type[ShowTrack]
    """The model of a track."""
    keyframe: Any
    """The type of one of its keyframes: a model an interpolation, or one for several."""
    track_reader: type[ShowTrack]
    """What reads a track: as its model, but its keyframes are `Keyframe` objects."""
    keyframe_reader: TypeAdapter[Keyframe[Any]]
    """What reads a keyframe."""


def track_models(parameter: Parameter, kinds: Mapping[str, type[Keyframe[Any]]] | None = None) -> TrackModels:
    """The models of a parameter's tracks; the same for all parameters with the same values.

    Args:
        parameter: The parameter.
        kinds: The interpolations; those of this process where they are not given.
    """
    return _models(parameter.type, parameter.bounds, _usable(parameter, kinds))


def _usable(parameter: Parameter, kinds: Mapping[str, type[Keyframe[Any]]] | None) -> Kinds:
    known = interpolations() if kinds is None else kinds
    return tuple((name, kind) for name, kind in known.items() if parameter.interpolates or name == "step")


@lru_cache(maxsize=1024)
def _models(kind: TypeName, bounds: Bounds, kinds: Kinds) -> TrackModels:
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
    tags = {name: names[0] for names in groups.values() for name in names}
    item: Any = _told_apart(members, tags, default)
    made: Any = Annotated[
        Keyframe[Any], _Made({name: (members[tags[name]], keyframe) for name, keyframe in kinds}, default)
    ]
    return TrackModels(
        _track(f"track_{name}", item), item, _track(f"track_reader_{name}", made), TypeAdapter(made)
    )


def _track(name: str, item: Any) -> type[ShowTrack]:
    keyframes: Any = Annotated[tuple[item, ...], Strict(strict=False)]
    return create_model(name, __base__=ShowTrack, keyframes=(keyframes, ()))


class _Made:
    """Reads a keyframe by the fields of a model, into an object of its interpolation.

    Args:
        kinds: By the interpolation's name, the model and the class.
        default: The interpolation where a keyframe names none.
    """

    def __init__(
        self, kinds: Mapping[str, tuple[type[ShowKeyframe], type[Keyframe[Any]]]], default: str
    ) -> None:
        self._kinds = kinds
        self._default = default

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        """A dataclass an interpolation; its name is read with its fields, and not kept."""
        fields: dict[type[ShowKeyframe], list[core_schema.DataclassField]] = {}
        for model, _ in self._kinds.values():
            if model not in fields:
                declared: Any = handler.resolve_ref_schema(handler.generate_schema(model))
                fields[model] = [
                    core_schema.dataclass_field(name, field["schema"], init_only=name == "interpolation")
                    for name, field in declared["schema"]["fields"].items()
                ]
        config = CoreConfig(strict=True, extra_fields_behavior="forbid", allow_inf_nan=False)
        kinds: dict[Any, CoreSchema] = {
            name: core_schema.dataclass_schema(
                kind,
                core_schema.dataclass_args_schema(kind.__name__, fields[model], collect_init_only=True),
                [field["name"] for field in fields[model] if field["name"] != "interpolation"],
                strict=False,
                config=config,
                slots=True,
            )
            for name, (model, kind) in self._kinds.items()
        }
        return core_schema.tagged_union_schema(kinds, self._interpolation)

    def _interpolation(self, document: object) -> str | None:
        if not isinstance(document, dict):
            return None
        name: object = cast("dict[str, object]", document).get("interpolation", self._default)
        return name if isinstance(name, str) else None


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
