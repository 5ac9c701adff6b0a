"""Render one condition of a scene's recipe."""

import bpy

from . import row_states
from .render_recipe import RenderVerb


class RTB_OT_render_condition(RenderVerb, bpy.types.Operator):
    """Write the recipe and render one condition, the active one unless another is named"""

    bl_idname = "rtb.render_condition"
    bl_label = "Render Condition"
    bl_options = {"REGISTER"}

    condition: bpy.props.StringProperty(
        name="Condition", description="Its name; empty for the active one", options={"SKIP_SAVE"}
    )

    def chosen(self, context):
        settings = context.scene.rtb
        if self.condition or settings.active_condition >= len(settings.conditions):
            return [self.condition] if self.condition else []
        row = settings.conditions[settings.active_condition]
        return [row_states.row_name(context.scene, row, settings.active_condition)]
