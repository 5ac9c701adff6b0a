"""A spectrum that a file holds."""

from pathlib import Path

import bpy
from bpy_extras.io_utils import ImportHelper

from ..rtb_addon.blender import curve_previews
from .spectrum_verbs import SpectrumVerb


class RTB_OT_use_spectrum_file(SpectrumVerb, bpy.types.Operator, ImportHelper):
    """Take a spectrum from a file of wavelength and value pairs"""

    bl_idname = "rtb.use_spectrum_file"
    bl_label = "Spectrum File"

    filter_glob: bpy.props.StringProperty(default="*.spd", options={"HIDDEN"})

    def text(self, context, owner):
        from ..rtb_addon.spectra.files import read_spd  # brings numpy, which enabling need not wait for

        read_spd(Path(bpy.path.abspath(self.filepath)))
        curve_previews.forget()  # it may have been changed since its curve was drawn
        return bpy.path.relpath(self.filepath) if bpy.data.filepath else self.filepath
