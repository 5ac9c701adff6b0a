"""
Model the colour checker of monkeys and export it as a recipe.

    python examples/dragon_color_checker/model.py -- --output FOLDER            (with the bpy package)
    blender -b --python examples/dragon_color_checker/model.py -- --output FOLDER

The paper's DragonColorChecker: one scene, 24 conditions, in each of which the figure is painted like one
patch of the ColorChecker; the montage of all 24 looks like the chart. RenderToolbox must be installed as an
extension.
"""

import argparse
import math
import sys

import bpy
from mathutils import Vector

EXTENSION = "bl_ext.user_default.render_toolbox"
CHART = "BabelColor Average"
PATCHES = (
    *("dark skin", "light skin", "blue sky", "foliage", "blue flower", "bluish green"),
    *("orange", "purplish blue", "moderate red", "purple", "yellow green", "orange yellow"),
    *("blue", "green", "red", "yellow", "magenta", "cyan"),
    *("white 9.5 (.05 D)", "neutral 8 (.23 D)", "neutral 6.5 (.44 D)"),
    *("neutral 5 (.70 D)", "neutral 3.5 (1.05 D)", "black 2 (1.5 D)"),
)
ROOM = 5.0  # [m] edge of the floor and the walls


def model(scene: bpy.types.Scene) -> None:
    """Put a monkey into a room of three walls with two lamps, in front of a camera."""
    add_room(material("Wall", "0.75"), material("Floor", "0.5"))
    add_monkey(material("Monkey", "(paint)"))
    add_lamp("LightX", (-2.0, -2.9, 2.7), (0, 0, 1.1), watts=40)
    add_lamp("LightY", (1.8, -3.2, 1.4), (0, 0, 1.0), watts=6)
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    camera.data.lens = 50
    scene.collection.objects.link(camera)
    camera.location = (0, -5.2, 1.5)
    look_at(camera, (0.03, 0, 1.02))
    scene.camera = camera


def material(name: str, reflectance: str) -> bpy.types.Material:
    """Return a matte material; a reflectance in parentheses is a variable of the conditions."""
    made = bpy.data.materials.new(name)
    made.rtb.use_spectra = True
    made.rtb.model = "matte"
    made.rtb.reflectance = reflectance
    return made


def add_room(wall: bpy.types.Material, floor: bpy.types.Material) -> None:
    """Add a floor, a back wall and two side walls, facing inwards."""
    half, right = ROOM / 2, math.radians(90)
    add_square("Floor", (0, 0, 0), (0, 0, 0), floor)
    add_square("BackWall", (0, 1.6, half), (right, 0, 0), wall)
    add_square("LeftWall", (-half, 0, half), (right, 0, right), wall)
    add_square("RightWall", (half, 0, half), (right, 0, -right), wall)


def add_square(name: str, location, rotation, surface: bpy.types.Material) -> None:
    """Add a square as large as the room."""
    bpy.ops.mesh.primitive_plane_add(size=ROOM, location=location, rotation=rotation)
    square = bpy.context.object
    square.name = square.data.name = name
    square.data.materials.append(surface)


def add_monkey(surface: bpy.types.Material) -> None:
    """Add Blender's own monkey, subdivided and smooth, turned a little to the side."""
    bpy.ops.mesh.primitive_monkey_add(size=2.2, location=(0, 0, 1.07))
    monkey = bpy.context.object
    monkey.name = monkey.data.name = "Monkey"
    monkey.rotation_euler = (math.radians(-8), 0, math.radians(-14))
    monkey.modifiers.new("Subdivision", "SUBSURF").render_levels = 2
    monkey.modifiers["Subdivision"].levels = 2
    monkey.data.shade_smooth()
    monkey.data.materials.append(surface)


def add_lamp(name: str, location, target, watts: float) -> None:
    """Add a square area lamp of daylight D65."""
    data = bpy.data.lights.new(name, "AREA")
    data.size, data.energy = 0.9, watts
    data.rtb.use_spectra = True
    data.rtb.spectrum = "D65"
    lamp = bpy.data.objects.new(name, data)
    lamp.location = location
    bpy.context.scene.collection.objects.link(lamp)
    look_at(lamp, target)


def look_at(thing: bpy.types.Object, target) -> None:
    """Turn a camera or lamp, which look along their -Z axis, towards a place."""
    bpy.context.view_layer.update()
    thing.rotation_euler = (Vector(target) - thing.location).to_track_quat("-Z", "Y").to_euler()


def vary(scene: bpy.types.Scene) -> None:
    """List the 24 conditions and how they are rendered and shown."""
    settings = scene.rtb
    settings.name = "DragonColorChecker"
    settings.set_conditions(
        ["imageName", "paint"],
        [[patch.split(" (")[0].replace(" ", "-"), f"{CHART}/{patch}"] for patch in PATCHES],
    )
    settings.width, settings.height, settings.samples = 150, 120, 256
    settings.montage_columns, settings.montage_fill = 6, "rows"


def main() -> None:
    """Model, export, and say where the recipe is."""
    from addon_utils import enable  # can be found once bpy is there

    words = argparse.ArgumentParser(description=__doc__.strip().splitlines()[0])
    words.add_argument("--output", required=True, help="folder of the recipe")
    output = words.parse_args(sys.argv[sys.argv.index("--") + 1 :]).output
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    if enable(EXTENSION) is None:
        raise SystemExit(
            "RenderToolbox is not installed in this Blender: install its zip, or link the checkout"
        )
    scene = bpy.context.scene
    model(scene)
    vary(scene)
    bpy.ops.rtb.export_recipe(folder=output)


if __name__ == "__main__":
    main()
