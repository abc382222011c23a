"""Every instrument by its name: the built-in ones, and those that installed packages bring.

A package brings one by an entry point of the group ``reina.instruments`` that names an `Instrument`::

    [project.entry-points."reina.instruments"]
    desk_bell = "my_package:DESK_BELL"
"""

import re
from collections.abc import Iterator, Mapping
from functools import cached_property
from importlib.metadata import entry_points

from reina.errors import ReinaError
from reina.instruments.brass.family import FAMILY
from reina.instruments.drums.drum_kit import DRUMS
from reina.instruments.instrument import Instrument

ENTRY_POINT_GROUP = "reina.instruments"

BUILT_IN: Mapping[str, Instrument] = {**FAMILY, DRUMS.name: DRUMS}

_NAME = re.compile(r"[a-z][a-z0-9_]*")


class InstrumentError(ReinaError):
    """An installed package offers an instrument that cannot be played."""


def discover_instruments() -> dict[str, Instrument]:
    """The built-in instruments and those of installed packages, looked for anew.

    Raises:
        InstrumentError: A package's entry point cannot be loaded, is no instrument, takes a name that is
            taken or is none, or streams parameters under another name.
    """
    table = dict(BUILT_IN)
    for point in sorted(entry_points(group=ENTRY_POINT_GROUP), key=lambda point: point.name):
        what = f"the instrument {point.name!r} of {point.value}"
        if point.name in table:
            raise InstrumentError(f"{what} is there already; rename it")
        try:
            loaded: object = point.load()
        except (ImportError, AttributeError) as error:
            raise InstrumentError(f"{what} cannot be loaded: {error}") from error
        if not isinstance(loaded, Instrument):
            raise InstrumentError(f"{what} is no Instrument; the entry point names one, not its class")
        name = getattr(loaded, "name", None)
        if name != point.name or not _NAME.fullmatch(point.name):
            raise InstrumentError(
                f"{what} has the name {name!r}; both are one, of a-z, 0-9 and _, as desk_bell"
            )
        if not getattr(loaded, "title", ""):
            raise InstrumentError(f"{what} has no title")
        others = [one.path for one in loaded.parameters if not one.path.startswith(f"{loaded.name}/")]
        if others:
            raise InstrumentError(f"{what} streams {others[0]!r}; its paths begin with {loaded.name}/")
        table[point.name] = loaded
    return table


class InstrumentRegistry(Mapping[str, Instrument]):
    """Every instrument by its name, looked for when it is asked for first: a package's may import this one.

    One without a rig has a fingering, and nobody can hold it.
    """

    @cached_property
    def _table(self) -> Mapping[str, Instrument]:
        return discover_instruments()

    def __getitem__(self, name: str) -> Instrument:
        return self._table[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._table)

    def __len__(self) -> int:
        return len(self._table)


INSTRUMENTS = InstrumentRegistry()
