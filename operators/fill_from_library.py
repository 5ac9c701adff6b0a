"""Rows from the spectra of the library."""

from __future__ import annotations

import bpy

from ..rtb_addon.blender.own_spectra import own_folders
from ..rtb_addon.errors import RecipeError
from .design_verbs import DesignVerb

MOST = 32  # what a set of flags can hold

_items: dict[str, list] = {}  # Blender reads items where we keep them


def forget() -> None:
    """Look for the library's names anew when they are next asked for."""
    _items.clear()


def _groups(operator, context):
    if "groups" not in _items:
        _items["groups"] = [(name, name, "", number) for number, name in enumerate(_names_by_group())]
    return _items["groups"]


def _spectra(operator, context):
    group = operator.group
    if group not in _items:
        names = _names_by_group().get(group, [])
        _items[group] = [(n, n.rpartition("/")[2], n, 1 << bit) for bit, n in enumerate(names)]
    return _items[group]


def _names_by_group() -> dict[str, list[str]]:
    """Return the library's names: those of each chart, and the illuminants of each kind."""
    from ..rtb_addon.spectra.library import names  # brings numpy, which enabling need not wait for

    groups: dict[str, list[str]] = {}
    for name in sorted(names(own_folders()), key=lambda each: "/" not in each):
        groups.setdefault(_group(name), []).append(name)
    return {group: found[:MOST] for group, found in groups.items()}


def _group(name: str) -> str:
    if "/" in name:
        return name.rpartition("/")[0]
    kinds = {"FL": "Fluorescent Lamps", "HP": "Discharge Lamps", "LE": "LED Lamps", "IS": "ISO 7589"}
    return kinds.get(name[:2], "CIE Illuminants")


class RTB_OT_fill_from_library(DesignVerb, bpy.types.Operator):
    """A row for each of some spectra of the library"""

    bl_idname = "rtb.fill_from_library"
    bl_label = "From Library"

    group: bpy.props.EnumProperty(name="Library", items=_groups)
    marked: bpy.props.EnumProperty(name="Spectra", items=_spectra, options={"ENUM_FLAG", "SKIP_SAVE"})
    names: bpy.props.StringProperty(
        name="Names",
        description="Names of the library between semicolons, for scripts",
        options={"SKIP_SAVE"},
    )
    fields = ("variable", "how", "group")

    def draw(self, context):
        super().draw(context)
        self.layout.use_property_split = False
        flow = self.layout.grid_flow(row_major=True, columns=3, even_columns=True, align=True)
        flow.prop(self, "marked")

    def edit(self, context):
        from ..rtb_addon.spectra.library import find

        order = [each[0] for each in _spectra(self, context)]
        names = [each.strip() for each in self.names.split(";") if each.strip()]
        names = names or sorted(self.marked, key=order.index)
        if not names:
            raise RecipeError("no spectrum is marked, click those that are wanted")
        for name in names:
            find(name, own_folders())
        return self.put(context, names, [each.rpartition("/")[2] for each in names], "SPECTRUM")
