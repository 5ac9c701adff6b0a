"""What the user can do in the Image Editor, and what that knows of the window."""

from . import pins, undone_pictures, view_settings, viewing
from .copy_pins import RTB_OT_copy_pins
from .export_pins import RTB_OT_export_pins
from .hover_probe import RTB_OT_hover_probe
from .probe import RTB_OT_probe
from .remove_pin import RTB_OT_remove_pin
from .show_still import RTB_OT_show_still

CLASSES = (
    RTB_OT_show_still,
    RTB_OT_hover_probe,
    RTB_OT_probe,
    RTB_OT_remove_pin,
    RTB_OT_copy_pins,
    RTB_OT_export_pins,
)


def register() -> None:
    """Watch the files that are opened, and make room for a view and for pins."""
    view_settings.register()
    viewing.register()
    pins.register()
    undone_pictures.register()


def unregister() -> None:
    """Forget what was looked at, and take that back."""
    undone_pictures.unregister()
    pins.unregister()
    viewing.unregister()
    view_settings.unregister()
