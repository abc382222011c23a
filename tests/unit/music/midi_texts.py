"""Titles and names of MIDI files in the languages that they are written in."""

from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Texts:
    """The texts of one file: the title, then names of parts."""

    language: str
    encoding: str
    texts: tuple[str, ...]

    @property
    def encoded(self) -> tuple[bytes, ...]:
        return tuple(text.encode(self.encoding) for text in self.texts)

    def first(self, count: int) -> "Texts":
        return Texts(self.language, self.encoding, self.texts[:count])


def read_texts(name: str) -> list[Texts]:
    """Read a table beside this file; files of several character sets come once in each."""
    found: list[Texts] = []
    language, encodings = "", [""]
    for line in (Path(__file__).parent / name).read_text("utf-8").splitlines():
        if line.startswith("["):
            language, _, sets = line[1:].partition("]")
            encodings = sets.split()
        elif line and not line.startswith("#"):
            texts = tuple(text.strip() for text in line.split("|"))
            found += [Texts(language, encoding, texts) for encoding in encodings]
    return found
