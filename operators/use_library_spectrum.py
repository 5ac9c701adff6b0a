"""A spectrum of the library, found by its name, with its curve beside it."""

import bpy

from ..rtb_addon.blender import curve_previews
from ..rtb_addon.blender.fields import FIELDS
from ..rtb_addon.blender.own_spectra import own_folders
from .spectrum_verbs import SpectrumVerb

# What is offered to whom: kind -> Blender's items, which it reads where we keep them.
_items: dict[str, list[tuple[str, str, str, int, int]]] = {}
_own: dict[str, float] = {}  # when each of the user's own files that are offered was written [s]


def forget() -> None:
    """Look for the library's names anew when they are next asked for."""
    _items.clear()
    curve_previews.forget_icons()


def look_again() -> None:
    """Forget the names where the user's own files are others than before."""
    from ..rtb_addon.spectra.library import own_files  # brings numpy, which enabling need not wait for

    now = {name: file.stat().st_mtime for name, file in own_files(own_folders()).items()}
    if now != _own:
        forget()
        _own.clear()
        _own.update(now)


def _names(operator, context):
    kind = _kind(operator.field)
    if kind not in _items:
        from ..rtb_addon.spectra.library import names  # brings numpy, which enabling need not wait for

        fitting = [name for name in names(own_folders()) if _fits(name, kind)]
        if kind in ("surface", "light"):  # what is meant first
            fitting.sort(key=lambda name: (_is_light(name) != (kind == "light"), name.startswith("Own/")))
        icons = curve_previews.icons(fitting, kind == "light")
        _items[kind] = [
            (name, name.replace("/", " › "), "", icon, number)
            for number, (name, icon) in enumerate(zip(fitting, icons, strict=True))
        ]
    return _items[kind]


def _kind(field: str) -> str:
    """Return what kind of spectra a field takes."""
    said = FIELDS[field]
    if said.index:
        return said.name if said.name in ("eta", "k") else "index"
    return "any" if field == "CELL" else "light" if said.shines else "surface"


def _fits(name: str, kind: str) -> bool:
    if name.startswith("Metals/"):
        return kind == "any" or name.endswith(f" {kind}")
    if name.startswith("Glasses/"):
        return kind in ("any", "index")
    return name.startswith("Own/") or kind in ("any", "light", "surface")


def _is_light(name: str) -> bool:
    from ..rtb_addon.spectra.library import is_light

    return not name.startswith("Own/") and is_light(name)


class RTB_OT_use_library_spectrum(SpectrumVerb, bpy.types.Operator):
    """Search the library for a measured or standard spectrum"""

    bl_idname = "rtb.use_library_spectrum"
    bl_label = "Library"
    bl_property = "name"

    name: bpy.props.EnumProperty(name="Name", items=_names)

    def invoke(self, context, event):
        look_again()
        context.window_manager.invoke_search_popup(self)
        return {"INTERFACE"}  # nothing has been done yet that could be undone

    def text(self, context, owner):
        return self.name
