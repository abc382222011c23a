"""The B♭ trumpet."""

from reina.instruments.brass.model import load_model
from reina.instruments.brass.valved_brass import ValvedBrass

TRUMPET = ValvedBrass(load_model("reina.instruments.trumpet", "trumpet.toml"))

__all__ = ["TRUMPET"]
