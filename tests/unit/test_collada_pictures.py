"""Pictures that stand for colours in a parent scene."""

import pytest

from rtb_addon.errors import RecipeError
from rtb_addon.recipe.named_files import texture_names
from rtb_addon.scene.render_scene import TextureUse
from tests.unit.dialects import asset, bound, document, resolved, square

# Pictures.

WOOD = {
    "1.4": (
        """<library_images><image id="wood-image"><init_from>./images/my%20wood.png</init_from></image>
        </library_images>""",
        """<newparam sid="wood-surface"><surface type="2D"><init_from>wood-image</init_from></surface>
        </newparam>
        <newparam sid="wood-sampler"><sampler2D><source>wood-surface</source></sampler2D></newparam>""",
        "wood-sampler",
    ),
    "1.4, the image at once": (
        """<library_images><image id="wood-image"><init_from>./images/my%20wood.png</init_from></image>
        </library_images>""",
        "",
        "wood-image",
    ),
    "1.5": (
        """<library_images><image id="wood-image"><init_from><ref>./images/my%20wood.png</ref></init_from>
        </image>
        </library_images>""",
        """<newparam sid="wood-sampler"><sampler2D><instance_image url="#wood-image"/></sampler2D>
        </newparam>""",
        "wood-sampler",
    ),
}


def wooden(kind):
    images, parameters, texture = WOOD[kind]
    effect = f'<lambert><diffuse><texture texture="{texture}" texcoord="UVSET1"/></diffuse></lambert>'
    uvs = "".join(
        f"""<source id="uv{k}"><float_array id="uv{k}-a" count="2">{k} {k}</float_array><technique_common>
        <accessor source="#uv{k}-a" count="1" stride="2"><param name="S"/><param name="T"/></accessor>
        </technique_common></source>"""
        for k in (0, 1)
    )
    faces = """<polygons material="{symbol}" count="1"><input semantic="VERTEX" source="#{id}-v" offset="0"/>
      <input semantic="TEXCOORD" source="#uv0" offset="1" set="0"/>
      <input semantic="TEXCOORD" source="#uv1" offset="1" set="1"/><p>0 0 1 0 2 0 3 0</p></polygons>"""
    inputs = "".join(
        f'<bind_vertex_input semantic="UVSET{k}" input_semantic="TEXCOORD" input_set="{k}"/>' for k in (0, 1)
    )
    nodes = f"""<node id="Square"><instance_geometry url="#Square-mesh">{bound("paint", "red", inputs)}
      </instance_geometry></node><node id="Eye"><instance_camera url="#eye"/></node>
      <node id="Lamp"><instance_light url="#lamp"/></node>"""
    geometry = square("Square-mesh", "Square", 1.0, "Z_UP", faces, uvs)
    head = asset("me", 1.0, "Z_UP")
    return document(head, nodes, geometry, effect=effect, more=images, parameters=parameters)


@pytest.mark.parametrize("kind", WOOD)
def test_a_picture_in_the_recipe_is_the_reflectance(kind, tmp_path):
    asked = []

    def find_file(name):
        asked.append(name)
        return tmp_path / "wood.png"

    found = resolved(wooden(kind), find_file)
    assert asked == ["./images/my%20wood.png"]
    assert found.scene.materials["red"].parameters["diffuseReflectance"] == TextureUse("wood-image")
    texture = found.scene.textures["wood-image"]
    assert (texture.kind, texture.parameters["filename"]) == ("bitmap", str(tmp_path / "wood.png"))
    assert (texture.parameters["gamma"], texture.parameters["wrapMode"]) == (-1, "repeat")
    (shape,) = found.scene.shapes
    assert shape.mesh.uvs.tolist() == [[1, 1]] * 4  # the set that the picture asks for


@pytest.mark.parametrize("kind", WOOD)
def test_a_picture_belongs_to_what_a_recipe_names(kind, tmp_path):
    (tmp_path / "parent.dae").write_text(wooden(kind))
    assert "./images/my%20wood.png" in texture_names(tmp_path / "parent.dae")


def test_a_picture_that_is_not_in_the_recipe_is_grey_and_said():
    found = resolved(wooden("1.4"))
    assert found.scene.textures == {}
    assert any(
        "its picture ./images/my%20wood.png is not in the recipe's folder or its resources/, grey" in each
        for each in found.warnings
    )

    def refuse(name):
        raise RecipeError(f"{name} lies outside")

    assert any("lies outside, grey" in each for each in resolved(wooden("1.4"), refuse).warnings)
