from __future__ import annotations

from typing import Annotated, Any, Literal

import pytest
from pydantic import Field

from reina.protocol.model import WireModel
from reina.protocol.typescript import field_types, interfaces, type_of


class Point(WireModel):
    """A place."""

    x: float
    label: str | None = None
    """What it is called."""


class Path(Point):
    kind: Literal["open", "closed"]
    points: list[Point]
    weights: list[float | None]
    pair: tuple[int, str]
    names: dict[str, Point]
    anything: Any
    mark: Literal["path"] = "path"


class Choice(WireModel):
    shape: Annotated[Point | Path, Field(description="Either.")]


def test_what_is_sent_has_all_its_fields() -> None:
    assert interfaces([Point]) == (
        "/** A place. */\n"
        "export interface Point {\n"
        "  x: number\n"
        "  /** What it is called. */\n"
        "  label: string | null\n"
        "}\n"
    )


def test_what_is_received_may_leave_out_what_has_a_default() -> None:
    assert "label?: string | null" in interfaces([], [Point])


def test_a_model_that_extends_another_says_so() -> None:
    text = interfaces([Path])
    assert "export interface Point {" in text
    path = text[text.index("export interface Path extends Point {") :]
    assert "x:" not in path
    assert "label" not in path


def test_every_shape_that_the_models_use() -> None:
    assert {name: kind for name, (kind, _) in field_types(Path).items()} == {
        "x": "number",
        "label": "string | null",
        "kind": '"open" | "closed"',
        "points": "Point[]",
        "weights": "(number | null)[]",
        "pair": "[number, string]",
        "names": "Record<string, Point>",
        "anything": "unknown",
        "mark": '"path"',
    }
    assert field_types(Choice)["shape"] == ("Point | Path", "Either.")


def test_a_schema_that_is_not_known_is_an_error() -> None:
    with pytest.raises(TypeError, match="no TypeScript for a JSON schema of type 'matrix'"):
        type_of({"type": "matrix"})
