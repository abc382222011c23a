"""The kit's materials, as indices into the file being written."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

from common.glb import linear
from drums.images import bronze_images, front_head_image, png, shell_image, skin_image

if TYPE_CHECKING:
    from common.glb import GlbWriter


@dataclass(frozen=True)
class KitMaterials:
    """Indices of the materials."""

    GRAINED_FROM: ClassVar[float] = 0.5
    """From this detail on bronze has its grooves and its light along them, and wood its lacquer."""

    shell: int
    bronze: int
    chrome: int
    steel: int
    skin: int
    front: int
    rubber: int
    felt: int
    hickory: int

    @property
    def shades(self) -> dict[int, tuple[float, float, float]]:
        """What is left of each one's colour (linear RGB) where other parts close it in."""
        cool, warm = (0.30, 0.29, 0.29), (0.42, 0.30, 0.18)
        others = (self.chrome, self.steel, self.skin, self.front, self.rubber, self.felt)
        return {
            self.bronze: warm,
            self.shell: (0.30, 0.20, 0.16),
            self.hickory: (0.4, 0.3, 0.2),
            **dict.fromkeys(others, cool),
        }

    @property
    def pictured(self) -> tuple[int, ...]:
        """Those with an image."""
        return (self.shell, self.bronze, self.skin, self.front)

    @classmethod
    def into(cls, writer: GlbWriter, detail: float) -> KitMaterials:
        """Add the materials to a file; images are as fine as `detail` asks."""
        clearcoat, anisotropy = "KHR_materials_clearcoat", "KHR_materials_anisotropy"
        fine = detail >= cls.GRAINED_FROM
        lacquer: dict[str, Any] = {}
        if fine:
            lacquer = {"extensions": {clearcoat: {"clearcoatFactor": 0.9, "clearcoatRoughnessFactor": 0.06}}}
        colour, rough, normal, across = bronze_images(detail)
        grain: dict[str, Any] = {}
        if fine:
            grain = {
                "normalTexture": {"index": writer.texture(*png(normal), "lathing"), "scale": 0.18},
                "extensions": {
                    anisotropy: {
                        "anisotropyStrength": 0.55,
                        "anisotropyTexture": {"index": writer.texture(*png(across), "across")},
                    }
                },
            }
        bronze = writer.material(
            "bronze",
            metallic=1.0,
            roughness=1.0,
            texture=writer.texture(*png(colour), "bronze"),
            doubleSided=True,
            **grain,
        )
        surface = writer.content["materials"][bronze]["pbrMetallicRoughness"]
        surface["metallicRoughnessTexture"] = {"index": writer.texture(*png(rough), "bronze rough")}
        return cls(
            shell=writer.material(
                "shell",
                metallic=0.0,
                roughness=0.32,
                texture=writer.texture(*shell_image(detail), "shell"),
                **lacquer,
            ),
            bronze=bronze,
            chrome=writer.material("chrome", metallic=1.0, roughness=0.17, colour=(0.58, 0.58, 0.60)),
            steel=writer.material("steel", metallic=1.0, roughness=0.46, colour=(0.17, 0.17, 0.175)),
            skin=writer.material(
                "coated head",
                metallic=0.0,
                roughness=0.62,
                texture=writer.texture(*skin_image(), "coated head"),
            ),
            front=writer.material(
                "front head",
                metallic=0.0,
                roughness=0.42,
                texture=writer.texture(*front_head_image(detail), "front head"),
            ),
            rubber=writer.material("rubber", metallic=0.0, roughness=0.72, colour=(0.012, 0.012, 0.013)),
            felt=writer.material("felt", metallic=0.0, roughness=0.95, colour=linear((0.50, 0.47, 0.42))),
            hickory=writer.material(
                "hickory", metallic=0.0, roughness=0.48, colour=linear((0.80, 0.63, 0.42))
            ),
        )
