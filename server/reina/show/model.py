"""The base of what a show's document is made of."""

from typing import Annotated, Any, ClassVar

from pydantic import AfterValidator, BaseModel, BeforeValidator, ConfigDict, Field, GetJsonSchemaHandler
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema

from reina.curves.value_types import LARGEST, STRICT
from reina.system.described import DescribedModel


class ShowModel(DescribedModel):
    """Immutable, and strict: no field that is not declared, no number in quotes."""

    model_config = STRICT | ConfigDict(frozen=True)
    null_is_said: ClassVar[bool] = False
    """Whether null says something; else it is read as what is not given, and nobody needs to write it."""

    @classmethod
    def __get_pydantic_json_schema__(
        cls, core_schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        """The schema, without null where it says nothing."""
        schema = super().__get_pydantic_json_schema__(core_schema, handler)
        properties: dict[str, Any] = handler.resolve_ref_schema(schema).get("properties", {})
        for name, field in properties.items():
            kinds: list[Any] = field.get("anyOf", [])
            if cls.null_is_said or {"type": "null"} not in kinds:
                continue
            given = [kind for kind in kinds if kind != {"type": "null"}]
            rest = {key: value for key, value in field.items() if key not in ("anyOf", "default")}
            properties[name] = (given[0] if len(given) == 1 else {"anyOf": given}) | rest
        return schema


def read_later(model: type[BaseModel]) -> BeforeValidator:
    """Marks JSON that is read when it is known what it is for, and described as a model."""
    return BeforeValidator(lambda document: document, json_schema_input_type=model)


def is_text(value: str) -> bool:
    """Whether a string can be written as UTF-8: a lone surrogate, half a character, cannot."""
    return value.isascii() or not any("\ud800" <= character <= "\udfff" for character in value)


def _text(value: str) -> str:
    if not is_text(value):
        raise ValueError("half a character (a lone surrogate) is no text")
    return value


def _whole(value: object) -> object:
    return int(value) if isinstance(value, float) and value.is_integer() else value


Text = Annotated[str, AfterValidator(_text)]
"""A string that can be written."""
Index = Annotated[int, Field(ge=0, le=int(LARGEST)), BeforeValidator(_whole)]
"""0, 1, 2 and so on; 2.0 is 2."""
Count = Annotated[int, Field(ge=1, le=int(LARGEST)), BeforeValidator(_whole)]
"""1, 2, 3 and so on."""
