"""What the user sees in the Image Editor."""

from bpy.utils import register_classes_factory

from . import overlay, probe_tool
from .probes import RTB_PT_probes, RTB_UL_pins
from .rendering import RTB_PT_montage, RTB_PT_rendering

_register, _unregister = register_classes_factory(
    (RTB_PT_rendering, RTB_PT_montage, RTB_UL_pins, RTB_PT_probes)
)


def register() -> None:
    """Make the panels, the tool and what lies over pictures known to Blender."""
    _register()
    overlay.register()
    probe_tool.register()


def unregister() -> None:
    """Take them back."""
    probe_tool.unregister()
    overlay.unregister()
    _unregister()
