"""What verbs on the mappings of a scene have in common."""

import bpy

from ..rtb_addon.errors import RecipeError
from .table_verbs import TableVerb


class MappingVerb(TableVerb):
    """A verb on one of the properties that conditions set."""

    bl_options = {"REGISTER", "UNDO", "INTERNAL"}
    edits_scene = True

    index: bpy.props.IntProperty(name="Mapping", description="Counted from 0", min=0, options={"SKIP_SAVE"})

    def mapping(self, context):
        """Return the mapping, or raise that there is none."""
        mappings = context.scene.rtb.mappings
        if self.index >= len(mappings):
            raise RecipeError(f"there is no mapping number {self.index + 1}, there are {len(mappings)}")
        return mappings[self.index]


class LineVerb(TableVerb):
    """A verb on a line of the written mappings."""

    bl_options = {"REGISTER", "UNDO", "INTERNAL"}

    line: bpy.props.IntProperty(name="Line", description="Counted from 1", min=1, options={"SKIP_SAVE"})
