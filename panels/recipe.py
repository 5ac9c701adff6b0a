"""3D Viewport > Sidebar > RenderToolbox: the recipe, how it is rendered, and what came of it."""

import bpy

from ..operators import findings, reading, running
from ..operators.check_recipe import RTB_OT_check_recipe
from ..operators.compare_renderers import RTB_OT_compare_renderers
from ..operators.open_folder import RTB_OT_open_folder
from ..operators.pack_recipe import RTB_OT_pack_recipe
from ..operators.render_condition import RTB_OT_render_condition
from ..operators.render_recipe import RTB_OT_render_recipe
from ..operators.select_culprit import RTB_OT_select_culprit
from ..operators.show_montage import RTB_OT_show_montage
from ..rtb_addon.blender.folders import recipe_name
from .progress import draw_progress, draw_under_way, draw_verbs
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
        draw_verbs(layout)
        if findings.is_about(context.scene):
            width = context.region.width
            draw_sentences(layout, findings.errors, width, alert=True, beside=draw_culprit)
            draw_sentences(layout, findings.remarks, width, beside=draw_culprit)


def draw_options(layout, scene) -> None:
    """Draw what the recipe is called and where it goes."""
    settings = scene.rtb
    layout.prop(settings, "name", placeholder=recipe_name(scene))
    layout.prop(settings, "folder")


def draw_run(layout) -> None:
    """Draw what the user can do, or how far it is."""
    if running.batch is not None:
        draw_progress(layout, running.batch)
        draw_under_way(layout, running.batch)
    elif reading.now is not None:
        layout.progress(factor=reading.now.share, type="BAR", text="Reading the Scene…")
    else:
        row = layout.row()
        row.scale_y = 1.5
        row.operator(RTB_OT_render_recipe.bl_idname, icon="RENDER_STILL")
    grid = layout.grid_flow(row_major=True, columns=2, even_columns=True, align=True)
    grid.operator(RTB_OT_render_condition.bl_idname)
    grid.operator(RTB_OT_check_recipe.bl_idname)
    grid.operator(RTB_OT_show_montage.bl_idname)
    grid.operator_context = "INVOKE_DEFAULT"
    grid.operator(RTB_OT_compare_renderers.bl_idname, text="Compare…")
    grid.operator(RTB_OT_open_folder.bl_idname)
    grid.operator(RTB_OT_pack_recipe.bl_idname, text="Pack…")


def draw_culprit(layout, sentence: str) -> None:
    """Draw the button that selects what a sentence speaks of, where it names something."""
    culprit = findings.culprits.get(sentence)
    if culprit is not None:
        button = layout.operator(
            RTB_OT_select_culprit.bl_idname, text="", icon="RESTRICT_SELECT_OFF", emboss=False
        )
        button.kind, button.name = culprit.kind.upper(), culprit.name
