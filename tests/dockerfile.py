"""The Dockerfile and .dockerignore, read for tests: not every machine that runs them has Docker."""

from __future__ import annotations

import re
import shlex
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[1]


@dataclass(frozen=True)
class Instruction:
    """One line of the Dockerfile, continued lines joined."""

    name: str
    text: str

    @property
    def words(self) -> list[str]:
        """What follows its name."""
        return shlex.split(self.text)


@dataclass(frozen=True)
class Stage:
    """From one FROM to the next."""

    name: str
    base: str
    instructions: tuple[Instruction, ...]

    def all(self, name: str) -> list[Instruction]:
        """Its instructions of one kind."""
        return [instruction for instruction in self.instructions if instruction.name == name]


def stages() -> list[Stage]:
    """The stages; a base that an argument names is told in full. The last one has no name."""
    text = (ROOT / "Dockerfile").read_text()
    joined = re.sub(r"^#.*\n", "", text, flags=re.MULTILINE).replace("\\\n", " ")
    arguments: dict[str, str] = {}
    found: list[tuple[str, str, list[Instruction]]] = []
    for line in filter(None, joined.splitlines()):
        name, rest = line.split(maxsplit=1)
        if name == "ARG":
            argument, value = rest.split("=", 1)
            arguments[argument] = value
        elif name == "FROM":
            base, _, stage = rest.partition(" AS ")
            found.append((stage, re.sub(r"\$\{(\w+)\}", lambda named: arguments[named[1]], base), []))
        else:
            found[-1][2].append(Instruction(name, rest.strip()))
    return [Stage(name, base, tuple(instructions)) for name, base, instructions in found]


def is_sent(path: str) -> bool:
    """Whether .dockerignore lets a path through: the last pattern that fits it or a folder above decides."""
    sent = True
    for line in (ROOT / ".dockerignore").read_text().splitlines():
        pattern = line.strip()
        if not pattern or pattern.startswith("#"):
            continue
        kept, pattern = pattern.startswith("!"), pattern.removeprefix("!")
        expression = re.escape(pattern).replace(r"\*\*/", "(.*/)?").replace(r"\*", "[^/]*")
        if re.fullmatch(f"{expression}(/.*)?", path):
            sent = kept
    return sent
