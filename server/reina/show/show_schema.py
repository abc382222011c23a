"""The JSON Schema of shows, written from the models that read them."""

import json
from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING, Any

from pydantic.json_schema import GenerateJsonSchema, JsonSchemaMode, models_json_schema

from reina.curves.interpolation import BUILT_IN
from reina.curves.keyframe import Keyframe
from reina.curves.parameter import Parameter
from reina.show.document import ShowHead
from reina.show.track_models import track_models

if TYPE_CHECKING:
    from pydantic import BaseModel

DIALECT = "https://json-schema.org/draft/2020-12/schema"


class _WithoutTitles(GenerateJsonSchema):
    """As pydantic writes it; the names of fields say what they are."""

    def field_title_should_be_set(self, schema: Any) -> bool:  # noqa: ARG002
        return False


def show_schema(
    parameters: Iterable[Parameter],
    interpolations: Mapping[str, type[Keyframe[Any]]] = BUILT_IN,
    pattern: Callable[[Parameter], str | None] = lambda _: None,
) -> dict[str, Any]:
    """JSON Schema (2020-12) of a show over parameters.

    A track of any other parameter is valid too: it is kept without effect. That every keyframe has a time
    and a key of its own, a schema cannot say; the reader does.

    Args:
        parameters: What a show can move.
        interpolations: Of its keyframes.
        pattern: A parameter -> the regular expression of all paths that it stands for; None for its own.
    """
    known = tuple(parameters)
    models = {parameter.path: track_models(parameter, interpolations).track for parameter in known}
    asked: list[tuple[type[BaseModel], JsonSchemaMode]] = [
        (model, "validation") for model in (ShowHead, *dict.fromkeys(models.values()))
    ]
    references, schema = models_json_schema(asked, schema_generator=_WithoutTitles)
    definitions: dict[str, Any] = schema["$defs"]
    head = definitions.pop(ShowHead.__name__)
    head["properties"]["tracks"] = {"type": "array", "items": {"$ref": "#/$defs/track"}}
    conditions = [
        {
            "if": {"properties": {"parameter": _named(parameter.path, pattern(parameter))}},
            "then": {
                **references[models[parameter.path], "validation"],
                "description": parameter.documentation,
            },
        }
        for parameter in known
    ]
    definitions["track"] = {
        "type": "object",
        "properties": {"parameter": {"type": "string"}},
        "required": ["parameter"],
        "allOf": conditions,
    }
    return {
        "$schema": DIALECT,
        **head,
        "title": "A show for Reina",
        "description": "Keyframes on the parameters of stage, lights, camera, note blocks and players.",
        "required": ["version", "tracks"],
        "$defs": definitions,
    }


def show_schema_text(
    parameters: Iterable[Parameter], pattern: Callable[[Parameter], str | None] = lambda _: None
) -> str:
    """`show_schema` of the built-in interpolations as the text that is published."""
    schema = show_schema(parameters, pattern=pattern)
    return json.dumps(schema, indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def _named(path: str, pattern: str | None) -> dict[str, str]:
    return {"const": path} if pattern is None else {"pattern": pattern}
