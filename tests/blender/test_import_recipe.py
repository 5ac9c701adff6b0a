"""Recipes opened in Blender: what they render stays the same."""

import sys
from pathlib import Path

import bpy
import numpy as np
import pytest
from lxml import etree

from tests.blender.test_varied_properties import assert_parameters


@pytest.fixture
def builder(library):
    """Return how to build a parent scene."""
    return library("scene.build")


@pytest.fixture
def recipe(library, builder, tmp_path):
    """A recipe with every kind of thing: a family that moves, colours and turns."""
    placed = builder.Placement
    scene = builder.SceneBuilder()
    scene.camera("Camera", placement=placed(location=(0, -1, 6), rotation=(10, 0, 0)))
    scene.camera("Flat", width=3.0, placement=placed(location=(0, 0, 5)))
    scene.point("Lamp", placement=placed(location=(1, 2, 3)))
    scene.spot("Spot", cone=50, blend=0.25, placement=placed(location=(-1, 0, 4), rotation=(0, -15, 0)))
    scene.sun("Sun", placement=placed(rotation=(20, 30, 0)))
    scene.plane("Floor", material="Paint", placement=placed(scale=(2, 3, 1)))
    scene.sphere("Ball", material="Gloss", placement=placed(location=(0, 0, 0.5), rotation=(0, 0, 45)))
    return library("recipe.new").new_recipe(
        tmp_path / "old",
        scene.tobytes(),
        conditions="imageName\tpaint\theight\nlow\t0.2\t1.5\nhigh\tresources/paint.spd\t4\n",
        mappings="""
            % moves and paints
            Collada {
                Lamp:translate|sid=location = 1 2 (height)
                Floor:scale|sid=scale *= 2
            }
            Generic {
                Paint-material:material:matte
                Paint-material:diffuseReflectance.spectrum = (paint)
                Gloss-material:material:anisoward
                Gloss-material:alphaU.float = 0.2
                Lamp-light:light:point
                Lamp-light:intensity.spectrum = 300:10 800:20
                Sun-light:light:directional
                Sun-light:intensity.spectrum = D65.spd
            }
            Mitsuba {
                integrator:maxDepth.integer = 5
            }
        """,
        resources={"paint.spd": b"400 0.5\n700 0.9\n"},
        renderer="tracer",
        width=40,
        height=30,
        samples=8,
        band_kind="centre",
        layers=("depth", "standard_error"),
    )


def scenes_of(library, folder) -> dict:
    """Return the neutral scene of each condition of a recipe's folder."""
    loaded, said = library("recipe").Recipe.load(folder), library("recipe.condition_scene")
    return {
        row.name: said.resolve_condition(
            loaded, row, said.adjustments_of(loaded, row, loaded.find_file)
        ).scene
        for row in loaded.conditions
    }


def corners(shape) -> np.ndarray:
    """Return the corners of a shape's triangles in the world, in their order."""
    mesh, matrix = shape.mesh, np.asarray(shape.to_world)
    world = mesh.vertices.astype(float) @ matrix[:3, :3].T + matrix[:3, 3]
    return world[mesh.triangles].reshape(-1, 9)


def assert_renders_the_same(one: dict, other: dict) -> None:
    assert list(one) == list(other)
    for name, first in one.items():
        second = other[name]
        np.testing.assert_allclose(first.camera.to_world, second.camera.to_world, atol=2e-6)
        np.testing.assert_allclose(first.camera.window, second.camera.window, rtol=2e-6)
        assert {each.id for each in first.shapes} == {each.id for each in second.shapes}
        shapes = {each.id: each for each in second.shapes}
        for shape in first.shapes:
            np.testing.assert_allclose(corners(shape), corners(shapes[shape.id]), rtol=1e-6, atol=1e-5)
            assert shape.material == shapes[shape.id].material
        lights = {each.id: each for each in second.lights}
        assert {each.id for each in first.lights} == set(lights)
        for light in first.lights:
            np.testing.assert_allclose(light.to_world, lights[light.id].to_world, atol=2e-6)
            assert_parameters(light.parameters, lights[light.id].parameters)
        for id, material in first.materials.items():
            assert material.model == second.materials[id].model
            assert_parameters(material.parameters, second.materials[id].parameters)
        assert (first.film.width, first.film.band_kind) == (second.film.width, second.film.band_kind)


@pytest.fixture
def reopened(scene, library, tmp_path):
    """Return how to open something in Blender and write it again: the folder that comes out."""

    def written(**said) -> Path:
        assert bpy.ops.rtb.import_recipe(**said) == {"FINISHED"}
        opened = next(each for each in bpy.data.scenes if each.rtb.mappings_text)
        return library("blender").read_recipe(opened).save(tmp_path / "again")

    return written


def test_a_folder_renders_the_same_after_it_was_opened_in_blender_and_written(recipe, reopened, library):
    folder = reopened(filepath=str(recipe.folder))
    assert_renders_the_same(scenes_of(library, recipe.folder), scenes_of(library, folder))
    again = library("recipe").Recipe.load(folder)
    assert again.options.band_kind == "centre"
    assert again.options.layers == ("depth", "standard_error")
    assert "maxDepth" in again.mappings.text


def test_names_that_are_taken_are_others_in_the_mappings_too(recipe, reopened, library):
    for home, name in (("materials", "Paint"), ("lights", "Lamp"), ("meshes", "Floor")):
        getattr(bpy.data, home).new(*((name, "POINT") if home == "lights" else (name,)))
    bpy.data.objects.new("Lamp", None)
    folder = reopened(filepath=str(recipe.folder))
    once, again = scenes_of(library, recipe.folder), scenes_of(library, folder)
    for name, one in once.items():
        other = again[name]
        assert [each.to_world.tolist() for each in one.lights] == [
            pytest.approx(each.to_world, abs=1e-6) for each in other.lights
        ]
        for first, second in zip(one.shapes, other.shapes, strict=True):
            np.testing.assert_allclose(corners(first), corners(second), rtol=1e-6, atol=1e-5)
            before, after = one.materials[first.material], other.materials[second.material]
            assert before.model == after.model
            assert_parameters(before.parameters, after.parameters)


def test_a_zip_is_unpacked_and_opened(recipe, reopened, library, tmp_path):
    library("recipe.packing").pack_recipe(recipe, tmp_path / "old.zip")
    folder = reopened(filepath=str(tmp_path / "old.zip"), output=str(tmp_path / "unpacked"))
    assert_renders_the_same(scenes_of(library, recipe.folder), scenes_of(library, folder))


def test_old_files_are_told_from_each_other_and_opened(recipe, reopened, library, tmp_path):
    place = tmp_path / "loose"
    place.mkdir()
    for name in ("parent.dae", "conditions.txt", "mappings.txt", "resources/paint.spd"):
        (place / Path(name).name).write_bytes((recipe.folder / name).read_bytes())
    library("old_recipes").import_recipe(
        place / "parent.dae", place / "conditions.txt", place / "mappings.txt", tmp_path / "plain"
    )
    files = [{"name": name} for name in ("mappings.txt", "parent.dae", "conditions.txt")]
    folder = reopened(directory=f"{place}/", files=files, output=str(tmp_path / "made"))
    assert_renders_the_same(scenes_of(library, tmp_path / "plain"), scenes_of(library, folder))


def test_mappings_in_json_become_blocks_that_say_the_same(builder, reopened, library, tmp_path):
    scene = builder.SceneBuilder()
    scene.camera("Camera", placement=builder.Placement(location=(0, 0, 6)))
    scene.point("Lamp", placement=builder.Placement(location=(1, 2, 3)))
    scene.plane("Floor", material="Paint")
    (tmp_path / "scene.dae").write_bytes(scene.tobytes())
    (tmp_path / "table.txt").write_text("imageName\theight\tpaint\na\t1\t0.2\nb\t2\t0.7\n")
    (tmp_path / "mappings.json").write_text(
        """[ { "name": "Lamp", "broadType": "nodes", "operation": "update", "destination": "mexximp",
               "properties": { "name": "transformation",
                               "operation": "mexximpTranslate([0 0 (height)]) * oldValue" } },
             { "name": "Paint", "broadType": "materials", "specificType": "matte", "operation": "update",
               "properties": { "name": "diffuseReflectance", "valueType": "spectrum",
                               "value": "(paint)" } } ]"""
    )
    library("old_recipes").import_recipe(
        tmp_path / "scene.dae", tmp_path / "table.txt", tmp_path / "mappings.json", tmp_path / "plain"
    )
    files = [{"name": name} for name in ("scene.dae", "table.txt", "mappings.json")]
    folder = reopened(directory=f"{tmp_path}/", files=files, output=str(tmp_path / "made"))
    assert_renders_the_same(scenes_of(library, tmp_path / "plain"), scenes_of(library, folder))


def test_a_node_whose_place_is_one_matrix_keeps_the_meaning_of_its_paths(recipe, reopened, library):
    file = recipe.folder / "parent.dae"
    root = etree.fromstring(file.read_bytes())
    lamp = root.find(".//{*}node[@id='Lamp']")
    for each in [each for each in lamp if each.get("sid")]:
        lamp.remove(each)
    matrix = etree.SubElement(lamp, "{*}matrix".replace("*", etree.QName(lamp).namespace), sid="transform")
    matrix.text = "0 -1 0 7 1 0 0 2 0 0 1 10 0 0 0 1"
    lamp.insert(0, matrix)
    file.write_bytes(etree.tostring(root))
    once = scenes_of(library, recipe.folder)
    assert [each.lights[0].to_world[2, 3] for each in once.values()] == [11.5, 14], (
        "the matrix, then the path"
    )
    assert_renders_the_same(once, scenes_of(library, reopened(filepath=str(recipe.folder))))


def test_a_scene_whose_y_axis_is_up_keeps_the_meaning_of_its_paths(recipe, reopened, library):
    file = recipe.folder / "parent.dae"
    file.write_text(file.read_text().replace("<up_axis>Z_UP</up_axis>", "<up_axis>Y_UP</up_axis>"))
    folder = reopened(filepath=str(recipe.folder))
    assert_renders_the_same(scenes_of(library, recipe.folder), scenes_of(library, folder))


def opened_and_written(library, tmp_path, **said) -> list[Path]:
    """Open something in Blender and write every scene that it became: the folders that come out."""
    before = set(bpy.data.scenes)
    assert bpy.ops.rtb.import_recipe(**said) == {"FINISHED"}
    opened = [each for each in bpy.data.scenes if each not in before]
    return [library("blender").read_recipe(each).save(tmp_path / "again" / each.rtb.name) for each in opened]


def assert_rows_render_the_same(library, recipe: Path, folders: list[Path]) -> None:
    """Compare each row of a recipe with that of the folder that has it; ids differ where names clash."""
    once = scenes_of(library, recipe)
    again = {name: scene for folder in folders for name, scene in scenes_of(library, folder).items()}
    assert sorted(once) == sorted(again)
    for name, one in once.items():
        other = again[name]
        np.testing.assert_allclose(one.camera.to_world, other.camera.to_world, atol=2e-6)
        for first, second in zip(one.lights, other.lights, strict=True):
            np.testing.assert_allclose(first.to_world, second.to_world, atol=2e-6)
        for first, second in zip(one.shapes, other.shapes, strict=True):
            np.testing.assert_allclose(corners(first), corners(second), rtol=1e-6, atol=1e-5)
            before, after = one.materials[first.material], other.materials[second.material]
            assert before.model == after.model
            assert_parameters(before.parameters, after.parameters)


def test_rows_with_parent_scenes_of_their_own_become_scenes_of_their_own(
    scene, recipe, library, builder, tmp_path
):
    other = builder.SceneBuilder()
    other.camera("Camera", placement=builder.Placement(location=(0, 0, 9)))
    other.point("Lamp", placement=builder.Placement(location=(3, 2, 1)))
    other.spot("Sun", placement=builder.Placement(location=(0, 0, 5)))
    other.plane("Floor", material="Paint")
    other.plane("Wall", material="Gloss", placement=builder.Placement(rotation=(90, 0, 0)))
    (recipe.folder / "resources/hall.dae").write_bytes(other.tobytes())
    table = recipe.folder / "conditions.txt"
    rows = [f"{line}\t" for line in table.read_text().splitlines()]
    rows[0] += "colladaFile"
    rows[1] += "parent.dae"
    rows[2] += "resources/hall.dae"
    table.write_text("\n".join(rows) + "\n")
    (recipe.folder / "mappings.txt").write_text(
        "Collada {\n    Lamp:translate|sid=location = 1 2 (height)\n}\nGeneric {\n"
        "    Paint-material:material:matte\n    Paint-material:diffuseReflectance.spectrum = (paint)\n}\n"
    )
    folders = opened_and_written(library, tmp_path, filepath=str(recipe.folder))
    assert sorted(each.name for each in folders) == ["old-hall", "old-parent"]
    assert_rows_render_the_same(library, recipe.folder, folders)
    assert any("each is a scene here" in each for each in library_findings(library))


def library_findings(library) -> list[str]:
    """Return what the panel says was left out."""
    return sys.modules[
        f"{library('errors').__package__.partition('.rtb_addon')[0]}.operators.findings"
    ].remarks


def in_json(builder, library, tmp_path, changes: str) -> tuple[Path, dict]:
    """Write old files with mappings in JSON; return the folder that they are without Blender, and which."""
    scene = builder.SceneBuilder()
    scene.camera("Camera", placement=builder.Placement(location=(0, 0, 6)))
    scene.point("Lamp", placement=builder.Placement(location=(1, 2, 3)))
    scene.point("Spare", placement=builder.Placement(location=(-1, 2, 3)))
    scene.plane("Floor", material="Paint")
    (tmp_path / "scene.dae").write_bytes(scene.tobytes())
    (tmp_path / "table.txt").write_text(
        "imageName\tgroupName\tpaint\na\tmatte\t0.2\nb\tshiny\t0.7\nc\tmatte\t0.4\n"
    )
    (tmp_path / "mappings.json").write_text(changes)
    names = ("scene.dae", "table.txt", "mappings.json")
    library("old_recipes").import_recipe(*(tmp_path / name for name in names), tmp_path / "plain")
    return tmp_path / "plain", {
        "directory": f"{tmp_path}/",
        "files": [{"name": name} for name in names],
        "output": str(tmp_path / "made"),
    }


PAINTED = """{ "name": "Paint", "broadType": "materials", "specificType": "matte", "operation": "update",
               "group": "matte", "properties": { "name": "diffuseReflectance", "valueType": "spectrum",
                                                 "value": "(paint)" } },
             { "name": "Paint", "broadType": "materials", "specificType": "anisoward",
               "operation": "update", "group": "shiny", "properties": [
                 { "name": "diffuseReflectance", "valueType": "spectrum", "value": "(paint)" },
                 { "name": "alphaU", "valueType": "float", "value": 0.2 } ] }"""


def test_mappings_in_json_that_change_other_things_in_other_rows_become_groups(
    scene, builder, library, tmp_path
):
    plain, files = in_json(builder, library, tmp_path, f"[ {PAINTED} ]")
    folders = opened_and_written(library, tmp_path, **files)
    assert len(folders) == 1
    assert_rows_render_the_same(library, plain, folders)


def test_mappings_in_json_may_shear_a_node_and_speak_twice_of_a_material(scene, builder, library, tmp_path):
    sheared = """{ "name": "Floor", "broadType": "nodes", "operation": "update", "destination": "mexximp",
        "properties": { "name": "transformation", "operation":
            "oldValue * mexximpRotate([0 0 1], 0.5) * mexximpScale([1 2 1]) * mexximpRotate([0 0 1], 1)" } },
      { "name": "Paint", "broadType": "materials", "specificType": "matte", "operation": "update",
        "properties": { "name": "diffuseReflectance", "valueType": "spectrum", "value": "0.1" } },
      { "name": "Paint", "broadType": "materials", "specificType": "matte", "operation": "update",
        "properties": { "name": "diffuseReflectance", "valueType": "spectrum", "value": "(paint)" } }"""
    plain, files = in_json(builder, library, tmp_path, f"[ {sheared} ]")
    folders = opened_and_written(library, tmp_path, **files)
    assert_rows_render_the_same(library, plain, folders)


def test_what_mappings_in_json_delete_is_not_in_the_scene_of_those_rows(scene, builder, library, tmp_path):
    gone = """{ "name": "Spare", "broadType": "nodes", "operation": "delete", "group": "shiny",
                "destination": "mexximp", "properties": [] }"""
    plain, files = in_json(builder, library, tmp_path, f"[ {gone}, {PAINTED} ]")
    folders = opened_and_written(library, tmp_path, **files)
    assert [each.name for each in folders] == ["scene-1", "scene-2"]
    assert_rows_render_the_same(library, plain, folders)
    assert len(scenes_of(library, folders[1])["b"].lights) == 1


@pytest.mark.parametrize(
    ("names", "why"),
    [
        (("a.txt",), "choose a Collada file"),
        (("a.dae", "b.dae"), "are both parent"),
        (("gone.dae",), "cannot read"),
    ],
)
def test_files_that_are_no_recipe_are_refused_in_one_sentence(scene, tmp_path, names, why):
    for name in names:
        if name != "gone.dae":
            (tmp_path / name).write_text("words")
    before = len(bpy.data.scenes)
    with pytest.raises(RuntimeError, match=why):
        bpy.ops.rtb.import_recipe(directory=f"{tmp_path}/", files=[{"name": name} for name in names])
    assert len(bpy.data.scenes) == before
