"""A table from a file."""

from pathlib import Path

import bpy
from bpy_extras.io_utils import ImportHelper

from ..rtb_addon.blender.conditions import IMAGE_NAME
from ..rtb_addon.blender.table_texts import replace_table
from ..rtb_addon.errors import RecipeError, at
from ..rtb_addon.spreadsheets import parse_rows
from .table_verbs import TableVerb


class RTB_OT_import_conditions(TableVerb, bpy.types.Operator, ImportHelper):
    """Replace the table by that of a file: RenderToolbox3 conditions (.txt) or a spreadsheet (.tsv, .csv)"""

    bl_idname = "rtb.import_conditions"
    bl_label = "Import Conditions"

    filter_glob: bpy.props.StringProperty(default="*.txt;*.tsv;*.csv", options={"HIDDEN"})

    def edit(self, context):
        from ..rtb_addon.conditions import decoded  # brings numpy, which enabling need not wait for

        file = Path(bpy.path.abspath(self.filepath))
        try:
            text = decoded(file.read_bytes())
        except OSError as error:
            raise RecipeError(f"cannot read {file}: {error.strerror}") from error
        rows = _old_rows(text, file) if file.suffix.lower() == ".txt" else parse_rows(text)
        with at(file):
            replace_table(context.scene, rows)
        return f"{len(rows) - 1} conditions of {file.name}"


def _old_rows(text: str, file: Path) -> list[list[str]]:
    from ..rtb_addon.conditions import parse_conditions

    table = parse_conditions(text, file, file.stem)
    variables = [each for each in dict.fromkeys(table.variables) if each != IMAGE_NAME]
    return [[IMAGE_NAME, *variables], *([row.name, *(row.cells[v] for v in variables)] for row in table)]
