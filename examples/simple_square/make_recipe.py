"""
Write the SimpleSquare as a recipe: python examples/simple_square/make_recipe.py FOLDER

RenderToolbox3's test of reflection, built without Blender: a matte square of 2 m under a sun of daylight D65
that stands straight above it, and 24 conditions, in each of which it has the reflectance of one patch of the
ColorChecker. Every pixel of it then has the radiance

    reflectance x D65 / pi

and the montage, four rows of six, is the chart.
"""

import argparse
from pathlib import Path

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
from rtb_addon.spectra import library
from rtb_addon.spectra.files import spd_text

CHART = "BabelColor Average"
BLENDERS_DEFAULT_LENS = 49.13434  # [degrees] across the picture, 35 mm on a sensor of 32 mm

MAPPINGS = """\
Generic {
    Paint-material:material:matte
    Paint-material:diffuseReflectance.spectrum = (paint)
    Sun-light:light:directional
    Sun-light:intensity.spectrum = D65.spd
}
"""


def make_recipe(folder: Path) -> Recipe:
    """Write the recipe's folder."""
    return write_recipe(
        folder,
        "SimpleSquare",
        RecipeOptions(width=50, height=50, integrator="direct", depth=2, samples=16),
        Conventions(),
        MontageOptions(columns=6, fill="rows"),
        parent_scene(),
        table(),
        MAPPINGS,
        {f"{patch}.spd": spd_text(library.find(name)).encode() for patch, name in patches().items()}
        | {"D65.spd": spd_text(library.find("D65")).encode()},
        {"made by": "examples/simple_square/make_recipe.py"},
    )


def parent_scene() -> bytes:
    """Return the square, the sun above it and the camera that looks down on it."""
    scene = SceneBuilder("SimpleSquare")
    scene.plane("Square", 2, 2, "Paint")
    scene.sun("Sun", placement=Placement((0, 0, 5)))
    scene.camera("Camera", BLENDERS_DEFAULT_LENS, aspect=1, placement=Placement((0, 0, 2.5)))
    return scene.tobytes()


def patches() -> dict[str, str]:
    """Return the library's names of the patches, by the names of their conditions."""
    names = [name for name in library.names() if name.startswith(f"{CHART}/")]
    return {name.split("/")[1].split(" (")[0].replace(" ", "-"): name for name in names}


def table() -> Conditions:
    """Return a condition for each patch."""
    rows = "".join(f"{patch}\t{patch}.spd\n" for patch in patches())
    return parse_conditions(f"imageName\tpaint\n{rows}", "conditions.txt", "SimpleSquare")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[1])
    parser.add_argument("folder", type=Path, help="of the new recipe")
    recipe = make_recipe(parser.parse_args().folder)
    print(f"{len(recipe.conditions)} conditions in {recipe.folder}")
