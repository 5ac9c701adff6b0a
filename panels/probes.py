"""Image Editor > Sidebar > RenderToolbox: the pins of the spectrum probe."""

import bpy

from ..operators import pins
from ..operators.copy_pins import RTB_OT_copy_pins
from ..operators.export_pins import RTB_OT_export_pins
from ..operators.remove_pin import RTB_OT_remove_pin
from .numbers import draw_numbers, in_prefix, number
from .sentences import draw_sentences
from .spectrum_field import draw_curve


class RTB_UL_pins(bpy.types.UIList):
    """Pins: colour, number, where they lie, luminance"""

    bl_idname = "RTB_UL_pins"

    def draw_item(self, context, layout, owner, item, icon, active, active_property, index):
        row = layout.row(align=True)
        chip = row.row()
        chip.ui_units_x = 1.0
        chip.prop(item, "colour", text="")
        row.label(text=f"{item.number}   {item.name}")
        value = row.row()
        value.alignment = "RIGHT"
        value.label(text=number(pins.probe_of(item.words).luminance))


class RTB_PT_probes(bpy.types.Panel):
    """What the spectrum probe has measured"""

    bl_idname = "RTB_PT_probes"
    bl_label = "Probe"
    bl_space_type = "IMAGE_EDITOR"
    bl_region_type = "UI"
    bl_category = "RenderToolbox"

    def draw(self, context):
        layout = self.layout
        if pins.sentence:
            draw_sentences(layout, [pins.sentence], context.region.width, alert=True)
        window_manager = context.window_manager
        pin = pins.active(window_manager)
        if pin is None:
            draw_sentences(layout, [HINT], context.region.width)
            return
        draw_list(layout, window_manager)
        draw_pin(layout, context, pin)


HINT = "Choose the Spectrum Probe in the toolbar, then click a rendering or drag a box"


def draw_list(layout, window_manager) -> None:
    """Draw the pins, and what can be done with them."""
    row = layout.row()
    row.template_list("RTB_UL_pins", "", window_manager, "rtb_pins", window_manager, "rtb_active_pin", rows=4)
    column = row.column(align=True)
    column.operator(RTB_OT_remove_pin.bl_idname, text="", icon="REMOVE")
    column.operator(RTB_OT_remove_pin.bl_idname, text="", icon="TRASH").all = True
    row = layout.row(align=True)
    row.operator(RTB_OT_copy_pins.bl_idname, text="Copy as CSV", icon="COPYDOWN")
    row.operator(RTB_OT_export_pins.bl_idname, text="", icon="EXPORT")


def draw_pin(layout, context, pin) -> None:
    """Draw the spectrum of a pin and its numbers."""
    probe = pins.probe_of(pin.words)
    draw_curve(layout, context, spoken(probe), shines=True)
    draw_numbers(layout, measured(probe) + compared(context.window_manager, pin, probe))


def spoken(probe) -> str:
    """Return a probe's spectrum as it is typed; beside its bands there is nothing, and no end value."""
    inner = [
        f"{nm:g}:{max(value, 0):.6g}" for nm, value in zip(probe.wavelengths, probe.radiance, strict=True)
    ]
    return " ".join([f"{probe.wavelengths[0] - 1:g}:0", *inner, f"{probe.wavelengths[-1] + 1:g}:0"])


def measured(probe) -> list[tuple[str, str]]:
    """Return the numbers of a probe with their names."""
    error = f" ± {probe.luminance_error:.2g}" if probe.region.pixels > 1 else ""
    cones, prefix = in_prefix(probe.lms)
    return [
        ("Renderer", probe.renderer),
        ("Pixels", f"{probe.region.width} × {probe.region.height}"),
        ("Luminance", f"{number(probe.luminance)}{error} cd/m²"),
        ("CIE xy", f"{probe.xy[0]:.4f}  {probe.xy[1]:.4f}"),
        ("LMS", cones),
        ("", f"{prefix}W/(sr m²), CIE 2006 2°"),
    ]


def compared(window_manager, pin, probe) -> list[tuple[str, str]]:
    """Return how a pin differs from the one that it is compared to."""
    first = pins.compared_to(window_manager, pin)
    if first is None:
        return []
    found = pins.difference_of(first.words, pin.words)
    contrast = "  ".join(f"{100 * each:+.1f}" for each in found.cone_contrast)
    return [
        ("To", f"Pin {first.number}"),
        ("ΔE 2000", f"{found.delta_e:.2f}"),
        ("", f"white: D65, {number(pins.probe_of(first.words).white)} cd/m²"),
        ("LMS Contrast", f"{contrast} %"),
    ]
