# An even grey of 18 %
import bpy

settings = bpy.context.material.rtb
settings.use_spectra = True
settings.model = "matte"
settings.reflectance = "0.18"
