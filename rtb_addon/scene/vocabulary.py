"""
The words for materials and lights that every renderer is asked to understand.

RenderToolbox3's Generic names, extended once. What each renderer makes of them stands in
renderers/fidelity.py.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Literal, NamedTuple

from ..units import Unit

if TYPE_CHECKING:
    from ..spectra import Spectrum


class Parameter(NamedTuple):
    """
    One parameter of a material or light.

    Parameters
    ----------
    kind : spectrum, number, index (of refraction, a number or a spectrum), text or reference (the id of
        another material or texture)
    default : what it is when a recipe does not say, the name of a file perhaps; None where it must say
    unit : unit of the numbers; of a spectrum's values when kind is spectrum
    choices : the texts that it may be; empty for any
    """

    kind: Literal["spectrum", "number", "index", "text", "reference"]
    default: float | str | None = None
    unit: str = "1"
    choices: tuple[str, ...] = ()

    def default_value(self) -> Spectrum | float | str | None:
        """Return the default as a renderer gets it, or None; a file is for Values to read."""
        if self.kind != "spectrum":
            return self.default
        if self.default is None or isinstance(self.default, str):
            return None
        from ..spectra import Spectrum  # brings numpy, which panels that only read words need not wait for

        return Spectrum.constant(float(self.default), Unit(self.unit))


def reflectance(default: float | None = 0.5) -> Parameter:
    """Return a reflectance parameter."""
    return Parameter("spectrum", default)


def number(default: float | None, unit: str = "1") -> Parameter:
    """Return a number parameter."""
    return Parameter("number", default, unit)


def intensity(unit: Unit) -> Parameter:
    """Return a light's intensity; 1 at every wavelength when unsaid, as in RenderToolbox3."""
    return Parameter("spectrum", 1.0, unit.value)


WARD_VARIANTS = ("ward", "ward-duer", "balanced")

_INDICES = {"intIOR": Parameter("index", 1.5), "extIOR": number(1.0)}
# Of the slopes of a rough surface's small mirrors.
_SLOPES = {"distribution": Parameter("text", "beckmann", choices=("beckmann", "ggx"))}
_TINTS = {"specularReflectance": reflectance(1.0), "specularTransmittance": reflectance(1.0)}
_INDEX_SPECTRA = {"eta": Parameter("spectrum", "Cu.eta.spd"), "k": Parameter("spectrum", "Cu.k.spd")}
_WRAPPED = {"materialID": Parameter("reference"), "textureID": Parameter("reference")}

MATERIALS: Mapping[str, Mapping[str, Parameter]] = {
    "matte": {"diffuseReflectance": reflectance()},
    "anisoward": {
        "diffuseReflectance": reflectance(),
        "specularReflectance": reflectance(),
        "alphaU": number(0.1),
        "alphaV": number(0.1),
        "variant": Parameter("text", "ward", choices=WARD_VARIANTS),
    },
    "metal": {**_INDEX_SPECTRA, "roughness": number(0.4), **_SLOPES},
    "mirror": {"specularReflectance": reflectance(1.0)},
    "glass": {**_INDICES, **_TINTS},
    "thinglass": {**_INDICES, **_TINTS},
    "roughglass": {**_INDICES, **_TINTS, "roughness": number(0.1), **_SLOPES},
    "plastic": {"intIOR": number(1.5), "extIOR": number(1.0), "diffuseReflectance": reflectance()},
    "roughplastic": {
        "intIOR": number(1.5),
        "extIOR": number(1.0),
        "diffuseReflectance": reflectance(),
        "roughness": number(0.1),
        **_SLOPES,
    },
    "principled": {
        "baseColor": reflectance(),
        "metallic": number(0.0),
        "roughness": number(0.5),
        "specular": number(0.5),
    },
    "blend": {
        "materialID": Parameter("reference"),
        "otherMaterialID": Parameter("reference"),
        "weight": number(0.5),
    },
    "mask": {"materialID": Parameter("reference"), "opacity": number(1.0)},
    "measured": {"filename": Parameter("text")},
    "fluorescent": {"filename": Parameter("text")},
    "bumpmap": {**_WRAPPED, "scale": number(1.0)},
    "normalmap": _WRAPPED,
}

LIGHTS: Mapping[str, Mapping[str, Parameter]] = {
    "point": {"intensity": intensity(Unit.INTENSITY), "radius": number(0.0, "m")},
    "spot": {
        "intensity": intensity(Unit.INTENSITY),
        "cone": number(45.0, "degrees, the full angle"),
        "blend": number(0.0),
        "radius": number(0.0, "m"),
    },
    "directional": {
        "intensity": intensity(Unit.IRRADIANCE),
        "angle": number(0.0, "degrees, the sun's diameter"),
    },
    "area": {"intensity": intensity(Unit.RADIANCE)},
    "environment": {"intensity": intensity(Unit.RADIANCE), "filename": Parameter("text", "")},
    "sunsky": {"turbidity": number(3.0)},
}

_COLOURS = {"oddColor": reflectance(0.0), "evenColor": reflectance(1.0)}
_OFFSETS = {"offsetU": number(0.0), "offsetV": number(0.0)}

TEXTURES: Mapping[str, Mapping[str, Parameter]] = {
    "bitmap": {
        "filename": Parameter("text"),
        "wrapMode": Parameter("text", "repeat"),
        "gamma": number(1.0),
        "filterMode": Parameter("text", "ewa"),
        "maxAnisotropy": number(20.0),
        **_OFFSETS,
        "scaleU": number(1.0),
        "scaleV": number(1.0),
    },
    "checkerboard": {"checksPerU": number(2.0), "checksPerV": number(2.0), **_OFFSETS, **_COLOURS},
}

# What a recipe may declare, by its category.
CATEGORIES: Mapping[str, Mapping[str, Mapping[str, Parameter]]] = {
    "material": MATERIALS,
    "light": LIGHTS,
    "floatTexture": TEXTURES,
    "spectrumTexture": TEXTURES,
}
