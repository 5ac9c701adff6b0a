"""Write the pins to a file."""

from pathlib import Path

import bpy
from bpy_extras.io_utils import ExportHelper

from ..rtb_addon.errors import RecipeError
from . import findings, pins


class RTB_OT_export_pins(bpy.types.Operator, ExportHelper):
    """Write all pins to a CSV file: what they are, then a row for each wavelength"""

    bl_idname = "rtb.export_pins"
    bl_label = "Export Pins"
    bl_options = {"REGISTER"}
    filename_ext = ".csv"

    filter_glob: bpy.props.StringProperty(default="*.csv", options={"HIDDEN"})

    @classmethod
    def poll(cls, context):
        return len(context.window_manager.rtb_pins) > 0

    def execute(self, context):
        try:
            pins.write_table(context.window_manager.rtb_pins, Path(bpy.path.abspath(self.filepath)))
        except RecipeError as error:
            return findings.refuse(self, error)
        self.report({"INFO"}, f"Pins written to {self.filepath}")
        return {"FINISHED"}
