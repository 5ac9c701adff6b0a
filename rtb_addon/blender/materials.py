"""Blender's materials: what they are tagged with, else their colour."""

from __future__ import annotations

from dataclasses import dataclass

from .colours import linear_rec709
from .folders import typed
from .nodes import colour_of_material
from .statements import Spoken, Statement

# What lamps with a surface are made of.
BLACK = "Lamp Black"


@dataclass(frozen=True)
class Paint:
    """
    A material, read.

    Parameters
    ----------
    colour : linear Rec.709, what the parent scene shows
    model, reflectance : of the vocabulary; None where the colour is to be promoted
    remarks : what had to be assumed, a sentence each
    """

    name: str
    colour: tuple[float, float, float]
    model: str = "matte"
    reflectance: Spoken | None = None
    remarks: tuple[str, ...] = ()

    def statement(self, id: str) -> Statement | None:
        """Return what the mappings say about it, if anything."""
        if self.reflectance is None:
            return None
        spectra = {"diffuseReflectance": self.reflectance}
        return Statement(id, self.name, "material", self.model, spectra, {})


LAMP_BLACK = Paint(BLACK, (0.0, 0.0, 0.0), "matte", Spoken("300:0 800:0", "black"))


def read_material(material) -> Paint:
    """Return what a material is tagged with, else the one colour that can be read from it."""
    name, settings = material.name_full, material.rtb
    found = colour_of_material(material)
    colour = linear_rec709(found.colour)
    if settings.use_spectra:
        text = typed(settings.reflectance, material)
        return Paint(name, colour, settings.model, Spoken(text, f"the material {name}"))
    shown = " ".join(f"{component:.3g}" for component in colour)
    remark = f"the material {name} has no spectrum: its {found.place} {shown} is promoted to one, and matte"
    if found.textured:
        remark += "; the texture in its place is not read"
    return Paint(name, colour, remarks=(remark,))
