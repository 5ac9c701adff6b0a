"""A spectrum, drawn alike wherever there is one: its text, the menu beside it, and its curve below."""

from ..rtb_addon.blender import curve_previews
from ..rtb_addon.blender.fields import FIELDS, is_number, typed_in
from .sentences import LETTER, draw_sentences
from .spectrum_menus import draw_menu

BESIDE = 25  # what the borders of a region take [pixels at scale 1]
FIELD = 0.6  # of the width; the rest is for the label
SMALLEST, LARGEST = 6, 10  # curves [units]


def draw_spectrum(layout, context, group, field: str, text: str | None = None, flat: bool = True) -> str:
    """
    Draw a field with its curve, and return why there is none; the active condition says its variables.

    Parameters
    ----------
    flat : whether a spectrum that is one number has a curve as well
    """
    name = FIELDS[field].name
    label = group.bl_rna.properties[name].name if text is None else text
    row = layout.row(align=True)
    if label and is_cut(getattr(group, name), context):
        row = draw_below(layout, label)
        label = ""
    row.prop(group, name, text=label)
    draw_menu(row, field)
    said = typed_in(group, name, context.scene.rtb)
    if flat or not is_number(said):
        return draw_curve(layout, context, said, FIELDS[field].shines, swatch=not FIELDS[field].index)
    return ""


def draw_below(layout, label: str):
    """Draw a label, and return a row below it as wide as the panel."""
    column = layout.column(align=True)
    column.use_property_split = False
    column.label(text=label)
    return column.row(align=True)


def is_cut(text: str, context) -> bool:
    """Whether a text is longer than what a field shows that stands beside its label."""
    scale = context.preferences.system.ui_scale or 1.0  # 0 where there is no window
    room = (context.region.width / scale - BESIDE) * FIELD - curve_previews.UNIT
    return len(text) * LETTER > room


def draw_curve(layout, context, text: str, shines: bool, swatch: bool = True) -> str:
    """Draw a curve, or why there is none, which is returned; an index has no colour, and so no swatch."""
    scale = context.preferences.system.ui_scale or 1.0  # 0 where there is no window
    units = min(max(int((context.region.width / scale - BESIDE) / curve_previews.UNIT), SMALLEST), LARGEST)
    under = context.scene.rtb.seen_under if swatch else ""
    found = curve_previews.shown(text, shines, curve_previews.side_of(units, context), under)
    draw_sentences(layout, [found.sentence] if found.sentence else [], context.region.width, alert=True)
    if not found.sentence:
        layout.template_icon(icon_value=found.icon, scale=units)
    return found.sentence
