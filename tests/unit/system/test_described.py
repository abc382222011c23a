"""Fields described by the docstrings below them."""

from typing import Any

from pydantic import Field, create_model

from reina.system.described import DescribedModel


class Chair(DescribedModel):
    """Something to sit on."""

    legs: int = 4
    """How many it stands on.

    Three never wobble.
    """
    colour: str = "red"
    said: int = Field(default=0, description="As the field says.")
    """Not this."""
    of_wood: bool = Field(default=True, alias="ofWood")
    """Whether it is."""


class Stool(Chair):
    """A chair without a back."""

    legs: int = 3
    height_m: float = 0.5
    """Of the seat."""


class Room(DescribedModel):
    """Where chairs stand."""

    chair: Chair
    """The one by the window."""


def _descriptions(schema: dict[str, Any]) -> dict[str, str | None]:
    return {name: field.get("description") for name, field in schema["properties"].items()}


def test_fields_are_described_by_what_stands_below_them() -> None:
    assert _descriptions(Chair.model_json_schema()) == {
        "legs": "How many it stands on.\n\nThree never wobble.",
        "colour": None,
        "said": "As the field says.",
        "ofWood": "Whether it is.",
    }


def test_a_field_is_described_where_it_was_declared_last() -> None:
    described = _descriptions(Stool.model_json_schema())
    assert described["legs"] is None
    assert described["ofWood"] == "Whether it is."
    assert described["height_m"] == "Of the seat."


def test_models_within_models_are_described() -> None:
    schema = Room.model_json_schema()
    assert schema["properties"]["chair"]["description"] == "The one by the window."
    assert schema["$defs"]["Chair"]["properties"]["ofWood"]["description"] == "Whether it is."


def test_a_model_that_is_made_while_the_program_runs_has_what_it_inherits() -> None:
    made = create_model("Made", __base__=Chair, colour=(int, 0))
    assert _descriptions(made.model_json_schema())["colour"] is None
    assert _descriptions(made.model_json_schema())["ofWood"] == "Whether it is."
