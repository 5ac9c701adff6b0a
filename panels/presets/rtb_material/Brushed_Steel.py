# Steel, brushed along the texture's U
import bpy

settings = bpy.context.material.rtb
settings.use_spectra = True
settings.model = "anisoward"
settings.reflectance = "0.05"
settings.specular_reflectance = "0.5"
settings.alpha_u = 0.05
settings.alpha_v = 0.25
settings.variant = "balanced"
