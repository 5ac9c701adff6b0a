# Sintered PTFE, as good as white
import bpy

settings = bpy.context.material.rtb
settings.use_spectra = True
settings.model = "matte"
settings.reflectance = "0.99"
