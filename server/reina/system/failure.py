"""What failed, in a few words that go into a log, between processes and to whoever looks for the fault."""

from __future__ import annotations

import sys
import traceback
from dataclasses import dataclass
from pathlib import Path

MOST_FRAMES = 12
"""So many calls are told, the innermost ones."""
LONGEST_MESSAGE = 300
_ROOTS = tuple(str(Path(root).resolve()) + "/" for root in sys.path if root and Path(root).is_dir())
"""Folders that modules are imported from: what is below them is told without them."""


@dataclass(frozen=True)
class Failure:
    """An exception without its traceback.

    Attributes:
        kind: The name of its class.
        message: Its text, on one line and in part where it is long.
        frames: The calls that led to it as ``"reina/sessions/store.py:120 get"``, the innermost last.
        cause: What it was raised from, as ``"OSError: No space left on device"``; None where nothing was.
    """

    kind: str
    message: str
    frames: tuple[str, ...] = ()
    cause: str | None = None

    @property
    def place(self) -> str:
        """The innermost call; empty where none is known."""
        return self.frames[-1] if self.frames else ""


class ProcessFailure(RuntimeError):  # noqa: N818 - it carries what failed elsewhere
    """What failed in another process; it can be pickled.

    Args:
        failure: What failed there.
    """

    def __init__(self, failure: Failure) -> None:
        super().__init__(failure)
        self.failure = failure

    def __str__(self) -> str:
        return f"{self.failure.kind}: {self.failure.message}"


def failure_of(error: BaseException) -> Failure:
    """An exception in a few words."""
    if isinstance(error, ProcessFailure):
        return error.failure
    steps = traceback.extract_tb(error.__traceback__)[-MOST_FRAMES:]
    frames = tuple(f"{shown_file(step.filename)}:{step.lineno} {step.name}" for step in steps)
    cause = error.__cause__ or (None if error.__suppress_context__ else error.__context__)
    told = None if cause is None else f"{type(cause).__name__}: {_line(str(cause))}".removesuffix(": ")
    return Failure(type(error).__name__, _line(str(error)), frames, told)


def shown_file(filename: str) -> str:
    """A module's path below where it was imported from, the longest such folder."""
    roots = [root for root in _ROOTS if filename.startswith(root)]
    return filename.removeprefix(max(roots, key=len)) if roots else Path(filename).name


def _line(text: str) -> str:
    line = " ".join(text.split())
    return line if len(line) <= LONGEST_MESSAGE else f"{line[: LONGEST_MESSAGE - 1]}…"
