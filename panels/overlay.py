"""Over the Image Editor: the scale of false colours, pins, and the plate of the probe."""

from __future__ import annotations

import bpy

from ..operators import pins, viewing
from ..operators.picture_places import box_of, shows_renderings

WHITE = (1.0, 1.0, 1.0)
BAR, THICK, EDGE = 160, 12, 14  # of the scale [pixels at scale 1]
NAMES = {"wavelength": "W/(sr m² nm)", "luminance": "cd/m²", "difference": "W/(sr m² nm)"}

_handler = None


def draw() -> None:
    """Draw what lies over the picture; Blender calls this for each Image Editor."""
    context = bpy.context
    if not shows_renderings(context):
        return
    view = viewing.seen["view"]
    if view["kind"] in NAMES:
        draw_scale(context, view["kind"])
    for pin in context.window_manager.rtb_pins:
        draw_pin(context, pin)
    if pins.under is not None and pins.under[1][2:] != (1, 1):
        draw_box(context, pins.under, (*WHITE, 0.9))


def draw_scale(context, kind: str) -> None:
    """Draw the scale of a view at the lower left corner: from 0 to what the last colour stands for."""
    from . import strokes

    unit = strokes.scale()
    left, bottom, *_ = room(context)
    left, bottom = left + EDGE * unit, bottom + (EDGE + 16) * unit
    right, top = left + BAR * unit, bottom + THICK * unit
    strokes.fill(
        left - 8 * unit, bottom - 22 * unit, right + 8 * unit, top + 22 * unit, (0.07, 0.07, 0.07, 0.85)
    )
    colours = _greys() if kind == "wavelength" else _false_colours()
    step = (right - left) / len(colours)
    for place, colour in enumerate(colours):
        strokes.fill(left + place * step, bottom, left + (place + 1) * step, top, colour)
    ink, full = (*WHITE, 1.0), viewing.seen["full"]
    for share, align in ((0.0, 0.0), (0.5, 0.5), (1.0, 1.0)):
        strokes.words(f"{share * full:.3g}", left + share * (right - left), bottom - 14 * unit, ink, align)
    strokes.words(f"{_title(kind)} {NAMES[kind]}", left, top + 7 * unit, ink)


def draw_pin(context, pin) -> None:
    """Draw where a pin lies, in its colour, with its number."""
    from . import strokes

    probe = pins.probe_of(pin.words)
    if probe.condition not in viewing.seen["there"]:
        return
    colour = (*pin.colour, 1.0)
    right, top = draw_box(context, (probe.condition, tuple(probe.region)), colour)
    strokes.words(str(pin.number), right + 4 * strokes.scale(), top - 4 * strokes.scale(), colour)


def draw_box(context, place: pins.Place, colour) -> tuple[float, float]:
    """Draw the edge of a region, at least as large as can be seen, and return its upper right corner."""
    from ..rtb_addon.probing import Region
    from . import strokes

    left, bottom, right, top = box_of(context.region, place[0], Region(*place[1]))
    grow = max(3 * strokes.scale() - min(right - left, top - bottom) / 2, 0)
    box = left - grow, bottom - grow, right + grow, top + grow
    strokes.frame(*box, (0.0, 0.0, 0.0, 0.6), 3.0)
    strokes.frame(*box, colour, 1.5)
    return box[2], box[3]


def draw_plate(context, x: float, y: float) -> None:
    """Draw the plate of the probe beside the pointer, in the coordinates of the window."""
    from . import plate

    probe = pins.hovered
    if probe is None or not shows_renderings(context):
        return
    pin = pins.active(context.window_manager)
    curves, difference, first = [(probe, WHITE)], None, ""
    if pin is not None:
        curves.append((pins.probe_of(pin.words), tuple(pin.colour)))
        difference, first = _difference(pin, probe), f"pin {pin.number}"
    region, (left, bottom, right, top) = context.region, room(context)
    inside = left + region.x, bottom + region.y, right + region.x, top + region.y
    plate.draw(x, y, inside, _where(probe), curves, plate.numbers(probe, difference, first))


def room(context) -> tuple[float, float, float, float]:
    """Return left, bottom, right and top of what other regions leave free of the picture [pixels]."""
    window = context.region
    left, bottom, right, top = 0.0, 0.0, float(window.width), float(window.height)
    for region in context.area.regions:
        if region.width <= 1 or region.height <= 1:
            continue
        if region.type == "UI":
            right = min(right, region.x - window.x)
        elif region.type == "TOOLS":
            left = max(left, region.x + region.width - window.x)
        elif region.type in {"HEADER", "TOOL_HEADER"} and region.y > window.y + window.height / 2:
            top = min(top, region.y - window.y)
        elif region.type == "HEADER":
            bottom = max(bottom, region.y + region.height - window.y)
    return left, bottom, right, top


def _difference(pin, probe):
    from ..rtb_addon.probing import difference

    return difference(pins.probe_of(pin.words), probe)


def _where(probe) -> str:
    left, top, width, height = probe.region
    return f"{probe.condition}  {left}, {top}" + (f"  {width} × {height}" if probe.region.pixels > 1 else "")


def _title(kind: str) -> str:
    if kind != "wavelength":
        return kind.capitalize()
    nearest = min(viewing.seen["bands"], key=lambda nm: abs(nm - viewing.seen["view"]["wavelength"]))
    return f"{nearest:g} nm"


def _greys():
    return [(level, level, level, 1.0) for level in (share / 63 for share in range(64))]


def _false_colours():
    from ..rtb_addon.views import false_colours

    return [(*(part / 255 for part in colour), 1.0) for colour in false_colours()[::4].tolist()]


def register() -> None:
    """Draw over Image Editors from now on."""
    global _handler
    _handler = bpy.types.SpaceImageEditor.draw_handler_add(draw, (), "WINDOW", "POST_PIXEL")


def unregister() -> None:
    """Draw no more."""
    bpy.types.SpaceImageEditor.draw_handler_remove(_handler, "WINDOW")
