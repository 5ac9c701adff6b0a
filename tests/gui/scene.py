"""A small recipe in Blender's default scene: a cube that is painted anew in each condition."""

import importlib
import time
from pathlib import Path

import bpy

PATCHES = ("blue", "green", "red", "yellow", "magenta", "cyan")
EXTENSION = "bl_ext.user_default.render_toolbox"


def extension(module: str):
    """Return a module of the extension as Blender has loaded it."""
    return importlib.import_module(f"{EXTENSION}.{module}")


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


def measured(owner, name: str) -> list[float]:
    """Let a method note how long it takes [s], and return its notes."""
    notes, method = [], getattr(owner, name)

    def note(*arguments):
        begin = time.perf_counter()
        try:
            return method(*arguments)
        finally:
            notes.append(time.perf_counter() - begin)

    # Blender counts the arguments of what it calls.
    def taking_one(self):
        return note(self)

    def drawing(self, context):
        return note(self, context)

    def drawing_item(self, context, layout, owner, item, icon, active, active_property, index):
        return note(self, context, layout, owner, item, icon, active, active_property, index)

    count = method.__code__.co_argcount
    setattr(owner, name, {1: taking_one, 2: drawing, 9: drawing_item}[count])
    return notes
