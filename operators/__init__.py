"""What the user can do: one verb a file."""

from bpy.utils import register_classes_factory

from . import running
from .cancel_rendering import RTB_OT_cancel_rendering
from .export_recipe import RTB_OT_export_recipe
from .render_recipe import RTB_OT_render_recipe
from .show_montage import RTB_OT_show_montage
from .tell import RTB_OT_tell
from .use_spectra import RTB_OT_use_spectra

_register, _unregister = register_classes_factory(
    (
        RTB_OT_export_recipe,
        RTB_OT_render_recipe,
        RTB_OT_cancel_rendering,
        RTB_OT_show_montage,
        RTB_OT_use_spectra,
        RTB_OT_tell,
    )
)


def register() -> None:
    """Make the operators known to Blender."""
    _register()
    running.register()


def unregister() -> None:
    """Stop what is rendering and take the operators back."""
    running.unregister()
    _unregister()
