"""What is found of one thing that the server needs."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Literal

Status = Literal["ok", "warn", "fail"]


@dataclass(frozen=True)
class Finding:
    """One line of what `reina doctor` says.

    Attributes:
        what: What was looked at.
        status: ``"ok"``; ``"warn"``: it works, but not all or not for long; ``"fail"``: it does not work.
        detail: What was found.
        to_do: What would make it right; empty where it is.
    """

    what: str
    status: Status
    detail: str
    to_do: str = ""

    def document(self) -> dict[str, str]:
        """It as plain data."""
        return asdict(self)


def ok(what: str, detail: str) -> Finding:
    """All is well."""
    return Finding(what, "ok", detail)


def warn(what: str, detail: str, to_do: str) -> Finding:
    """It works, but not all or not for long."""
    return Finding(what, "warn", detail, to_do)


def fail(what: str, detail: str, to_do: str) -> Finding:
    """It does not work."""
    return Finding(what, "fail", detail, to_do)
