"""3D Viewport > Sidebar > RenderToolbox: the recipe, how it is rendered, and what came of it."""

import bpy

from ..operators import findings, running
from ..operators.export_recipe import RTB_OT_export_recipe
from ..operators.render_recipe import RTB_OT_render_recipe
from ..operators.show_montage import RTB_OT_show_montage
from ..rtb_addon.blender.folders import recipe_name
from .progress import draw_progress
from .sentences import draw_sentences


class RTB_PT_recipe(bpy.types.Panel):
    """The recipe of this scene"""

    bl_idname = "RTB_PT_recipe"
    bl_label = "Recipe"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "RenderToolbox"

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        draw_options(layout, context.scene)
        layout.separator()
        draw_run(layout)
        width = context.region.width
        draw_sentences(layout, findings.errors, width, alert=True)
        draw_sentences(layout, findings.remarks, width)


def draw_options(layout, scene) -> None:
    """Draw where the recipe goes and how it is rendered."""
    settings = scene.rtb
    layout.prop(settings, "name", placeholder=recipe_name(scene))
    layout.prop(settings, "folder")
    layout.prop(settings, "renderer")
    column = layout.column(align=True)
    column.prop(scene.render, "resolution_x", text="Width")
    column.prop(scene.render, "resolution_y", text="Height")
    column.prop(scene.render, "resolution_percentage", text="%")
    layout.prop(settings, "samples")


def draw_run(layout) -> None:
    """Draw what the user can do, or how far it is."""
    if running.batch is not None:
        draw_progress(layout, running.batch)
    else:
        row = layout.row()
        row.scale_y = 1.5
        row.operator(RTB_OT_render_recipe.bl_idname, icon="RENDER_STILL")
    column = layout.column(align=True)
    column.operator(RTB_OT_show_montage.bl_idname, icon="IMAGE_DATA")
    column.operator(RTB_OT_export_recipe.bl_idname, icon="EXPORT")


class Details:
    """A closed part of the recipe's panel."""

    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "RenderToolbox"
    bl_parent_id = RTB_PT_recipe.bl_idname
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        self.layout.use_property_split = True
        self.layout.use_property_decorate = False
        for names in self.properties:
            column = self.layout.column(align=True)
            for name in names:
                column.prop(context.scene.rtb, name)


class RTB_PT_light_paths(Details, bpy.types.Panel):
    """How far light is followed, and in which bands"""

    bl_idname = "RTB_PT_light_paths"
    bl_label = "Light Paths and Bands"
    properties = (("integrator", "depth"), ("seed",), ("bands_start", "bands_step", "bands_count"))


class RTB_PT_montage(Details, bpy.types.Panel):
    """How the renderings become one picture"""

    bl_idname = "RTB_PT_montage"
    bl_label = "Montage"
    properties = (("montage_columns", "montage_fill"),)
