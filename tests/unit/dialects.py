"""
What exporters write of one scene.

A square of 2 m by 1 m lies in the XY plane and faces up; a lamp stands 3 m above it; a camera, 5 m above
it, looks down at it.
"""

import numpy as np

from rtb_addon.scene.adjustments import Adjustments
from rtb_addon.scene.document import Scene
from rtb_addon.scene.render_scene import Film
from rtb_addon.scene.resolve import SceneSettings, resolve

SQUARE = np.array([[-1, -0.5, 0], [1, -0.5, 0], [1, 0.5, 0], [-1, 0.5, 0]])

# World axes of the document's own, by its up axis.
TURNS = {
    "Z_UP": np.eye(3),
    "Y_UP": np.array([[1, 0, 0], [0, 0, 1], [0, -1, 0]]),
    "X_UP": np.array([[0, 0, 1], [-1, 0, 0], [0, -1, 0]]),
}

INCH = 0.0254


def words(numbers):
    return " ".join(f"{each:.9g}" for each in np.ravel(numbers))


def placed(point, unit, up):
    """Return a point of the world [m] in a document's axes and units."""
    return TURNS[up] @ np.asarray(point, float) / unit


def looking_down(unit, up):
    """Return the matrix of the camera's node in a document."""
    matrix = np.eye(4)
    matrix[:3, :3] = TURNS[up]
    matrix[:3, 3] = placed((0, 0, 5), unit, up)
    return matrix


def square(id, name, unit, up, faces, more="", symbol="paint"):
    points = words([placed(point, unit, up) for point in SQUARE])
    normal = words(TURNS[up] @ [0, 0, 1])
    return f"""<geometry id="{id}" name="{name}"><mesh>
    <source id="{id}-p"><float_array id="{id}-pa" count="12">{points}</float_array><technique_common>
      <accessor source="#{id}-pa" count="4" stride="3"><param name="X" type="float"/>
        <param name="Y" type="float"/>
      <param name="Z" type="float"/></accessor></technique_common></source>
    <source id="{id}-n"><float_array id="{id}-na" count="3">{normal}</float_array><technique_common>
      <accessor source="#{id}-na" count="1" stride="3"><param name="X" type="float"/>
        <param name="Y" type="float"/>
      <param name="Z" type="float"/></accessor></technique_common></source>{more}
    <vertices id="{id}-v"><input semantic="POSITION" source="#{id}-p"/></vertices>
    {faces.format(id=id, symbol=symbol)}</mesh></geometry>"""


TRIANGLES = """<triangles material="{symbol}" count="1"><input semantic="VERTEX" source="#{id}-v" offset="0"/>
  <input semantic="NORMAL" source="#{id}-n" offset="1"/><p>0 0 1 0 2 0</p></triangles>
  <triangles material="{symbol}" count="1"><input semantic="VERTEX" source="#{id}-v" offset="0"/>
  <input semantic="NORMAL" source="#{id}-n" offset="1"/><p>0 0 2 0 3 0</p></triangles>
  <lines material="{symbol}" count="1"><input semantic="VERTEX" source="#{id}-v" offset="0"/><p>0 1</p>
        </lines>"""

POLYGONS = """<polygons material="{symbol}" count="1"><input semantic="VERTEX" source="#{id}-v" offset="0"/>
  <input semantic="NORMAL" source="#{id}-n" offset="1"/><p>0 0 1 0 2 0 3 0</p></polygons>"""

POLYLIST = """<polylist material="{symbol}" count="1"><input offset="0" semantic="VERTEX" source="#{id}-v" />
  <vcount>4 </vcount><p>0 1 2 3 </p></polylist>"""

RED = """<phong><emission><color>0 0 0 1</color></emission><ambient><color>1 0 0 1</color></ambient>
  <diffuse><color>0.8 0.1 0.1 1</color></diffuse><specular><color>0.5 0.5 0.5 1</color></specular></phong>"""

LENS = """<perspective><xfov>40</xfov><aspect_ratio>1.333</aspect_ratio><znear>0.1</znear><zfar>100</zfar>
  </perspective>"""

POINT = "<point><color>1 1 1</color><constant_attenuation>1</constant_attenuation></point>"


def document(
    asset, nodes, geometry, *, effect=RED, lens=LENS, ids=None, more="", version="1.4.1", parameters=""
):
    """Return a document; ids of its material, effect, light and camera differ among exporters."""
    ids = {"material": "red", "effect": "red-fx", "light": "lamp", "camera": "eye", **(ids or {})}
    space = "2005/11" if version.startswith("1.4") else "2008/03"
    return f"""<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/{space}/COLLADASchema" version="{version}">
<asset>{asset}</asset>{more}
<library_cameras><camera id="{ids["camera"]}" name="Eye"><optics>
        <technique_common>{lens}</technique_common></optics>
</camera></library_cameras>
<library_lights><light id="{ids["light"]}" name="Lamp"><technique_common>{POINT}</technique_common></light>
</library_lights>
<library_materials><material id="{ids["material"]}" name="Red"><instance_effect url="#{ids["effect"]}"/>
        </material>
</library_materials>
<library_effects><effect id="{ids["effect"]}">
        <profile_COMMON>{parameters}<technique sid="common">{effect}</technique>
</profile_COMMON></effect></library_effects>
<library_geometries>{geometry}</library_geometries>
<library_visual_scenes><visual_scene id="Scene">{nodes}</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#Scene"/></scene></COLLADA>"""


def asset(tool, unit, up):
    contributor = f"<contributor><author>me</author><authoring_tool>{tool}</authoring_tool></contributor>"
    return f'{contributor}<unit meter="{unit:.9g}" name="unit"/><up_axis>{up}</up_axis>'


def bound(symbol, target, inputs=""):
    return (
        f'<bind_material><technique_common><instance_material symbol="{symbol}" target="#{target}">{inputs}'
        "</instance_material></technique_common></bind_material>"
    )


def nothing(name):
    return None


def resolved(text, find_file=nothing):
    data = text if isinstance(text, bytes) else text.encode()
    return resolve(Scene.parse(data, "parent.dae"), Adjustments(), SceneSettings(Film(320, 240)), find_file)
