"""Materials in the words of the vocabulary: their properties, what becomes of them, and what renders."""

import sys
from types import SimpleNamespace

import bpy
import numpy as np
import pytest

import rtb_addon as rtb
from rtb_addon.renderers.fidelity import TABLE
from rtb_addon.scene.vocabulary import MATERIALS
from tests.blender.stand_in_layout import RecordingLayout

RENDERED = sorted(
    feature.removeprefix("material ")
    for feature, renderers in TABLE.items()
    if feature.startswith("material ") and {"mitsuba", "tracer"} & set(renderers)
)
AROUND = ("bumpmap", "normalmap")
SIZE = 8  # of each patch of a chart [pixels]


@pytest.fixture
def paint(scene, box, lamp):
    """The spectral material of a box in a lit scene."""
    lamp().data.rtb.use_spectra = True
    box()
    settings = bpy.data.materials["Paint"].rtb
    settings.use_spectra = True
    return settings


@pytest.fixture
def patch(put):
    """Return how to put a square of a material into a chart: patch(3, material)."""

    def put_patch(number, material, uvs=True):
        mesh = bpy.data.meshes.new(f"Patch {number}")
        corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
        mesh.from_pydata(corners, [], [(0, 1, 2, 3)])
        if uvs:
            layer = mesh.uv_layers.new()
            for loop, (x, y, _) in zip(layer.data, corners, strict=True):
                loop.uv = (x, y)
        mesh.materials.append(material)
        return put(f"Patch {number}", mesh, location=(number, 0, 0))

    return put_patch


def spectral(name: str, **said):
    """Return a new material that is tagged; its model comes first, and brings its defaults."""
    material = bpy.data.materials.new(name)
    material.rtb.use_spectra = True
    for key, value in said.items():
        setattr(material.rtb, key, value)
    return material


def image_of(path, pixels) -> bpy.types.Image:
    """Return an image of (height, width, 3) numbers, from the lowest row up, saved as a PNG."""
    height, width, _ = np.shape(pixels)
    image = bpy.data.images.new(path.stem, width, height)
    image.colorspace_settings.name = "Non-Color"
    image.pixels = np.concatenate([pixels, np.ones((height, width, 1))], axis=2).ravel().tolist()
    image.filepath_raw, image.file_format = str(path), "PNG"
    image.save()
    return image


# Properties


@pytest.mark.parametrize("model", [model for model in RENDERED if model not in AROUND])
def test_every_model_that_a_renderer_has_is_offered_with_every_parameter(paint, library, model):
    paint.model = model
    words = library("blender.material_words").words_of
    assert all(hasattr(paint, words(parameter).name) for parameter in MATERIALS[model])


def test_a_model_begins_with_the_vocabularys_defaults_and_keeps_what_was_chosen(paint):
    paint.reflectance = "0.25"
    for model, parameter, wanted in (
        ("metal", "roughness", 0.4),
        ("roughplastic", "roughness", 0.1),
        ("anisoward", "specular_reflectance", "0.5"),
        ("mirror", "specular_reflectance", "1"),
    ):
        paint.model = model
        found = getattr(paint, parameter)
        assert found == (pytest.approx(wanted) if isinstance(wanted, float) else wanted)
    paint.model = "matte"
    assert paint.reflectance == "0.25"
    paint.model, paint.roughness = "metal", 0.33
    paint.model = "roughglass"
    assert paint.roughness == pytest.approx(0.33)


def test_what_files_from_before_hold_means_the_same(paint):
    group = paint.bl_rna.properties
    assert (group["model"].default, group["reflectance"].default, paint.use_spectra) == ("matte", "0.5", True)
    assert group["model"].enum_items["matte"].value == 1


def test_a_material_that_an_earlier_version_saved_keeps_its_values(scene, box):
    box()
    material = bpy.data.materials["Paint"]
    # As such a file holds them, which had these three properties.
    material["rtb"] = {"use_spectra": 1, "model": 1, "reflectance": "BabelColor Average/blue"}
    settings = material.rtb
    assert (settings.use_spectra, settings.model) == (True, "matte")
    assert settings.reflectance == "BabelColor Average/blue"
    assert settings.opacity == 1.0


def test_numbers_of_a_material_vary_like_any_property(paint, scene, resolved, library):
    paint.model, paint.roughness = "metal", 0.2
    with bpy.context.temp_override(object=bpy.data.objects["Box"]):
        bpy.ops.rtb.vary_property(home="materials", thing="Paint", path="rtb.roughness", variable="rough")
    scene.rtb.conditions[0].name = "smooth"
    bpy.ops.rtb.add_condition()
    scene.rtb.conditions[-1].name = "coarse"
    scene.rtb.conditions[-1].cells[0].value = "0.5"
    for condition, wanted in (("smooth", 0.2), ("coarse", 0.5)):
        found = resolved(scene, condition).materials["Paint-material"].parameters["roughness"]
        assert found == pytest.approx(wanted, rel=1e-6)
    assert paint.roughness == pytest.approx(0.2)


def test_everything_survives_undo_appending_and_saving(paint, tmp_path):
    other = spectral("Other")
    paint.model, paint.part, paint.weight = "blend", other, 0.25
    paint.other_part, paint.detail_scale = other, 0.5
    texture = paint.reflectance_texture
    texture.kind, texture.checks, texture.odd = "checkerboard", (4, 8), "(odd)"
    bpy.ops.ed.undo_push(message="before")
    bpy.data.materials["Paint"].rtb.weight = 0.75
    bpy.ops.ed.undo_push(message="after")
    bpy.ops.ed.undo()
    assert bpy.data.materials["Paint"].rtb.weight == 0.25
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "kept.blend"))
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    with bpy.data.libraries.load(str(tmp_path / "kept.blend")) as (_, wanted):
        wanted.materials = ["Paint"]
    found = bpy.data.materials["Paint"].rtb
    assert (found.model, found.part.name, found.weight) == ("blend", "Other", 0.25)
    assert (found.reflectance_texture.odd, tuple(found.reflectance_texture.checks)) == ("(odd)", (4, 8))
    assert found.detail_scale == 0.5


def test_a_metal_is_chosen_by_its_name(paint):
    paint.model = "metal"
    with bpy.context.temp_override(object=bpy.data.objects["Box"]):
        bpy.ops.rtb.use_metal(metal="Metals/Au gold")
    assert (paint.eta, paint.k) == ("Metals/Au gold eta", "Metals/Au gold k")


# What is written


def test_each_parameter_is_said_in_the_vocabularys_words(paint, scene, resolved):
    paint.model, paint.eta, paint.k, paint.roughness = "metal", "Metals/Au gold eta", "Metals/Au gold k", 0.2
    found = resolved(scene).materials["Paint-material"]
    assert found.model == "metal"
    assert found.parameters["roughness"] == pytest.approx(0.2)
    assert found.parameters["eta"].at(582.1) == pytest.approx(0.29)  # Johnson and Christy 1972
    paint.model, paint.variant, paint.alpha_u = "anisoward", "balanced", 0.25
    found = resolved(scene).materials["Paint-material"]
    assert (found.parameters["variant"], found.parameters["alphaU"]) == ("balanced", 0.25)


def test_an_index_is_a_number_or_a_spectrum(paint, scene, resolved):
    paint.model, paint.ior = "glass", "1.7"
    assert resolved(scene).materials["Paint-material"].parameters["intIOR"] == 1.7
    paint.ior = "Glasses/N-BK7"
    assert resolved(scene).materials["Paint-material"].parameters["intIOR"].at(590) == pytest.approx(
        1.5167, abs=1e-4
    )


def test_a_blend_brings_its_parts_that_nothing_else_shows(paint, scene, resolved, read):
    paint.model, paint.weight = "blend", 0.25
    paint.part = spectral("First", reflectance="0.2")
    with pytest.raises(Exception, match="material Paint says nothing for Second, choose a material"):
        read(scene)
    paint.other_part = spectral("Second", model="mirror")
    materials = resolved(scene).materials
    said = materials["Paint-material"].parameters
    assert (said["materialID"], said["otherMaterialID"], said["weight"]) == (
        *("First-material", "Second-material"),
        0.25,
    )
    assert materials["First-material"].parameters["diffuseReflectance"].at(500) == pytest.approx(0.2)
    assert materials["Second-material"].model == "mirror"


def test_detail_goes_around_a_surface(paint, scene, resolved, tmp_path):
    paint.detail, paint.detail_scale, paint.opacity = "bumpmap", 0.02, 0.5
    paint.detail_image = image_of(tmp_path / "heights.png", np.full((2, 2, 3), 0.5))
    scene.unit_settings.scale_length = 0.1
    found = resolved(scene)
    mask = found.materials["Paint-material"]
    bump = found.materials[mask.parameters["materialID"]]
    matte = found.materials[bump.parameters["materialID"]]
    assert (mask.model, bump.model, matte.model) == ("mask", "bumpmap", "matte")
    assert bump.parameters["scale"] == pytest.approx(0.002), "metres"
    assert found.textures[bump.parameters["textureID"]].parameters["filename"].endswith("heights.png")


def test_what_was_measured_goes_along_as_a_file(paint, scene, read, resolved, tmp_path):
    paint.model = "measured"
    with pytest.raises(Exception, match="material Paint needs a file of what was measured, choose one"):
        read(scene)
    (tmp_path / "satin.bsdf").write_bytes(b"tensor_file")
    paint.file = str(tmp_path / "satin.bsdf")
    assert read(scene).resources["satin.bsdf"] == b"tensor_file"
    found = resolved(scene).materials["Paint-material"]
    assert found.parameters["filename"].endswith("resources/satin.bsdf")
    paint.file = str(tmp_path / "gone.bsdf")
    with pytest.raises(Exception, match=r"gone\.bsdf, which cannot be read"):
        read(scene)


def test_images_that_are_in_no_file_are_refused_and_packed_ones_are_written(paint, scene, read, tmp_path):
    paint.reflectance_texture.kind = "bitmap"
    with pytest.raises(Exception, match="has a texture without an image, choose one"):
        read(scene)
    paint.reflectance_texture.image = bpy.data.images.new("Painted", 2, 2)
    with pytest.raises(Exception, match="image Painted, which is in no file: save or pack it"):
        read(scene)
    paint.reflectance_texture.image = image = image_of(tmp_path / "heights.png", np.full((2, 2, 3), 0.5))
    image.pack()
    (tmp_path / "heights.png").unlink()
    assert read(scene).resources["heights.png"].startswith(b"\x89PNG")


def test_conditions_vary_spectra_of_every_parameter(paint, scene, resolved):
    paint.model, paint.transmittance, paint.ior = "glass", "(tint)", "(index)"
    scene.rtb.set_conditions(
        ["imageName", "tint", "index"], [("a", "0.5", "1.4"), ("b", "0.7", "Glasses/water")]
    )
    for condition, tint, index in (("a", 0.5, 1.4), ("b", 0.7, 1.3334)):
        said = resolved(scene, condition).materials["Paint-material"].parameters
        assert said["specularTransmittance"].at(500) == pytest.approx(tint)
        assert said["intIOR"].at(580) == pytest.approx(index, abs=1e-3)
    variables = scene.rtb.variables
    scene.rtb.active_variable = variables.find("tint")
    bpy.ops.rtb.rename_variable(name="colour")
    assert paint.transmittance == "(colour)"


# What renders


def in_both(model: str) -> bool:
    return {"mitsuba", "tracer"} <= set(TABLE.get(f"material {model}", ()))


def chart(patch, tmp_path):
    """Yield (material, what a white furnace shows of it, None where that has no closed form)."""
    red = spectral("Red", reflectance="0.25")
    silver = spectral("Silver", model="mirror", specular_reflectance="0.8")
    checks = spectral("Checks")
    texture = checks.rtb.reflectance_texture
    texture.kind, texture.even, texture.odd = "checkerboard", "0.25", "0.75"
    picture = spectral("Picture")
    texture = picture.rtb.reflectance_texture
    texture.kind, texture.image = "bitmap", image_of(tmp_path / "grey.png", np.full((2, 2, 3), 0.6))
    yield red, 0.25
    yield silver, 0.8
    yield checks, 0.5
    yield picture, 0.6
    yield spectral("Blend", model="blend", part=red, other_part=silver, weight=0.25), 0.75 * 0.25 + 0.25 * 0.8
    yield spectral("Mask", model="mask", part=red, opacity=0.5), 0.5 * 0.25 + 0.5
    yield spectral("Thin", reflectance="0.25", opacity=0.75), 0.75 * 0.25 + 0.25
    yield spectral("Pane", model="thinglass"), 1.0
    yield spectral("Glass", model="glass", transmittance="0.9"), None
    yield spectral("Frost", model="roughglass"), None
    yield spectral("Gold", model="metal", eta="Metals/Au gold eta", k="Metals/Au gold k", roughness=0.2), None
    yield spectral("Ward", model="anisoward", reflectance="0.2", alpha_u=0.3), None
    yield spectral("Plastic", model="plastic", reflectance="0.6"), None
    yield spectral("Rough", model="roughplastic", reflectance="0.6"), None
    if in_both("principled"):
        yield spectral("Principled", model="principled", base_reflectance="0.6"), None
    for relief, pixel, wanted in (("bumpmap", (0.5, 0.5, 0.5), 0.25), ("normalmap", (0.3, 0.5, 0.9), None)):
        if in_both(relief):
            tilted = spectral(relief.title(), reflectance="0.25", detail=relief, detail_scale=0.1)
            tilted.rtb.detail_image = image_of(tmp_path / f"{relief}.png", np.full((2, 2, 3), pixel))
            yield tilted, wanted


def test_every_material_renders_alike_in_both_renderers(scene, patch, library, tmp_path):
    made = list(chart(patch, tmp_path))
    for number, (material, _) in enumerate(made):
        patch(number, material)
    world = scene.world = bpy.data.worlds.new("White")
    world.rtb.use_spectra = True
    camera = scene.camera
    camera.data.type, camera.data.ortho_scale = "ORTHO", len(made)
    camera.location = (len(made) / 2, 0.5, 5)
    settings = scene.rtb
    settings.width, settings.height = SIZE * len(made), SIZE
    settings.samples, settings.bands_start, settings.bands_step, settings.bands_count = 64, 450, 100, 3
    folder = library("blender").read_recipe(scene).save(tmp_path / "chart")
    means, errors = [], []
    for renderer in ("mitsuba", "tracer"):
        (rendering,) = rtb.execute_recipe(folder, renderer=renderer)
        patches = rendering.image.radiance.reshape(SIZE, len(made), SIZE, -1).swapaxes(1, 2)
        pixels = patches.reshape(SIZE * SIZE, len(made), -1)
        means.append(pixels.mean(axis=0))
        errors.append(pixels.std(axis=0) / SIZE)
    noise = np.hypot(*errors)
    np.testing.assert_array_less(np.abs(means[0] - means[1]), 5 * noise + 2e-4)
    for number, (material, wanted) in enumerate(made):
        for mean, error in zip(means, errors, strict=True):
            if wanted is not None:
                assert (np.abs(mean[number] - wanted) < 5 * error[number] + 1e-4).all(), material.name


# What is said before anything renders


@pytest.fixture
def told(paint, extension, monkeypatch):
    """Return the lines of In the Renderers, where the table says what a test says."""
    words = sys.modules[f"{extension}.panels.renderer_words"]
    fidelity = sys.modules[f"{extension}.rtb_addon.renderers.fidelity"]

    def lines(table):
        monkeypatch.setattr(fidelity, "TABLE", table)
        layout = RecordingLayout()
        context = SimpleNamespace(region=SimpleNamespace(width=600), preferences=bpy.context.preferences)
        words.draw_renderers(layout, context, list(words.features(paint)))
        return layout.names("label")[1:]

    return lines


def test_the_panel_says_what_is_exact_approximate_and_absent(paint, told, library):
    fidelity = library("renderers.fidelity")
    paint.model = "roughglass"
    glass = {"material roughglass": {"mitsuba": fidelity.EXACT, "tracer": fidelity.EXACT}}
    assert told(glass) == ["Mitsuba: exact", "Tracer: exact"]
    paint.ior = "Glasses/N-BK7"
    close = fidelity.Fidelity("approximate", "as at 589.3 nm")
    table = {**glass, "index spectrum": {"mitsuba": close, "tracer": fidelity.EXACT}}
    assert told(table) == [
        "Mitsuba: approximate",
        "An index that varies with wavelength: approximate, as at 589.3 nm",
        "Tracer: exact",
    ]
    assert told(glass)[:2] == ["Mitsuba: absent", "An index that varies with wavelength is absent"]


def test_every_feature_of_a_material_is_asked_for_by_the_tables_words(paint, extension):
    features = sys.modules[f"{extension}.panels.renderer_words"].features
    paint.model, paint.detail, paint.opacity = "metal", "normalmap", 0.5
    paint.distribution = "ggx"
    assert [feature for feature, _ in features(paint)] == [
        *("material metal", "distribution ggx", "material normalmap", "material mask")
    ]
    paint.model = "plastic"
    paint.reflectance_texture.kind = "checkerboard"
    assert "texture checkerboard" in [feature for feature, _ in features(paint)]
