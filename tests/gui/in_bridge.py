"""Run by ``blender -b``: what the bridge makes of Blender 5, its working spaces and its properties."""

import importlib
import json
import sys
import traceback
from pathlib import Path

import bpy

EXTENSION = "bl_ext.user_default.render_toolbox"
SPACES = ("Linear Rec.709", "Linear Rec.2020", "ACEScg")
COLOUR, TINT = (0.8, 0.2, 0.1), (0.3, 0.9, 0.5)


def library(name: str):
    return importlib.import_module(f"{EXTENSION}.rtb_addon.{name}")


def colours_in(space: str, folder: Path) -> dict:
    """Let Blender convert a scene's colours to a working space, and return what the bridge makes of them."""
    bpy.ops.wm.read_homefile(use_factory_startup=True)
    shader = next(
        node for node in bpy.data.materials["Material"].node_tree.nodes if node.type == "BSDF_PRINCIPLED"
    )
    shader.inputs["Base Color"].default_value = (*COLOUR, 1)
    light = bpy.data.lights["Light"]
    light.color, light.use_temperature, light.temperature = TINT, False, 3000
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "colours.blend"))
    if space != bpy.data.colorspace.working_space:
        bpy.ops.wm.set_working_color_space(working_space=space, convert_colors=True)
    colours, lights, nodes = (library(f"blender.{name}") for name in ("colours", "lights", "nodes"))
    light = bpy.data.lights["Light"]
    found = {
        "working": bpy.data.colorspace.working_space,
        "material": colours.linear_rec709(nodes.colour_of_material(bpy.data.materials["Material"]).colour),
        "light": colours.linear_rec709(lights.colour_of(light)),
    }
    light.color, light.use_temperature = (1, 1, 1), True
    return found | {"temperature": colours.linear_rec709(lights.colour_of(light))}


def recipe(folder: Path) -> dict:
    """Read and save a recipe of everything that a Blender file may hold, twice, the second time reopened."""
    bpy.ops.wm.read_homefile(use_factory_startup=True)
    scene = bpy.context.scene
    cube = bpy.data.objects["Cube"]
    modifier = cube.modifiers.new("Subdivision", "SUBSURF")
    modifier.levels, modifier.render_levels = 0, 2
    bpy.ops.object.text_add(location=(0, 3, 0))
    bpy.context.object.data.materials.append(bpy.data.materials["Material"])
    bpy.ops.object.light_add(type="AREA", location=(0, 0, 5))
    bpy.data.lights["Area"].rtb.use_spectra = True
    bpy.data.materials["Material"].rtb.use_spectra = True
    bpy.data.materials["Material"].rtb.reflectance = "(paint)"
    scene.rtb.set_conditions(["imageName", "paint"], [("dark", "0.1"), ("light", "0.8")])
    file = str(folder / "family.blend")
    bpy.ops.wm.save_as_mainfile(filepath=file)
    first = library("blender").read_recipe(scene).save(folder / "first")
    bpy.ops.wm.read_homefile(use_factory_startup=True)
    bpy.ops.wm.open_mainfile(filepath=file)
    second = library("blender").read_recipe(bpy.context.scene)
    second.save(folder / "second")
    same = [
        (first / name).read_bytes() == (folder / "second" / name).read_bytes()
        for name in ("parent.dae", "conditions.txt", "mappings.txt", "recipe.json")
    ]
    return {
        "same": all(same),
        "mappings": second.mappings,
        "report": list(second.report),
        "triangles": second.parent.count(b'count="192"'),
        "scenes": [each.name for each in bpy.data.scenes],
        "rows": [[row.name, *(cell.value for cell in row.cells)] for row in bpy.context.scene.rtb.conditions],
    }


def baked() -> dict:
    """Let a function change, add and remove things for each condition, and compare before with after."""
    bpy.ops.wm.read_homefile(use_factory_startup=True)
    scene, cube = bpy.context.scene, bpy.data.objects["Cube"]
    cube.modifiers.new("Subdivision", "SUBSURF")
    cube.shape_key_add(name="Basis")
    cube.shape_key_add(name="Tall").data[0].co = (3, 3, 3)
    scene.rtb.set_conditions(["imageName", "level"], [("zero", 0), ("two", 2), ("gone", 0), ("as-two", 2)])
    read_recipe = library("blender").read_recipe
    before = read_recipe(scene).parent

    def remodel(scene, condition):
        cube = bpy.data.objects["Cube"]
        cube.modifiers["Subdivision"].render_levels = int(condition.cells["level"])
        cube.data.shape_keys.key_blocks["Tall"].value = 0.5
        scene.frame_set(7)
        if condition.name == "gone":
            scene.collection.objects.link(bpy.data.objects.new("Twin", bpy.data.meshes["Cube"].copy()))
            bpy.data.objects.remove(cube)

    cube_in = [b'id="Cube"' in before]
    recipe = read_recipe(scene, remodel)
    parents = {"parent.dae": recipe.parent}
    parents |= {f"resources/{name}": content for name, content in recipe.resources.items()}
    return {
        "same": read_recipe(scene).parent == before,
        "cells": [each.parent_scene for each in recipe.conditions],
        "cubes": cube_in + [b'id="Cube"' in parents[each.parent_scene] for each in recipe.conditions],
        "frame": scene.frame_current,
        "objects": sorted(bpy.data.objects.keys()),
        "meshes": bpy.data.meshes.keys(),
    }


def undone() -> list[str]:
    """Return a reflectance before a change, after it, undone and redone."""
    bpy.ops.wm.read_homefile(use_factory_startup=True)
    found = [bpy.data.materials["Material"].rtb.reflectance]
    bpy.ops.ed.undo_push(message="before")
    bpy.data.materials["Material"].rtb.reflectance = "0.9"
    bpy.ops.ed.undo_push(message="after")
    found.append(bpy.data.materials["Material"].rtb.reflectance)
    for verb in (bpy.ops.ed.undo, bpy.ops.ed.redo):
        verb()
        found.append(bpy.data.materials["Material"].rtb.reflectance)
    return found


if __name__ == "__main__":
    target, folder = map(Path, sys.argv[sys.argv.index("--") + 1 :])
    folder.mkdir(parents=True, exist_ok=True)
    try:
        report = {
            "colours": {space: colours_in(space, folder) for space in SPACES},
            "recipe": recipe(folder),
            "baked": baked(),
            "undone": undone(),
        }
    except BaseException:
        report = {"traceback": traceback.format_exc()}
    target.write_text(json.dumps(report, indent=1))
    sys.exit(4 if "traceback" in report else 0)
