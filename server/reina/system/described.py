"""Models whose fields are described by the docstrings below them."""

import ast
import inspect
import sys
from collections.abc import Mapping
from functools import lru_cache
from typing import Any

from pydantic import BaseModel, GetJsonSchemaHandler
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema


class DescribedModel(BaseModel):
    """What its JSON schema says of a field is the docstring below it.

    Pydantic's own `use_attribute_docstrings` reads and parses the source of each model when it is declared, a
    tenth of the time that the server takes to start. Here it is read when a schema is asked for.
    """

    @classmethod
    def __get_pydantic_json_schema__(
        cls, core_schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        """The schema, with its fields described."""
        schema = handler(core_schema)
        properties: dict[str, Any] = handler.resolve_ref_schema(schema).get("properties", {})
        for name, declared in cls.model_fields.items():
            field = properties.get(declared.alias or name, {"description": ""})
            if "description" not in field and (said := _docstring(cls, name)):
                field["description"] = said
        return schema


def _docstring(model: type[BaseModel], field: str) -> str | None:
    """The docstring of a field, where it was declared last."""
    for declaring in model.__mro__:
        if field in inspect.get_annotations(declaring):
            return _docstrings(declaring.__module__).get(f"{declaring.__qualname__}.{field}")
    return None


@lru_cache(maxsize=256)
def _docstrings(module: str) -> Mapping[str, str]:
    """The docstrings of attributes of a module's classes, by the names of both."""
    found: dict[str, str] = {}
    for declared in ast.parse(inspect.getsource(sys.modules[module])).body:
        if not isinstance(declared, ast.ClassDef):
            continue
        for attribute, below in zip(declared.body, declared.body[1:], strict=False):
            match attribute, below:
                case (
                    ast.AnnAssign(target=ast.Name(id=name)),
                    ast.Expr(value=ast.Constant(value=str(text))),
                ):
                    found[f"{declared.name}.{name}"] = inspect.cleandoc(text)
                case _:
                    pass
    return found
