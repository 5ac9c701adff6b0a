"""What the user sees; draws and never decides."""

from bpy.utils import register_classes_factory

from . import menus, progress
from .recipe import RTB_PT_light_paths, RTB_PT_montage, RTB_PT_recipe
from .spectral_emission import RTB_PT_spectral_emission
from .spectral_light import RTB_PT_spectral_light
from .spectral_material import RTB_PT_spectral_material
from .spectral_world import RTB_PT_spectral_world

_register, _unregister = register_classes_factory(
    (
        RTB_PT_recipe,
        RTB_PT_light_paths,
        RTB_PT_montage,
        RTB_PT_spectral_material,
        RTB_PT_spectral_light,
        RTB_PT_spectral_world,
        RTB_PT_spectral_emission,
    )
)


def register() -> None:
    """Make the panels, menu entries and the status bar's bar known to Blender."""
    _register()
    menus.register()
    progress.register()


def unregister() -> None:
    """Take them back."""
    progress.unregister()
    menus.unregister()
    _unregister()
