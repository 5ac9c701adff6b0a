"""Another line of the written mappings."""

import bpy

from .mapping_verbs import LineVerb


class RTB_OT_edit_mapping_line(LineVerb, bpy.types.Operator):
    """Change this line of the written mappings"""

    bl_idname = "rtb.edit_mapping_line"
    bl_label = "Edit Line"

    text: bpy.props.StringProperty(name="Line", description="As the mappings' text will have it")

    def invoke(self, context, event):
        from ..rtb_addon.blender import written_mappings  # enabling need not wait for it

        lines, _ = written_mappings.written_lines(context.scene)
        self.text = next((each.text for each in lines if each.line == self.line), "")
        return context.window_manager.invoke_props_dialog(self, width=420, confirm_text="Change")

    def draw(self, context):
        self.layout.prop(self, "text", text="")

    def edit(self, context):
        from ..rtb_addon.blender import written_mappings

        written_mappings.rewrite(context.scene, self.line, self.text)
