"""The materials that come with the extension, and presets of one's own."""

import importlib.util
import subprocess
import sys
from pathlib import Path

import bpy
import numpy as np
import pytest

from rtb_addon.spectra.spoken import spectrum_from

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def assets(tmp_path_factory) -> Path:
    """The folder that the zip brings, made anew in a process of its own."""
    folder = tmp_path_factory.mktemp("assets")
    script = ROOT / "packaging/make_assets.py"
    subprocess.run([sys.executable, str(script), "--", str(folder)], check=True, capture_output=True)
    return folder


@pytest.fixture
def materials(scene, assets):
    with bpy.data.libraries.load(str(assets / "spectral_materials.blend"), assets_only=True) as (
        there,
        wanted,
    ):
        wanted.materials = list(there.materials)
    return list(bpy.data.materials)


def test_every_shipped_material_is_an_asset_in_a_catalog_with_a_picture(materials, assets):
    lines = (assets / "blender_assets.cats.txt").read_text().splitlines()[1:]
    catalogs = {line.split(":")[0] for line in lines}
    assert len(materials) > 70
    for each in materials:
        assert each.asset_data.catalog_id in catalogs
        assert each.asset_data.license == "CC0"
        assert each.preview.image_size[0] == 128
    assert (assets / "spectral_materials.blend").stat().st_size < 500_000


def test_every_shipped_material_says_spectra_that_are_there(materials, library):
    fields = library("blender.fields")
    for each in materials:
        assert each.rtb.use_spectra
        for field in fields.fields_of("material"):
            if not field.within:
                spectrum_from(getattr(each.rtb, field.name))
    gold = bpy.data.materials["gold, brushed"].rtb
    assert (gold.model, gold.eta) == ("metal", "Metals/Au gold eta")
    assert gold.roughness == pytest.approx(0.2)


def test_blenders_own_colour_is_about_that_of_the_spectrum(materials):
    red, blue = (np.array(bpy.data.materials[name].diffuse_color[:3]) for name in ("red", "blue"))
    assert red[0] > 3 * red[2]
    assert blue[2] > 3 * blue[0]


def test_the_asset_browser_shows_them_while_the_extension_is_enabled(library, assets, extension):
    shown, libraries = library("blender.asset_library"), bpy.context.preferences.filepaths.asset_libraries
    before = [each.path for each in libraries]
    shown.register(assets)
    shown.register(assets)
    assert [each.path for each in libraries] == [*before, str(assets)]
    shown.unregister(assets)
    shown.unregister(assets)
    assert [each.path for each in libraries] == before
    shown.register(assets / "nowhere")
    assert [each.path for each in libraries] == before


def test_presets_bring_a_material_back(scene, box, extension):
    box()
    material = bpy.data.materials["Paint"]
    material.rtb.use_spectra, material.rtb.model = True, "metal"
    material.rtb.eta, material.rtb.k, material.rtb.roughness = "Metals/Au gold eta", "Metals/Au gold k", 0.25
    other = bpy.data.materials.new("Other")
    with bpy.context.temp_override(material=material):
        bpy.ops.rtb.add_material_preset(name="My Gold")
    file = bpy.utils.preset_find("My Gold", "rtb_material", display_name=True)
    with bpy.context.temp_override(material=other):
        bpy.ops.script.execute_preset(filepath=file, menu_idname="RTB_PT_material_presets")
    assert (other.rtb.use_spectra, other.rtb.model, other.rtb.k) == (True, "metal", "Metals/Au gold k")
    assert other.rtb.roughness == pytest.approx(0.25)
    assert importlib.util.find_spec("bl_ui") is not None


SHIPPED = sorted((ROOT / "panels/presets/rtb_material").glob("*.py"))


@pytest.mark.parametrize("preset", SHIPPED, ids=lambda file: file.stem)
def test_a_shipped_preset_makes_a_material_that_can_be_read(preset, scene, box, lamp, library, extension):
    box()
    lamp("POINT")
    material = bpy.data.materials["Paint"]
    folders = [Path(each) for each in bpy.utils.preset_paths("rtb_material")]
    assert any(folder.samefile(preset.parent) for folder in folders)
    with bpy.context.temp_override(material=material):
        bpy.ops.script.execute_preset(filepath=str(preset), menu_idname="RTB_PT_material_presets")
    assert material.rtb.use_spectra
    paint = library("blender.materials").read_material(material)
    assert paint.model == material.rtb.model
    recipe = library("blender").read_recipe(bpy.context.scene)
    assert f"Paint-material:material:{paint.model}" in recipe.mappings


def test_shipped_presets_are_gone_when_the_extension_is(extension):
    presets = sys.modules[f"{extension}.panels.material_presets"]
    presets.unregister()
    try:
        assert presets.HERE not in {
            str(Path(each).parents[1]) for each in bpy.utils.preset_paths("rtb_material")
        }
    finally:
        presets.register()


def test_the_button_for_metals_tells_the_one_there_is(scene, library):
    words = library("blender.material_words")
    settings = bpy.data.materials.new("Sheet").rtb
    settings.eta, settings.k = "Metals/Au gold eta", "Metals/Au gold k"
    assert words.metal_of(settings) == "Gold (Au)"
    settings.k = "Metals/Cu copper k"
    assert words.metal_of(settings) is None
    settings.eta = settings.k = "1.5"
    assert words.metal_of(settings) is None


# What Blender's own shader comes to


def principled(material, **inputs):
    """Set inputs of a material's Principled BSDF."""
    material.use_nodes = True
    shader = next(node for node in material.node_tree.nodes if node.type == "BSDF_PRINCIPLED")
    for name, value in inputs.items():
        shader.inputs[name.replace("_", " ")].default_value = value
    return shader


def use_spectra():
    """Press the button in the panel of the box's material."""
    with bpy.context.temp_override(object=bpy.data.objects["Box"]):
        assert bpy.ops.rtb.use_spectra(thing="MATERIAL") == {"FINISHED"}


GREY = (0.5, 0.5, 0.5, 1)
SHADERS = [
    ({"Base_Color": GREY}, "matte", {"reflectance": "0.5"}),
    ({"Base_Color": GREY, "Roughness": 0.0}, "plastic", {"reflectance": "0.5", "ior": "1.5"}),
    ({"Base_Color": GREY, "Roughness": 0.3, "IOR": 1.33}, "roughplastic", {"roughness": 0.09, "ior": "1.33"}),
    ({"Base_Color": GREY, "Metallic": 1.0, "Roughness": 0.4}, "metal", {"roughness": 0.16}),
    ({"Base_Color": GREY, "Transmission_Weight": 1.0, "Roughness": 0.0}, "glass", {"transmittance": "0.707"}),
    (
        {"Transmission_Weight": 1.0, "Roughness": 0.5, "IOR": 1.4},
        "roughglass",
        {"roughness": 0.25, "ior": "1.4"},
    ),
]


@pytest.mark.parametrize(("inputs", "model", "said"), SHADERS)
def test_use_spectra_takes_over_what_the_shader_comes_to(scene, box, inputs, model, said):
    box()
    material = bpy.data.materials["Paint"]
    principled(material, **{"IOR": 1.5, **inputs})
    use_spectra()
    assert material.rtb.model == model
    for name, wanted in said.items():
        found = getattr(material.rtb, name)
        assert found == (pytest.approx(wanted) if isinstance(wanted, float) else wanted)


@pytest.mark.parametrize(("inputs", "model", "said"), SHADERS)
def test_an_untagged_material_is_promoted_alike_and_the_report_says_how(
    scene, box, lamp, read, resolved, inputs, model, said
):
    box()
    lamp()
    principled(bpy.data.materials["Paint"], **{"IOR": 1.5, **inputs})
    untagged = resolved(scene).materials["Paint-material"]
    report = [sentence for sentence in read(scene).report if "material Paint has no spectrum" in sentence]
    assert len(report) == 1
    use_spectra()
    tagged = resolved(scene).materials["Paint-material"]
    assert untagged.model == tagged.model == model
    for name, value in tagged.parameters.items():
        other = untagged.parameters[name]
        if hasattr(value, "at"):
            np.testing.assert_allclose(other.at([450, 550, 650]), value.at([450, 550, 650]), rtol=1e-3)
        else:
            assert other == pytest.approx(value) if isinstance(value, float) else other == value


def test_a_promoted_metal_reflects_its_colour_straight_on(scene, box, lamp, resolved):
    box()
    lamp()
    principled(bpy.data.materials["Paint"], Base_Color=(0.9, 0.6, 0.3, 1), Metallic=1.0)
    said = resolved(scene).materials["Paint-material"].parameters
    for nm, wanted in ((420, 0.3), (545, 0.6), (680, 0.9)):
        n, k = said["eta"].at(nm), said["k"].at(nm)
        assert ((n - 1) ** 2 + k**2) / ((n + 1) ** 2 + k**2) == pytest.approx(wanted, abs=2e-3)


def test_an_image_in_the_shader_becomes_a_texture(scene, box, lamp, resolved, tmp_path):
    box()
    lamp()
    image = bpy.data.images.new("wood", 2, 2)
    image.filepath_raw, image.file_format = str(tmp_path / "wood.png"), "PNG"
    image.save()
    material = bpy.data.materials["Paint"]
    shader = principled(material)
    node = material.node_tree.nodes.new("ShaderNodeTexImage")
    node.image = image
    material.node_tree.links.new(node.outputs["Color"], shader.inputs["Base Color"])
    found = resolved(scene)
    texture = found.materials["Paint-material"].parameters["diffuseReflectance"].texture
    assert found.textures[texture].parameters["filename"].endswith("wood.png")
    use_spectra()
    assert material.rtb.reflectance_texture.image == image


def test_relief_and_alpha_of_the_shader_are_taken_over(scene, box, lamp, read, resolved, tmp_path):
    box()
    lamp()
    image = bpy.data.images.new("heights", 2, 2)
    image.filepath_raw, image.file_format = str(tmp_path / "heights.png"), "PNG"
    image.save()
    material = bpy.data.materials["Paint"]
    shader = principled(material, Alpha=0.75)
    tree = material.node_tree
    bump, source = (tree.nodes.new(f"ShaderNode{name}") for name in ("Bump", "TexImage"))
    bump.inputs["Distance"].default_value, bump.inputs["Strength"].default_value = 0.02, 0.5
    source.image = image
    tree.links.new(source.outputs["Color"], bump.inputs["Height"])
    tree.links.new(bump.outputs["Normal"], shader.inputs["Normal"])

    def seen():
        materials = resolved(scene).materials
        mask = materials["Paint-material"]
        bumpy = materials[mask.parameters["materialID"]]
        return mask.parameters["opacity"], bumpy.model, bumpy.parameters["scale"]

    assert seen() == (0.75, "bumpmap", pytest.approx(0.01))
    use_spectra()
    assert (material.rtb.detail, material.rtb.detail_image, material.rtb.opacity) == ("bumpmap", image, 0.75)
    assert seen() == (0.75, "bumpmap", pytest.approx(0.01))
    material.rtb.use_spectra, bump.invert = False, True
    assert "what tilts its surface is left out" in "\n".join(read(scene).report)
