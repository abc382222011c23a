"""An element of a MusicXML document, with the line that it stands in."""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

_NUMBER = re.compile(r"[+-]?(\d{1,15}(\.\d{0,20})?|\.\d{1,20})", re.ASCII)


class Element:
    """An element: its name, attributes, text and children, and its line in the document."""

    __slots__ = ("attributes", "children", "line", "name", "text")

    def __init__(self, name: str, attributes: dict[str, str], line: int) -> None:
        self.name = name
        self.attributes = attributes
        self.text = ""
        self.children: list[Element] = []
        self.line = line

    def __iter__(self) -> Iterator[Element]:
        return iter(self.children)

    def all(self, name: str) -> Iterator[Element]:
        """Yield the children of a name."""
        return (child for child in self.children if child.name == name)

    def first(self, *path: str) -> Element | None:
        """Return the first descendant along a path of names."""
        at: Element | None = self
        for name in path:
            at = next((child for child in at.children if child.name == name), None) if at else None
        return at

    def said(self, *path: str) -> str:
        """Return the text of the first descendant along a path, "" if there is none."""
        found = self.first(*path)
        return found.text.strip() if found else ""

    def number(self, *path: str) -> float | None:
        """Return the number that the first descendant along a path holds, None if it holds none."""
        return number_of(self.said(*path))

    def attribute(self, name: str) -> str:
        """Return an attribute without the space about it, "" if there is none."""
        return self.attributes.get(name, "").strip()


def number_of(text: str) -> float | None:
    """Return a decimal number of a text that is one, else None."""
    text = text.strip()
    return float(text) if _NUMBER.fullmatch(text) else None


def whole_of(text: str) -> int | None:
    """Return a whole number of a text that is one, as ``"2"`` or ``"2.0"``, else None."""
    value = number_of(text)
    return int(value) if value is not None and value == math.floor(value) else None
