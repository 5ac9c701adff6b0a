"""Spectra from files into the user's library: by a file browser, or dropped on a window."""

from pathlib import Path

import bpy
from bpy_extras.io_utils import ImportHelper

from ..rtb_addon.blender import curve_previews
from ..rtb_addon.blender.own_spectra import folder_for_imports
from ..rtb_addon.errors import RecipeError
from . import fill_from_library, use_library_spectrum

ENDINGS = ".spd;.csv;.tsv;.mat"


class RTB_OT_import_spectra(bpy.types.Operator, ImportHelper):
    """Take spectra into your library: pairs (.spd), tables (.csv), the Psychophysics Toolbox's (.mat)"""

    bl_idname = "rtb.import_spectra"
    bl_label = "Import Spectra"
    bl_options = {"REGISTER"}

    filter_glob: bpy.props.StringProperty(default=ENDINGS.replace(".", "*."), options={"HIDDEN"})
    files: bpy.props.CollectionProperty(
        type=bpy.types.OperatorFileListElement, options={"HIDDEN", "SKIP_SAVE"}
    )
    directory: bpy.props.StringProperty(subtype="DIR_PATH", options={"HIDDEN", "SKIP_SAVE"})

    def invoke(self, context, event):
        if self.directory and self.files:  # dropped
            return self.execute(context)
        return super().invoke(context, event)

    def execute(self, context):
        # This brings numpy, which enabling need not wait for.
        from ..rtb_addon.spectra.files import write_spd
        from ..rtb_addon.spectra.imports import read_spectra

        chosen = [Path(self.directory) / each.name for each in self.files if each.name]
        chosen = chosen or [Path(bpy.path.abspath(self.filepath))]
        try:
            found = [(file, read_spectra(file)) for file in chosen]
            count = 0
            for file, spectra in found:
                for name, spectrum in spectra.items():
                    folder = folder_for_imports() / (file.stem if len(spectra) > 1 else "")
                    folder.mkdir(parents=True, exist_ok=True)
                    write_spd(folder / f"{name}.spd", spectrum)
                    count += 1
        except (RecipeError, OSError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        for library in (use_library_spectrum, fill_from_library):
            library.forget()
        curve_previews.forget()
        what = next(iter(found[0][1])) if count == 1 else f"{count} spectra"
        self.report({"INFO"}, f"{what} {'is' if count == 1 else 'are'} in the library, under Own")
        return {"FINISHED"}
