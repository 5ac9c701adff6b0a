"""The presets of spectral materials, in the header of their panel."""

from pathlib import Path

import bpy
from bl_ui.utils import PresetPanel

from ..operators.add_material_preset import FOLDER, RTB_OT_add_material_preset

HERE = str(Path(__file__).parent)  # of the folder presets/


class RTB_PT_material_presets(PresetPanel, bpy.types.Panel):
    """Materials that you have kept"""

    bl_label = "Spectral Material Presets"
    preset_subdir = FOLDER
    preset_operator = "script.execute_preset"
    preset_add_operator = RTB_OT_add_material_preset.bl_idname


def register() -> None:
    """Show the shipped presets beside the user's own."""
    bpy.utils.register_preset_path(HERE)


def unregister() -> None:
    """Take them back."""
    bpy.utils.unregister_preset_path(HERE)
