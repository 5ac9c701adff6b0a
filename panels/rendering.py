"""Image Editor > Sidebar > RenderToolbox: which renderings are shown, and how."""

import bpy

from ..operators import running, viewing
from ..operators.render_engine import ENGINE
from ..operators.show_montage import RTB_OT_show_montage
from ..operators.show_still import RTB_OT_show_still
from .numbers import draw_numbers, number
from .progress import draw_progress
from .sentences import draw_sentences


class RTB_PT_rendering(bpy.types.Panel):
    """The renderings of this scene's recipe"""

    bl_idname = "RTB_PT_rendering"
    bl_label = "Rendering"
    bl_space_type = "IMAGE_EDITOR"
    bl_region_type = "UI"
    bl_category = "RenderToolbox"

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        if running.batch is not None:
            draw_progress(layout, running.batch)
        if shows_render_result(context):
            layout.operator(RTB_OT_show_still.bl_idname, icon="RENDER_RESULT")
        if viewing.seen and not viewing.shows(context.scene):
            draw_sentences(layout, [f"The picture is of {viewing.seen['name']}"], context.region.width)
        if not viewing.shows(context.scene) and not viewing.sentence:
            layout.operator(RTB_OT_show_montage.bl_idname, icon="IMAGE_DATA")
            return
        draw_view(layout, context.window_manager.rtb_view)
        draw_sentences(
            layout, [viewing.sentence] if viewing.sentence else [], context.region.width, alert=True
        )


def shows_render_result(context) -> bool:
    """Whether the editor shows what Blender's own Render Image has rendered with our engine."""
    image = context.space_data.image
    return image is not None and image.type == "RENDER_RESULT" and context.scene.render.engine == ENGINE


def draw_view(layout, view) -> None:
    """Draw what is shown, and how."""
    layout.prop(view, "condition", placeholder="All")
    layout.prop(view, "kind")
    if view.kind == "wavelength":
        layout.prop(view, "wavelength", slider=True, text="Band (nm)")
    if view.kind == "difference":
        layout.prop(view, "other", text="To")
    column = layout.column(align=True)
    column.prop(view, "auto_scale")
    light = view.scale_name == "full_luminance"
    if not view.auto_scale:
        column.prop(view, view.scale_name, text="White (cd/m²)" if light else "White (W/…)")
    elif viewing.seen:
        unit = "cd/m²" if light else "W/(sr m² nm)"
        draw_numbers(column, [("White", f"{number(viewing.seen['full'])} {unit}")])
    layout.prop(view, "renderer")


class RTB_PT_montage(bpy.types.Panel):
    """How the renderings become one picture"""

    bl_idname = "RTB_PT_montage"
    bl_label = "Montage"
    bl_space_type = "IMAGE_EDITOR"
    bl_region_type = "UI"
    bl_category = "RenderToolbox"
    bl_parent_id = RTB_PT_rendering.bl_idname
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        self.layout.use_property_split = True
        self.layout.use_property_decorate = False
        column = self.layout.column(align=True)
        column.prop(context.scene.rtb, "montage_columns", text="Columns")
        column.prop(context.scene.rtb, "montage_fill", text="Order")
