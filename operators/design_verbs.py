"""What verbs that fill the table with an experimental design have in common."""

import bpy

from ..rtb_addon.blender.table_texts import HOW, fill
from .table_verbs import TableVerb


class DesignVerb(TableVerb):
    """An operator with a dialog that puts values of a variable into the table."""

    width = 340  # of the dialog [pixels at scale 1]

    variable: bpy.props.StringProperty(
        name="Variable", description="The column that is filled; a new one if there is none of that name"
    )
    how: bpy.props.EnumProperty(name="Into", items=HOW)

    def invoke(self, context, event):
        settings = context.scene.rtb
        active = settings.variables[settings.active_variable : settings.active_variable + 1]
        self.begin(context, active[0].name if active else "variable")
        return context.window_manager.invoke_props_dialog(self, width=self.width, confirm_text="Fill In")

    def begin(self, context, variable: str) -> None:
        """Propose the active variable."""
        self.variable = variable

    def draw(self, context):
        self.layout.use_property_split = True
        self.layout.use_property_decorate = False
        for name in self.fields:
            self.layout.prop(self, name)

    def put(self, context, values: list[str], names: list[str] | None = None, kind: str = "") -> str:
        """Put values into the variable's column, of a type where it is a new one, and say how many."""
        name = self.variable.strip()
        rows = [[value] for value in values]
        fill(context.scene.rtb, [name], rows, names or named(name, rows), self.how, kind)
        return f"{len(values)} values of {name}"


def named(prefix: str, rows: list[list[str]]) -> list[str]:
    """Return a name for each row of a design: the variable's with a number."""
    return [f"{prefix}-{number:0{len(str(len(rows)))}}" for number in range(1, len(rows) + 1)]
