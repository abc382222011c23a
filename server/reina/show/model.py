"""The base of what a show's document is made of."""

from typing import Annotated

from pydantic import AfterValidator, BaseModel, BeforeValidator, ConfigDict, Field

from reina.curves.value_types import LARGEST, STRICT


class ShowModel(BaseModel):
    """Immutable, and strict: no field that is not declared, no number in quotes."""

    model_config = ConfigDict(**STRICT, frozen=True, use_attribute_docstrings=True)


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
