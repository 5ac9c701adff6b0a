"""What verbs on the table of conditions have in common."""

from ..rtb_addon.blender import preview
from ..rtb_addon.blender.redrawing import redraw_panels
from ..rtb_addon.errors import RecipeError
from . import scene_edits


class TableVerb:
    """An operator that edits a scene's table, or says in a sentence why it cannot and changes nothing."""

    bl_options = {"REGISTER", "UNDO"}
    edits_scene = False  # whether it is more than the table that it edits

    def execute(self, context):
        try:
            with preview.suspended():  # a thousand cells need not be shown one by one
                said = self.edit(context)
        except RecipeError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        if self.edits_scene:
            scene_edits.note()
        redraw_panels()
        if said:
            self.report({"INFO"}, said)
        return {"FINISHED"}


class RowVerb(TableVerb):
    """A verb on the active condition."""

    bl_options = {"REGISTER", "UNDO", "INTERNAL"}

    @classmethod
    def poll(cls, context):
        settings = context.scene.rtb
        there = settings.active_condition < len(settings.conditions)
        if not there:
            cls.poll_message_set("There is no condition yet: add one")
        return there


class ColumnVerb(TableVerb):
    """A verb on the active variable."""

    bl_options = {"REGISTER", "UNDO", "INTERNAL"}

    @classmethod
    def poll(cls, context):
        settings = context.scene.rtb
        there = settings.active_variable < len(settings.variables)
        if not there:
            cls.poll_message_set("There is no variable yet: add one")
        return there
