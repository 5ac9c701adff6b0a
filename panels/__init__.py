"""What the user sees; draws and never decides."""

from bpy.utils import register_classes_factory

from . import menus, progress
from .recipe import RTB_PT_recipe
from .spectral_material import RTB_PT_spectral_material

_register, _unregister = register_classes_factory((RTB_PT_recipe, RTB_PT_spectral_material))


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
