"""From Blender's scene to a recipe: what is written, what is assumed, what is refused."""

import bpy
import numpy as np
import pytest


@pytest.fixture
def still(scene, box, lamp):
    """A scene that can be read: a tagged box and a tagged lamp."""
    box()
    lamp().data.rtb.use_spectra = True
    bpy.data.materials["Paint"].rtb.use_spectra = True
    bpy.data.materials["Paint"].rtb.reflectance = "0.5"
    return scene


def sentence(library, act) -> str:
    """Return the one sentence that something is refused with."""
    with pytest.raises(library("errors").RecipeError) as caught:
        act()
    text = str(caught.value)
    assert not text.endswith(".")
    assert "\n" not in text
    return text


# What is written


def test_an_unchanged_scene_is_written_with_the_same_bytes(still, read, tmp_path):
    contents = []
    for name in ("first", "second", "first"):
        folder = read(still).save(tmp_path / name)
        contents.append({file.name: file.read_bytes() for file in folder.rglob("*") if file.is_file()})
    assert contents[0] == contents[1] == contents[2]
    assert {"parent.dae", "mappings.txt", "recipe.json", "Paint.spd", "Lamp.spd"} <= set(contents[0])


def test_reading_leaves_the_scene_as_it_was(still, read):
    engine, names = still.render.engine, [each.name for each in bpy.data.scenes]
    read(still)
    assert (still.render.engine, [each.name for each in bpy.data.scenes]) == (engine, names)
    assert not hasattr(bpy.types, "LookingEngine")


def test_a_recipe_folder_renders_without_blender(still, read, library, tmp_path):
    recipe = library("recipe").Recipe.load(read(still).save(tmp_path / "still"))
    assert recipe.problems() == []
    assert (recipe.options.width, recipe.options.height, recipe.options.camera) == (8, 6, "Camera")
    assert recipe.provenance["blender"] == bpy.app.version_string


def test_what_is_hidden_from_renders_is_left_out_and_what_only_renders_is_there(still, box, read):
    box("Hidden").hide_render = True
    box("OnlyRendered").hide_viewport = True
    modifier = bpy.data.objects["Box"].modifiers.new("Subdivision", "SUBSURF")
    modifier.levels, modifier.render_levels = 0, 2
    parent = read(still).parent
    assert b'id="Hidden"' not in parent
    assert b'id="OnlyRendered"' in parent
    assert parent.count(b'<triangles material="Paint-material" count="192"') == 1


def test_children_of_what_is_hidden_stay_where_they_are(still, box, resolved):
    above = box("Above", location=(0, 0, 5))
    below = box("Below", location=(1, 0, 0))
    below.parent, above.hide_render = above, True
    shapes = {each.id: each.to_world for each in resolved(still).shapes}
    assert "Above-mesh" not in shapes
    np.testing.assert_allclose(shapes["Below-mesh"][:3, 3], (1, 0, 5))


def test_names_that_clean_to_the_same_id_do_not_meet(still, box, resolved):
    box("a.b", location=(1, 0, 0))
    box("a_b", location=(2, 0, 0))
    box("a b", location=(3, 0, 0))
    places = {each.id: float(each.to_world[0, 3]) for each in resolved(still).shapes}
    assert places == {"Box-mesh": 0.0, "a_b-mesh": 2.0, "a_b2-mesh": 3.0, "a_b3-mesh": 1.0}


def test_shared_meshes_and_instances_are_written_once(still, box, put, read, resolved):
    model = box("Model")
    put("Twin", model.data, location=(5, 0, 0))
    family = bpy.data.collections.new("Family")
    family.objects.link(model)
    for place in range(3):
        placed = put(f"Group.{place}", None, location=(0, 3 * place, 0), rotation_euler=(0, 0, place))
        placed.instance_type, placed.instance_collection = "COLLECTION", family
    assert read(still).parent.count(b"<geometry id=") == 2
    assert_same_as_blender(still, resolved)


def test_what_geometry_nodes_scatter_is_there(still, box, put, read, resolved):
    seed = box("Seed")
    grid = bpy.data.meshes.new("Grid")
    grid.from_pydata([(0, 0, 4), (2, 0, 4), (0, 2, 4)], [], [(0, 1, 2)])
    grid.materials.append(bpy.data.materials["Paint"])
    field = put("Field", grid, location=(1, 2, 3))
    tree = bpy.data.node_groups.new("Scatter", "GeometryNodeTree")
    tree.interface.new_socket("Geometry", in_out="INPUT", socket_type="NodeSocketGeometry")
    tree.interface.new_socket("Geometry", in_out="OUTPUT", socket_type="NodeSocketGeometry")
    kinds = ("NodeGroupInput", "GeometryNodeInstanceOnPoints", "GeometryNodeObjectInfo", "NodeGroupOutput")
    entry, scatter, info, leaving = (tree.nodes.new(kind) for kind in kinds)
    info.inputs["Object"].default_value = seed
    info.inputs["As Instance"].default_value = True
    tree.links.new(entry.outputs[0], scatter.inputs["Points"])
    tree.links.new(info.outputs["Geometry"], scatter.inputs["Instance"])
    tree.links.new(scatter.outputs[0], leaving.inputs[0])
    field.modifiers.new("Scatter", "NODES").node_group = tree
    assert len(resolved(still).shapes) == 5
    assert read(still).parent.count(b"<geometry id=") == 2
    assert_same_as_blender(still, resolved)


def test_curves_and_texts_and_metaballs_become_meshes(still, put, resolved):
    curve = bpy.data.curves.new("Ring", "CURVE")
    curve.splines.new("NURBS").points.add(3)
    for point, place in zip(curve.splines[0].points, ((0, 0), (1, 0), (1, 1), (0, 1)), strict=True):
        point.co = (*place, 0, 1)
    curve.dimensions, curve.bevel_depth = "3D", 0.1
    text = bpy.data.curves.new("Word", "FONT")
    text.body = "RTB"
    ball = bpy.data.metaballs.new("Drop")
    ball.elements.new().radius, ball.render_resolution = 1, ball.resolution
    for name, content in (("Ring", curve), ("Word", text), ("Drop", ball)):
        content.materials.append(bpy.data.materials["Paint"])
        put(name, content, location=(1, 2, 3))
    assert {each.id for each in resolved(still).shapes} == {"Box-mesh", "Ring-mesh", "Word-mesh", "Drop-mesh"}
    assert_same_as_blender(still, resolved)


def test_a_material_that_an_object_has_for_itself_counts(still, box, put, resolved):
    own = put("Own", bpy.data.objects["Box"].data)
    own.material_slots[0].link = "OBJECT"
    own.material_slots[0].material = bpy.data.materials.new("Own Paint")
    assert {each.material for each in resolved(still).shapes} == {"Paint-material", "Own_Paint-material"}


def test_sheared_objects_are_written_as_matrices(still, box, resolved):
    above = box("Above", scale=(1, 3, 1), rotation_euler=(0, 0, 0.5))
    below = box("Below", rotation_euler=(0.3, 0.7, 0.2))
    below.parent = above
    assert_same_as_blender(still, resolved)


def test_instances_of_an_emitting_object_share_its_watts_by_their_own_area(still, box, put, resolved):
    shining = box("Shining")
    shining.rtb.emits, shining.rtb.spectrum, shining.rtb.emission, shining.rtb.amount = True, "1", "watts", 24
    family = bpy.data.collections.new("Family")
    family.objects.link(shining)
    big = put("Big", None, scale=(2, 2, 2))
    big.instance_type, big.instance_collection = "COLLECTION", family
    radiance = sorted(
        each.emission.integral() for each in resolved(still).shapes if each.emission is not None
    )
    assert radiance == pytest.approx([1 / (4 * np.pi), 1 / np.pi], rel=1e-6)


def test_a_scene_is_read_at_its_frame(still, resolved):
    body = bpy.data.objects["Box"]
    for frame, height in ((1, 0.0), (11, 5.0)):
        body.location[2] = height
        body.keyframe_insert("location", frame=frame)
    still.frame_set(11)
    assert [each.to_world[2, 3] for each in resolved(still).shapes] == [5.0]


def test_what_stands_on_something_scaled_to_nothing_is_left_out_alone(still, box, resolved):
    above = box("Above", scale=(0, 0, 0))
    box("Below").parent = above
    assert {each.id for each in resolved(still).shapes} == {"Box-mesh"}


def assert_same_as_blender(scene, resolved) -> None:
    """Compare the triangles that renderers get with Blender's evaluated ones, both in the world."""
    depsgraph = bpy.context.evaluated_depsgraph_get()
    wanted = []
    for instance in depsgraph.object_instances:
        # Curves and the like come as meshes as well; what only scatters others has none of its own.
        if instance.object.type == "MESH" and len(instance.object.data.polygons) > 0:
            mesh = instance.object.data
            mesh.calc_loop_triangles()
            matrix = np.array(instance.matrix_world)
            corners = np.array([mesh.vertices[v].co for each in mesh.loop_triangles for v in each.vertices])
            wanted.append(corners @ matrix[:3, :3].T + matrix[:3, 3])
    found = [
        each.mesh.vertices[each.mesh.triangles.ravel()] @ each.to_world[:3, :3].T + each.to_world[:3, 3]
        for each in resolved(scene).shapes
    ]
    assert len(found) == len(wanted) > 1
    np.testing.assert_allclose(_sorted_corners(found), _sorted_corners(wanted), atol=2e-6)


def _sorted_corners(bodies) -> np.ndarray:
    """Return the corners of triangles that are more than a line, in an order that places decide."""
    triangles = np.concatenate(bodies).reshape(-1, 3, 3)
    sides = triangles[:, 1:] - triangles[:, :1]
    corners = triangles[np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1) > 1e-9].reshape(-1, 3)
    return corners[np.lexsort(np.round(corners, 3).T)]


# Spectra and conditions


def test_spectra_are_files_named_after_what_they_belong_to(still, read):
    recipe = read(still)
    assert "Paint-material:diffuseReflectance.spectrum = resources/Paint.spd\n" in recipe.mappings
    assert "Lamp-light:intensity.spectrum = resources/Lamp.spd\n" in recipe.mappings
    assert set(recipe.resources) == {"Paint.spd", "Lamp.spd"}


def test_watts_are_the_integral_of_a_lamps_spectrum(still, resolved):
    bpy.data.lights["Lamp"].energy = 60
    (light,) = resolved(still).lights
    assert light.parameters["intensity"].integral() == pytest.approx(60 / (4 * np.pi), rel=1e-6)


def test_a_variable_becomes_a_column_of_files(still, read, resolved, library):
    bpy.data.materials["Paint"].rtb.reflectance = "(paint)"
    rows = [("blue", "BabelColor Average/blue"), ("grey", "0.25")]
    library("blender").set_conditions(still, ["imageName", "paint"], rows)
    recipe = read(still)
    cells = {each.name: each.cells["paint"] for each in recipe.conditions}
    assert cells == {"blue": "resources/BabelColor-Average-blue.spd", "grey": "resources/0.25.spd"}
    paint = resolved(still, "grey").materials["Paint-material"].parameters["diffuseReflectance"]
    np.testing.assert_allclose(paint.values, 0.25)


def test_lamps_that_share_a_variable_have_a_column_each_for_their_watts(still, lamp, resolved, library):
    first, second = bpy.data.lights["Lamp"], lamp(name="Other").data
    second.rtb.use_spectra = True
    first.energy, second.energy = 10, 30
    first.rtb.spectrum = second.rtb.spectrum = "daylight (kelvin)"
    library("blender").set_conditions(still, ["imageName", "kelvin"], [("warm", 4000), ("cool", 9000)])
    for condition, warm in (("warm", True), ("cool", False)):
        spectra = {each.id: each.parameters["intensity"] for each in resolved(still, condition).lights}
        watts = [spectra[id].integral() * 4 * np.pi for id in ("Lamp-light", "Other-light")]
        assert watts == pytest.approx([10, 30], rel=1e-6)
        blue, red = spectra["Lamp-light"].at([450, 650])
        assert (red > blue) == warm


def test_a_variable_of_a_lamp_and_a_material_means_its_own_to_each(still, resolved, library):
    bpy.data.materials["Paint"].rtb.reflectance = "(value)"
    bpy.data.lights["Lamp"].rtb.spectrum = "(value)"
    library("blender").set_conditions(still, ["value"], [["0.5"], ["0.7"]])
    scene = resolved(still, "Scene-002")
    np.testing.assert_allclose(scene.materials["Paint-material"].parameters["diffuseReflectance"].values, 0.7)
    assert scene.lights[0].parameters["intensity"].integral() == pytest.approx(10 / (4 * np.pi), rel=1e-6)


def test_spd_files_are_found_beside_the_blend(still, read, tmp_path):
    (tmp_path / "spectra").mkdir()
    (tmp_path / "spectra/red.spd").write_text("400 0.125\n700 0.5\n")
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "still.blend"))
    for text in ("spectra/red.spd", "//spectra/red.spd"):
        bpy.data.materials["Paint"].rtb.reflectance = text
        assert b"0.125" in read(bpy.context.scene).resources["Paint.spd"]


def test_a_column_of_cameras_names_their_ids(still, put, resolved, library):
    put("Eye.two", bpy.data.cameras.new("Eye"), location=(0, 0, 9))
    library("blender").set_conditions(
        still, ["imageName", "camera"], [("near", "Camera"), ("far", "Eye.two")]
    )
    assert [each.cells["camera"] for each in library("blender").read_recipe(still).conditions] == [
        "Camera",
        "Eye_two",
    ]


def test_the_world_shines_where_it_is_tagged(still, resolved):
    world = still.world = bpy.data.worlds.new("Sky")
    assert resolved(still).environment is None
    world.rtb.use_spectra, world.rtb.spectrum, world.rtb.amount = True, "0.5", 3.0
    np.testing.assert_allclose(resolved(still).environment.parameters["intensity"].values, 1.5)


def test_an_emitting_object_does_not_light_those_that_share_its_mesh(still, put, resolved):
    shining = put("Shining", bpy.data.objects["Box"].data, location=(9, 0, 0))
    shining.rtb.emits, shining.rtb.spectrum, shining.rtb.amount = True, "2", 1.5
    emission = {float(each.to_world[0, 3]): each.emission for each in resolved(still).shapes}
    assert emission[0.0] is None
    np.testing.assert_allclose(emission[9.0].values, 3.0)


# What is assumed


def test_what_has_no_spectrum_is_promoted_and_the_report_says_so(still, read, resolved):
    material, light = bpy.data.materials["Paint"], bpy.data.lights["Lamp"]
    material.rtb.use_spectra = light.rtb.use_spectra = False
    material.use_nodes = True
    shader = next(node for node in material.node_tree.nodes if node.type == "BSDF_PRINCIPLED")
    shader.inputs["Base Color"].default_value = (0.5, 0.25, 0.125, 1)
    light.color, light.energy = (0.5, 0.5, 0.5), 60
    world = still.world = bpy.data.worlds.new("Sky")
    world.use_nodes = True
    report = "\n".join(read(still).report)
    for part in (
        "material Paint has no spectrum: its base color 0.5 0.25 0.125",
        "light Lamp has no",
        "world Sky",
    ):
        assert part in report
    scene = resolved(still)
    paint = scene.materials["Paint-material"].parameters["diffuseReflectance"]
    np.testing.assert_allclose(paint.at([420, 540, 680]), (0.125, 0.25, 0.5))
    assert scene.lights[0].parameters["intensity"].integral() == pytest.approx(
        0.5 * 60 / (4 * np.pi), rel=1e-6
    )


def test_what_no_renderer_does_is_said(still, read):
    light = bpy.data.lights["Lamp"]
    light.diffuse_factor, light.use_shadow, light.shadow_soft_size, light.color = 0.5, False, 0.2, (1, 0, 0)
    still.camera.data.dof.use_dof, still.camera.data.dof.aperture_blades = True, 6
    bpy.data.objects["Box"].visible_shadow = False
    material = bpy.data.materials["Paint"]
    material.use_nodes = True
    shader = next(node for node in material.node_tree.nodes if node.type == "BSDF_PRINCIPLED")
    shader.inputs["Emission Strength"].default_value = 1
    report = "\n".join(read(still).report)
    for part in (
        "diffuse factor",
        "shadows",
        "soft falloff",
        "not in its colour",
        "round aperture",
        "glows",
        "all light",
    ):
        assert part in report
    light.energy = -1
    assert "negative power" in "\n".join(read(still).report)


def test_a_tagged_scene_has_nothing_to_report(still, read):
    bpy.data.lights["Lamp"].shadow_soft_size = 0
    assert read(still).report == ()


# What is refused


def refusals():
    """Yield what is done to a scene, and what the one sentence must say."""
    things = bpy.data
    yield lambda scene: things.objects["Box"].data.materials.clear(), ("Box", "no material")
    yield lambda scene: setattr(scene, "camera", None), ("Scene", "no camera")
    yield lambda scene: setattr(scene.camera, "hide_render", True), ("Camera", "does not render")
    yield lambda scene: setattr(things.objects["Lamp"], "hide_render", True), ("Scene", "no light")
    yield (
        lambda scene: setattr(things.materials["Paint"].rtb, "reflectance", "gone.spd"),
        ("Paint", "gone.spd"),
    )
    yield lambda scene: setattr(things.materials["Paint"].rtb, "reflectance", ""), ("Paint", "empty")
    yield lambda scene: setattr(things.lights["Lamp"].rtb, "spectrum", "D66"), ("Lamp", "D66")
    yield lambda scene: setattr(things.lights["Lamp"].rtb, "spectrum", "0"), ("Lamp", "watts")
    yield (
        lambda scene: setattr(things.lights["Lamp"].rtb, "spectrum", "(light)"),
        ("Lamp", "(light)", "no conditions"),
    )
    yield lambda scene: setattr(scene.camera.data, "type", "PANO"), ("Camera", "panoramic")


@pytest.mark.parametrize("number", range(10))
def test_what_is_wrong_is_said_in_one_sentence(still, read, library, number):
    spoil, words = list(refusals())[number]
    spoil(still)
    said = sentence(library, lambda: read(still))
    assert all(word in said for word in words), said


def test_a_variable_that_is_not_there_or_says_nothing_is_refused(still, read, library):
    bpy.data.materials["Paint"].rtb.reflectance = "(pant)"
    library("blender").set_conditions(still, ["imageName", "paint"], [("one", "0.5")])
    assert "(pant), the variables of the conditions are paint" in sentence(library, lambda: read(still))
    bpy.data.materials["Paint"].rtb.reflectance = "(paint)"
    still.rtb.conditions[0].cells[0].value = " "
    assert "the condition one says nothing for paint" in sentence(library, lambda: read(still))


def test_rows_that_would_write_the_same_file_or_none_are_refused(still, read, library):
    for rows, words in (([("a", "1"), ("A", "2")], "stands in line"), ([("a/b", "1")], "cannot name files")):
        still.rtb.set_conditions(["imageName", "paint"], rows)
        assert words in sentence(library, lambda: read(still))
    still.rtb.set_conditions(["paint", "paint"], [("1", "2")])
    assert "'paint' needs a name" in sentence(library, lambda: read(still))


def test_an_unsaved_file_has_no_folder_to_save_a_relative_one_in(still, read, library, tmp_path):
    assert "save that first" in sentence(library, lambda: read(still).save())
    still.rtb.folder = str(tmp_path / "RENAMED" / "NAME")
    still.rtb.name = "elsewhere"
    assert read(still).save() == tmp_path / "RENAMED" / "elsewhere"


# A row applied in Blender and then exported, or exported and then applied by the mappings


def moved(body):
    body.location = (1.25, -2, 0.75)


def turned(body):
    body.rotation_euler = tuple(np.radians((10, 20, 30)))


def scaled(body):
    body.scale = (2, 0.5, -1)


EDITS = {
    "location": (moved, "Below:translate|sid=location = 1.25 -2 0.75"),
    "rotation": (
        turned,
        "Below:rotate|sid=rotationX = 1 0 0 10\nBelow:rotate|sid=rotationY = 0 1 0 20\n"
        "Below:rotate|sid=rotationZ = 0 0 1 30",
    ),
    "scale": (scaled, "Below:scale|sid=scale = 2 0.5 -1"),
}


@pytest.mark.parametrize("edit", EDITS)
def test_a_move_in_blender_is_the_same_as_by_a_mapping(still, box, resolved, edit):
    above = box("Above", location=(3, 2, 1), scale=(2, 2, 2), rotation_euler=(0.5, 0, 1))
    box("Below", location=(0, 1, 0), rotation_euler=(0.1, 0.2, 0.3), scale=(1, 2, 3)).parent = above
    act, lines = EDITS[edit]
    mapped = resolved(still, mappings=f"Collada {{\n{lines}\n}}\n")
    act(bpy.data.objects["Below"])
    exported = resolved(still)
    corners = [
        np.concatenate(
            [
                each.mesh.vertices[each.mesh.triangles].reshape(-1, 3) @ each.to_world[:3, :3].T
                + each.to_world[:3, 3]
                for each in scene.shapes
            ]
        )
        for scene in (mapped, exported)
    ]
    np.testing.assert_allclose(*corners, rtol=1e-6, atol=1e-6)
    assert not np.allclose(corners[0], 0)


def test_a_spectrum_in_blender_is_the_same_as_by_a_row(still, resolved, library):
    material, light = bpy.data.materials["Paint"].rtb, bpy.data.lights["Lamp"].rtb
    texts = {"paint": "BabelColor Average/orange", "light": "blackbody 3000"}
    library("blender").set_conditions(still, ["imageName", *texts], [["row", *texts.values()]])
    material.reflectance, light.spectrum = "(paint)", "(light)"
    mapped = resolved(still, "row")
    material.reflectance, light.spectrum = texts.values()
    exported = resolved(still, "row")
    for read in (
        lambda scene: scene.materials["Paint-material"].parameters["diffuseReflectance"],
        lambda scene: scene.lights[0].parameters["intensity"],
    ):
        np.testing.assert_array_equal(read(mapped).values, read(exported).values)
        assert np.ptp(read(mapped).values) > 0


def test_a_lamps_power_in_blender_is_the_same_as_by_a_mapping(still, resolved):
    light = bpy.data.lights["Lamp"]
    light.rtb.spectrum, light.energy = "1", 470 * 4 * np.pi
    lines = "Lamp-light:intensity.spectrum = 300:2 800:2"
    mapped = resolved(still, mappings=f"Generic {{\n{lines}\n}}\n").lights[0]
    light.energy *= 2
    exported = resolved(still).lights[0]
    wavelengths = np.arange(360, 831, 10)
    np.testing.assert_allclose(
        mapped.parameters["intensity"].at(wavelengths),
        exported.parameters["intensity"].at(wavelengths),
        rtol=1e-6,
    )
