"""A scene as stock Mitsuba XML: the text itself, which needs no Mitsuba."""

import re
from dataclasses import replace
from xml.etree import ElementTree as Xml

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rtb_addon.errors import RecipeError, RenderingError
from rtb_addon.renderers.interface import NativeLine
from rtb_addon.renderers.mitsuba import renderer
from rtb_addon.renderers.mitsuba.native import read_native
from rtb_addon.renderers.mitsuba.one_hot import one_hot
from rtb_addon.renderers.mitsuba.renderer import check_pixels
from rtb_addon.renderers.mitsuba.xml.names import Names
from rtb_addon.renderers.mitsuba.xml.spectrum import format_spectrum, parse_spectrum, properties, range_for
from rtb_addon.scene.render_scene import Light, Material, Shape, TextureUse
from rtb_addon.spectra import FULL_RANGE, Bands, Spectrum
from tests.renderings.mitsuba_scenes import FLOOR, INTENSITY, REFLECTANCE, at, lamp, scene, square

GREY = Spectrum.constant(0.5)
GLOWING = Shape("Panel-mesh", square(1), at(0, 0, 3), "soot", INTENSITY)


def xml(one, folder, extras=()):
    return Xml.parse(renderer().translate(one, extras, folder, "scene")).getroot()


def written_and_read(spectrum, span=FULL_RANGE):
    return parse_spectrum(format_spectrum("reflectance", spectrum, span))


@pytest.mark.parametrize(
    ("places", "samples"),
    [([400, 550, 700], 48), ([401, 550, 700], 471), ([400.5, 550, 700], 941), ([380.1, 700], 4701)],
)
def test_spectra_are_regular_on_the_coarsest_grid_that_holds_every_sample(places, samples):
    spectrum = Spectrum.of(places, np.linspace(0.1, 0.9, len(places)))
    node = format_spectrum("reflectance", spectrum, FULL_RANGE)
    assert node.get("type") == "regular"
    assert len(properties(node)["values"].split(",")) == samples
    wavelengths = np.linspace(*FULL_RANGE, 12345)
    np.testing.assert_allclose(
        written_and_read(spectrum).at(wavelengths), spectrum.at(wavelengths), rtol=1e-12
    )


@settings(deadline=None)
@given(
    st.lists(st.floats(300, 900), min_size=1, max_size=30, unique=True),
    st.floats(0, 1e6),
    st.sampled_from([Bands.regular(400, 10, 31), Bands.around([300, 402.5, 403, 950])]),
)
def test_band_values_survive_writing_and_reading_whatever_the_samples(places, top, bands):
    places = sorted(places)
    spectrum = Spectrum.of(places, np.linspace(0, top, len(places)))
    if (np.diff(places) < 1e-9).any():
        return
    read = written_and_read(spectrum, range_for(bands))
    for kind in ("averaged", "centre"):
        expected = spectrum.in_bands(bands, kind)
        np.testing.assert_allclose(read.in_bands(bands, kind), expected, rtol=1e-9, atol=1e-9 * top)


def test_a_spectrum_too_fine_for_a_grid_is_irregular_and_exact():
    spectrum = Spectrum.of([400.1234567, 500, 500.0001], [0.1, 0.2, 0.9])
    assert format_spectrum("reflectance", spectrum, FULL_RANGE).get("type") == "irregular"
    assert written_and_read(spectrum).at(500.00005) == pytest.approx(0.55)


def test_black_is_uniform_because_mitsuba_refuses_tables_of_zeros():
    node = format_spectrum("reflectance", Spectrum.of([400, 700], [0, 0]), FULL_RANGE)
    assert node.get("type") == "uniform"
    assert not parse_spectrum(node).values.any()


def test_end_values_reach_to_360_and_830_and_beyond_where_bands_do():
    node = format_spectrum("reflectance", Spectrum.of([500, 600], [0.2, 0.7]), FULL_RANGE)
    values = properties(node)["values"].split(", ")
    assert (values[0], values[-1]) == ("0.2", "0.7")
    assert range_for(Bands.regular(310, 20, 31)) == (300, 920)


def test_the_film_has_a_unit_band_for_each_channel(tmp_path):
    film = xml(scene(bands=Bands.around([400.5, 410, 430])), tmp_path).find("sensor/film")
    assert film.get("type") == "specfilm"
    assert properties(film)["component_format"] == "float32"
    assert film.find("rfilter").get("type") == "box"
    responses = film.findall("spectrum")
    assert [node.get("name") for node in responses] == ["b000_400_5nm", "b001_410nm", "b002_430nm"]
    for node in responses:
        facts = properties(node)
        low, high = float(facts["wavelength_min"]), float(facts["wavelength_max"])
        assert float(facts["values"].split(",")[0]) * (high - low) == pytest.approx(1)


def test_everything_that_render_needs_is_read_back(tmp_path):
    one = scene(
        bands=Bands.around([400.5, 410, 430]), kind="centre", size=(7, 5), samples=12, depth=9, seed=5
    )
    native = read_native(renderer().translate(one, (), tmp_path, "scene"))
    assert (native.width, native.height, native.samples, native.seed, native.depth) == (7, 5, 12, 5, 9)
    np.testing.assert_array_equal(native.bands.centres, one.film.bands.centres)
    np.testing.assert_array_equal(native.bands.edges, one.film.bands.edges)
    assert native.band_kind == "centre"


def test_emitters_are_nested_in_their_shapes_and_black_shapes_emit_nothing(tmp_path):
    dark = replace(GLOWING, id="Dark", emission=Spectrum.constant(0))
    root = xml(scene(shapes=[FLOOR, GLOWING, dark]), tmp_path)
    emitters = {shape.get("id"): shape.find("emitter") for shape in root.findall("shape")}
    assert emitters["Panel-mesh"].get("type") == "area"
    assert emitters["Floor"] is None
    assert emitters["Dark"] is None


def test_conditions_share_their_meshes_and_a_scene_names_them_beside_itself(tmp_path):
    for name in ("one", "two"):
        renderer().translate(scene(shapes=[FLOOR, GLOWING]), (), tmp_path, name)
    assert len(list((tmp_path / "meshes").iterdir())) == 2
    names = re.findall(r'name="filename" value="(.*?)"', (tmp_path / "two.xml").read_text())
    assert all((tmp_path / name).is_file() and not name.startswith("/") for name in names)


def test_matte_surfaces_are_twosided_and_no_light_holds_a_plain_number(tmp_path):
    lights = [lamp("point", radius=0.0), lamp("point", radius=1.0), lamp("directional", angle=0.0)]
    lights = [replace(light, id=f"Lamp{k}") for k, light in enumerate(lights)]
    sky = lamp("environment", filename="")
    root = xml(scene(lights, [FLOOR, GLOWING], environment=sky), tmp_path)
    assert {node.get("type") for node in root.findall("bsdf")} == {"twosided", "diffuse"}
    for emitter in root.iter("emitter"):
        assert [child.get("type") for child in emitter if child.tag == "spectrum"] == ["regular"]
        assert not [child for child in emitter if child.tag in ("rgb", "float")]


def test_ids_are_clean_and_unique():
    names = Names()
    given = [names.of("shape", name) for name in ("a.b", "a_b", "A_B", "3D", "Würfel", "_x")]
    given += [names.of("material", "a.b")]
    assert len({name.lower() for name in given}) == len(given)
    assert all(re.fullmatch(r"[A-Za-z][A-Za-z0-9_-]*", name) for name in given)
    assert names.known("material", "a.b", "shape x") == given[-1]


def test_a_shape_without_its_material_is_one_sentence(tmp_path):
    with pytest.raises(RecipeError, match="shape Floor wants material wood, which the scene does not have"):
        xml(scene(shapes=[replace(FLOOR, material="wood")]), tmp_path)


@pytest.mark.parametrize(
    ("cone", "blend"), [(45.0, 0.0), (45.0, 0.15), (10.0, 0.5), (170.0, 1.0), (1.0, 0.01)]
)
def test_stock_angles_and_blenders_cone_and_blend_say_the_same(tmp_path, cone, blend):
    spot = lamp("spot", cone=cone, blend=blend, radius=0.0)
    native = read_native(renderer().translate(scene([spot]), (), tmp_path, "scene"))
    row = one_hot(native).emitters["Lamp"]
    outer = np.cos(np.radians(cone / 2))
    assert row.outer == pytest.approx(outer, abs=1e-14)
    assert row.inner - row.outer == pytest.approx((1 - outer) * blend, rel=1e-8, abs=1e-14)
    np.testing.assert_allclose(row.axis, [0, 0, -1], atol=1e-15)


def test_what_stock_mitsuba_cannot_say_stands_in_a_comment(tmp_path):
    lights = [
        replace(lamp("spot", cone=30.0, blend=0.1, radius=0.2), id="Spot"),
        replace(lamp("directional", angle=1.0), id="Sun"),
    ]
    native = renderer().translate(scene(lights), (), tmp_path, "scene")
    comments = re.findall("<!-- (.*?) -->", native.read_text())
    assert [comment.split()[0] for comment in comments] == ["Spot", "Sun"]
    said = read_native(native).beyond_stock()
    assert said == ["the edge of the spot Spot", "the disc of Sun"]


def test_no_spectrum_is_left_in_what_the_lobe_path_loads(tmp_path):
    lights = [replace(lamp("point", radius=0.0), id="A"), replace(lamp("spot", cone=9.0, radius=0.3), id="B")]
    native = read_native(renderer().translate(scene(lights, [FLOOR, GLOWING]), (), tmp_path, "scene"))
    ready = one_hot(native)
    kinds = {node.get("type") for node in Xml.fromstring(ready.xml).iter("spectrum")}
    assert kinds == {"rawconstant"}
    assert list(ready.materials) == ["black", "paint", "soot"]
    assert set(ready.emitters) == {"A", "B", "Panel-mesh-emission"}
    painted = ready.materials["paint"][0].reflectance
    np.testing.assert_allclose(painted.at([400, 550]), REFLECTANCE.at([400, 550]))
    # A spot with a radius has become a sphere of that radiance.
    np.testing.assert_allclose(ready.emitters["B"].spectrum.at(500), 2 / (np.pi * 0.09))


def line(text):
    return NativeLine(text, "mappings.txt", 7)


def test_the_lines_of_a_mitsuba_block_change_depth_and_samples(tmp_path):
    lines = [
        line("integrator:maxDepth.integer = 9"),
        line("Camera-camera_sampler:sampleCount.integer = 1024"),
    ]
    root = xml(scene(), tmp_path, lines)
    assert properties(root.find("integrator"))["max_depth"] == "9"
    assert properties(root.find("sensor/sampler"))["sample_count"] == "1024"


@pytest.mark.parametrize("text", ["integrator:integrator:photonmapper", "Red-material:bsdf:ward"])
def test_a_line_that_mitsuba_does_not_understand_is_refused_where_it_stands(tmp_path, text):
    with pytest.raises(RecipeError, match=r"^mappings.txt:7: Mitsuba has no use for"):
        xml(scene(), tmp_path, [line(text)])


def test_the_direct_integrator_is_a_path_of_depth_two(tmp_path):
    root = xml(scene(depth=6), tmp_path, [line("integrator:integrator:direct")])
    assert properties(root.find("integrator"))["max_depth"] == "2"


WRONG = {
    "depth 0": lambda: scene(depth=0),
    "texture wood, which the scene does not have": lambda: scene(reflectance=TextureUse("wood")),
    "a negative diffuseReflectance": lambda: scene(reflectance=Spectrum.constant(-0.1)),
    "a negative intensity": lambda: scene([lamp("point", intensity=Spectrum.constant(-1), radius=0.0)]),
    "no sunsky light yet": lambda: scene([Light("Lamp", "sunsky", np.eye(4), {})]),
    "-2 as its radius": lambda: scene([lamp("point", radius=-2)]),
    "a cone of 200 degrees": lambda: scene([lamp("spot", cone=200.0, blend=0.0)]),
    "knows no fog around a scene": lambda: scene(environment=lamp("fog")),
    "shines nowhere": lambda: scene([lamp("directional", np.zeros((4, 4)), angle=0.0)]),
}


def painted(model, **parameters):
    """Return a scene whose paint is of a material."""
    one = scene()
    return replace(one, materials={**one.materials, "paint": Material("paint", model, parameters)})


TINTS = {"specularReflectance": Spectrum.constant(1), "specularTransmittance": Spectrum.constant(1)}
WRONG |= {
    "paint is made of itself": lambda: painted("mask", materialID="paint", opacity=0.5),
    "material paint wants material oak": lambda: painted("mask", materialID="oak", opacity=0.5),
    "has 1.5 as its opacity": lambda: painted("mask", materialID="soot", opacity=1.5),
    "no fluorescent yet": lambda: painted("fluorescent", filename="x"),
    "has cosine as its distribution, give beckmann or ggx": lambda: painted(
        "metal", eta=GREY, k=GREY, roughness=0.1, distribution="cosine"
    ),
    "has -0.1 as its roughness": lambda: painted("metal", eta=GREY, k=GREY, roughness=-0.1),
    "paint needs a spectrum as its eta": lambda: painted("metal", eta=TextureUse("x"), k=GREY, roughness=0.1),
    "has 0.0 as its extIOR": lambda: painted("glass", intIOR=1.5, extIOR=0.0, **TINTS),
    "is of variant phong, want one of ward": lambda: painted(
        "anisoward", variant="phong", alphaU=0.1, alphaV=0.1, diffuseReflectance=GREY
    ),
}


def test_a_picture_around_the_scene_is_a_plugin_that_a_comment_names(tmp_path):
    said = {"environment": lamp("environment", at(1, 2, 3), filename=str(tmp_path / "resources" / "sky.png"))}
    root = xml(scene(**said), tmp_path / "scenes")
    (sky,) = root.iter("emitter")
    assert sky.get("type") == "skypicture"
    facts = properties(sky.find("texture"))
    assert (facts["filename"], facts["gamma"], facts["wrap_mode"]) == (
        "../resources/sky.png",
        "-1.0",
        "around",
    )
    # It is turned as the world is, and neither moved nor scaled.
    assert sky.find("transform/matrix").get("value").split() == [repr(x) for x in np.eye(4).ravel().tolist()]
    assert "<!-- Lamp needs a plugin of ours" in (tmp_path / "scenes" / "scene.xml").read_text()


@pytest.mark.parametrize("words", WRONG)
def test_what_mitsuba_cannot_render_is_refused_in_one_sentence(tmp_path, words):
    with pytest.raises(RecipeError, match=re.escape(words)) as caught:
        xml(WRONG[words](), tmp_path)
    assert not list(tmp_path.glob("*.xml"))
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("<scene", "cannot read the native scene"),
        ("<scene/>", "is no native scene of ours"),
        ('<!DOCTYPE x [<!ENTITY a "b">]><scene/>', "declares entities"),
    ],
)
def test_a_native_scene_that_is_not_ours_is_refused_in_one_sentence(tmp_path, text, words):
    (tmp_path / "scene.xml").write_text(text)
    with pytest.raises(RenderingError, match=words):
        read_native(tmp_path / "scene.xml")


@pytest.mark.parametrize("wrong", [np.nan, np.inf, -1e-3])
def test_pixels_that_no_light_can_have_are_refused(wrong):
    radiance = np.ones((4, 5, 3), np.float32)
    check_pixels(radiance)
    radiance[2, 3, 1] = wrong
    with pytest.raises(RenderingError, match=r"1 pixels came out .* row 2, column 3, band 1"):
        check_pixels(radiance)


def test_a_blend_refers_to_materials_that_stand_before_it_and_keeps_their_spectra(tmp_path):
    one = painted("blend", materialID="glossy", otherMaterialID="soot", weight=0.5)
    one = replace(one, materials={**one.materials, "glossy": Material("glossy", "plastic", PLASTIC)})
    native = read_native(renderer().translate(one, (), tmp_path, "scene"))
    order = [node.get("id") for node in native.root.findall("bsdf")]
    assert order.index("paint") > max(order.index("glossy"), order.index("soot"))
    assert [node.get("id") for node in native.root.find("bsdf[@id='paint']").findall("ref")] == [
        "glossy",
        "soot",
    ]
    lobes = one_hot(native).materials["paint"]
    np.testing.assert_allclose([lobe.reflectance.at(555) for lobe in lobes], [REFLECTANCE.at(555), 1, 0])


PLASTIC = {"intIOR": 1.5, "extIOR": 1.0, "diffuseReflectance": REFLECTANCE}


def test_spectra_that_are_the_same_share_a_lobe(tmp_path):
    one = painted("blend", materialID="one", otherMaterialID="two", weight=0.5)
    made = {name: Material(name, "plastic", PLASTIC) for name in ("one", "two")}
    one = replace(one, materials={**one.materials, **made})
    native = read_native(renderer().translate(one, (), tmp_path, "scene"))
    assert len(one_hot(native).materials["paint"]) == 2
