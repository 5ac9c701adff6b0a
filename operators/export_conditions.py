"""The table as a file."""

from pathlib import Path

import bpy
from bpy_extras.io_utils import ExportHelper

from ..rtb_addon.blender.table_texts import table_rows
from ..rtb_addon.errors import RecipeError
from ..rtb_addon.spreadsheets import format_rows


class RTB_OT_export_conditions(bpy.types.Operator, ExportHelper):
    """Write the table to a file that spreadsheets open"""

    bl_idname = "rtb.export_conditions"
    bl_label = "Export Conditions"
    bl_options = {"REGISTER"}

    filename_ext = ".tsv"
    check_extension = None  # .csv is as good
    filter_glob: bpy.props.StringProperty(default="*.txt;*.tsv;*.csv", options={"HIDDEN"})

    def execute(self, context):
        from ..rtb_addon.files import write_text  # enabling need not wait for it

        file = Path(bpy.path.abspath(self.filepath))
        separator = "," if file.suffix.lower() == ".csv" else "\t"
        try:
            write_text(file, format_rows(table_rows(context.scene.rtb), separator))
        except RecipeError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        self.report({"INFO"}, f"Conditions written to {file}")
        return {"FINISHED"}
