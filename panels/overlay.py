"""Over the Image Editor: names, the scale of false colours, pins, and the plate of the probe."""

from __future__ import annotations

import bpy

from ..operators import pins, viewing
from ..operators.picture_places import Box, box_of, shows_renderings
from . import captions, colour_bar

WHITE = (1.0, 1.0, 1.0)

_handler = None


def draw() -> None:
    """Draw what lies over the picture; Blender calls this for each Image Editor."""
    context = bpy.context
    if not shows_renderings(context) or not context.space_data.overlay.show_overlays:
        return
    captions.draw(context)
    if viewing.seen["view"]["kind"] != "srgb":
        colour_bar.draw(*room(context)[:2])
    for pin in context.window_manager.rtb_pins:
        draw_pin(context, pin)
    if pins.under is not None and pins.under[1][2:] != (1, 1):
        draw_box(context, pins.under, (*WHITE, 0.9))


def draw_pin(context, pin) -> None:
    """Draw where a pin lies, in its colour, with its number, if the picture shows what it has measured."""
    from . import strokes

    if not pins.is_seen(pin):
        return
    probe, colour = pins.probe_of(pin.words), (*pin.colour, 1.0)
    box = draw_box(context, (probe.condition, tuple(probe.region)), colour)
    if box is not None:
        strokes.words(str(pin.number), box[2] + 4 * strokes.scale(), box[3] - 4 * strokes.scale(), colour)


def draw_box(context, place: pins.Place, colour) -> Box | None:
    """Draw the edge of a region, at least as large as can be seen, and return it."""
    from ..rtb_addon.probing import Region
    from . import strokes

    if (found := box_of(context.region, place[0], Region(*place[1]))) is None:
        return None
    left, bottom, right, top = found
    grow = max(3 * strokes.scale() - min(right - left, top - bottom) / 2, 0)
    box = left - grow, bottom - grow, right + grow, top + grow
    strokes.frame(*box, (0.0, 0.0, 0.0, 0.6), 3.0)
    strokes.frame(*box, colour, 1.5)
    return box


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


def register() -> None:
    """Draw over Image Editors from now on."""
    global _handler
    _handler = bpy.types.SpaceImageEditor.draw_handler_add(draw, (), "WINDOW", "POST_PIXEL")


def unregister() -> None:
    """Draw no more."""
    bpy.types.SpaceImageEditor.draw_handler_remove(_handler, "WINDOW")
