"""Small recipes, and somebody else's renderer, for tests of the engine."""

import os
from pathlib import Path

import pytest

PLUGIN = Path(__file__).resolve().parent / "plugin"

# A white square a metre wide under a lamp, seen from above.
PARENT = """\
<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset><unit name="meter" meter="1"/><up_axis>Z_UP</up_axis></asset>
  <library_cameras><camera id="Camera-camera" name="Camera"><optics><technique_common><perspective>
    <xfov sid="xfov">40</xfov><aspect_ratio>1.333333</aspect_ratio><znear>0.1</znear><zfar>100</zfar>
  </perspective></technique_common></optics></camera></library_cameras>
  <library_lights><light id="Lamp-light" name="Lamp"><technique_common><point>
    <color sid="color">1 1 1</color></point></technique_common></light></library_lights>
  <library_effects><effect id="Paint-effect"><profile_COMMON><technique sid="common"><lambert>
    <diffuse><color sid="diffuse">0.5 0.5 0.5 1</color></diffuse></lambert></technique></profile_COMMON>
  </effect></library_effects>
  <library_materials><material id="Paint-material" name="Paint"><instance_effect url="#Paint-effect"/>
  </material></library_materials>
  <library_geometries><geometry id="Square-mesh" name="Square"><mesh>
    <source id="Square-mesh-positions"><float_array id="Square-mesh-positions-array" count="12">
      -0.5 -0.5 0 0.5 -0.5 0 0.5 0.5 0 -0.5 0.5 0</float_array><technique_common>
      <accessor source="#Square-mesh-positions-array" count="4" stride="3"><param name="X" type="float"/>
      <param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
    <vertices id="Square-mesh-vertices"><input semantic="POSITION" source="#Square-mesh-positions"/>
    </vertices>
    <triangles material="Paint-material" count="2"><input semantic="VERTEX" source="#Square-mesh-vertices"
      offset="0"/><p>0 1 2 0 2 3</p></triangles></mesh></geometry></library_geometries>
  <library_visual_scenes><visual_scene id="Scene" name="Scene">
    <node id="Camera" name="Camera" type="NODE"><translate sid="location">0 0 3</translate>
      <rotate sid="rotationZ">0 0 1 0</rotate><rotate sid="rotationY">0 1 0 0</rotate>
      <rotate sid="rotationX">1 0 0 0</rotate><scale sid="scale">1 1 1</scale>
      <instance_camera url="#Camera-camera"/></node>
    <node id="Lamp" name="Lamp" type="NODE"><translate sid="location">0 0 2</translate>
      <instance_light url="#Lamp-light"/></node>
    <node id="Square" name="Square" type="NODE"><instance_geometry url="#Square-mesh"><bind_material>
      <technique_common><instance_material symbol="Paint-material" target="#Paint-material"/>
      </technique_common></bind_material></instance_geometry></node>
  </visual_scene></library_visual_scenes>
  <scene><instance_visual_scene url="#Scene"/></scene>
</COLLADA>
"""
MAPPINGS = """\
Generic {
    Paint-material:material:matte
    Paint-material:diffuseReflectance.spectrum = (paint)
    Lamp-light:light:point
    Lamp-light:intensity.spectrum = 300:10 800:10
}
"""


@pytest.fixture
def plugin(monkeypatch):
    """Install somebody else's renderer, called plain, for this process and its children."""
    inherited = os.environ.get("PYTHONPATH", "")
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join(filter(None, [str(PLUGIN), inherited])))
    monkeypatch.syspath_prepend(str(PLUGIN))
    return monkeypatch


@pytest.fixture
def write_family(tmp_path, plugin):
    """Return a function that writes a recipe with a row for each name and paint."""
    from rtb_addon.conditions import parse_conditions
    from rtb_addon.recipe import write_recipe
    from rtb_addon.recipe.options import Conventions, MontageOptions, RecipeOptions

    def write(paints: dict[str, str], folder="family", conventions=None, resources=None, **options):
        rows = "".join(f"{name}\t{paint}\n" for name, paint in paints.items())
        options = {"renderer": "plain", "width": 4, "height": 3, "samples": 2, **options}
        return write_recipe(
            tmp_path / folder,
            "family",
            RecipeOptions(**options),
            conventions or Conventions(),
            MontageOptions(),
            PARENT.encode(),
            parse_conditions(f"imageName\tpaint\n{rows}", "conditions.txt", "family"),
            MAPPINGS,
            resources or {},
            {"by": "a test"},
        )

    return write


@pytest.fixture
def old_recipe(tmp_path):
    """Write an old recipe's three files, and others that they name in places of all kinds."""
    for folder in ("old/resources", "data/deep"):
        (tmp_path / folder).mkdir(parents=True)
    for name in ("old/beside.spd", "old/resources/inside.spd", "data/deep/far.spd"):
        (tmp_path / name).write_text("300 0.5\n800 0.5\n")
    (tmp_path / "old" / "stone.png").write_bytes(b"a picture")
    parent, conditions, mappings = (tmp_path / "old" / f"old{end}" for end in (".dae", "C.txt", "M.txt"))
    image = '<library_images><image id="i"><init_from>file:///C:/me/stone.png</init_from></image></library_images>'
    parent.write_text(PARENT.replace("<library_cameras>", image + "<library_cameras>"))
    conditions.write_text(
        "imageName\tpaint\n% all kinds of places\na\tbeside.spd\nb\tresources/inside.spd\nc\tgone.spd\n"
    )
    mappings.write_text(
        MAPPINGS.replace("300:10 800:10", "D65.spd")
        + "PBRT {\n    Paint-material:material:matte\n    Paint-material:Kd.spectrum = far.spd\n}\n"
    )
    return parent, conditions, mappings
