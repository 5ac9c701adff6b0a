"""3D Viewport > Sidebar > RenderToolbox: what conditions change in the scene, as sentences."""

from __future__ import annotations

from typing import TYPE_CHECKING

import bpy

from ..operators.edit_mapping import RTB_OT_edit_mapping
from ..operators.edit_mapping_line import RTB_OT_edit_mapping_line
from ..operators.edit_mappings_text import RTB_OT_edit_mappings_text
from ..operators.remove_mapping import RTB_OT_remove_mapping
from ..operators.remove_mapping_line import RTB_OT_remove_mapping_line
from .sentences import draw_sentence

if TYPE_CHECKING:
    from ..rtb_addon.blender.mapping_sentences import Line, Spectral

BUTTONS = 30  # by how much two small buttons shorten a sentence beside them [pixels at scale 1]
EQUALS = "\N{NO-BREAK SPACE}="  # stays on the line of the last word


class RTB_PT_mappings(bpy.types.Panel):
    """What conditions change in the scene"""

    bl_idname = "RTB_PT_mappings"
    bl_label = "Mappings"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "RenderToolbox"

    def draw(self, context):
        # Enabling the extension need not wait for it.
        from ..rtb_addon.blender import mapping_sentences as words

        layout, scene, width = self.layout, context.scene, context.region.width
        layout.use_property_decorate = False
        spectra, lines = words.spectra_that_vary(scene), words.written(scene)
        if not (spectra or len(scene.rtb.mappings) or lines.lines or lines.problem):
            draw_sentence(layout, "Right-click a property: Vary in Recipe", width, "INFO")
        for each in spectra:
            draw_spectrum_mapping(layout, each, width)
        for index, mapping in enumerate(scene.rtb.mappings):
            draw_property_mapping(layout, scene, mapping, index, width)
        for line in lines.lines:
            draw_line(layout, line, width)
        if lines.problem:
            layout.alert = True
            draw_sentence(layout, lines.problem, width, "ERROR")
            layout.alert = False
        layout.operator(RTB_OT_edit_mappings_text.bl_idname, icon="TEXT")


def draw_spectrum_mapping(layout, mapping: Spectral, width: int) -> None:
    """Draw a spectrum that names variables, with the field that says so."""
    column = layout.column(align=True)
    column.alert = bool(mapping.missing)
    draw_sentence(column, f"{mapping.subject}{EQUALS}", width, "ERROR" if mapping.missing else mapping.icon)
    column.prop(mapping.group, mapping.name, text="")
    draw_missing(column, mapping.missing, width)


def draw_property_mapping(layout, scene, mapping, index: int, width: int) -> None:
    """Draw a property that conditions set, with its value and what can be done with it."""
    from ..rtb_addon.blender import mapping_sentences as words

    missing = words.missing(scene, mapping)
    column = layout.column(align=True)
    column.alert = bool(missing)
    draw_sentence(
        column, f"{mapping.name}{EQUALS}", width, "ERROR" if missing else words.icon_of(mapping.thing)
    )
    row = column.row(align=True)
    row.prop(mapping, "value", text="")
    row.operator_context = "INVOKE_DEFAULT"
    row.operator(RTB_OT_edit_mapping.bl_idname, text="", icon="GREASEPENCIL").index = index
    row.operator(RTB_OT_remove_mapping.bl_idname, text="", icon="X").index = index
    draw_missing(column, missing, width)


def draw_line(layout, line: Line, width: int) -> None:
    """Draw a line of the written mappings: a sentence where it has one, with its renderer's badge."""
    row = layout.row(align=True)
    row.alert = bool(line.missing)
    column = row.column(align=True)
    draw_sentence(column, line.sentence, width - BUTTONS, "ERROR" if line.missing else line.icon)
    draw_missing(column, line.missing, width - BUTTONS)
    row.operator_context = "INVOKE_DEFAULT"
    row.operator(RTB_OT_edit_mapping_line.bl_idname, text="", icon="GREASEPENCIL").line = line.number
    row.operator(RTB_OT_remove_mapping_line.bl_idname, text="", icon="X").line = line.number


def draw_missing(layout, missing: str, width: int) -> None:
    """Draw what is missing, if anything."""
    if missing:
        draw_sentence(layout, missing, width, "BLANK1")
