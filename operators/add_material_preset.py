"""What a spectral material says, kept under a name for other files."""

from __future__ import annotations

import bpy
from bl_operators.presets import AddPresetBase

from ..rtb_addon.blender.material_words import words_of
from ..rtb_addon.scene.vocabulary import MATERIALS

FOLDER = "rtb_material"


class RTB_OT_add_material_preset(AddPresetBase, bpy.types.Operator):
    """Keep the model and parameters of this spectral material as a preset, or remove one"""

    bl_idname = "rtb.add_material_preset"
    bl_label = "Add Material Preset"
    bl_options = {"REGISTER", "INTERNAL"}

    preset_menu = "RTB_PT_material_presets"
    preset_subdir = FOLDER
    preset_defines = ("settings = bpy.context.material.rtb", "settings.use_spectra = True")

    @classmethod
    def poll(cls, context):
        return getattr(context, "material", None) is not None

    @property
    def preset_values(self):
        """The properties of the active material's model, the model first: it brings its defaults."""
        parameters = MATERIALS[bpy.context.material.rtb.model]
        own = [words_of(name).name for name, each in parameters.items() if each.kind != "reference"]
        return [f"settings.{name}" for name in ("model", *own, "opacity")]
