"""Valved brass: what trumpet, cornet, flugelhorn, euphonium and tuba have in common, and their tables."""

from reina.instruments.brass.model import BrassModel, load_model
from reina.instruments.brass.valved_brass import ValvedBrass

__all__ = ["BrassModel", "ValvedBrass", "load_model"]
