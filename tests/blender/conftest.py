"""Blender's own Python module, with a user folder of its own and the extension enabled from this checkout."""

import importlib
import importlib.util
import os
import tempfile
from pathlib import Path

# Before the first `import bpy`: nobody's own Blender settings are read or written.
os.environ["BLENDER_USER_RESOURCES"] = tempfile.mkdtemp(prefix="rtb-blender-user-")

import bpy
import pytest

from tests.blender.tables import ROWS

ROOT = Path(__file__).resolve().parents[2]
EXTENSION = "bl_ext.user_default.render_toolbox"


@pytest.fixture(scope="session")
def extension() -> str:
    """Enable the extension as Blender does, and return the name it has there."""
    import addon_utils

    spec = importlib.util.spec_from_file_location("link_extension", ROOT / "packaging/link_extension.py")
    script = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(script)
    script.link_extension(Path(os.environ["BLENDER_USER_RESOURCES"]))
    assert addon_utils.enable(EXTENSION, default_set=True) is not None, "the extension does not enable"
    return EXTENSION


@pytest.fixture(scope="session")
def library(extension):
    """Return a module of the library as Blender has loaded it: library("blender.lights")."""
    return lambda name: importlib.import_module(f"{extension}.rtb_addon.{name}")


@pytest.fixture
def scene(extension):
    """An empty scene that could be rendered once it had something in it: a camera, 8 x 6 pixels."""
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    scene = bpy.context.scene
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    scene.collection.objects.link(camera)
    scene.camera = camera
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 8, 6, 100
    return scene


@pytest.fixture
def put(scene):
    """Return how to put an object into the scene: put("Lamp", data, location=(0, 0, 1))."""

    def put_into_scene(name, content, **properties):
        placed = bpy.data.objects.new(name, content)
        scene.collection.objects.link(placed)
        for key, value in properties.items():
            setattr(placed, key, value)
        return placed

    return put_into_scene


@pytest.fixture
def lamp(put):
    """Return how to put a lamp into the scene: lamp("POINT", energy=100)."""

    def put_lamp(kind="POINT", name="Lamp", location=(0.0, 0.0, 3.0), **properties):
        light = bpy.data.lights.new(name, kind)
        for key, value in properties.items():
            setattr(light, key, value)
        return put(name, light, location=location)

    return put_lamp


@pytest.fixture
def box(put):
    """Return how to put a cube of a material into the scene: box("Box", location=(0, 0, 1))."""

    def put_box(name="Box", material="Paint", **properties):
        mesh = bpy.data.meshes.new(name)
        corners = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
        faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
        mesh.from_pydata(corners, [], faces)
        mesh.materials.append(bpy.data.materials.get(material) or bpy.data.materials.new(material))
        return put(name, mesh, **properties)

    return put_box


@pytest.fixture
def read(library):
    """Return how to read a scene's recipe."""
    return lambda scene: library("blender").read_recipe(scene)


@pytest.fixture
def resolved(library, read, tmp_path):
    """Return how to see a scene, or a recipe, as renderers see it, for its first or a named condition."""

    def resolve(scene, condition=None, mappings=""):
        recipe = read(scene)
        folder = tmp_path / "resolved"
        recipe.save(folder)
        find_file = library("recipe").Recipe.load(folder).find_file
        document = library("scene.document").Scene.parse(recipe.parent, "parent.dae")
        row = recipe.conditions[condition] if condition else next(iter(recipe.conditions))
        said = library("mappings").parse_mappings(recipe.mappings + mappings, "mappings.txt")
        adjustments = said.fill_in(row, "tracer", document, find_file)
        settings = library("scene.resolve").SceneSettings(
            film=recipe.options.film, camera=recipe.options.camera
        )
        return library("scene.resolve").resolve(document, adjustments, settings, find_file).scene

    return resolve


@pytest.fixture
def still(scene, box, lamp):
    """A scene that can be read: a tagged box and a tagged lamp."""
    box()
    lamp().data.rtb.use_spectra = True
    bpy.data.materials["Paint"].rtb.use_spectra = True
    bpy.data.materials["Paint"].rtb.reflectance = "0.5"
    return scene


@pytest.fixture
def module(extension):
    """Return a module of the extension as Blender has loaded it."""
    return lambda name: importlib.import_module(f"{extension}.{name}")


@pytest.fixture
def family(extension, module, tmp_path):
    """Blender's default scene, saved, as a recipe of two conditions that is quickly rendered."""
    bpy.ops.wm.read_homefile(use_factory_startup=True)
    scene = bpy.context.scene
    bpy.data.materials["Material"].rtb.use_spectra = True
    bpy.data.materials["Material"].rtb.reflectance = "(paint)"
    bpy.data.lights["Light"].rtb.use_spectra = True
    rows = [[patch, f"BabelColor Average/{patch}"] for patch in ("blue", "green")]
    module("rtb_addon.blender").set_conditions(scene, ["imageName", "paint"], rows)
    scene.rtb.renderer, scene.rtb.samples = "tracer", 2
    scene.rtb.width, scene.rtb.height = 24, 16
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "cube.blend"))
    return bpy.context.scene


@pytest.fixture
def settings(extension):
    """What the default scene says: three conditions of two variables, the second of each active."""
    bpy.ops.wm.read_homefile(use_factory_startup=True)
    settings = bpy.context.scene.rtb
    settings.set_conditions(["imageName", "paint", "light"], ROWS)
    settings.active_condition = settings.active_variable = 1
    return settings


@pytest.fixture
def empty(extension):
    """A scene without table."""
    bpy.ops.wm.read_homefile(use_factory_startup=True)
    return bpy.context.scene.rtb
