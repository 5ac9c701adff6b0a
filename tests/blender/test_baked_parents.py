"""Parent scenes that a function bakes: one for each condition that differs, and the scene afterwards."""

import re

import bpy
import numpy as np
import pytest

from tests.blender.recipe_sentences import sentence


@pytest.fixture
def read(library):
    """Return how to read a scene's recipe, remodeled by a function."""
    return library("blender").read_recipe


@pytest.fixture
def state(library):
    """Return how to see all that is kept of the open file, by list, datablock and place."""
    keeping, kept_values = library("blender.keeping"), library("blender.kept_values")

    def everything() -> dict[tuple, str]:
        # A datablock that comes back has another number in the session.
        return {
            (home, each.name_full, *where): re.sub(r"\('<datablock>', (\d+)\)", _name_of, repr(value))
            for home, each in keeping._all()
            for where, value in kept_values.values_of(each, {}).items()
        }

    return everything


def _name_of(number: re.Match) -> str:
    lists = (each.identifier for each in bpy.data.bl_rna.properties if each.type == "COLLECTION")
    for datablock in (each for name in lists for each in getattr(bpy.data, name)):
        if datablock.session_uid == int(number[1]):
            return datablock.name_full
    return "nothing"


@pytest.fixture
def still(scene, box, lamp):
    """A box with a modifier, a shape key, nodes and an animation, under a lamp; all tagged."""
    body = box(location=(0, 0, -5))
    light = lamp().data
    light.rtb.use_spectra, light.shadow_soft_size = True, 0
    paint = bpy.data.materials["Paint"]
    paint.rtb.use_spectra, paint.rtb.reflectance = True, "0.5"
    body.modifiers.new("Smooth", "SUBSURF").render_levels = 0
    body.modifiers.new("Shift", "NODES").node_group = _shift()
    body.shape_key_add(name="Basis")
    for point in body.shape_key_add(name="Tall").data:
        point.co[2] *= 3
    body.vertex_groups.new(name="Some").add([0, 1], 0.25, "ADD")
    body["note"] = [1.5, 2.5]
    for frame, place in ((1, 0.0), (11, 3.0)):
        body.location[0] = place
        body.keyframe_insert("location", index=0, frame=frame)
    scene.frame_set(1)
    body.location[0] = 0.125  # not the animation's: an edit that nobody has keyed yet
    return scene


def _shift():
    """Return geometry nodes that move everything by a vector, their input."""
    tree = bpy.data.node_groups.new("Shift", "GeometryNodeTree")
    tree.interface.new_socket("Geometry", in_out="INPUT", socket_type="NodeSocketGeometry")
    tree.interface.new_socket("Offset", in_out="INPUT", socket_type="NodeSocketVector")
    tree.interface.new_socket("Geometry", in_out="OUTPUT", socket_type="NodeSocketGeometry")
    entry, move, leaving = (
        tree.nodes.new(kind) for kind in ("NodeGroupInput", "GeometryNodeSetPosition", "NodeGroupOutput")
    )
    tree.links.new(entry.outputs[0], move.inputs["Geometry"])
    tree.links.new(entry.outputs[1], move.inputs["Offset"])
    tree.links.new(move.outputs[0], leaving.inputs[0])
    return tree


def subdivided(scene, value) -> None:
    bpy.data.objects["Box"].modifiers["Smooth"].render_levels = int(value)


def grown(scene, value) -> None:
    bpy.data.objects["Box"].data.shape_keys.key_blocks["Tall"].value = float(value)


def played(scene, value) -> None:
    scene.frame_set(int(value))


def shifted(scene, value) -> None:
    bpy.data.objects["Box"].modifiers["Shift"]["Socket_1"] = (float(value), 0.0, 0.0)


VALUES = {
    subdivided: ("0", "2", "0", "1"),
    grown: ("0", "1", "0", "0.5"),
    played: ("1", "11", "1", "6"),
    shifted: ("0", "4", "0", "-1.5"),
}
NAMES = ("first", "second", "as-first", "the third")


def set_rows(library, scene, values) -> None:
    library("blender").set_conditions(
        scene, ["imageName", "value"], list(zip(NAMES[: len(values)], values, strict=True))
    )


def parents_of(recipe) -> list[bytes]:
    """Return the parent scene of each condition."""
    files = {"": recipe.parent, "parent.dae": recipe.parent}
    files |= {f"resources/{name}": content for name, content in recipe.resources.items()}
    return [files[each.parent_scene] for each in recipe.conditions]


# What is written


@pytest.mark.parametrize("act", VALUES)
def test_every_row_has_the_parent_scene_of_the_scene_set_up_by_hand(still, read, library, act):
    set_rows(library, still, VALUES[act])
    parents = parents_of(read(still, lambda scene, condition: act(scene, condition.cells["value"])))
    for value, parent in zip(VALUES[act], parents, strict=True):
        act(still, value)
        assert read(still).parent == parent
    assert len(set(parents)) == 3


def test_there_are_as_many_parent_scenes_as_there_are_different_ones(still, read, library, tmp_path):
    set_rows(library, still, VALUES[grown])
    recipe = read(still, lambda scene, condition: grown(scene, condition.cells["value"]))
    folder = recipe.save(tmp_path / "family")
    files = sorted(str(each.relative_to(folder)) for each in folder.rglob("*.dae"))
    assert files == ["parent.dae", "resources/parent-second.dae", "resources/parent-the third.dae"]
    named = [each.parent_scene for each in recipe.conditions]
    assert named == ["parent.dae", files[1], "parent.dae", files[2]]
    assert library("recipe").Recipe.load(folder).problems() == []


def test_a_function_that_changes_nothing_adds_no_column(still, read, library):
    set_rows(library, still, ("1", "2"))
    recipe = read(still, lambda scene, condition: None)
    assert recipe.conditions.variables == ("imageName", "value")
    assert recipe.parent == read(still).parent


def test_the_tracer_renders_the_parent_scene_of_each_row(still, read, library, tmp_path):
    values = ("0", "40", "0")
    set_rows(library, still, values)
    folder = read(still, lambda scene, condition: shifted(scene, condition.cells["value"])).save(
        tmp_path / "one"
    )
    events = list(library("batch").render_recipe(folder, renderer="tracer", jobs=1, samples=4))
    assert not [each for each in events if each.kind == "failed"], events
    recipe = library("recipe").Recipe.load(folder).overridden(renderer="tracer")
    load = library("spectral_image").SpectralImage.load
    first, second, third = (load(recipe.rendering_file(each)).radiance for each in recipe.conditions)
    assert first.max() > 0
    assert second.max() == 0  # out of sight
    np.testing.assert_array_equal(first, third)


# Spectra and amounts that differ


def resolved(library, recipe, folder, name):
    """Return what renderers see of a condition."""
    from_disk = library("recipe").Recipe.load(recipe.save(folder))
    condition, scenes = from_disk.conditions[name], library("recipe.condition_scene")
    adjustments = scenes.adjustments_of(from_disk, condition, from_disk.find_file)
    return scenes.resolve_condition(from_disk, condition, adjustments).scene


def test_tags_and_amounts_that_a_function_sets_become_columns(still, read, library, tmp_path):
    def act(scene, condition):
        value = float(condition.cells["value"])
        bpy.data.materials["Paint"].rtb.reflectance = f"{value / 8}"
        light = bpy.data.lights["Lamp"]
        light.energy, light.shadow_soft_size = 100 * value, value / 100

    set_rows(library, still, ("1", "2", "1"))
    recipe = read(still, act)
    for name, value in (("first", 1), ("second", 2), ("as-first", 1)):
        scene = resolved(library, recipe, tmp_path / "family", name)
        paint = scene.materials["Paint-material"].parameters["diffuseReflectance"]
        np.testing.assert_allclose(paint.values, value / 8)
        (light,) = scene.lights
        assert light.parameters["intensity"].integral() == pytest.approx(100 * value / (4 * np.pi), rel=1e-6)
        assert light.parameters["radius"] == pytest.approx(value / 100, rel=1e-6)
    assert {"Paint.spd", "Paint-2.spd", "Lamp.spd", "Lamp-2.spd"} == {
        each for each in recipe.resources if each.endswith(".spd")
    }


def test_a_variable_counts_in_the_rows_whose_tags_use_it(still, read, library, tmp_path):
    def act(scene, condition):
        if condition.name == "second":
            bpy.data.materials["Paint"].rtb.reflectance = "(value)"

    set_rows(library, still, ("0.25", "0.75"))
    recipe = read(still, act)
    for name, value in (("first", 0.5), ("second", 0.75)):
        scene = resolved(library, recipe, tmp_path / "family", name)
        paint = scene.materials["Paint-material"].parameters["diffuseReflectance"]
        np.testing.assert_allclose(paint.values, value)
    assert [each.cells["value"] for each in recipe.conditions] == ["0.25", "0.75"]


def test_a_camera_that_a_function_chooses_becomes_a_column(still, put, read, library):
    put("Eye.two", bpy.data.cameras.new("Eye"), location=(0, 0, 9))
    set_rows(library, still, ("Camera", "Eye.two"))
    recipe = read(still, lambda scene, row: setattr(scene, "camera", bpy.data.objects[row.cells["value"]]))
    assert [each.cells["camera"] for each in recipe.conditions] == ["Camera", "Eye_two"]
    assert still.camera.name == "Camera"


# The scene is given back


def lost_modifiers(scene):
    bpy.data.objects["Box"].modifiers.clear()


def new_things(scene):
    body = bpy.data.objects["Box"]
    body.modifiers.new("Bevel", "BEVEL")
    body.constraints.new("COPY_LOCATION").target = scene.camera
    scene.collection.objects.link(bpy.data.objects.new("Twin", body.data))
    bpy.data.materials.new("New").use_nodes = True
    body["new"] = "note"


def own_properties(scene):
    shifted(scene, "3")
    body = bpy.data.objects["Box"]
    body.name, body.scale, body.rotation_mode = "Renamed", (1, 2, 3), "QUATERNION"
    body["note"], body.rtb.emits, body.parent = [3.5], True, scene.camera
    body.matrix_world[0][3] = 4.0
    body.data.vertices[0].co = (7, 7, 7)
    body.vertex_groups["Some"].add([0], 0.75, "REPLACE")
    bpy.data.node_groups["Shift"].nodes["Set Position"].inputs["Offset"].default_value = (1, 2, 3)
    bpy.data.lights["Lamp"].type = "SUN"
    scene.camera.data.lens, scene.render.resolution_x, scene.camera = 20, 99, None


def another_frame(scene):
    scene.frame_set(7, subframe=0.5)
    bpy.data.objects["Box"].keyframe_insert("scale", frame=7)
    scene.camera.keyframe_insert("location", frame=2)


def lost_geometry(scene):
    bpy.data.objects["Box"].data.clear_geometry()


def lost_objects(scene):
    bpy.data.objects.remove(bpy.data.objects["Box"])
    bpy.data.objects.remove(bpy.data.objects["Lamp"])


def lost_contents(scene):
    bpy.data.meshes.remove(bpy.data.objects["Box"].data)
    bpy.data.materials.remove(bpy.data.materials["Paint"])
    bpy.data.node_groups.remove(bpy.data.node_groups["Shift"])


def lost_nodes(scene):
    bpy.data.node_groups["Shift"].nodes.clear()


EDITS = (
    lost_modifiers,
    new_things,
    own_properties,
    another_frame,
    lost_geometry,
    lost_objects,
    lost_contents,
    lost_nodes,
)


@pytest.mark.parametrize("edit", EDITS)
def test_whatever_a_function_does_is_taken_back_exactly(still, read, library, state, edit):
    set_rows(library, still, ("1", "2"))
    exported, before, changed = read(still).parent, state(), []

    def act(scene, condition):
        edit(scene)
        changed.append(state() != before)
        raise ValueError("far enough")

    said = sentence(library, lambda: read(still, act))
    assert said == "the condition first cannot be remodeled: ValueError: far enough"
    assert changed == [True]
    after = state()
    differing = [where for where in {**before, **after} if before.get(where) != after.get(where)]
    assert [(where, before.get(where), after.get(where)) for where in differing] == []
    assert read(still).parent == exported


def test_references_that_the_function_holds_stay_good_from_row_to_row(still, read, library):
    modifier, key = bpy.data.objects["Box"].modifiers["Smooth"], bpy.data.shape_keys[0].key_blocks["Tall"]
    set_rows(library, still, ("0", "1", "2"))

    def act(scene, condition):
        modifier.render_levels, key.value = int(condition.cells["value"]), 0.5

    assert len(set(parents_of(read(still, act)))) == 3
    assert (modifier.render_levels, key.value) == (0, 0.0)


def test_what_is_selected_and_active_stays_so(still, read, library):
    layer, body, lamp = bpy.context.view_layer, bpy.data.objects["Box"], bpy.data.objects["Lamp"]
    layer.objects.active = body
    body.select_set(True)
    lamp.select_set(False)
    lamp.hide_set(True)

    def act(scene, condition):
        bpy.ops.mesh.primitive_cube_add()
        bpy.context.object.data.materials.append(bpy.data.materials["Paint"])
        lamp.hide_set(False)

    set_rows(library, still, ("1",))
    read(still, act)
    assert layer.objects.active == body
    assert [each.name for each in layer.objects if each.select_get()] == ["Box"]
    assert lamp.hide_get()
    assert "Cube" not in bpy.data.objects


# What is refused


def only_in(name, edit):
    return lambda scene, condition: edit() if condition.name == name else None


def test_what_one_text_of_mappings_cannot_say_is_refused(still, lamp, read, library):
    lamp(name="Other")
    set_rows(library, still, ("1", "2"))
    hide = only_in("second", lambda: setattr(bpy.data.objects["Other"], "hide_render", True))
    assert "first has Other-light, second has not" in sentence(library, lambda: read(still, hide))
    turn = only_in("second", lambda: setattr(bpy.data.lights["Other"], "type", "SUN"))
    said = sentence(library, lambda: read(still, turn))
    assert "Other-light is a point light in the condition first and a directional light in second" in said
    assert (bpy.data.lights["Other"].type, bpy.data.objects["Other"].hide_render) == ("POINT", False)


def test_a_scene_that_cannot_be_written_is_refused_with_its_condition(still, read, library):
    set_rows(library, still, ("1", "2"))
    act = only_in("second", lambda: setattr(bpy.context.scene, "camera", None))
    said = sentence(library, lambda: read(still, act))
    assert said.startswith("the condition second cannot be written: the scene Scene has no camera")
    assert still.camera is not None


def test_what_cannot_be_taken_back_is_said(still, read, library):
    set_rows(library, still, ("1", "2"))
    bpy.data.scenes.new("Other")
    said = sentence(library, lambda: read(still, lambda *_: bpy.data.scenes.remove(bpy.data.scenes["Other"])))
    assert said == "what was done to Other cannot be taken back, load the .blend file again"


def test_a_function_needs_conditions_and_its_own_column(still, read, library):
    assert "no conditions to remodel" in sentence(library, lambda: read(still, lambda *_: None))
    library("blender").set_conditions(still, ["imageName", "colladaFile"], [("a", "b.dae")])
    assert "the column colladaFile" in sentence(library, lambda: read(still, lambda *_: None))
