# A paint with a soft gloss, after Ward
import bpy

settings = bpy.context.material.rtb
settings.use_spectra = True
settings.model = "anisoward"
settings.reflectance = "0.36"
settings.specular_reflectance = "0.05"
settings.alpha_u = 0.1
settings.alpha_v = 0.1
settings.variant = "balanced"
