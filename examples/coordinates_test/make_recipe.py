"""
Write the CoordinatesTest as a recipe: python examples/coordinates_test/make_recipe.py FOLDER

RenderToolbox3's test of axes and handedness, built without Blender: a ball 10 m along each axis and a cube
10 m against it, red for X, green for Y, blue for Z, between eight lamps. From where the camera stands no
two axes can be exchanged, and none turned round, without a ball or cube jumping by 20 pixels of 320.

    as-it-is        what Blender's own viewport shows
    mirrored        the same with the camera's x axis turned round
    lit-all-round   without shadows, under a sky of 0.05 W sr-1 m-2 nm-1
"""

import argparse
from itertools import product
from pathlib import Path

import numpy as np

from rtb_addon import (
    Conditions,
    Conventions,
    MontageOptions,
    Recipe,
    RecipeOptions,
    SceneBuilder,
    write_recipe,
)
from rtb_addon.conditions import parse_conditions
from rtb_addon.scene.build import Placement

COLOURS = {"X": (0.64, 0.0208, 0.0943), "Y": (0.1753, 0.64, 0.1122), "Z": (0.0894, 0.0637, 0.64)}
EYE = (2.0, 2.0, 25.0)
# To the right, up and back, as the camera sees it.
DIRECTIONS = ((0.75441, 0.63302, -0.17365), (-0.65612, 0.73502, -0.17101), (0.01938, 0.24295, 0.96985))
XFOV = 77.31962  # [degrees] across the picture

TABLE = """\
imageName	groupName
as-it-is	lamps
mirrored	mirror
lit-all-round	sky
"""

MAPPINGS = """\
Collada mirror {
    Camera:scale|sid=scale = -1 1 1
}
Generic sky {
    Sky-light:light:environment
    Sky-light:intensity.spectrum = 300:0.05 800:0.05
}
"""


def make_recipe(folder: Path) -> Recipe:
    """Write the recipe's folder."""
    return write_recipe(
        folder,
        "CoordinatesTest",
        RecipeOptions(width=320, height=240, integrator="direct", depth=2, samples=16),
        Conventions(),
        MontageOptions(tone_map=100),
        parent_scene(),
        table(),
        MAPPINGS,
        {},
        {"made by": "examples/coordinates_test/make_recipe.py"},
    )


def parent_scene() -> bytes:
    """Return balls and cubes on the axes, lamps between them, and the camera."""
    scene = SceneBuilder("CoordinatesTest")
    for axis, (name, colour) in enumerate(COLOURS.items()):
        scene.material(name, colour)
        place = 10 * np.eye(3)[axis]
        scene.sphere(f"Ball{name}", 1, name, Placement(tuple(place)))
        scene.mesh(f"Cube{name}", *cube(), material=name, placement=Placement(tuple(-place)))
    for number, corner in enumerate(product((-5.0, 5.0), repeat=3)):
        scene.point(f"Lamp{number}", (10, 10, 10), Placement(corner))
    scene.camera("Camera", XFOV, placement=eye())
    return scene.tobytes()


def cube() -> tuple[np.ndarray, np.ndarray]:
    """Return the corners and triangles of a cube of 2 m."""
    corners = np.array(list(product((-1, 1), repeat=3)))
    sides = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
    return corners, np.array([half for a, b, c, d in sides for half in ((a, b, c), (a, c, d))])


def eye() -> np.ndarray:
    """Return where the camera stands and how it is turned, a (4, 4) matrix [m]."""
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = np.array(DIRECTIONS).T, EYE
    return matrix


def table() -> Conditions:
    """Return the conditions."""
    return parse_conditions(TABLE, "conditions.txt", "CoordinatesTest")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[1])
    parser.add_argument("folder", type=Path, help="of the new recipe")
    recipe = make_recipe(parser.parse_args().folder)
    print(f"{len(recipe.conditions)} conditions in {recipe.folder}")
