"""A row of balls, one of each material, on a floor under a lamp: what every renderer must show alike."""

import numpy as np

from rtb_addon.scene.render_scene import Camera, Film, Integrator, Material, RenderScene, Shape
from rtb_addon.spectra import Bands, Spectrum
from tests.renderings.mitsuba_scenes import FULL_TURN, INTENSITY, at, globe, lamp, square

# Off the samples of the spectra, where the straight lines between them bend.
BANDS = Bands.around([430.0, 515.0, 585.0, 665.0])
RED = Spectrum.of([400, 550, 620, 700], [0.05, 0.1, 0.7, 0.9])
BLUE = Spectrum.of([400, 480, 560, 700], [0.9, 0.6, 0.15, 0.05])
GREEN = Spectrum.of([400, 530, 700], [0.1, 0.8, 0.2])
PALE = Spectrum.of([400, 700], [0.6, 0.9])
# Every 50 nm, rounded: enough to look like gold.
GOLD = {
    "eta": Spectrum.of([400, 450, 500, 550, 600, 650, 700], [1.66, 1.51, 0.97, 0.43, 0.25, 0.17, 0.16]),
    "k": Spectrum.of([400, 450, 500, 550, 600, 650, 700], [1.96, 1.88, 1.87, 2.46, 2.99, 3.45, 3.81]),
}
PIXELS = 8
_INDICES = {"intIOR": 1.5, "extIOR": 1.0}
_TINTS = {"specularReflectance": PALE, "specularTransmittance": GREEN}

MATERIALS = {
    "matte": {"diffuseReflectance": RED},
    "anisoward": {
        "diffuseReflectance": RED.scaled(0.5),
        "specularReflectance": BLUE.scaled(0.5),
        "alphaU": 0.3,
        "alphaV": 0.15,
        "variant": "ward",
    },
    "metal": {**GOLD, "roughness": 0.15},
    "mirror": {"specularReflectance": PALE},
    "plastic": {**_INDICES, "diffuseReflectance": BLUE},
    "roughplastic": {**_INDICES, "diffuseReflectance": GREEN, "roughness": 0.2},
    "glass": {**_INDICES, **_TINTS},
    "thinglass": {**_INDICES, **_TINTS},
    "roughglass": {**_INDICES, **_TINTS, "roughness": 0.25},
    "blend": {"materialID": "matte", "otherMaterialID": "roughplastic", "weight": 0.3},
    "mask": {"materialID": "plastic", "opacity": 0.6},
}
# What came later.
MORE = {
    "principled": {"baseColor": RED, "metallic": 0.4, "roughness": 0.5, "specular": 0.6},
    "metal ggx": {**MATERIALS["metal"], "distribution": "ggx"},
    "roughplastic ggx": {**MATERIALS["roughplastic"], "distribution": "ggx"},
    "roughglass ggx": {**MATERIALS["roughglass"], "distribution": "ggx"},
}
LAMPS = ("point", "area", "environment")


def row(light="environment", names=tuple(MATERIALS), materials=None, **integrator):
    """
    Return the balls of some materials side by side, 8 x 8 pixels each, under a kind of lamp.

    The order of names is that of the picture; the first word of a name is the model.
    """
    materials = MATERIALS if materials is None else materials
    balls = [Shape(name, globe(0.42), at(k + 0.5, 0.5, 0.5), name) for k, name in enumerate(names)]
    floor = Shape("floor", square(60), np.eye(4), "floor")
    panel = Shape("panel", square(1.5), at(len(names) / 2, -2, 4, FULL_TURN), "soot", INTENSITY)
    sky = lamp("environment", filename="", intensity=INTENSITY)
    point = lamp("point", at(len(names) / 2, -2, 4), INTENSITY.scaled(20), radius=0.0)
    declared = {name: Material(name, name.split()[0], parameters) for name, parameters in materials.items()}
    for name, spectrum in (("floor", PALE), ("soot", Spectrum.constant(0.0))):
        declared[name] = Material(name, "matte", {"diffuseReflectance": spectrum})
    return RenderScene(
        camera=Camera("Camera", "orthographic", at(0, 0, 9), (0, len(names), 0, 1)),
        shapes=(*balls, floor, *([panel] if light == "area" else [])),
        materials=declared,
        lights=(point,) if light == "point" else (),
        environment=sky if light == "environment" else None,
        integrator=Integrator(**{"depth": 5, "samples": 256, **integrator}),
        film=Film(PIXELS * len(names), PIXELS, BANDS, "centre"),
    )


def of(radiance, name, names=tuple(MATERIALS)):
    """Return one material's part of a picture."""
    first = names.index(name) * PIXELS
    return radiance[:, first : first + PIXELS]
