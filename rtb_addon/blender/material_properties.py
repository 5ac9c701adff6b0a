"""What RenderToolbox keeps of a material: a property for each parameter of the vocabulary, and textures."""

import bpy

from ..scene.vocabulary import MATERIALS, Parameter
from .material_words import (
    CHOICES,
    MODELS,
    Words,
    defaults,
    is_typed,
    parameters,
    takes_texture,
    texture_of,
    words_of,
)
from .overridable import (
    BoolProperty,
    EnumProperty,
    FloatProperty,
    FloatVectorProperty,
    PointerProperty,
    StringProperty,
)

TEXTURES = (
    ("NONE", "None", "The same everywhere", 0),
    ("bitmap", "Image", "A picture of colours, or an EXR file of spectra", 1),
    ("checkerboard", "Checkerboard", "Two spectra by turns", 2),
)
WRAPS = (
    ("repeat", "Repeat", "Again and again", 1),
    ("mirror", "Mirror", "Again and again, every other time mirrored", 2),
    ("clamp", "Extend", "Its border goes on", 3),
)
DETAILS = (
    ("NONE", "None", "As smooth as the mesh", 0),
    ("bumpmap", "Bump", "An image of heights tilts the surface", 1),
    ("normalmap", "Normal Map", "An image of directions in tangent space tilts the surface", 2),
)
_SHORT = {"eta": "Metals/Cu copper eta", "k": "Metals/Cu copper k"}


class RTB_PG_texture(bpy.types.PropertyGroup):
    """A picture or a pattern that stands for a parameter of a material, over the UV map."""

    kind: EnumProperty(name="Texture", items=TEXTURES, default="NONE")
    image: PointerProperty(type=bpy.types.Image, name="Image")
    wrap: EnumProperty(name="Extension", description="Beyond its border", items=WRAPS, default="repeat")
    checks: FloatVectorProperty(name="Checks", description="Along U and V", size=2, default=(2, 2), min=0)
    offset: FloatVectorProperty(name="Offset", description="Along U and V", size=2)
    scale: FloatVectorProperty(name="Scale", description="Along U and V", size=2, default=(1, 1))
    even: StringProperty(name="Even", description="Spectrum of the first check", default="1")
    odd: StringProperty(name="Odd", description="Spectrum of the checks beside it", default="0")


def _parts(settings, other) -> bool:
    return other.rtb != settings


def _to_defaults(settings, _context) -> None:
    """Let what was a model's default be that of the new one; what somebody has chosen stays."""
    for name, parameter in MATERIALS[settings.model].items():
        if parameter.default is None or parameter.kind == "reference":
            continue
        own = words_of(name).name
        usual = [default_of(name, each) for each in defaults(name)]
        wanted, now = default_of(name, parameter.default), getattr(settings, own)
        if now != wanted and any(_is_same(now, each) for each in usual):
            setattr(settings, own, wanted)


def default_of(name: str, default):
    """Return a default of the vocabulary as the parameter's property holds it."""
    typed = dict(parameters())[name]
    if not is_typed(typed.kind):
        return default
    return _SHORT.get(name, str(default) if isinstance(default, str) else f"{default:g}")


def _is_same(one, other) -> bool:
    return abs(one - other) < 1e-6 if isinstance(one, float) else one == other


def _property(name: str, parameter: Parameter, words: Words):
    """Return the property of a parameter."""
    said = {"name": words.label, "description": words.tooltip}
    if is_typed(parameter.kind):
        return StringProperty(**said, default=default_of(name, parameter.default))
    if parameter.kind == "number":
        most = {} if words.most is None else {"soft_max": words.most}
        return FloatProperty(**said, default=parameter.default, min=0.0, precision=3, **most)
    if parameter.kind == "reference":
        return PointerProperty(**said, type=bpy.types.Material, poll=_parts)
    if parameter.choices:
        items = [(each, CHOICES.get(each, each.title()), "", at) for at, each in enumerate(parameter.choices)]
        return EnumProperty(**said, items=items, default=parameter.default)
    if name == "filename":
        return StringProperty(**said, subtype="FILE_PATH", options={"PATH_SUPPORTS_BLEND_RELATIVE"})
    return StringProperty(**said, default=parameter.default or "")


def _annotations() -> dict:
    items = tuple((model, *words) for model, words in MODELS.items())
    found = {
        "use_spectra": BoolProperty(
            name="Use Spectra", description="Reflect as said here instead of by the colour", default=False
        ),
        "model": EnumProperty(name="Model", items=items, default="matte", update=_to_defaults),
        "detail": EnumProperty(name="Relief", items=DETAILS, default="NONE"),
        "detail_image": PointerProperty(type=bpy.types.Image, name="Image"),
        "detail_scale": FloatProperty(
            name="Height", description="Of the brightest pixel", default=0.01, unit="LENGTH", precision=4
        ),
    }
    for name, parameter in parameters():
        words = words_of(name)
        found[words.name] = _property(name, parameter, words)
        if takes_texture(name, parameter.kind):
            found[texture_of(words.name)] = PointerProperty(type=RTB_PG_texture)
    return found


RTB_PG_material = type(
    "RTB_PG_material",
    (bpy.types.PropertyGroup,),
    {
        "__doc__": "What a surface does with light of each wavelength.",
        "__module__": __name__,
        "__annotations__": _annotations(),
    },
)
