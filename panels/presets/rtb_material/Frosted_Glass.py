# A body of crown glass with a ground surface
import bpy

settings = bpy.context.material.rtb
settings.use_spectra = True
settings.model = "roughglass"
settings.ior = "Glasses/N-BK7"
settings.roughness = 0.3
settings.distribution = "ggx"
