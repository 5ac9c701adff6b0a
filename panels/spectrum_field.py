"""A spectrum, drawn alike wherever there is one: its text, the menu beside it, and its curve below."""

from ..rtb_addon.blender import curve_previews
from ..rtb_addon.blender.fields import FIELDS, typed_in
from .sentences import draw_sentences
from .spectrum_menus import draw_menu

UNIT = 20  # of Blender's layouts [pixels at scale 1]
BESIDE = 25  # what the borders of a region take [pixels at scale 1]
BORDER = 4  # that Blender leaves around a picture [pixels at scale 1]
SMALLEST, LARGEST = 6, 10  # curves [units]


def draw_spectrum(layout, context, group, field: str, text: str | None = None) -> None:
    """Draw a field with its curve; the active condition says what its variables are."""
    name = FIELDS[field].name
    row = layout.row(align=True)
    row.prop(group, name, **({} if text is None else {"text": text}))
    draw_menu(row, field)
    draw_curve(layout, context, typed_in(group, name, context.scene.rtb), FIELDS[field].shines)


def draw_curve(layout, context, text: str, shines: bool) -> None:
    """Draw the curve of a spectrum, or why there is none."""
    scale = context.preferences.system.ui_scale or 1.0  # 0 where there is no window
    units = min(max(int((context.region.width / scale - BESIDE) / UNIT), SMALLEST), LARGEST)
    found = curve_previews.shown(text, shines, round((units * UNIT - BORDER) * scale))
    draw_sentences(layout, [found.sentence] if found.sentence else [], context.region.width, alert=True)
    if not found.sentence:
        layout.template_icon(icon_value=found.icon, scale=units)
