"""The trumpet's materials, as indices into the file being written."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from common.glb import GlbWriter


@dataclass(frozen=True)
class Metals:
    """Indices of the materials."""

    brass: int
    silver: int
    felt: int
    pearl: int
    aluminium: int
    cork: int

    @property
    def shades(self) -> dict[int, tuple[float, float, float]]:
        """What is left of each one's colour (linear RGB) where other parts close it in.

        Brass reflects brass.
        """
        warm, cool = (0.50, 0.34, 0.20), (0.36, 0.35, 0.34)
        others = (self.silver, self.aluminium, self.felt, self.pearl, self.cork)
        return {self.brass: warm, **dict.fromkeys(others, cool)}

    @classmethod
    def into(cls, writer: GlbWriter) -> Metals:
        """Add the materials to a file."""
        clearcoat = "KHR_materials_clearcoat"
        lacquer = {clearcoat: {"clearcoatFactor": 0.6, "clearcoatRoughnessFactor": 0.06}}
        shell = {clearcoat: {"clearcoatFactor": 1.0, "clearcoatRoughnessFactor": 0.05}}
        return cls(
            brass=writer.material(
                "brass",
                metallic=1.0,
                roughness=0.14,
                colour=(0.93, 0.62, 0.20),
                doubleSided=True,
                extensions=lacquer,
            ),
            silver=writer.material(
                "silver", metallic=1.0, roughness=0.16, colour=(0.86, 0.86, 0.84), doubleSided=True
            ),
            felt=writer.material("felt", metallic=0.0, roughness=0.95, colour=(0.03, 0.03, 0.035)),
            pearl=writer.material(
                "pearl", metallic=0.0, roughness=0.12, colour=(0.93, 0.91, 0.88), extensions=shell
            ),
            aluminium=writer.material(
                "aluminium", metallic=1.0, roughness=0.34, colour=(0.78, 0.79, 0.81), doubleSided=True
            ),
            cork=writer.material("cork", metallic=0.0, roughness=0.9, colour=(0.50, 0.32, 0.17)),
        )
