"""A small recipe in Blender's default scene: a cube that is painted anew in each condition."""

import sys
from pathlib import Path

import bpy

PATCHES = ("blue", "green", "red", "yellow", "magenta", "cyan")
EXTENSION = "bl_ext.user_default.render_toolbox"


def extension(module: str):
    """Return a module of the extension as Blender has loaded it."""
    return sys.modules[f"{EXTENSION}.{module}"]


def make_recipe(folder: Path, count: int, renderer: str, samples: int, size: tuple[int, int]) -> None:
    """Save the default scene in a folder as a recipe of so many conditions."""
    scene = bpy.context.scene
    tag(bpy.data.materials["Material"], bpy.data.lights["Light"])
    settings = scene.rtb
    rows = [[patch, f"BabelColor Average/{patch}"] for patch in PATCHES[:count]]
    extension("rtb_addon.blender").set_conditions(scene, ["imageName", "paint"], rows)
    settings.renderer, settings.samples = renderer, samples
    settings.width, settings.height = size
    folder.mkdir(parents=True, exist_ok=True)
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "cube.blend"))


def tag(material, light) -> None:
    """Paint the cube with the conditions' paint, and light it with daylight."""
    material.rtb.use_spectra = True
    material.rtb.reflectance = "(paint)"
    light.rtb.use_spectra = True
    light.rtb.spectrum = "D65"
