"""What RenderToolbox keeps of what shines: lamps, the world, meshes that emit."""

import math

import bpy

from .amounts import MEASURES
from .material_words import TYPED
from .overridable import (
    BoolProperty,
    EnumProperty,
    FloatProperty,
    FloatVectorProperty,
    PointerProperty,
    StringProperty,
)

EMISSIONS = (
    ("radiance", "Radiance", "The amount is a factor of a spectrum of radiance, in W / (sr m² nm)", 1),
    ("watts", "Watts", "The amount is the power in watts that the surface sends out", 2),
    ("lumens", "Lumens", "The amount is the luminous flux that the surface sends out", 3),
    ("nits", "cd/m²", "The amount is the luminance, how bright the surface looks", 4),
)
SKIES = (
    ("CONSTANT", "Everywhere", "The same from all directions", 1),
    ("IMAGE", "Image", "A picture all around, of colours or of spectra (EXR)", 2),
    ("SUNSKY", "Sun and Sky", "The sun and a clear sky, as Hosek and Wilkie measured them", 3),
)
SKY_MEASURES = (
    ("RADIANCE", "Radiance", "The amount is a factor of a spectrum of radiance, in W / (sr m² nm)", 1),
    ("NITS", "cd/m²", "The amount is the luminance, how bright it looks", 2),
)


class RTB_PG_light(bpy.types.PropertyGroup):
    """What light a lamp sends out, and how much: Blender's power, or as people measure light."""

    use_spectra: BoolProperty(
        name="Use Spectra", description="Shine as said here instead of in the colour", default=False
    )
    spectrum: StringProperty(
        name="Spectrum", description=f"Shape of the spectrum, scaled to the power: {TYPED}", default="D65"
    )
    measure: EnumProperty(name="Measure", items=MEASURES, default="WATTS")
    amount: FloatProperty(
        name="Amount",
        description="In the unit beside it; Blender's own power then counts no more",
        default=100.0,
        min=0.0,
    )
    distance: FloatProperty(
        name="At Distance", description="Where the illuminance is", default=1.0, min=0.0, unit="LENGTH"
    )


class RTB_PG_world(bpy.types.PropertyGroup):
    """What light comes from all around."""

    use_spectra: BoolProperty(name="Use Spectra", description="Let the world shine", default=False)
    kind: EnumProperty(name="Light From", items=SKIES, default="CONSTANT")
    spectrum: StringProperty(
        name="Spectrum", description=f"Radiance, in W / (sr m² nm): {TYPED}", default="1"
    )
    measure: EnumProperty(name="Measure", items=SKY_MEASURES, default="RADIANCE")
    amount: FloatProperty(name="Amount", description="Factor of the spectrum", default=1.0, min=0.0)
    image: PointerProperty(
        type=bpy.types.Image,
        name="Image",
        description="Equirectangular, as Blender's: its middle lies ahead of +X",
    )
    rotation: FloatVectorProperty(
        name="Rotation", description="Of the image, around X, Y and Z", size=3, subtype="EULER"
    )
    turbidity: FloatProperty(
        name="Turbidity",
        description="Haze of the air: 2 for the arctic, 10 for fog",
        default=3,
        min=1,
        max=10,
    )
    elevation: FloatProperty(
        name="Elevation",
        description="Of the sun above the horizon",
        default=math.radians(45),
        min=0.0,
        max=math.radians(90),
        unit="ROTATION",
    )
    azimuth: FloatProperty(name="Azimuth", description="Of the sun, from X to Y", unit="ROTATION")


class RTB_PG_object(bpy.types.PropertyGroup):
    """What light a mesh sends out, from the side of its normals, and how its place is written."""

    emits: BoolProperty(name="Emits", description="Let this surface shine", default=False)
    spectrum: StringProperty(name="Spectrum", description=f"What it sends out: {TYPED}", default="D65")
    emission: EnumProperty(name="Measure", items=EMISSIONS, default="radiance")
    amount: FloatProperty(name="Amount", default=1.0, min=0.0)
    # Of a recipe that was opened: its mappings count on one matrix, or on separate transforms.
    as_matrix: BoolProperty(options={"HIDDEN"})
