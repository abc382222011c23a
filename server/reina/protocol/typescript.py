"""TypeScript interfaces from pydantic models, by way of their JSON schemas."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from pydantic.json_schema import JsonSchemaMode, models_json_schema

from reina.protocol.model import RequestModel, WireModel

if TYPE_CHECKING:
    from collections.abc import Sequence

    from pydantic import BaseModel

Schema = dict[str, Any]

_PRIMITIVES = {
    "string": "string",
    "number": "number",
    "integer": "number",
    "boolean": "boolean",
    "null": "null",
}


def interfaces(
    sent: Sequence[type[BaseModel]], received: Sequence[type[BaseModel]] = (), *, readonly: bool = False
) -> str:
    """One exported interface (or type) for each model and everything that it refers to.

    Args:
        sent: Models that the server sends; all their fields are there.
        received: Models that it is sent; fields with a default are optional.
        readonly: Whether nothing of them may be assigned to.
    """
    modes: list[tuple[type[BaseModel], JsonSchemaMode]] = []
    modes.extend((base, "serialization") for model in sent if (base := _base(model)))
    modes.extend((model, "serialization") for model in sent)
    modes.extend((model, "validation") for model in received)
    _, schema = models_json_schema(modes)
    definitions: dict[str, Schema] = schema["$defs"]
    bases = {model.__name__: base.__name__ for model, _ in modes if (base := _base(model))}
    order = list(dict.fromkeys([*(model.__name__ for model, _ in modes), *definitions]))
    texts: list[str] = []
    for name in order:
        base = bases.get(name)
        inherited: Schema = definitions[base]["properties"] if base else {}
        texts.append(_definition(name, definitions[name], base, inherited, readonly=readonly))
    return "\n\n".join(texts) + "\n"


def field_types(model: type[BaseModel]) -> dict[str, tuple[str, str]]:
    """Field name -> its TypeScript type and its documentation on one line."""
    schema = model.model_json_schema(mode="serialization")
    return {
        name: (type_of(field), " ".join(str(field.get("description", "")).split()))
        for name, field in schema["properties"].items()
    }


def _base(model: type[BaseModel]) -> type[BaseModel] | None:
    """The model that it extends, or None."""
    base = model.__base__
    return base if base and issubclass(base, WireModel) and base not in (WireModel, RequestModel) else None


def _definition(name: str, schema: Schema, base: str | None, inherited: Schema, *, readonly: bool) -> str:
    documentation = _comment(schema.get("description"), "")
    if schema.get("type") != "object" or "properties" not in schema:
        return f"{documentation}export type {name} = {type_of(schema, readonly=readonly)}"
    required = set(schema.get("required", ()))
    extends = f" extends {base}" if base else ""
    lines = [f"{documentation}export interface {name}{extends} {{"]
    prefix = "readonly " if readonly else ""
    for field, value in schema["properties"].items():
        if field in inherited:
            continue
        optional = "" if field in required else "?"
        kind = type_of(value, readonly=readonly)
        lines.append(f"{_comment(value.get('description'), '  ')}  {prefix}{_key(field)}{optional}: {kind}")
    if schema.get("additionalProperties") is True:
        lines.append(f"  {prefix}[other: string]: unknown")
    return "\n".join([*lines, "}"])


def _comment(text: str | None, indent: str) -> str:
    if not text:
        return ""
    paragraph = [line.strip().replace("`", "") for line in text.strip().splitlines()]
    if len(paragraph) == 1:
        return f"{indent}/** {paragraph[0]} */\n"
    return "\n".join(
        [f"{indent}/**", *(f"{indent} * {line}".rstrip() for line in paragraph), f"{indent} */\n"]
    )


def _key(field: str) -> str:
    return field if field.isidentifier() else json.dumps(field)


def type_of(schema: Schema, *, readonly: bool = False) -> str:
    """The TypeScript type of a JSON schema, as far as pydantic writes such schemas.

    Raises:
        TypeError: For a schema that this does not know; silence would let the page drift from the server.
    """
    prefix = "readonly " if readonly else ""
    if "$ref" in schema:
        return str(schema["$ref"]).rsplit("/", 1)[-1]
    if "const" in schema:
        return json.dumps(schema["const"])
    if "enum" in schema:
        return " | ".join(json.dumps(value) for value in schema["enum"])
    alternatives = schema.get("oneOf") or schema.get("anyOf")
    if alternatives and "properties" not in schema:
        return " | ".join(dict.fromkeys(type_of(each, readonly=readonly) for each in alternatives))
    match schema.get("type"):
        case "array" if "prefixItems" in schema:
            items = (type_of(item, readonly=readonly) for item in schema["prefixItems"])
            return f"{prefix}[{', '.join(items)}]"
        case "array":
            item = type_of(schema.get("items", {}), readonly=readonly)
            return f"{prefix}({item})[]" if " " in item else f"{prefix}{item}[]"
        case "object":
            values = schema.get("additionalProperties")
            kind = "unknown" if values in (None, True) else type_of(values, readonly=readonly)
            return f"Readonly<Record<string, {kind}>>" if readonly else f"Record<string, {kind}>"
        case None:
            return "unknown"
        case name if name in _PRIMITIVES:
            return _PRIMITIVES[str(name)]
        case name:
            raise TypeError(f"no TypeScript for a JSON schema of type {name!r}: {schema}")
