"""What the user sees; draws and never decides."""

import bpy
from bpy.utils import register_classes_factory

from ..rtb_addon.blender import asset_library, curve_previews, light_words, typed_paths
from . import image_editor, material_presets, menus, progress, spectrum_menus
from .condition_menus import RTB_MT_conditions, RTB_MT_designs, RTB_MT_variable
from .conditions import RTB_PT_conditions, RTB_UL_conditions
from .mappings import RTB_PT_mappings
from .recipe import RTB_PT_recipe
from .render_settings import RTB_PT_render_settings
from .spectral_emission import RTB_PT_spectral_emission
from .spectral_light import RTB_PT_spectral_light
from .spectral_material import RTB_PT_spectral_material
from .spectral_world import RTB_PT_spectral_world

_register, _unregister = register_classes_factory(
    (
        RTB_PT_recipe,
        RTB_PT_render_settings,
        spectrum_menus.RTB_MT_spectrum,
        RTB_UL_conditions,
        RTB_MT_designs,
        RTB_MT_variable,
        RTB_MT_conditions,
        menus.RTB_MT_recipe,
        RTB_PT_conditions,
        RTB_PT_mappings,
        material_presets.RTB_PT_material_presets,
        RTB_PT_spectral_material,
        RTB_PT_spectral_light,
        RTB_PT_spectral_world,
        RTB_PT_spectral_emission,
    )
)


def register() -> None:
    """Make the panels, menu entries and the status bar's bar known to Blender."""
    _register()
    # Of the window and not of the scene: which columns are shown is neither saved nor undone.
    bpy.types.WindowManager.rtb_first_variable = bpy.props.IntProperty(options={"HIDDEN"}, min=0)
    curve_previews.register()
    typed_paths.register()
    asset_library.register()
    material_presets.register()
    menus.register()
    spectrum_menus.register()
    progress.register()
    image_editor.register()


def unregister() -> None:
    """Take them back."""
    image_editor.unregister()
    progress.unregister()
    spectrum_menus.unregister()
    menus.unregister()
    material_presets.unregister()
    asset_library.unregister()
    typed_paths.unregister()
    curve_previews.unregister()
    light_words.unregister()
    del bpy.types.WindowManager.rtb_first_variable
    _unregister()
