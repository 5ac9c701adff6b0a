# A pane of float glass
import bpy

settings = bpy.context.material.rtb
settings.use_spectra = True
settings.model = "thinglass"
settings.ior = "1.52"
