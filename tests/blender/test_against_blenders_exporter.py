"""The parent scene against Blender 4.5's own Collada exporter, and back through its importer."""

import math

import bpy
import numpy as np
import pytest
from lxml import etree

SAME = 1e-6
PIXELS = (1.0, 0.7)
SHEARED = ("child", "grandchild")


class Document:
    """A Collada document, read as simply as may be and without the library."""

    def __init__(self, content: bytes) -> None:
        self.root = etree.fromstring(content, etree.XMLParser(huge_tree=True))
        self.by_id = {each.get("id"): each for each in self.root.iter() if each.get("id")}

    def find(self, element, path):
        return element.find("/".join(f"{{*}}{part}" for part in path.split("/")))

    def worlds(self) -> dict[str, np.ndarray]:
        """World matrices of the nodes."""
        found = {}

        def walk(node, above):
            here = above @ self.transform(node)
            found[node.get("id")] = here
            for below in node.findall("{*}node"):
                walk(below, here)

        for node in self.root.find(".//{*}visual_scene").findall("{*}node"):
            walk(node, np.eye(4))
        return found

    def transform(self, node):
        matrix = np.eye(4)
        for part in node:
            numbers = np.array((part.text or "").split() or [0], float)
            matrix = matrix @ {"translate": moved, "rotate": turned, "scale": scaled, "matrix": square}.get(
                etree.QName(part).localname, lambda _: np.eye(4)
            )(numbers)
        return matrix

    def corners(self, node_id: str) -> dict[tuple, dict[str, np.ndarray]]:
        """Triangles of a node: vertices (the smallest first) -> what each corner has, and the material."""
        link = self.find(self.by_id[node_id], "instance_geometry")
        targets = {each.get("symbol"): each.get("target") for each in link.iter("{*}instance_material")}
        mesh = self.find(self.by_id[link.get("url")[1:]], "mesh")
        found = {}
        for triangles in mesh.findall("{*}triangles"):
            inputs = triangles.findall("{*}input")
            width = 1 + max(int(each.get("offset")) for each in inputs)
            places = np.array(self.find(triangles, "p").text.split(), int).reshape(-1, 3, width)
            arrays = {each.get("semantic"): (self.values(each), int(each.get("offset"))) for each in inputs}
            for triangle in places:
                vertices = triangle[:, arrays["VERTEX"][1]]
                order = np.roll(np.arange(3), -int(np.argmin(vertices)))
                corner = {name: values[triangle[order, at]] for name, (values, at) in arrays.items()}
                found[tuple(vertices[order])] = {**corner, "material": targets[triangles.get("material")]}
        return found

    def values(self, link):
        source = self.by_id[link.get("source")[1:]]
        if etree.QName(source).localname == "vertices":
            source = self.by_id[self.find(source, "input").get("source")[1:]]
        numbers = np.array(self.find(source, "float_array").text.split(), float)
        return numbers.reshape(-1, int(source.find(".//{*}accessor").get("stride")))


def moved(numbers):
    matrix = np.eye(4)
    matrix[:3, 3] = numbers
    return matrix


def turned(numbers):
    matrix, axis = np.eye(4), int(np.argmax(numbers[:3]))
    a, b = (axis + 1) % 3, (axis + 2) % 3
    cosine, sine = math.cos(math.radians(numbers[3])), math.sin(math.radians(numbers[3]))
    matrix[a, a], matrix[a, b], matrix[b, a], matrix[b, b] = cosine, -sine, sine, cosine
    return matrix


def scaled(numbers):
    return np.diag([*numbers, 1.0])


def square(numbers):
    return numbers.reshape(4, 4)


def blenders(tmp_path) -> Document:
    """Export the scene with Blender's own exporter."""
    file = tmp_path / "blender.dae"
    bpy.ops.wm.collada_export(filepath=str(file), apply_modifiers=True, triangulate=True)
    return Document(file.read_bytes())


@pytest.fixture
def room(scene, box, put, lamp):
    """A room of everything: modifiers, parents with inverses, shared meshes, mirrored and flattened ones."""
    lamp()
    round_ = box("round.one", rotation_euler=(0.1, 0.2, 0.3), scale=(1, 2, 0.5), location=(1, -2, 0.25))
    bevel = round_.modifiers.new("Subdivision", "SUBSURF")
    bevel.levels = bevel.render_levels = 2
    round_.data.uv_layers.new(name="UVMap")
    for place, each in enumerate(round_.data.uv_layers[0].uv):
        each.vector = (place * 0.07 % 1, place * 0.13 % 1)
    child = box("child", location=(0, 3, 0), rotation_euler=(0.3, -0.7, 2.0))
    child.parent = round_
    bpy.context.view_layer.update()
    child.matrix_parent_inverse = round_.matrix_world.inverted()
    grandchild = box("grandchild", material="Other", location=(1, 1, 1), scale=(-1, 1, 0.3))
    grandchild.parent = child
    grandchild.data.materials.append(bpy.data.materials["Paint"])
    grandchild.data.polygons[2].material_index = 1
    smooth = box("smooth")
    smooth.data.shade_smooth()
    custom = box("custom", rotation_mode="QUATERNION", rotation_quaternion=(0.5, 0.5, -0.5, 0.5))
    normals = np.random.default_rng(1).normal(size=(len(custom.data.loops), 3))
    custom.data.normals_split_custom_set(normals / np.linalg.norm(normals, axis=1, keepdims=True))
    put("shared", smooth.data, location=(5, 0, 0), scale=(2, 2, 2))
    for each in scene.objects:
        if each.type == "MESH" and each.name != "shared":
            # Blender's exporter cuts quads otherwise than its renderers do.
            each.modifiers.new("Triangulate", "TRIANGULATE").keep_custom_normals = True
    shared = scene.objects["shared"].modifiers.new("Triangulate", "TRIANGULATE")
    shared.keep_custom_normals = True
    return scene


@pytest.fixture
def documents(room, library, tmp_path):
    ours = library("blender").read_recipe(room)
    return Document(ours.parent), blenders(tmp_path)


def test_every_object_stands_where_blenders_exporter_puts_it(documents):
    ours, theirs = (each.worlds() for each in documents)
    assert set(ours) == set(theirs)
    assert len(ours) == 8
    for name, matrix in theirs.items():
        np.testing.assert_allclose(ours[name], matrix, atol=SAME * max(1, abs(matrix).max()), err_msg=name)


@pytest.mark.parametrize("name", ["round_one", "child", "grandchild", "smooth", "custom", "shared"])
def test_meshes_are_those_of_blenders_exporter(documents, name):
    ours, theirs = (each.corners(name) for each in documents)
    assert set(ours) == set(theirs)
    assert len(ours) >= 12
    for vertices, corner in theirs.items():
        assert ours[vertices]["material"] == corner["material"]
        assert set(ours[vertices]) == set(corner)
        for each in set(corner) - {"material"}:
            np.testing.assert_allclose(ours[vertices][each], corner[each], atol=2 * SAME, err_msg=each)


def test_ids_are_those_of_blenders_exporter(documents):
    ours, theirs = (
        {
            id
            for id, each in document.by_id.items()
            if etree.QName(each).localname in ("node", "geometry", "material", "effect", "camera", "light")
        }
        for document in documents
    )
    # A mesh that a modifier changes is one of its own here: its objects do not share it any more.
    assert theirs <= ours
    assert ours - theirs <= {"smooth2-mesh"}


@pytest.mark.parametrize("size", [(8, 6), (6, 8)])
@pytest.mark.parametrize("kind", ["PERSP", "ORTHO"])
@pytest.mark.parametrize("fit", ["AUTO", "HORIZONTAL", "VERTICAL"])
def test_cameras_project_as_blenders_do(scene, lamp, library, size, kind, fit):
    lamp()
    camera = scene.camera.data
    camera.type, camera.sensor_fit, camera.lens, camera.ortho_scale = kind, fit, 35, 5
    camera.sensor_width, camera.sensor_height = 30, 17
    camera.shift_x, camera.shift_y = 0.2, -0.1
    scene.render.resolution_x, scene.render.resolution_y = size
    for pixel in PIXELS:
        scene.render.pixel_aspect_y = 1 / pixel
        view = resolved(library, scene).camera
        near = camera.clip_start if kind == "PERSP" else 1.0
        left, right, bottom, top = (edge * near for edge in view.window)
        wanted = scene.camera.calc_matrix_camera(
            bpy.context.evaluated_depsgraph_get(),
            x=size[0],
            y=size[1],
            scale_x=scene.render.pixel_aspect_x,
            scale_y=scene.render.pixel_aspect_y,
        )
        assert wanted[0][0] == pytest.approx(2 * near / (right - left), rel=SAME)
        assert wanted[1][1] == pytest.approx(2 * near / (top - bottom), rel=SAME)
        moved = [wanted[0][2], wanted[1][2]] if kind == "PERSP" else [-wanted[0][3], -wanted[1][3]]
        middle = [(right + left) / (right - left), (top + bottom) / (top - bottom)]
        assert moved == pytest.approx(middle, rel=3 * SAME)


@pytest.mark.parametrize("kind", ["PERSP", "ORTHO"])
def test_cameras_are_written_as_blenders_exporter_writes_them(scene, lamp, library, tmp_path, kind):
    lamp()
    camera = scene.camera.data
    camera.type, camera.shift_x, camera.shift_y, camera.lens, camera.ortho_scale = kind, 0.25, -0.5, 37, 7
    ours, theirs = Document(library("blender").read_recipe(scene).parent), blenders(tmp_path)
    for word in ("xfov", "xmag", "aspect_ratio", "znear", "zfar", "shiftx", "shifty"):
        found = [
            [float(each.text) for each in document.root.iter(f"{{*}}{word}")] for document in (ours, theirs)
        ]
        assert found[0] == pytest.approx(found[1], rel=SAME), word


def test_blenders_importer_reads_the_parent_scene_back(room, library, tmp_path):
    recipe = library("blender").read_recipe(room)
    (tmp_path / "parent.dae").write_bytes(recipe.parent)
    before = {each.name: np.array(each.matrix_world) for each in room.objects}
    depsgraph = bpy.context.evaluated_depsgraph_get()
    bodies = [each for each in room.objects if each.type == "MESH"]
    faces = {each.name: len(each.evaluated_get(depsgraph).data.polygons) for each in bodies}
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    assert bpy.ops.wm.collada_import(filepath=str(tmp_path / "parent.dae")) == {"FINISHED"}
    assert {each.name for each in bpy.data.objects} == set(before)
    for name, matrix in before.items():
        read = bpy.data.objects[name]
        if name not in SHEARED:  # which an object of Blender's can only be with a parent inverse
            np.testing.assert_allclose(np.array(read.matrix_world), matrix, atol=2e-6, err_msg=name)
        if name in faces:
            assert len(read.data.polygons) == faces[name]
    assert len(bpy.data.objects["grandchild"].data.materials) == 2


def resolved(library, scene):
    """Return the neutral scene that renderers would see of Blender's scene."""
    recipe = library("blender").read_recipe(scene)
    document = library("scene.document").Scene.parse(recipe.parent, "parent.dae")
    settings = library("scene.resolve").SceneSettings(film=recipe.options.film, camera=recipe.options.camera)
    adjustments = library("scene.adjustments").Adjustments()
    return library("scene.resolve").resolve(document, adjustments, settings, lambda name: None).scene
