"""Give a material, a lamp or the world spectra of its own."""

import bpy

from ..rtb_addon.blender.fields import active
from ..rtb_addon.blender.lights import colour_of

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
        from ..rtb_addon.blender.principled import in_words, promote  # enabling need not wait for it

        thing = active(context, self.thing.lower())
        if thing is None:
            self.report({"ERROR"}, f"No {self.thing.lower()} is active here: select one first")
            return {"CANCELLED"}
        thing.rtb.use_spectra = True
        if self.thing == "MATERIAL":
            self.report({"INFO"}, promote(thing))
        elif self.thing == "WORLD":
            from ..rtb_addon.blender.worlds import promote_world  # numpy, which enabling need not wait for

            self.report({"INFO"}, promote_world(thing))
        elif self.thing == "LIGHT" and tuple(colour_of(thing)) != (1.0, 1.0, 1.0):
            thing.rtb.spectrum = in_words(colour_of(thing))
        return {"FINISHED"}
