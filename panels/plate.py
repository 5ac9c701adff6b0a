"""The plate beside the pointer: a spectrum with its axes, and what observers make of it below."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from . import strokes
from .numbers import in_prefix, number

if TYPE_CHECKING:
    from ..rtb_addon.probing import Difference, Probe

WIDTH, ROW, EDGE = 220, 16, 8  # [pixels at scale 1]
PLOT = 92  # height of the axes [pixels at scale 1]
LEFT = 52  # room for the numbers beside them [pixels at scale 1]
BESIDE = 18  # from the pointer [pixels at scale 1]
GROUND, INK, FAINT = (0.07, 0.07, 0.07, 0.9), (0.92, 0.92, 0.92, 1.0), (0.92, 0.92, 0.92, 0.22)
UNIT = "W/(sr m² nm)"
STEP = 100  # between two wavelengths that are written [nm]
Curve = tuple["Probe", Sequence[float]]


def numbers(probe: Probe, difference: Difference | None, first: str) -> list[str]:
    """Return what is written below the curve."""
    error = f" ± {probe.luminance_error:.2g}" if probe.region.pixels > 1 else ""
    cones, prefix = in_prefix(probe.lms)
    rows = [
        f"L {number(probe.luminance)}{error} cd/m²",
        f"xy {probe.xy[0]:.3f} {probe.xy[1]:.3f}",
        f"LMS {cones} {prefix}W/(sr m²)",
    ]
    if difference is not None:
        contrast = " ".join(f"{100 * each:+.0f}" for each in difference.cone_contrast)
        rows += [f"ΔE {difference.delta_e:.1f} to {first}", f"LMS contrast {contrast} %"]
    return rows


def draw(
    x: float, y: float, room: Sequence[float], title: str, curves: Sequence[Curve], rows: Sequence[str]
) -> None:
    """
    Draw a plate beside a place, inside of what room there is.

    Parameters
    ----------
    x, y : of the pointer
    room : left, bottom, right and top of what the plate may cover
    curves : with their colours, the first one on top
    """
    unit = strokes.scale()
    width, edge, step = min(WIDTH * unit, room[2] - room[0]), EDGE * unit, ROW * unit
    inside = width - 2 * edge
    head = [strokes.shortened(title, inside), strokes.shortened(UNIT, inside)]
    foot = [line for row in rows for line in strokes.broken(row, inside)]
    height = PLOT * unit + (len(head) + len(foot) + 1.6) * step + 2 * edge
    left, bottom = _corner(x, y, room, width, height, BESIDE * unit)
    top = bottom + height
    strokes.fill(left, bottom, left + width, top, GROUND)
    for place, row in enumerate(head):
        strokes.words(row, left + edge, top - edge - (0.7 + place) * step, INK)
    for place, row in enumerate(foot):
        strokes.words(row, left + edge, bottom + edge + (len(foot) - 1 - place) * step, INK)
    low = bottom + edge + (len(foot) + 1) * step
    _draw_plot((left + LEFT * unit, low, left + width - edge, low + PLOT * unit), curves)


def _corner(
    x: float, y: float, room: Sequence[float], width: float, height: float, beside: float
) -> tuple[float, float]:
    """Return the lower left corner: right above the pointer, else on the sides where there is room."""
    left = x + beside if x + beside + width <= room[2] else x - beside - width
    bottom = y + beside if y + beside + height <= room[3] else y - beside - height
    return max(min(left, room[2] - width), room[0]), max(min(bottom, room[3] - height), room[1])


def _draw_plot(box: Sequence[float], curves: Sequence[Curve]) -> None:
    """Draw axes with their numbers, and the curves between them."""
    from ..rtb_addon.curves import nice_above

    left, bottom, right, top = box
    unit = strokes.scale()
    low = min(min(probe.wavelengths) for probe, _ in curves)
    high = max(max(probe.wavelengths) for probe, _ in curves)
    span = max(high - low, 1.0)
    full = nice_above(max(max(probe.radiance) for probe, _ in curves))

    def place(nm: float, value: float) -> tuple[float, float]:
        return left + (nm - low) / span * (right - left), bottom + value / full * (top - bottom)

    for nm in range(int(-(-low // STEP) * STEP), int(high) + 1, STEP):
        across = place(nm, 0)[0]
        strokes.line(((across, bottom), (across, top)), FAINT)
        strokes.words(str(nm), across, bottom - 14 * unit, INK, align=0.5 if nm + STEP <= high else 0.8)
    strokes.words("nm", left - 20 * unit, bottom - 14 * unit, INK, align=1.0)
    for share in (0.0, 0.5, 1.0):
        height = bottom + share * (top - bottom)
        strokes.line(((left, height), (right, height)), FAINT)
        strokes.words(number(share * full), left - 5 * unit, height - 4 * unit, INK, align=1.0)
    for probe, colour in reversed(curves):
        _draw_band(probe, place, colour)
        points = [
            place(nm, max(value, 0)) for nm, value in zip(probe.wavelengths, probe.radiance, strict=True)
        ]
        strokes.line(points, (*colour[:3], 1.0), 1.6)


def _draw_band(probe: Probe, place, colour: Sequence[float]) -> None:
    """Draw how far the standard error reaches, where there is one."""
    values = zip(probe.wavelengths, probe.radiance, probe.standard_error, strict=True)
    for nm, value, error in values:
        if error > 0:
            strokes.line((place(nm, max(value - error, 0)), place(nm, value + error)), (*colour[:3], 0.6))
