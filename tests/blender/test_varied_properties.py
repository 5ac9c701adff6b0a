"""Properties that conditions set: what is written, what is previewed, and that all is as before after it."""

from concurrent.futures import ThreadPoolExecutor

import bpy
import numpy as np
import pytest

from tests.blender.test_baked_parents import _shift, parents_of


@pytest.fixture
def still(scene, box, lamp):
    """A box with a modifier, a shape key and nodes, under a lamp, before a second camera."""
    body = box(location=(0, 0, -5))
    lamp().data.shadow_soft_size = 0
    body.modifiers.new("Smooth", "SUBSURF").render_levels = 0
    body.modifiers.new("Shift", "NODES").node_group = _shift()
    body.shape_key_add(name="Basis")
    for point in body.shape_key_add(name="Tall").data:
        point.co[2] *= 3
    body["note"] = 1.5
    other = bpy.data.objects.new("Other", bpy.data.cameras.new("Other"))
    scene.collection.objects.link(other)
    world = scene.world = bpy.data.worlds.new("World")
    world.rtb.use_spectra = True
    scene.rtb.folder = "/nowhere/"
    return scene


# Home, thing, path, index, and what three conditions say.
VARIED = {
    "location": ("objects", "Box", "location", 0, ("0", "0.5", "-2.25")),
    "whole location": ("objects", "Lamp", "location", -1, ("0 0 3", "1 2 3", "-1 0.125 5")),
    "rotation": ("objects", "Box", "rotation_euler", 2, ("0", "45", "-30")),
    "scale": ("objects", "Box", "scale", 1, ("1", "2", "0.5")),
    "power": ("lights", "Lamp", "energy", -1, ("10", "20", "35")),
    "colour of a lamp": ("lights", "Lamp", "color", -1, ("1 1 1", "1 0.5 0.25", "0 1 0")),
    "size of a lamp": ("lights", "Lamp", "shadow_soft_size", -1, ("0", "0.1", "0.25")),
    "lens": ("cameras", "Camera", "lens", -1, ("50", "35", "85")),
    "shift": ("cameras", "Camera", "shift_x", -1, ("0", "0.1", "-0.2")),
    "kind of camera": ("cameras", "Camera", "type", -1, ("PERSP", "ORTHO", "Perspective")),
    "levels": ("objects", "Box", 'modifiers["Smooth"].render_levels', -1, ("0", "1", "2")),
    "input of nodes": ("objects", "Box", 'modifiers["Shift"]["Socket_1"]', 0, ("0", "1", "-1.5")),
    "shape": ("shape_keys", "Key", 'key_blocks["Tall"].value', -1, ("0", "1", "0.5")),
    "visibility": ("objects", "Box", "hide_render", -1, ("no", "no", "yes")),
    "frame": ("scenes", "Scene", "frame_current", -1, ("1", "11", "6")),
    "camera": ("scenes", "Scene", "camera", -1, ("Camera", "Other", "Camera")),
    "world": ("worlds", "World", "rtb.amount", -1, ("1", "2", "0.5")),
    "colour": ("materials", "Paint", "diffuse_color", -1, ("0.5 0.5 0.5", "1 0 0", "0 0 1")),
}


def vary(home: str, thing: str, path: str, index: int, cells: tuple[str, ...]) -> str:
    """Let conditions vary a property as the button does, and write three cells."""
    bpy.ops.rtb.vary_property(home=home, thing=thing, path=path, index=index, variable="v")
    settings = bpy.context.scene.rtb
    while len(settings.conditions) < len(cells):
        bpy.ops.rtb.add_condition()
    first = settings.conditions[0].cells[0].value
    for row, cell in zip(settings.conditions, cells, strict=True):
        row.cells[0].value = cell
    return first


def state(library) -> dict:
    """Return all that the open file holds, to the bit, but for the table and the mappings."""
    keeping, kept_values = library("blender.keeping"), library("blender.kept_values")
    kept_values.forget_types()  # as keeping does: the extension may have been disabled in between
    return {
        (each.session_uid, *where): repr(value)
        for _, each in keeping._all()
        for where, value in kept_values.values_of(each, {}).items()
        if "rtb" not in where or isinstance(each, bpy.types.World)
    }


@pytest.mark.parametrize("what", VARIED)
def test_a_condition_is_written_as_the_scene_set_up_by_hand(still, library, what):
    home, thing, path, index, cells = VARIED[what]
    if what == "frame":
        animate(bpy.data.objects["Box"])
    vary(home, thing, path, index, cells)
    read = library("blender").read_recipe
    before = state(library)
    recipe = read(still)
    assert state(library) == before
    written = [resolved(library, recipe, number) for number in range(3)]
    mapping = library("blender.mapped")
    for number, cell in enumerate(cells):
        place, value = mapping.value_for(still.rtb.mappings[0], {"v": cell})
        library("blender.places").set_value(place, value)
        kept = [(each.thing, each.path, each.index, each.value) for each in still.rtb.mappings]
        still.rtb.mappings.clear()
        by_hand = resolved(library, read(still), number)
        for thing_, path_, index_, text in kept:
            library("blender.mapping_edits").add_mapping(still.rtb, thing_, path_, index_, text)
        assert_same(by_hand, written[number])


def animate(body) -> None:
    for frame, place in ((1, 0.0), (11, 3.0)):
        body.location[0] = place
        body.keyframe_insert("location", index=0, frame=frame)


def resolved(library, recipe, number: int):
    """Return the neutral scene of one condition of a recipe that is nowhere but in memory."""
    from pathlib import Path
    from tempfile import mkdtemp

    folder = recipe.save(Path(mkdtemp(prefix="rtb-varied-")))
    loaded = library("recipe").Recipe.load(folder)
    condition = loaded.conditions.rows[number]
    said = library("recipe.condition_scene")
    adjustments = said.adjustments_of(loaded, condition, loaded.find_file)
    return said.resolve_condition(loaded, condition, adjustments).scene


def assert_same(one, other) -> None:
    """Assert that two neutral scenes are the same to 1e-6."""
    assert_close(one.camera, other.camera, ("to_world", "window", "clip"))
    assert one.camera.projection == other.camera.projection
    for name in ("shapes", "lights", "materials"):
        ours, theirs = (
            list(getattr(each, "values", lambda each=each: each)())
            for each in (getattr(one, name), getattr(other, name))
        )
        assert [each.id for each in ours] == [each.id for each in theirs]
        for mine, yours in zip(ours, theirs, strict=True):
            if hasattr(mine, "to_world"):
                assert_close(mine, yours, ("to_world",))
            if hasattr(mine, "mesh"):
                assert_close(mine.mesh, yours.mesh, ("vertices", "triangles"))
            if hasattr(mine, "parameters"):
                assert_parameters(mine.parameters, yours.parameters)
    assert (one.environment is None) == (other.environment is None)
    if one.environment is not None:
        assert_parameters(one.environment.parameters, other.environment.parameters)


def assert_close(one, other, names) -> None:
    for name in names:
        np.testing.assert_allclose(getattr(one, name), getattr(other, name), rtol=1e-6, atol=1e-6)


def assert_parameters(one, other) -> None:
    assert one.keys() == other.keys()
    for name, value in one.items():
        if hasattr(value, "values") and hasattr(value, "wavelengths"):
            np.testing.assert_allclose(value.values, other[name].values, rtol=1e-6)
        else:
            assert value == pytest.approx(other[name], rel=1e-6) if isinstance(value, float) else True


@pytest.mark.parametrize("what", VARIED)
def test_a_preview_shows_a_row_and_is_taken_back_to_the_bit(still, library, what):
    if what == "frame":
        animate(bpy.data.objects["Box"])
    vary(*VARIED[what])
    before = state(library)
    bpy.ops.rtb.preview_condition(show=True)
    shown = []
    for number in range(3):
        still.rtb.active_condition = number
        shown.append(state(library))
        assert not library("blender.preview").problems()
    assert any(each != shown[0] for each in shown[1:])
    bpy.ops.rtb.preview_condition(show=False)
    assert state(library) == before
    assert not len(still.rtb.kept)


def test_what_can_be_a_mapping_is_one_and_shares_the_parent_scene(still, library):
    for home, thing, path, index, name in (
        ("objects", "Lamp", "location", 2, "height"),
        ("objects", "Box", "rotation_euler", 1, "turn"),
        ("cameras", "Camera", "lens", -1, "lens"),
    ):
        bpy.ops.rtb.vary_property(home=home, thing=thing, path=path, index=index, variable=name)
    bpy.ops.rtb.paste_conditions(text="height\tturn\tlens\n1\t10\t35\n2\t20\t85\n")
    recipe = library("blender").read_recipe(still)
    assert len({*parents_of(recipe)}) == 1
    assert "Lamp:translate|sid=location = 0 0 (height)" in recipe.mappings
    assert "Box:rotate|sid=rotationY = 0 1 0 (turn)" in recipe.mappings
    assert "xfov" in recipe.mappings


def test_what_no_mapping_can_say_gets_a_parent_scene_for_each_value(still, library):
    vary(*VARIED["levels"])
    bpy.ops.rtb.add_condition()  # like the last one
    recipe = library("blender").read_recipe(still)
    parents = parents_of(recipe)
    assert len({*parents}) == 3
    assert parents[2] == parents[3]


def test_arithmetic_and_angles_are_as_the_interface_says_them(still, library):
    mapped, edits = library("blender.mapped"), library("blender.mapping_edits")
    settings = still.rtb
    for thing, path, index, text, value in (
        (bpy.data.objects["Box"], "rotation_euler", 0, "90 - (a)", np.radians(60)),
        (bpy.data.objects["Box"], "location", 1, "2 * (a) + (b) / 4", 61),
        (bpy.data.objects["Box"], "location", -1, "2 * (v)", [2, 4, 6]),
        (bpy.data.objects["Box"], "scale", -1, "(b)", [4, 4, 4]),
        (bpy.data.objects["Box"], "hide_render", -1, "1 - (one)", False),
    ):
        settings.mappings.clear()
        edits.add_mapping(settings, thing, path, index, text)
        cells = {"a": "30", "b": "4", "v": "1 2 3", "one": "1"}
        assert mapped.value_for(settings.mappings[0], cells)[1] == pytest.approx(value)


@pytest.mark.parametrize(
    ("spoil", "says"),
    [
        (lambda: bpy.data.objects.remove(bpy.data.objects["Box"]), "is gone"),
        (lambda: setattr(bpy.context.scene.rtb.mappings[0], "path", "lokation"), "has no lokation"),
        (lambda: setattr(bpy.context.scene.rtb.mappings[0], "value", "(w)"), "no variable is called w"),
        (lambda: setattr(bpy.context.scene.rtb.conditions[1].cells[0], "value", "far"), "'far'"),
        (lambda: animate(bpy.data.objects["Box"]), "animated"),
    ],
)
def test_a_broken_mapping_says_what_is_missing_everywhere(still, library, spoil, says):
    vary(*VARIED["location"])
    spoil()
    with pytest.raises(RuntimeError) as caught:
        bpy.ops.rtb.export_recipe()
    assert says in str(caught.value)
    assert any(says in each for each in library("blender.scene_problems").scene_problems(still))
    still.rtb.active_condition = 1
    if bpy.data.objects.get("Box") or says == "is gone":
        assert says in library("blender.mapping_sentences").missing(still, still.rtb.mappings[0])


@pytest.mark.parametrize(
    ("said", "why"),
    [
        ({"home": "scenes", "thing": "Scene", "path": "render.resolution_x"}, "are the recipe's"),
        ({"home": "objects", "thing": "Box", "path": "type"}, "lets nobody set it"),
        ({"home": "screens", "thing": "Layout", "path": "name"}, "nothing in screens can vary"),
        ({"home": "objects", "thing": "Bax", "path": "location"}, "nothing is called Bax"),
        ({"home": "objects", "thing": "Box", "path": "location", "index": 5}, "none is number 6"),
    ],
)
def test_what_cannot_vary_is_refused_in_one_sentence(still, said, why):
    with pytest.raises(RuntimeError, match=why):
        bpy.ops.rtb.vary_property(**said)
    assert not len(still.rtb.variables)


def test_a_property_varies_only_once(still):
    vary(*VARIED["location"])
    with pytest.raises(RuntimeError, match="varies already"):
        bpy.ops.rtb.vary_property(home="objects", thing="Box", path="location", index=-1)
    bpy.ops.rtb.vary_property(home="objects", thing="Box", path="location", index=1)
    names = [each.name for each in still.rtb.mappings]
    assert names == ["Location X of the object Box", "Location Y of the object Box"]


def test_a_scene_is_read_in_steps_and_is_as_before_at_each(still, library):
    bpy.ops.rtb.vary_property(home="objects", thing="Lamp", path="location", index=2, variable="height")
    bpy.ops.rtb.fill_range(variable="height", how="ADD", first=1, last=4, count=4)
    reading, lamp = library("blender.reading"), bpy.data.objects["Lamp"]
    before, shares, heights = lamp.location[2], [], set()
    steps = reading.read_in_steps(still)
    try:
        while True:
            shares.append(next(steps))
            heights.add(lamp.location[2])
    except StopIteration as end:
        finish = end.value
    assert shares == sorted(shares)
    assert (len(shares), shares[-1]) == (len(still.rtb.conditions), 1.0)
    assert heights == {before}
    with ThreadPoolExecutor(1) as thread:
        stepwise = thread.submit(finish).result()
    at_once = library("blender").read_recipe(still)
    assert (stepwise.parent, stepwise.mappings) == (at_once.parent, at_once.mappings)
    assert stepwise.resources == at_once.resources


def test_reading_that_is_left_in_the_middle_leaves_the_scene_and_its_preview(still, library):
    bpy.ops.rtb.vary_property(home="objects", thing="Lamp", path="location", index=2, variable="height")
    bpy.ops.rtb.fill_range(variable="height", how="ADD", first=1, last=4, count=4)
    bpy.ops.rtb.preview_condition(show=True)
    lamp = bpy.data.objects["Lamp"]
    assert lamp.location[2] == 4
    steps = library("blender.reading").read_in_steps(still)
    next(steps)
    assert lamp.location[2] == 3, "nothing is previewed meanwhile"
    steps.close()
    assert lamp.location[2] == 4
    bpy.ops.rtb.preview_condition(show=False)
    assert lamp.location[2] == 3
