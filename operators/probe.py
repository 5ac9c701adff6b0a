"""Probe a pixel or a box of a rendering and keep that as a pin."""

import bpy
from bpy.props import BoolProperty, IntVectorProperty, StringProperty

from . import findings, pins, viewing
from .picture_places import pixel_at, pixel_within


class RTB_OT_probe(bpy.types.Operator):
    """Measure a pixel by a click or a box by dragging it; with Shift compared to the active pin"""

    bl_idname = "rtb.probe"
    bl_label = "Probe Spectrum"
    bl_options = {"REGISTER"}

    condition: StringProperty(name="Condition", options={"SKIP_SAVE"})
    region: IntVectorProperty(
        name="Region",
        description="Left, top, width and height, counted from the upper left pixel",
        size=4,
        default=(0, 0, 1, 1),
        options={"SKIP_SAVE"},
    )
    compare: BoolProperty(name="Compare", description="Compare it to the active pin", options={"SKIP_SAVE"})

    def execute(self, context):
        self._ask(context, (self.condition, tuple(self.region)))
        viewing.wait()
        if pins.sentence:
            return findings.refuse(self, RuntimeError(pins.sentence))
        return {"FINISHED"}

    def invoke(self, context, event):
        if (first := pixel_at(context, event.mouse_region_x, event.mouse_region_y)) is None:
            return {"PASS_THROUGH"}
        self.first = first
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type == "MOUSEMOVE":
            pins.hover(self._dragged(context, event))
        elif event.type == "LEFTMOUSE" and event.value == "RELEASE":
            self.condition, self.region = place = self._dragged(context, event)
            pins.hover(None)
            self._ask(context, place)
            return {"FINISHED"}
        elif event.type in {"ESC", "RIGHTMOUSE"}:
            pins.hover(None)
            return {"CANCELLED"}
        return {"RUNNING_MODAL"}

    def _dragged(self, context, event) -> pins.Place:
        """Return the box between where the button was pressed and the pointer."""
        from ..rtb_addon.probing import Region

        condition, column, row = self.first
        end = pixel_within(context, condition, event.mouse_region_x, event.mouse_region_y)
        return condition, tuple(Region.between((column, row), end))

    def _ask(self, context, place: pins.Place) -> None:
        compare = self.compare  # the operator is gone when the answer comes
        pins.ask(context.scene, place, lambda probe, folder: pins.add(probe, folder, compare))
