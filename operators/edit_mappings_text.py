"""The written mappings in the Text Editor."""

import bpy


class RTB_OT_edit_mappings_text(bpy.types.Operator):
    """Write mappings in the words of RenderToolbox3 in the Text Editor; what stands there counts at once"""

    bl_idname = "rtb.edit_mappings_text"
    bl_label = "Edit as Text"
    bl_options = {"REGISTER", "UNDO"}

    line: bpy.props.IntProperty(
        name="Line", description="To show, from 1", default=1, min=1, options={"SKIP_SAVE"}
    )

    def execute(self, context):
        from ..rtb_addon.blender import written_mappings  # enabling need not wait for it

        text = written_mappings.text_for(context.scene)
        text.cursor_set(min(self.line, len(text.lines)) - 1)
        if not bpy.app.background and context.window is not None:
            show(context, text)
        return {"FINISHED"}


def show(context, text) -> None:
    """Show a text in a Text Editor, one below the largest 3D Viewport where none is open."""
    areas = list(context.window.screen.areas)
    editors = [each for each in areas if each.type == "TEXT_EDITOR"]
    if not editors:
        viewports = [each for each in areas if each.type == "VIEW_3D"]
        widest = max(viewports or areas, key=lambda each: each.width * each.height)
        before = {each.as_pointer() for each in areas}
        with context.temp_override(window=context.window, area=widest):
            bpy.ops.screen.area_split(direction="HORIZONTAL", factor=0.4)
        editors = [each for each in context.window.screen.areas if each.as_pointer() not in before]
        editors[0].type = "TEXT_EDITOR"
    editors[0].spaces.active.text = text
