"""One scene in the dialect of each exporter, and what is odd in some."""

import numpy as np
import pytest

from rtb_addon.errors import RecipeError
from tests.unit.dialects import (
    INCH,
    POLYGONS,
    POLYLIST,
    TRIANGLES,
    TURNS,
    asset,
    bound,
    document,
    looking_down,
    placed,
    resolved,
    square,
    words,
)


def sketchup():
    """Inches, Z up, ids of numbers, components in a library of nodes, edges as lines, a vertical angle."""
    unit, up = INCH, "Z_UP"
    ids = {"material": "ID5", "effect": "ID6", "light": "ID9", "camera": "ID1"}
    half = np.degrees(2 * np.arctan(np.tan(np.radians(20)) * 0.75))
    lens = f"<perspective><yfov>{half:.9g}</yfov><aspect_ratio>0</aspect_ratio></perspective>"
    nodes = f"""<node name="SketchUp">
      <node name="skp_camera_Last_Saved_SU_View"><matrix>{words(looking_down(unit, up))}</matrix>
        <instance_camera url="#ID1"/></node>
      <node id="ID2" name="instance_0"><matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</matrix>
        <instance_node url="#ID3"/></node>
      <node><translate>{words(placed((0, 0, 3), unit, up))}</translate><instance_light url="#ID9"/></node>
        </node>"""
    library = f"""<library_nodes><node id="ID3" name="Component_1">
      <instance_geometry url="#ID4">{bound("Material2", "ID5")}</instance_geometry></node></library_nodes>"""
    geometry = square("ID4", "", unit, up, TRIANGLES, symbol="Material2")
    return document(asset("SketchUp 17.2.2555", unit, up), nodes, geometry, ids=ids, lens=lens, more=library)


def maya():
    """Centimetres, Y up, transforms of many parts, symbols of shading groups, animations."""
    unit, up = 0.01, "Y_UP"
    ids = {
        "material": "lambert2",
        "effect": "lambert2-fx",
        "light": "pointLightShape1",
        "camera": "cameraShape1",
    }
    turn = '<rotate sid="rotateZ">0 0 1 0</rotate><rotate sid="rotateY">0 1 0 0</rotate>'
    nodes = f"""<node id="pPlane1" name="pPlane1" type="NODE">
        <translate sid="rotatePivot">0 0 0</translate>{turn}
        <rotate sid="rotateX">1 0 0 0</rotate><scale sid="scale">1 1 1</scale>
        <instance_geometry url="#pPlaneShape1">{bound("lambert2SG", "lambert2")}</instance_geometry>
        <extra><technique profile="OpenCOLLADAMaya"><originalMayaNodeId>pPlane1</originalMayaNodeId>
        </technique></extra>
      </node>
      <node id="camera1"><translate sid="translate">{words(placed((0, 0, 5), unit, up))}</translate>{turn}
        <rotate sid="rotateX">1 0 0 -90</rotate><instance_camera url="#cameraShape1"/></node>
      <node id="pointLight1"><translate sid="translate">{words(placed((0, 0, 3), unit, up))}</translate>
        <instance_light url="#pointLightShape1"/></node>"""
    more = '<library_animations><animation id="a1"/><animation id="a2"/></library_animations>'
    geometry = square("pPlaneShape1", "pPlane1", unit, up, POLYGONS, symbol="lambert2SG")
    return document(asset("Maya 2018 | COLLADA export", unit, up), nodes, geometry, ids=ids, more=more)


def max_3ds():
    """Inches, Z up, a matrix and a pivot node within each node, ids with escaped blanks."""
    unit, up = INCH, "Z_UP"
    ids = {"material": "Material__25-material", "effect": "Material__25", "light": "Omni01-light"}
    nodes = f"""<node id="VisualSceneNode" name="3ds_scene">
      <node id="node-Plane001" name="Plane_x0020_001"><matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</matrix>
        <node id="node-Plane001-pivot"><matrix sid="transform">1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</matrix>
          <instance_geometry url="#My%20Plane-mesh">{bound("Material__25", "Material__25-material")}
          </instance_geometry></node></node>
      <node id="node-Camera001"><matrix>{words(looking_down(unit, up))}</matrix>
        <instance_camera url="#eye"/></node>
      <node id="node-Omni01"><matrix>1 0 0 0 0 1 0 0 0 0 1 {3 / unit:.9g} 0 0 0 1</matrix>
        <instance_light url="#Omni01-light"/>
        <extra><technique profile="OpenCOLLADA"><track type="visibility"/></technique></extra></node>
        </node>"""
    geometry = square("My Plane-mesh", "Plane 001", unit, up, TRIANGLES, symbol="Material__25")
    return document(asset("OpenCOLLADA for 3ds Max;", unit, up), nodes, geometry, ids=ids)


def cinema_4d():
    """Centimetres, Y up, no sids, nothing bound: the material goes by its symbol."""
    unit, up = 0.01, "Y_UP"
    ids = {"material": "ID3", "effect": "ID2", "light": "ID7", "camera": "ID9"}
    nodes = f"""<node id="ID5" name="Plane"><translate>0 0 0</translate><rotate>0 1 0 0</rotate>
        <scale>1 1 1</scale>
        <instance_geometry url="#ID4"/></node>
      <node id="ID6" name="Light"><translate>{words(placed((0, 0, 3), unit, up))}</translate>
        <instance_light url="#ID7"/></node>
      <node id="ID8" name="Camera"><translate>{words(placed((0, 0, 5), unit, up))}</translate>
        <rotate>0 1 0 0</rotate><rotate>1 0 0 -90</rotate><rotate>0 0 1 0</rotate>
        <instance_camera url="#ID9"/></node>"""
    geometry = square("ID4", "Plane", unit, up, POLYLIST, symbol="ID3")
    return document(asset("CINEMA4D 21.207 COLLADA Exporter", unit, up), nodes, geometry, ids=ids)


def assimp():
    """Metres, Y up, one node of everything, matrices, one symbol for all."""
    unit, up = 1.0, "Y_UP"
    ids = {"material": "m0Red", "effect": "m0Red-fx", "light": "Lamp-light", "camera": "Eye-camera"}
    nodes = f"""<node id="Root" name="Root"><matrix sid="matrix">1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</matrix>
      <node id="nodeId0" name="Square" type="NODE">
        <matrix sid="matrix">1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</matrix>
        <instance_geometry url="#meshId0">{bound("defaultMaterial", "m0Red")}</instance_geometry></node>
      <node id="Eye"><matrix>{words(looking_down(unit, up))}</matrix><instance_camera url="#Eye-camera"/>
        </node>
      <node id="Lamp"><matrix>1 0 0 0 0 1 0 3 0 0 1 0 0 0 0 1</matrix><instance_light url="#Lamp-light"/>
        </node></node>"""
    geometry = square("meshId0", "meshId0_name", unit, up, POLYLIST, symbol="defaultMaterial")
    return document(asset("Assimp Exporter", unit, up), nodes, geometry, ids=ids)


def opencollada(up="X_UP", version="1.4.1"):
    """Any axis up, a lookat for the camera, or Collada 1.5."""
    unit = 1.0
    eye, point = placed((0, 0, 5), unit, up), placed((0, 0, 0), unit, up)
    nodes = f"""<node id="Square">
        <instance_geometry url="#Square-mesh">{bound("paint", "red")}</instance_geometry>
      </node><node id="Eye"><lookat>{words(eye)} {words(point)} {words(TURNS[up] @ [0, 1, 0])}</lookat>
      <instance_camera url="#eye"/></node>
      <node id="Lamp"><translate>{words(placed((0, 0, 3), unit, up))}</translate>
        <instance_light url="#lamp"/></node>"""
    geometry = square("Square-mesh", "Square", unit, up, POLYGONS)
    return document(asset("COLLADA Mixamo exporter", unit, up), nodes, geometry, version=version)


DIALECTS = {
    "SketchUp": sketchup,
    "Maya": maya,
    "3ds Max": max_3ds,
    "Cinema 4D": cinema_4d,
    "Assimp": assimp,
    "OpenCOLLADA, X up": opencollada,
    "Collada 1.5": lambda: opencollada("Z_UP", "1.5.0"),
}


def area_of(shapes):
    found = np.zeros(3)
    for shape in shapes:
        points = shape.mesh.vertices @ shape.to_world[:3, :3].T + shape.to_world[:3, 3]
        a, b, c = points[shape.mesh.triangles].transpose(1, 0, 2)
        found += np.cross(b - a, c - a).sum(axis=0) / 2
    return found


@pytest.mark.parametrize("encoding", ["utf-8", "utf-16"])
@pytest.mark.parametrize("name", DIALECTS)
def test_every_exporter_tells_the_same_scene(name, encoding):
    text = DIALECTS[name]().replace('encoding="utf-8"', f'encoding="{encoding}"')
    scene = resolved(text.encode(encoding)).scene
    np.testing.assert_allclose(area_of(scene.shapes), [0, 0, 2], atol=1e-6)
    assert all(shape.mesh.normals is None for shape in scene.shapes)
    (lamp,) = scene.lights
    np.testing.assert_allclose(lamp.to_world[:3, 3], [0, 0, 3], atol=1e-7)
    camera = scene.camera.to_world
    np.testing.assert_allclose(camera[:3, 3], [0, 0, 5], atol=1e-7)
    np.testing.assert_allclose(-camera[:3, 2], [0, 0, -1], atol=1e-7)
    np.testing.assert_allclose(camera[:3, 1], [0, 1, 0], atol=1e-7)
    half = np.tan(np.radians(20))
    assert scene.camera.window == pytest.approx((-half, half, -half * 0.75, half * 0.75), rel=1e-6)
    (material,) = {shape.material for shape in scene.shapes}
    red, blue = scene.materials[material].parameters["diffuseReflectance"].at([650, 450])
    assert red > 4 * blue


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("SketchUp", "the lines of ID4 are left out, only faces are drawn"),
        ("Maya", "2 animations are left out, the scene stands still"),
        ("3ds Max", "1 tracks inside nodes are left out, the scene stands still"),
    ],
)
def test_what_is_left_out_is_said(name, words):
    assert words in resolved(DIALECTS[name]()).warnings


def test_two_elements_of_one_id_are_said():
    text = assimp().replace('id="Root"', 'id="nodeId0"', 1)
    assert (
        "2 elements have the id nodeId0, the last one is meant wherever it is named"
        in resolved(text).warnings
    )


def test_links_into_this_very_file_are_followed_and_into_others_refused():
    here = assimp().replace('url="#meshId0"', 'url="./parent.dae#meshId0"')
    assert len(resolved(here).scene.shapes) == 1
    there = assimp().replace('url="#meshId0"', 'url="other.dae#meshId7"')
    with pytest.raises(RecipeError, match=r"the geometry other\.dae#meshId7 is in another file"):
        resolved(there)


@pytest.mark.parametrize(("escaped", "plain"), [("My_x0020_mesh", "My mesh"), ("My%20mesh", "My mesh")])
def test_names_that_exporters_escape_are_found(escaped, plain):
    text = assimp().replace('url="#meshId0"', f'url="#{escaped}"').replace('id="meshId0"', f'id="{plain}"')
    assert len(resolved(text).scene.shapes) == 1


def test_characters_that_xml_forbids_go_and_are_said():
    found = resolved(assimp().replace('name="Square"', 'name="Squ\x0bare\x00"'))
    assert "parent.dae: 2 characters that XML forbids were left out" in found.warnings


def test_a_text_that_is_not_the_utf_8_it_says_is_read_as_latin_1():
    found = resolved(assimp().replace('name="Square"', 'name="Fläche"').encode("latin-1"))
    assert "parent.dae: its text is not the UTF-8 that it says, it was read as Latin-1" in found.warnings
