"""The scale of a view: which colour of the picture stands for how much."""

from __future__ import annotations

from ..operators import viewing
from .numbers import number

WIDE, THICK, EDGE = 160, 12, 14  # [pixels at scale 1]
GROUND, INK = (0.07, 0.07, 0.07, 0.85), (1.0, 1.0, 1.0, 1.0)
STEPS = 64  # colours that it is drawn in
UNITS = {"luminance": "cd/m²"}  # of other views it is that of radiance
RADIANCE = "W/(sr m² nm)"


def draw(left: float, bottom: float) -> None:
    """Draw the scale, with its lower left corner beside a place [pixels], from 0 to the brightest."""
    from . import strokes

    unit = strokes.scale()
    left, bottom = left + EDGE * unit, bottom + (EDGE + 16) * unit
    words = title()
    right, top = left + max(WIDE * unit, strokes.width_of(words)), bottom + THICK * unit
    strokes.fill(left - 8 * unit, bottom - 22 * unit, right + 8 * unit, top + 22 * unit, GROUND)
    step = (right - left) / STEPS
    for place, colour in enumerate(colours()):
        strokes.fill(left + place * step, bottom, left + (place + 1) * step, top, colour)
    for share in (0.0, 0.5, 1.0):
        across = left + share * (right - left)
        strokes.words(number(share * viewing.seen["full"]), across, bottom - 14 * unit, INK, align=share)
    strokes.words(words, left, top + 7 * unit, INK)


def title() -> str:
    """Return what the scale is of, with its unit."""
    view = viewing.seen["view"]
    kind = view["kind"]
    if kind == "wavelength":
        nearest = min(viewing.seen["bands"], key=lambda nm: abs(nm - view["wavelength"]))
        return f"{nearest:g} nm  {RADIANCE}"
    what = {"difference": f"Difference to {viewing.seen['other']}", "error": "Standard Error"}
    return f"{what.get(kind, kind.capitalize())}  {UNITS.get(kind, RADIANCE)}"


def colours() -> list[tuple[float, ...]]:
    """Return the colours of the scale as the picture has them, from 0 on."""
    from ..rtb_addon.views import colours_of

    table = colours_of(viewing.seen["view"]["kind"])[:: 256 // STEPS]
    return [(*(part / 255 for part in colour), 1.0) for colour in table.tolist()]
