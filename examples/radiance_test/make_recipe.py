"""
Write the RadianceTest as a recipe: python examples/radiance_test/make_recipe.py FOLDER

RenderToolbox3's calibration scene, built without Blender: a white square of 2 m that a camera sees at 45
degrees, under a lamp of 1 W sr-1 nm-1 at 100 m. Each condition changes one thing, and physics says what
that does to the radiance of the square:

    reference         1/(pi 100^2) = 3.183099e-5 W sr-1 m-2 nm-1
    2xFarLight        a quarter
    2xFarCamera       the same, in a quarter of the pixels
    rotateReflector   the cosine of 41.4 degrees
    rotateCamera      the same, in more pixels
    sparseSpectrum    the same: values are per nanometre, not per sample
    unitAreaLight     about the same: a disc of 1 m2 and 1 W sr-1 m-2 nm-1
    halfAreaLight     about half of it

Discs are polygons of 32 corners, a little smaller than the circles around them, and stand 0.1 m behind
where the lamp is.
"""

import argparse
from pathlib import Path

import numpy as np

from rtb_addon import (
    Conditions,
    Conventions,
    MontageOptions,
    Recipe,
    RecipeOptions,
    SceneBuilder,
    Spectrum,
    write_recipe,
)
from rtb_addon.conditions import parse_conditions
from rtb_addon.scene.build import Placement
from rtb_addon.spectra.files import spd_text

CORNERS = 32
BLENDERS_DEFAULT_LENS = 49.13434  # [degrees] across the picture, 35 mm on a sensor of 32 mm

# The last column is a radius [m]: 0.5642 makes a circle of 1 m2, 0.3989 one of half of that.
TABLE = """\
imageName	lightDistance	cameraY	cameraZ	cameraTilt	reflectorTilt	lightSpectrum	groupName	discRadius
reference	100	5	5	-45	0	per-5-nm.spd	pointLight	0.01
2xFarLight	200	5	5	-45	0	per-5-nm.spd	pointLight	0.01
2xFarCamera	100	10	10	-45	0	per-5-nm.spd	pointLight	0.01
rotateReflector	100	5	5	-45	-41.4	per-5-nm.spd	pointLight	0.01
rotateCamera	100	1.23	6.96	-10	0	per-5-nm.spd	pointLight	0.01
sparseSpectrum	100	5	5	-45	0	per-10-nm.spd	pointLight	0.01
unitAreaLight	100	5	5	-45	0	per-5-nm.spd	areaLight	0.5642
halfAreaLight	100	5	5	-45	0	per-5-nm.spd	areaLight	0.3989
"""

MAPPINGS = """\
Collada {
    Camera:translate|sid=location = 0 (cameraY) (cameraZ)
    Camera:rotate|sid=rotationX = 1 0 0 (cameraTilt)
    Reflector:rotate|sid=rotationX = 1 0 0 (reflectorTilt)
    Lamp:translate|sid=location = 0 0 (lightDistance)
    % the disc stands just behind the lamp
    Disc:translate|sid=location = 0 0 (lightDistance)
    Disc:translate|sid=location += 0 0 0.1
    Disc:scale|sid=scale = (discRadius) (discRadius) 1
}
Generic {
    White-material:material:matte
    White-material:diffuseReflectance.spectrum = 300:1 800:1
    Black-material:material:matte
    Black-material:diffuseReflectance.spectrum = 300:0 800:0
}
Generic pointLight {
    Lamp-light:light:point
    Lamp-light:intensity.spectrum = (lightSpectrum)
}
Generic areaLight {
    Lamp-light:light:point
    Lamp-light:intensity.spectrum = 300:0 800:0
    Disc-mesh:light:area
    Disc-mesh:intensity.spectrum = (lightSpectrum)
}
"""


def make_recipe(folder: Path) -> Recipe:
    """Write the recipe's folder."""
    return write_recipe(
        folder,
        "RadianceTest",
        RecipeOptions(width=100, height=100, integrator="direct", depth=2, samples=64),
        Conventions(),
        MontageOptions(),
        parent_scene(),
        table(),
        MAPPINGS,
        {f"per-{step}-nm.spd": flat_light(step).encode() for step in (5, 10)},
        {"made by": "examples/radiance_test/make_recipe.py"},
    )


def parent_scene() -> bytes:
    """Return the scene whose lamp, disc, square and camera the conditions move."""
    scene = SceneBuilder("RadianceTest")
    scene.plane("Reflector", 2, 2, "White")
    scene.point("Lamp", placement=Placement((0, 0, 100)))
    downwards = Placement((0, 0, 100.1), rotation=(180, 0, 0))
    scene.mesh("Disc", *polygon(), material="Black", placement=downwards)
    scene.camera("Camera", BLENDERS_DEFAULT_LENS, aspect=1, placement=Placement((0, 5, 5), (-45, 0, 0)))
    return scene.tobytes()


def polygon() -> tuple[np.ndarray, np.ndarray]:
    """Return the corners and triangles of a polygon in a circle of radius 1."""
    turn = 2 * np.pi * np.arange(CORNERS) / CORNERS
    rim = np.column_stack([np.cos(turn), np.sin(turn), np.zeros(CORNERS)])
    number = np.arange(CORNERS)
    fan = np.column_stack([np.zeros(CORNERS, int), 1 + number, 1 + np.roll(number, -1)])
    return np.vstack([np.zeros(3), rim]), fan


def table() -> Conditions:
    """Return the conditions."""
    return parse_conditions(TABLE, "conditions.txt", "RadianceTest")


def flat_light(step: int) -> str:
    """Return the file of a light that is 1 from 300 to 800 nm, with a sample at every step [nm]."""
    wavelengths = np.arange(300, 801, step)
    return spd_text(Spectrum.of(wavelengths, np.ones(len(wavelengths))))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[1])
    parser.add_argument("folder", type=Path, help="of the new recipe")
    recipe = make_recipe(parser.parse_args().folder)
    print(f"{len(recipe.conditions)} conditions in {recipe.folder}")
