"""The valved brass that Reina has; each is a table."""

from collections.abc import Mapping
from types import MappingProxyType

from reina.instruments.brass.model import load_model
from reina.instruments.brass.valved_brass import ValvedBrass

NAMES = ("trumpet", "c_trumpet", "cornet", "euphonium", "flugelhorn", "piccolo_trumpet", "tuba")

FAMILY: Mapping[str, ValvedBrass] = MappingProxyType(
    {name: ValvedBrass(load_model("reina.instruments.brass", f"{name}.toml")) for name in NAMES}
)
"""Instruments by name; each is ``<name>.toml`` beside this module."""
