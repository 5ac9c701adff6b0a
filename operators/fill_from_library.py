"""Rows from the spectra of the library."""

from itertools import compress

import bpy

from ..rtb_addon.blender import curve_previews
from ..rtb_addon.blender.own_spectra import own_folders
from ..rtb_addon.errors import RecipeError
from .design_verbs import DesignVerb

MOST = 32  # what a property can hold

_groups: dict[str, list[str]] = {}  # what the library has, until something is put into it
_items: list[tuple[str, str, str, int]] = []  # Blender reads items where we keep them


def forget() -> None:
    """Look for the library's names anew when they are next asked for."""
    _groups.clear()
    _items.clear()


def _group_items(operator, context):
    if not _items:
        _items.extend((name, name, "", number) for number, name in enumerate(_names_by_group()))
    return _items


def _unmark(operator, context):
    operator.marked = [False] * MOST


def _names_by_group() -> dict[str, list[str]]:
    """Return the library's names: charts first, then illuminants and lamps, then indices, one's own last."""
    from ..rtb_addon.spectra.library import names  # brings numpy, which enabling need not wait for

    if not _groups:
        found: dict[str, list[str]] = {}
        for name in sorted(names(own_folders()), key=_order):
            found.setdefault(_group(name), []).append(name)
        _groups.update(part for group in found for part in _parts(group, found[group]))
    return _groups


def _parts(group: str, names: list[str]):
    """Cut a group that one property cannot mark into parts."""
    if len(names) <= MOST:
        return [(group, names)]
    begins = range(0, len(names), MOST)
    return [(f"{group} from {begin + 1}", names[begin : begin + MOST]) for begin in begins]


def _order(name: str) -> int:
    from ..rtb_addon.spectra.library import OWN, is_light

    if name.startswith(OWN):
        return 3
    return 2 if name.startswith(("Metals/", "Glasses/")) else int(is_light(name))


def _group(name: str) -> str:
    if "/" in name:
        return name.rpartition("/")[0]
    kinds = {"FL": "Fluorescent Lamps", "HP": "Discharge Lamps", "LE": "LED Lamps", "IS": "ISO 7589"}
    return kinds.get(name[:2], "CIE Illuminants")


class RTB_OT_fill_from_library(DesignVerb, bpy.types.Operator):
    """A row for each of some spectra of the library"""

    bl_idname = "rtb.fill_from_library"
    bl_label = "From Library"

    group: bpy.props.EnumProperty(name="Library", items=_group_items, update=_unmark)
    marked: bpy.props.BoolVectorProperty(
        name="Spectra",
        description="Which spectra of the group are wanted, in its order",
        size=MOST,
        options={"SKIP_SAVE"},
    )
    names: bpy.props.StringProperty(
        name="Names",
        description="Names of the library between semicolons, for scripts",
        options={"SKIP_SAVE"},
    )
    fields = ("variable", "how", "group")
    width = 420  # of three columns of names with their curves [pixels at scale 1]

    def begin(self, context, variable):
        """Propose the group of what the active cell says now."""
        super().begin(context, variable)
        settings = context.scene.rtb
        for row in settings.conditions[settings.active_condition : settings.active_condition + 1]:
            for cell in row.cells[settings.active_variable : settings.active_variable + 1]:
                found = (group for group, names in _names_by_group().items() if cell.value in names)
                self.group = next(found, self.group)

    def draw(self, context):
        super().draw(context)
        self.layout.use_property_split = False
        flow = self.layout.grid_flow(row_major=True, columns=3, even_columns=True, align=True)
        names = _names_by_group()[self.group]
        for number, icon in enumerate(curve_previews.icons(names, shines=False)):
            text = names[number].rpartition("/")[2]
            flow.prop(self, "marked", index=number, text=text, icon_value=icon, toggle=True)

    def edit(self, context):
        from ..rtb_addon.spectra.library import find

        names = [each.strip() for each in self.names.split(";") if each.strip()]
        names = names or list(compress(_names_by_group()[self.group], self.marked))
        if not names:
            raise RecipeError("no spectrum is marked, click those that are wanted")
        for name in names:
            find(name, own_folders())
        return self.put(context, names, [each.rpartition("/")[2] for each in names], "SPECTRUM")
