"""Further folders of the user's own spectra: a list in the preferences, as Blender has of asset libraries."""

import bpy

from . import use_library_spectrum
from .preferred import preferences


class RTB_PG_spectra_folder(bpy.types.PropertyGroup):
    """A folder of spectra, also in folders within it."""

    path: bpy.props.StringProperty(
        name="Folder", subtype="DIR_PATH", update=lambda self, context: use_library_spectrum.forget()
    )


class RTB_OT_add_spectra_folder(bpy.types.Operator):
    """Add a folder of your own spectra to the library"""

    bl_idname = "rtb.add_spectra_folder"
    bl_label = "Add Folder of Spectra"
    bl_options = {"REGISTER", "INTERNAL"}

    directory: bpy.props.StringProperty(subtype="DIR_PATH", options={"SKIP_SAVE"})

    @classmethod
    def poll(cls, context):
        return preferences() is not None

    def invoke(self, context, event):
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def execute(self, context):
        _folders().add().path = self.directory
        context.preferences.is_dirty = True
        return {"FINISHED"}


class RTB_OT_remove_spectra_folder(bpy.types.Operator):
    """Take this folder out of the library; its files stay where they are"""

    bl_idname = "rtb.remove_spectra_folder"
    bl_label = "Remove Folder of Spectra"
    bl_options = {"REGISTER", "INTERNAL"}

    index: bpy.props.IntProperty(name="Index", min=0)

    @classmethod
    def poll(cls, context):
        return preferences() is not None and len(_folders()) > 0

    def execute(self, context):
        if self.index >= len(_folders()):
            self.report({"ERROR"}, f"There is no folder {self.index} in the list")
            return {"CANCELLED"}
        _folders().remove(self.index)
        context.preferences.is_dirty = True
        use_library_spectrum.forget()
        return {"FINISHED"}


def _folders():
    chosen = preferences()
    assert chosen is not None  # without it there are no buttons
    return chosen.spectra_folders


def draw_folders(layout, folders) -> None:
    """Draw the list, a folder a row."""
    row = layout.row()
    row.label(text="Further Folders of Spectra")
    row.operator(RTB_OT_add_spectra_folder.bl_idname, text="", icon="ADD")
    for number, each in enumerate(folders):
        row = layout.row(align=True)
        row.alert = not each.path
        row.prop(each, "path", text="")
        row.operator(RTB_OT_remove_spectra_folder.bl_idname, text="", icon="X").index = number
