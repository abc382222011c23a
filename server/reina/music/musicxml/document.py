"""The bytes of a MusicXML document into its head and its measures, one by one.

A measure of a part is handed on as soon as it is closed and forgotten then, so that the document as a whole
is never held as a tree. A document of either kind (``score-partwise``, ``score-timewise``) comes as such
cells.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from defusedxml.common import DefusedXmlException
from defusedxml.ElementTree import ParseError, XMLParser

from reina.music.errors import ScoreError, ScoreLimitError
from reina.music.musicxml.element import Element

if TYPE_CHECKING:
    from collections.abc import Callable

    from reina.music.limits import Limits
    from reina.music.warnings import WarningLog

PARTWISE, TIMEWISE = "score-partwise", "score-timewise"
ROOTS = (PARTWISE, TIMEWISE)

LOOKED = frozenset({"defaults", "print", "beam", "stem", "notehead", "encoding", "harmony", "figured-bass"})
"""Elements that only say how a page looks, or what is not played; nothing in them is read."""

MAX_DEPTH = 100
"""Elements within one another; MusicXML has about ten."""
MAX_HELD = 200_000
"""Elements of one measure, or of the document's head."""
MAX_TEXT = 10_000
"""Characters of one element's text that are kept."""
CHUNK_BYTES = 64 * 1024

_DECLARED = re.compile(rb'^\s*<\?xml[^>]*?encoding\s*=\s*["\']([A-Za-z0-9._-]+)["\']')


@dataclass(frozen=True)
class Cell:
    """A measure of a part.

    Attributes:
        part: The part's id.
        part_index: Its place among the parts of the document's body.
        measure: The measure's place, from 0.
        number: What the document numbers it.
        implicit: Whether it counts as no measure of its own, as a pickup.
        element: What is in it.
    """

    part: str
    part_index: int
    measure: int
    number: str
    implicit: bool
    element: Element

    @property
    def place(self) -> str:
        """For messages."""
        return f"part {self.part or self.part_index + 1}, measure {self.number or self.measure + 1}"


@dataclass
class Head:
    """What stands before the measures: `work`, `part-list` and so on."""

    elements: list[Element] = field(default_factory=list[Element])

    def first(self, name: str, *path: str) -> Element | None:
        """Return the first element along a path of names."""
        for element in self.elements:
            if element.name == name:
                return element.first(*path)
        return None

    def said(self, *path: str) -> str:
        """Return the text of the first element along a path, "" if there is none."""
        found = self.first(*path)
        return found.text.strip() if found else ""


def read_document(
    data: bytes, on_cell: Callable[[Head, Cell], None], *, limits: Limits, log: WarningLog
) -> Head:
    """Read a document, handing on each measure of each part as it is closed.

    What stands before a fault is kept where a measure does, and the fault is told.

    Args:
        data: The document.
        on_cell: Is given the head and a measure.
        limits: How much may be in it.
        log: Where repairs are told.

    Raises:
        ScoreError: If it is no such document, or declares entities.
        ScoreLimitError: If it holds more than `limits` has.
    """
    text, encoding = _decoded(data, log)
    target = _Target(on_cell, limits.elements)
    parser = XMLParser(target=target, encoding=encoding)
    target.line_of = lambda: int(parser.parser.CurrentLineNumber)
    try:
        for at in range(0, len(text), CHUNK_BYTES):
            parser.feed(text[at : at + CHUNK_BYTES])
        parser.close()
    except (ScoreError, ScoreLimitError):
        raise
    except DefusedXmlException as error:
        raise ScoreError(
            "the document declares entities of its own, which are not read; export it anew from the "
            "program that wrote it",
            location=f"line {target.line_of()}",
        ) from error
    except (ParseError, ValueError, LookupError) as error:
        what = _fault(error)
        where = f"line {getattr(error, 'position', (target.line_of(), 0))[0]}"
        if not target.cells:
            raise ScoreError(f"this is no MusicXML that can be read: {what}", location=where) from error
        log.add("broken_document", where, f"{what}; what stands before it was kept")
    if target.root not in ROOTS:
        raise ScoreError(
            f"the document is <{target.root[:30]}>; <{PARTWISE}> or <{TIMEWISE}> would be MusicXML",
            location="line 1",
        )
    return target.head


def _fault(error: Exception) -> str:
    text = str(error).split(": line ")[0]
    return {"no element found": "it breaks off", "unclosed token": "it breaks off"}.get(text, text)


def _decoded(data: bytes, log: WarningLog) -> tuple[bytes, str | None]:
    """Return what the parser is fed, and the encoding that overrides the declared one.

    What says or means UTF-8 and is not is read as windows-1252, which such files are in.
    """
    declared = _DECLARED.match(data)
    named = declared[1].lower() if declared else b"utf-8"
    if named not in (b"utf-8", b"utf8") or data.startswith((b"\xff\xfe", b"\xfe\xff")):
        return data, None
    try:
        data.decode("utf-8")
    except UnicodeDecodeError as error:
        if error.reason == "unexpected end of data":
            return data, None
        line = data.count(b"\n", 0, error.start) + 1
        log.add("bad_text", f"line {line}", "is not UTF-8, as it should be; it was read as windows-1252")
        return data.decode("cp1252", errors="replace").encode(), "utf-8"
    return data, None


class _Target:
    """Takes what the parser finds; keeps the head, and the one measure that is open."""

    def __init__(self, on_cell: Callable[[Head, Cell], None], most: int) -> None:
        self.head = Head()
        self.root = ""
        self.cells = 0
        self.line_of: Callable[[], int] = lambda: 0
        self._on_cell = on_cell
        self._most = most
        self._open: list[Element] = []
        self._text: list[str] = []
        self._text_size = 0
        self._skipped = 0
        self._count = 0
        self._held = 0
        self._outer = self._inner = -1
        self._measure_number, self._measure_implicit = "", False

    def start(self, name: str, attributes: dict[str, str]) -> None:
        if name[0] == "{":
            name = name.rpartition("}")[2]
        self._count += 1
        if self._count > self._most:
            raise ScoreLimitError(
                f"more than {self._most:,} elements, the most that are read",
                location=f"line {self.line_of()}",
            )
        if self._skipped or name in LOOKED:
            self._skipped += 1
            return
        self._held += 1
        depth = len(self._open)
        if self._held > MAX_HELD or depth > MAX_DEPTH:
            raise ScoreLimitError(
                f"one measure holds more than {MAX_HELD:,} elements, or {MAX_DEPTH} within one another; that "
                "is no music",
                location=f"line {self.line_of()}",
            )
        if depth == 0:
            self.root = name
            if name not in ROOTS:
                raise ScoreError(
                    f"the document is <{name[:30]}>; <{PARTWISE}> or <{TIMEWISE}> would be MusicXML",
                    location=f"line {self.line_of()}",
                )
        self._text.clear()
        self._text_size = 0
        element = Element(name, attributes, self.line_of())
        if depth == 1 and name == self._outer_name:
            self._outer += 1
            self._inner = -1
            self._count_measure(element)
        elif depth == 2 and name == self._inner_name and self._open[1].name == self._outer_name:
            self._inner += 1
            self._count_measure(element)
        self._open.append(element)

    def data(self, text: str) -> None:
        if not self._skipped and self._text_size < MAX_TEXT:
            self._text.append(text)
            self._text_size += len(text)

    def end(self, _: str) -> None:
        if self._skipped:
            self._skipped -= 1
            return
        element = self._open.pop()
        if self._text:
            element.text = "".join(self._text)[:MAX_TEXT]
            self._text.clear()
            self._text_size = 0
        depth = len(self._open)
        if depth == 2 and element.name == self._inner_name and self._open[1].name == self._outer_name:
            self._hand_on(element)
            self._held = 0
        elif depth == 1 and element.name != self._outer_name:
            self.head.elements.append(element)
        elif depth > 1:
            self._open[-1].children.append(element)

    def close(self) -> None:
        """Nothing is left to do at the document's end."""

    @property
    def _outer_name(self) -> str:
        return "part" if self.root == PARTWISE else "measure"

    @property
    def _inner_name(self) -> str:
        return "measure" if self.root == PARTWISE else "part"

    def _count_measure(self, element: Element) -> None:
        if element.name == "measure":
            self._measure_number = element.attribute("number")[:20]
            self._measure_implicit = element.attribute("implicit") == "yes"

    def _hand_on(self, element: Element) -> None:
        outer = self._open[1]
        partwise = self.root == PARTWISE
        self.cells += 1
        self._on_cell(
            self.head,
            Cell(
                part=(outer if partwise else element).attribute("id")[:60],
                part_index=self._outer if partwise else self._inner,
                measure=self._inner if partwise else self._outer,
                number=self._measure_number,
                implicit=self._measure_implicit,
                element=element,
            ),
        )
