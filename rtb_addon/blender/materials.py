"""Blender's materials: what they are tagged with, else their colour."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from .colours import linear_rec709
from .folders import typed
from .nodes import Found, colour_of_material, glows
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
    remarks = tuple(_remarks(material, found, colour))
    if not settings.use_spectra:
        return Paint(name, colour, remarks=remarks)
    reflectance = Spoken(typed(settings.reflectance, material), f"the material {name}")
    return Paint(name, colour, settings.model, reflectance, remarks)


def _remarks(material, found: Found, colour: tuple[float, float, float]) -> Iterator[str]:
    name = f"the material {material.name_full}"
    if not material.rtb.use_spectra:
        shown = " ".join(f"{component:.3g}" for component in colour)
        yield f"{name} has no spectrum: its {found.place} {shown} is promoted to one, and matte"
        if found.textured:
            yield f"{name} has a texture for its {found.place}, which is not read"
    if glows(material):
        yield f"{name} glows in Blender only: let its object emit to have it shine"
