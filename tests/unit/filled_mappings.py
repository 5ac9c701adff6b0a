"""A small parent scene, a row, and what mappings say for them."""

import os
from pathlib import Path

from rtb_addon.conditions import Condition
from rtb_addon.mappings import parse_mappings
from rtb_addon.scene.document import Scene

RTB3 = Path(os.environ.get("RTB3_FOLDER", Path(__file__).resolve().parents[3] / "shared" / "rtb3"))

# Blocks, declarations and configurations of the files that RenderToolbox3 shipped, counted by an independent
# reader.
OLD_FILES = {
    "CheckerShadowSceneMappings": (4, 11, 33),
    "DiceMappings": (3, 5, 7),
    "DiceTransformationsMappings": (7, 5, 13),
    "DragonColorCheckerMappings": (2, 5, 6),
    "DragonGradedMappings": (3, 6, 7),
    "DragonMappings": (2, 6, 7),
    "DragonMaterialsMappings": (8, 11, 17),
    "InteriorDragonMappings": (5, 32, 34),
    "InteriorMappings": (8, 33, 38),
    "MaterialSphereBumpsMappings": (6, 6, 13),
    "MaterialSphereMappings": (5, 4, 9),
    "RadianceTestMappings": (4, 5, 14),
    "ScalingTestMappings": (4, 2, 28),
    "SimpleSphereMappings": (4, 2, 14),
    "SimpleSquareMappings": (1, 2, 2),
    "SpectralIllusionMappings": (5, 31, 33),
    "DefaultMappings": (1, 0, 1),
    "SpectralPromotionMappings": (5, 3, 6),
}

# A file of ours with everything in it that those have.
OWN_FILE = """\
% Every kind of block
Collada {
    % move the lamp
    Lamp:translate|sid=location += 0 0 (height)
    Camera:scale|sid=scale  =  -1 1 1
}

Generic{
    Paint-material:material:matte
    Paint-material:diffuseReflectance.spectrum    = (paint)
    Lamp-light:light:point
    Lamp-light:intensity:spectrum = (lamp).spd
}
Generic night {
    Lamp-light:intensity.spectrum = 300:0 800:0
}
Generic day {
    Paint-material:diffuseReflectance.spectrum = 300:0.5 800:0.75
}
mitsuba {
    integrator:integrator:path
    integrator:maxDepth.integer = 7
}
Mitsuba-path {
    Camera-camera_film$ = merge
    Camera-camera:transform|name=toWorld:scale.x = [Camera-camera:optics:technique_common:perspective:xfov]
}
PBRT {
    integrator:SurfaceIntegrator:path
}
PBRT-path {
    sampler:parameter|name=pixelsamples = (samples that nobody asked for)
}
"""

SCENE = Scene.parse(
    b"""<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema"><camera id="Camera-camera"><optics>
    <technique_common><perspective><xfov>40</xfov></perspective></technique_common></optics></camera>
    <node id="Lamp"><translate sid="location">1 2 3</translate></node></COLLADA>""",
    "parent.dae",
)

ROW = Condition("first", {"imageName": "first", "height": "2.5", "paint": "300:1 800:1", "lamp": "D65"})


def nothing(name):
    return None


def filled(text, renderer="mitsuba", find_file=nothing, **cells):
    row = Condition("first", {**ROW.cells, **cells})
    return parse_mappings(text, "mappings.txt").fill_in(row, renderer, SCENE, find_file)


def generic(*lines):
    return "Generic {\n" + "\n".join(lines) + "\n}\n"
