"""From Blender's scene to a recipe: what is written, and where it stands."""

import bpy
import numpy as np
import pytest

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
