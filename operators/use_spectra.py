"""Give a material, a lamp or the world spectra of its own."""

from __future__ import annotations

import bpy

from ..rtb_addon.blender.lights import colour_of
from ..rtb_addon.blender.nodes import colour_of_material

THINGS = (
    ("MATERIAL", "Material", "The active material", 1),
    ("LIGHT", "Light", "The active lamp", 2),
    ("WORLD", "World", "The scene's world", 3),
)


class RTB_OT_use_spectra(bpy.types.Operator):
    """Say this in spectra, beginning with what its colour stands for"""

    bl_idname = "rtb.use_spectra"
    bl_label = "Use Spectra"
    bl_options = {"REGISTER", "UNDO", "INTERNAL"}

    thing: bpy.props.EnumProperty(name="Thing", items=THINGS)

    def execute(self, context):
        thing = getattr(context, self.thing.lower(), None)
        if thing is None:
            self.report({"ERROR"}, f"No {self.thing.lower()} is active here: select one first")
            return {"CANCELLED"}
        thing.rtb.use_spectra = True
        if self.thing == "MATERIAL":
            thing.rtb.reflectance = in_words(colour_of_material(thing).colour)
        elif self.thing == "LIGHT" and tuple(colour_of(thing)) != (1.0, 1.0, 1.0):
            thing.rtb.spectrum = in_words(colour_of(thing))
        return {"FINISHED"}


def in_words(colour: tuple[float, float, float]) -> str:
    """Return the spectrum of a colour of Blender's as somebody would type it, one number for a grey."""
    # numpy takes longer to come than all else that enabling the extension waits for.
    from ..rtb_addon.blender.colours import linear_rec709
    from ..rtb_addon.spectra.promotion import promoted
    from ..rtb_addon.spectra.text import format_number, format_spectrum

    rounded = [round(component, 3) for component in linear_rec709(colour)]
    return format_number(rounded[0]) if len(set(rounded)) == 1 else format_spectrum(promoted(rounded))
