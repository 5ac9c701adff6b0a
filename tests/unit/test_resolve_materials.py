"""Materials and textures of the neutral scene, from mappings or from the parent scene."""

import pytest

from rtb_addon.errors import RecipeError
from tests.unit.small_rooms import generic, in_folder, resolved, room

# Materials.


def test_a_material_without_a_mapping_keeps_its_colour_and_says_so():
    builder = room()
    builder.material("Red", (0.8, 0.1, 0.2))
    builder.plane("Other", material="Red")
    found = resolved(builder)
    red = found.scene.materials["Red-material"]
    assert red.model == "matte"
    assert red.parameters["diffuseReflectance"].at([430, 545, 650]) == pytest.approx([0.2, 0.1, 0.8])
    assert (
        "Red-material has no mapping: its colour 0.8 0.1 0.2 was promoted to a reflectance" in found.warnings
    )


def test_a_declared_material_has_what_it_says_and_the_defaults():
    lines = ("Paint-material:material:anisoward", "Paint-material:alphaU.float = 0.25")
    material = resolved(room(), generic(*lines)).scene.materials["Paint-material"]
    assert material.model == "anisoward"
    assert material.parameters["alphaU"] == 0.25
    assert material.parameters["alphaV"] == 0.1
    assert material.parameters["variant"] == "ward"
    assert material.parameters["diffuseReflectance"].values.tolist() == [0.5, 0.5]


def test_declaring_again_begins_anew_and_configuring_again_does_not():
    first = generic("Paint-material:material:anisoward", "Paint-material:alphaU.float = 0.25")
    more = generic("Paint-material:alphaV.float = 0.3")
    anew = generic("Paint-material:material:anisoward", "Paint-material:alphaV.float = 0.3")

    def alphas(text):
        parameters = resolved(room(), text).scene.materials["Paint-material"].parameters
        return parameters["alphaU"], parameters["alphaV"]

    assert alphas(first + more) == (0.25, 0.3)
    assert alphas(first + anew) == (0.1, 0.3)
    said = "mappings.txt:6: Paint-material is declared again, so alphaU of line 2 no longer counts"
    assert said in resolved(room(), first + anew).warnings
    assert not any("declared again" in each for each in resolved(room(), first + more).warnings)


@pytest.mark.parametrize("text", ["paint.spd", "300:0.25 800:0.75"])
def test_a_spectrum_is_a_file_or_a_text(tmp_path, text):
    (tmp_path / "paint.spd").write_text("300 0.25\n800 0.75\n")
    lines = ("Paint-material:material:matte", f"Paint-material:diffuseReflectance.spectrum = {text}")
    scene = resolved(room(), generic(*lines), find_file=in_folder(tmp_path)).scene
    assert scene.materials["Paint-material"].parameters["diffuseReflectance"].at(550) == pytest.approx(0.5)


def test_a_texture_is_used_by_its_id():
    lines = (
        "Paint-material:material:matte",
        "Paint-material:diffuseReflectance.texture = checks",
        "checks:spectrumTexture:checkerboard",
        "checks:checksPerU.float = 8",
    )
    scene = resolved(room(), generic(*lines)).scene
    assert scene.materials["Paint-material"].parameters["diffuseReflectance"].texture == "checks"
    assert scene.textures["checks"].kind == "checkerboard"
    assert scene.textures["checks"].parameters["checksPerU"] == 8


METAL = ("Paint-material:eta.spectrum = 300:1", "Paint-material:k.spectrum = 300:1")

BUMPS = (
    "checks:floatTexture:checkerboard",
    "Bumps:material:bumpmap",
    "Bumps:materialID.string = Paint-material",
    "Bumps:textureID.string = checks",
)


@pytest.mark.parametrize("lines", [BUMPS, ("Paint-material:material:metal", *METAL, *BUMPS)])
def test_bumps_go_around_the_material_that_they_name(lines):
    found = resolved(room(), generic(*lines))
    (shape,) = found.scene.shapes
    outer = found.scene.materials[shape.material]
    assert (outer.id, outer.model, outer.parameters["scale"]) == ("Paint-material", "bumpmap", 1)
    inner = found.scene.materials[outer.parameters["materialID"]]
    assert (inner.id, inner.model) == ("Paint-material-inner", "metal" if len(lines) > 4 else "matte")
    assert outer.parameters["textureID"] in found.scene.textures
    assert not any("material of nothing" in each for each in found.warnings)


def test_bumps_that_are_a_shapes_own_material_leave_others_flat():
    builder = room()
    builder.plane("Floor", 2, 2, "Bumps")
    lines = (each.replace("Bumps:", "Bumps-material:") for each in BUMPS)
    scene = resolved(builder, generic(*lines)).scene
    assert [scene.materials[each.material].model for each in scene.shapes] == ["matte", "bumpmap"]
    assert scene.materials["Bumps-material"].parameters["materialID"] == "Paint-material"


MATTE = "Paint-material:material:matte"


@pytest.mark.parametrize(
    ("lines", "line", "words"),
    [
        (["Paint-material:material:mate"], 2, "no material is called mate, want one of matte, "),
        (["Paint-material:stuff:matte"], 2, "is declared a stuff, want one of .*material"),
        (
            [MATTE, "Paint-material:diffuseReflectanse.spectrum = 1"],
            3,
            "matte has no diffuseReflectanse, it has diff",
        ),
        (
            [MATTE, "Paint-material:diffuseReflectance.spectrum = nosuch.spd"],
            3,
            "there is no spectrum file nosuch.spd",
        ),
        (
            [MATTE, "Paint-material:diffuseReflectance.spectrum = bright"],
            3,
            "no wavelength:value pair|no number",
        ),
        ([MATTE, "Paint-material:diffuseReflectance.texture = wood"], 2, "uses a texture wood, declare it"),
        (["Paint-material:diffuseReflectance.spectrum = 300:1"], 2, "is not declared, add .*:material:matte"),
        (
            ["Paint-material:material:anisoward", "Paint-material:alphaU.float = few"],
            3,
            "alphaU is 'few', want one number",
        ),
        (["Paint-material:material:metal", "Paint-material:k = Xx.k.spd"], 3, "no spectrum file Xx.k.spd"),
        (["Paint-material:material:bumpmap"], 2, "Paint-material must say its materialID"),
        (["Lamp-light:light:pont"], 2, "no light is called pont, want one of point"),
        (
            ["Lampe-light:light:point"],
            2,
            "no light in the scene has the id Lampe-light, there are Lamp-light",
        ),
        (["Wal-mesh:light:area"], 2, "no mesh in the scene has the id Wal-mesh, there are Wall-mesh"),
        (
            ["Lamp-light:light:area"],
            2,
            "Lamp-light is a lamp, declare the mesh that emits: Lamp-mesh:light:area",
        ),
        (["Lamp-light:material:matte"], 2, "Lamp-light is a light of the parent scene, declare it a light"),
        (
            ["Paint-material:light:point"],
            2,
            "Paint-material is the material of a shape|no light in the scene",
        ),
        (["sky:light:environment", "more:light:environment"], 3, "more is a second environment, beside sky"),
    ],
)
def test_what_is_wrong_in_a_block_is_said_with_its_place_and_what_would_be_right(lines, line, words):
    with pytest.raises(RecipeError, match=rf"^mappings.txt:{line}: .*({words})"):
        resolved(room(), generic(*lines))


def test_a_missing_file_says_where_it_was_looked_for():
    lines = (MATTE, "Paint-material:diffuseReflectance.spectrum = resources/nosuch.spd")
    with pytest.raises(
        RecipeError, match="in the recipe's folder or its resources/, and the library serves none"
    ):
        resolved(room(), generic(*lines))


def test_a_reflectance_above_one_is_said():
    lines = (MATTE, "Paint-material:diffuseReflectance.spectrum = 300:1.78 800:0.1")
    assert any(
        "diffuseReflectance of Paint-material reaches 1.78" in each
        for each in resolved(room(), generic(*lines)).warnings
    )


def test_a_material_of_nothing_is_said():
    found = resolved(room(), generic("Pant-material:material:matte"))
    assert "mappings.txt:2: Pant-material is the material of nothing in the scene" in found.warnings


def test_an_object_without_material_is_grey_and_said():
    text = room().tobytes().decode().replace('material="Paint-material"', "").encode()
    found = resolved(text)
    assert found.scene.shapes[0].material == "no-material"
    assert "the object Wall has no material and becomes grey" in found.warnings
    declared = resolved(text, generic("no-material:material:matte", "no-material:diffuseReflectance = 1"))
    assert declared.scene.materials["no-material"].parameters["diffuseReflectance"].at(500) == 1


def test_a_metal_is_copper_unless_it_says_another(tmp_path):
    for name in ("Cu.eta.spd", "Cu.k.spd"):
        (tmp_path / name).write_text("300 0.2\n800 0.3\n")
    scene = resolved(room(), generic("Paint-material:material:metal"), find_file=in_folder(tmp_path)).scene
    metal = scene.materials["Paint-material"]
    assert metal.parameters["eta"].at(550) == pytest.approx(0.25)
    assert metal.parameters["roughness"] == 0.4


def test_metals_that_the_recipe_has_no_files_of_are_the_librarys():
    found = resolved(room(), generic("Paint-material:material:metal", "Paint-material:k = Ag.k.spd"))
    metal = found.scene.materials["Paint-material"].parameters
    assert (metal["eta"].at(582.1), metal["k"].at(582.1)) == (0.7, 3.858)  # Johnson and Christy 1972
    assert any("Cu.eta.spd is not in the recipe's folder" in each for each in found.warnings)


@pytest.mark.parametrize("symbol", ["Paint", "Paint-material"])
def test_very_old_files_bind_materials_by_their_names(symbol):
    text = (
        room()
        .tobytes()
        .decode()
        .replace('triangles material="Paint-material"', f'triangles material="{symbol}"')
    )
    bound = text[text.index("<bind_material>") : text.index("</bind_material>") + len("</bind_material>")]
    for version in (text, text.replace(bound, "")):
        assert resolved(version.encode()).scene.shapes[0].material == "Paint-material"
