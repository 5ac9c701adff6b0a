"""A spectrum of the library, found by its name."""

from __future__ import annotations

import bpy

from .spectrum_verbs import SpectrumVerb

_items: list[tuple[str, str, str, int]] = []  # Blender reads them where we keep them


def _names(operator, context):
    if not _items:
        from ..rtb_addon.spectra.library import names  # brings numpy, which enabling need not wait for

        _items.extend((name, name.replace("/", " › "), "", number) for number, name in enumerate(names()))
    return _items


class RTB_OT_use_library_spectrum(SpectrumVerb, bpy.types.Operator):
    """Search the library for a measured or standard spectrum"""

    bl_idname = "rtb.use_library_spectrum"
    bl_label = "Library"
    bl_property = "name"

    name: bpy.props.EnumProperty(name="Name", items=_names)

    def invoke(self, context, event):
        context.window_manager.invoke_search_popup(self)
        return {"FINISHED"}

    def text(self, context, owner):
        return self.name
