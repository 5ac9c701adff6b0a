"""Mitsuba's materials: closed forms, and no energy from nothing."""

from dataclasses import replace

import numpy as np
import pytest

from rtb_addon.errors import RecipeError
from rtb_addon.renderers.mitsuba import llvm, renderer, session
from rtb_addon.scene.render_scene import Camera, Material, Shape
from rtb_addon.scene.vocabulary import WARD_VARIANTS as VARIANTS
from rtb_addon.spectra import Spectrum
from tests.renderings import materials_scene
from tests.renderings.materials_scene import MATERIALS, PIXELS, of, row
from tests.renderings.microfacets import returned
from tests.renderings.mitsuba_scenes import (
    BANDS,
    FULL_TURN,
    INTENSITY,
    REFLECTANCE,
    assert_within_noise,
    at,
    globe,
    kernels,
    lamp,
    picture,
    scene,
    square,
)
from tests.renderings.tracer_scenes import facing

SKY = lamp("environment", filename="")
SHINING = INTENSITY.in_bands(BANDS)
PAINTED = REFLECTANCE.in_bands(BANDS)
WHITE = Spectrum.constant(1.0)
GREY = Spectrum.constant(0.7)
EVERY = {**MATERIALS, **materials_scene.MORE}
# Beckmann's masking is Walter's form, within 0.35 % for each of two directions.
CLOSE = {"beckmann": 7e-3, "ggx": 2e-4}
AIR = {"intIOR": 1.5, "extIOR": 1.0}


def white(model, parameters):
    # Ward's two reflectances share the light.
    spectrum = WHITE.scaled(0.5) if model == "anisoward" else WHITE
    if model == "metal":
        return {**parameters, "eta": Spectrum.constant(0.0), "k": WHITE}
    return {name: spectrum if isinstance(value, Spectrum) else value for name, value in parameters.items()}


def furnace(folder, names, smooth):
    """Return the picture of white balls on a white floor under a white sky."""
    whitened = {name: white(name.split()[0], parameters) for name, parameters in EVERY.items()}
    one = row(names=names, materials=whitened, depth=40, samples=400)
    floor = {"floor": Material("floor", "matte", {"diffuseReflectance": WHITE})}
    ball = globe(0.42, smooth=smooth)
    shapes = tuple(replace(each, mesh=ball) if each.id in names else each for each in one.shapes)
    even = lamp("environment", filename="", intensity=WHITE)
    materials = {**one.materials, **floor}
    return picture(replace(one, environment=even, shapes=shapes, materials=materials), folder).radiance


def test_no_material_gives_more_light_than_it_gets(tmp_path):
    image = furnace(tmp_path, tuple(EVERY), smooth=True)
    for name in EVERY:
        assert of(image, name, tuple(EVERY)).mean(dtype=float) < 1.005, name


def test_materials_that_lose_nothing_vanish_before_a_white_sky(tmp_path):
    names = ("matte", "mirror", "plastic", "glass", "thinglass", "mask")
    image = furnace(tmp_path, names, smooth=False)
    for name in names:
        pixels = of(image, name, names).mean(axis=2, dtype=float)
        error = pixels.std(ddof=1) / PIXELS
        assert abs(pixels.mean() - 1) < 4.5 * error + 1e-3, name
        assert error < 5e-3


@pytest.mark.parametrize("slopes", CLOSE)
@pytest.mark.parametrize("degrees", [0, 45, 80])
def test_rough_surfaces_lose_what_their_mirrors_send_into_others(tmp_path, slopes, degrees):
    place = 3 * np.array([np.sin(np.radians(degrees)), 0, np.cos(np.radians(degrees))])
    camera = Camera("Camera", "orthographic", facing(place, (0, 0, 0)), (-1e-3, 1e-3, -1e-3, 1e-3))
    for model, index, k in (("metal", 0.0, 1.0), ("roughglass", 1.5, 0.0)):
        said = {**white(model, EVERY[model]), "roughness": 0.4, "distribution": slopes}
        back, through = returned(slopes, 0.4, degrees, index, k)
        image = picture(replace(of_paint(model, **said), camera=camera), tmp_path)
        # Behind the surface the same light is in a smaller cone.
        share = back + (through / index**2 if index else 0)
        assert_within_noise(image, share * SHINING, floor=CLOSE[slopes])


def test_paint_that_reflects_more_than_it_gets_is_rendered_as_it_is(tmp_path):
    image = picture(of_paint("matte", diffuseReflectance=REFLECTANCE.scaled(2.5)), tmp_path)
    assert_within_noise(image, 2.5 * PAINTED * SHINING)


def other(name, value):
    """Return another spectrum or number that a material may have instead."""
    if isinstance(value, Spectrum):
        return Spectrum(value.wavelengths + 7, value.values * 0.8 + 0.05)
    # Mitsuba compiles an index of refraction into its kernels.
    return 0.9 * value if isinstance(value, float) and not name.endswith("IOR") else value


@pytest.mark.parametrize("sort", [Spectrum, float])
def test_other_spectra_and_other_numbers_of_materials_never_recompile_anything(tmp_path, sort):
    picture(row(names=tuple(EVERY), materials=EVERY), tmp_path)
    for factor in (1, 2, 3):
        changed = {
            model: {
                name: other(name, value) if isinstance(value, sort) and len(name) % factor == 0 else value
                for name, value in parameters.items()
            }
            for model, parameters in EVERY.items()
        }
        ran, compiled = kernels(row(names=tuple(EVERY), materials=changed), tmp_path, "changed")
        assert (ran > 0, compiled) == (True, 0), factor


def test_one_thread_gives_the_same_bits_again(tmp_path):
    first, again = (picture(row(samples=64), tmp_path, name=name).radiance for name in ("first", "again"))
    assert np.array_equal(first, again)


def of_paint(model, **parameters):
    """Return a floor of a material, seen from above under an even sky."""
    one = scene(environment=SKY, samples=1024, depth=4)
    made = {"paint": Material("paint", model, parameters)}
    return replace(one, materials={**one.materials, **made})


def test_a_mirror_shows_the_sky_times_its_reflectance(tmp_path):
    image = picture(of_paint("mirror", specularReflectance=REFLECTANCE), tmp_path)
    np.testing.assert_allclose(image.radiance[0, 0], PAINTED * SHINING, rtol=1e-5)


RHODIUM = {
    "eta": Spectrum.of([400, 500, 600, 700], [1.41, 1.83, 2.12, 2.3]),
    "k": Spectrum.of([400, 500, 600, 700], [4.2, 4.9, 5.5, 6.1]),
}
METALS = {"gold": materials_scene.GOLD, "rhodium": RHODIUM}


def reflected(metal, degrees=0.0):
    """Return what a metal reflects in each band, by Fresnel's law in complex numbers."""
    index = metal["eta"].in_bands(BANDS) + 1j * metal["k"].in_bands(BANDS)
    cosine = np.cos(np.radians(degrees))
    inside = np.sqrt(1 - (1 - cosine**2) / index**2)
    s = (cosine - index * inside) / (cosine + index * inside)
    p = (index * cosine - inside) / (index * cosine + inside)
    return (abs(s) ** 2 + abs(p) ** 2) / 2


def seen_from(degrees):
    angle = np.radians(degrees)
    turn = np.eye(4)
    turn[1:3, 1:3] = [[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]
    turn[:3, 3] = 3 * turn[:3, 2]
    return Camera("Camera", "perspective", turn, (-1e-5, 1e-5, -1e-5, 1e-5))


@pytest.mark.parametrize("name", METALS)
@pytest.mark.parametrize("degrees", [0, 50, 80])
def test_a_smooth_metal_reflects_what_fresnels_law_says_of_each_bands_index(tmp_path, name, degrees):
    one = replace(of_paint("metal", **METALS[name], roughness=0.0), camera=seen_from(degrees))
    expected = reflected(METALS[name], degrees) * SHINING
    np.testing.assert_allclose(picture(one, tmp_path).radiance[0, 0], expected, rtol=1e-4)
    if degrees == 0:
        n, k = (METALS[name][part].in_bands(BANDS) for part in ("eta", "k"))
        np.testing.assert_allclose(expected / SHINING, ((n - 1) ** 2 + k**2) / ((n + 1) ** 2 + k**2))


def test_a_hardly_rough_metal_is_nearly_a_smooth_one(tmp_path):
    image = picture(of_paint("metal", **RHODIUM, roughness=0.01), tmp_path)
    np.testing.assert_allclose(image.radiance.mean(axis=(0, 1)), reflected(RHODIUM) * SHINING, rtol=3e-3)


def test_two_metals_and_a_paint_are_blended_each_with_its_own_law(tmp_path):
    one = of_paint("blend", materialID="alloy", otherMaterialID="matte", weight=0.25)
    parts = {
        "alloy": ("blend", {"materialID": "gold", "otherMaterialID": "rhodium", "weight": 0.6}),
        "matte": ("matte", {"diffuseReflectance": REFLECTANCE}),
        **{name: ("metal", {**metal, "roughness": 0.0}) for name, metal in METALS.items()},
    }
    made = {name: Material(name, *said) for name, said in parts.items()}
    one = replace(one, materials={**one.materials, **made}, camera=seen_from(60))
    alloy = 0.4 * reflected(METALS["gold"], 60) + 0.6 * reflected(RHODIUM, 60)
    assert_within_noise(picture(one, tmp_path), (0.75 * alloy + 0.25 * PAINTED) * SHINING)


@pytest.mark.parametrize("index", [1.2, 1.5, 2.0])
def test_smooth_plastic_is_paint_below_a_fresnel_reflection(tmp_path, index):
    image = picture(of_paint("plastic", intIOR=index, extIOR=1.0, diffuseReflectance=REFLECTANCE), tmp_path)
    fresnel = ((index - 1) / (index + 1)) ** 2
    # Mitsuba takes the mean reflection from inside from a fit that is good to a thousandth.
    assert_within_noise(image, (fresnel + (1 - fresnel) * PAINTED) * SHINING, floor=3e-3)


def test_plastic_without_roughness_is_smooth(tmp_path):
    rough = of_paint("roughplastic", **AIR, roughness=0.0, diffuseReflectance=REFLECTANCE)
    smooth = of_paint("plastic", **AIR, diffuseReflectance=REFLECTANCE)
    first, second = (picture(one, tmp_path).radiance for one in (rough, smooth))
    assert np.array_equal(first, second)


def slab(one):
    """Return a plate of tinted glass, seen from above under an even sky."""
    lower = Shape("Below", square(50), at(0, 0, -0.5, FULL_TURN), "paint")
    return replace(one, shapes=(*one.shapes, lower), integrator=replace(one.integrator, depth=30))


@pytest.mark.parametrize("index", [1.3, 1.8])
def test_a_plate_of_glass_reflects_and_transmits_what_its_two_faces_sum_up_to(tmp_path, index):
    tints = {"specularReflectance": GREY, "specularTransmittance": REFLECTANCE}
    one = slab(of_paint("glass", intIOR=index, extIOR=1.0, **tints))
    f, r, t = ((index - 1) / (index + 1)) ** 2, 0.7, PAINTED
    # Light goes to and fro between the faces.
    inside = (1 - f) ** 2 * t**2 / (1 - (f * r) ** 2)
    assert_within_noise(picture(one, tmp_path), (f * r + inside * f * r + inside) * SHINING)


@pytest.mark.parametrize("model", ["glass", "roughglass"])
def test_light_is_condensed_in_glass_by_the_square_of_its_index(tmp_path, model):
    rough = {"roughness": 0.0} if model == "roughglass" else {}
    clear = {"specularReflectance": WHITE, "specularTransmittance": WHITE}
    image = picture(of_paint(model, **AIR, **rough, **clear), tmp_path)
    # Below the only face, glass has no end.
    assert_within_noise(image, (0.04 + 0.96 / 1.5**2) * SHINING)


def test_a_hardly_rough_plate_is_nearly_a_smooth_one(tmp_path):
    clear = {"specularReflectance": GREY, "specularTransmittance": REFLECTANCE}
    smooth, rough = (
        picture(slab(of_paint(model, **AIR, **clear, **more)), tmp_path).radiance.mean(axis=(0, 1))
        for model, more in [("glass", {}), ("roughglass", {"roughness": 0.01})]
    )
    np.testing.assert_allclose(rough, smooth, rtol=4e-3)


def test_thin_glass_reflects_on_both_faces_and_bends_nothing(tmp_path):
    tints = {"specularReflectance": GREY, "specularTransmittance": REFLECTANCE}
    image = picture(of_paint("thinglass", **AIR, **tints), tmp_path)
    reflects = 2 * 0.04 / 1.04
    assert_within_noise(image, (reflects * 0.7 + (1 - reflects) * PAINTED) * SHINING)


def test_rough_glass_without_a_difference_of_indices_is_refused(tmp_path):
    same = {"intIOR": 1.5, "extIOR": 1.5, "specularReflectance": WHITE, "specularTransmittance": WHITE}
    with pytest.raises(RecipeError, match="the same index inside and outside"):
        renderer().translate(of_paint("roughglass", **same, roughness=0.1), (), tmp_path, "same")


def made_of(model, **parameters):
    """Return a floor that is made of a mirror and of soot."""
    one = of_paint(model, **parameters)
    glossy = Material("glossy", "mirror", {"specularReflectance": REFLECTANCE})
    return replace(one, materials={**one.materials, "glossy": glossy})


@pytest.mark.parametrize("weight", [0.0, 0.25, 1.0])
def test_a_blend_shows_so_much_of_the_other_material(tmp_path, weight):
    one = made_of("blend", materialID="soot", otherMaterialID="glossy", weight=weight)
    image = picture(one, tmp_path)
    if weight:
        assert_within_noise(image, weight * PAINTED * SHINING)
    else:
        assert not image.radiance.any()


@pytest.mark.parametrize("opacity", [0.0, 0.25, 1.0])
def test_what_a_mask_does_not_cover_shows_what_lies_behind(tmp_path, opacity):
    image = picture(made_of("mask", materialID="glossy", opacity=opacity), tmp_path)
    # Behind the floor is the other half of the same sky.
    expected = (opacity * PAINTED + 1 - opacity) * SHINING
    assert_within_noise(image, expected)


@pytest.fixture
def fast():
    """Mitsuba as the lobe path uses it."""
    llvm.prepare()
    return session.start(session.FAST, 1)


WIDTHS = [(0.1, 0.1), (0.15, 0.5), (0.6, 0.3)]


@pytest.mark.parametrize("variant", VARIANTS)
def test_wards_samples_are_distributed_as_it_says(fast, variant):
    for (u, v), degrees in zip(WIDTHS, [0, 35, 65], strict=True):
        angle = np.radians(degrees)
        ball = fast.chi2.SphericalDomain()
        grey = 'type="rawconstant"><float name="value" value="0.5"/></spectrum>'
        text = f"""<string name="variant" value="{variant}"/>
            <float name="alpha_u" value="{u}"/><float name="alpha_v" value="{v}"/>
            <spectrum name="diffuse_reflectance" {grey}
            <spectrum name="specular_reflectance" {grey}
        """
        wi = fast.Vector3f(
            *(np.array([0.8, 0.6, 1]) * [np.sin(angle), np.sin(angle), np.cos(angle)]).tolist()
        )
        draw, density = fast.chi2.BSDFAdapter("ward", text, wi=wi)
        test = fast.chi2.ChiSquareTest(ball, draw, density, sample_dim=3, sample_count=200_000, res=101)
        assert test.run(), (variant, u, v, degrees)


def ward(mi, variant, diffuse, specular, u, v):
    def colour(value):
        return {"type": "rawconstant", "value": value}

    return mi.load_dict(
        {
            "type": "ward",
            "variant": variant,
            "alpha_u": u,
            "alpha_v": v,
            "diffuse_reflectance": colour(diffuse),
            "specular_reflectance": colour(specular),
        }
    )


@pytest.mark.parametrize("variant", VARIANTS)
def test_ward_is_what_was_published(fast, variant):
    import drjit as dr

    u, v = 0.2, 0.45
    wi, wo = (np.array(w) / np.linalg.norm(w) for w in ([0.3, -0.2, 0.8], [-0.1, 0.5, 0.6]))
    si = dr.zeros(fast.SurfaceInteraction3f)
    si.wi = fast.Vector3f(*map(float, wi))
    value = ward(fast, variant, 0.3, 0.6, u, v).eval(fast.BSDFContext(), si, fast.Vector3f(*map(float, wo)))
    h = (wi + wo) / np.linalg.norm(wi + wo)
    polar, azimuth = np.arccos(h[2]), np.arctan2(h[1], h[0])
    peak = np.exp(-(np.tan(polar) ** 2) * ((np.cos(azimuth) / u) ** 2 + (np.sin(azimuth) / v) ** 2))
    height = {
        "ward": 1 / np.sqrt(wi[2] * wo[2]),
        "ward-duer": 1 / (wi[2] * wo[2]),
        "balanced": 2 * (1 + wi @ wo) / (np.cos(polar) * np.linalg.norm(wi + wo)) ** 4 * 4,
    }[variant]
    expected = (0.3 / np.pi + 0.6 * peak * height / (4 * np.pi * u * v)) * wo[2]
    assert float(value.x[0]) == pytest.approx(expected, rel=1e-5)


@pytest.mark.parametrize("variant", VARIANTS)
def test_ward_reflects_no_more_than_it_gets_at_any_angle(fast, variant):
    import drjit as dr

    # Duer's form is known to gain energy at grazing angles.
    count, angles = 2**17, np.linspace(0, np.radians(80 if variant == "ward-duer" else 89), 12)
    for u, v in WIDTHS:
        lobe = ward(fast, variant, 0.0, 1.0, u, v)
        random = np.random.default_rng(1).random((3, count))
        for angle in angles:
            si = dr.zeros(fast.SurfaceInteraction3f, count)
            si.wi = fast.Vector3f(
                float(0.6 * np.sin(angle)), float(0.8 * np.sin(angle)), float(np.cos(angle))
            )
            _, weight = lobe.sample(fast.BSDFContext(), si, fast.Float(random[0]), fast.Point2f(random[1:]))
            given = weight.x.numpy()
            assert given.mean() < 1 + 4 * given.std() / np.sqrt(count), (variant, u, v, angle)


def test_a_scene_with_ward_says_that_it_needs_our_plugin(tmp_path):
    names = ("anisoward",)
    native = renderer().translate(row(names=names), (), tmp_path, "scene")
    assert "anisoward needs a plugin of ours" in native.read_text()


def test_ward_renders_without_llvm_as_well(tmp_path, monkeypatch):
    one = row(names=("anisoward",), samples=512)
    materials = {name: one.materials[name] for name in ("anisoward", "floor", "soot")}
    one = replace(one, materials=materials)
    fast = picture(one, tmp_path).radiance.mean(axis=(0, 1))
    monkeypatch.setattr(llvm, "prepare", lambda: None)
    slow = picture(replace(one, integrator=replace(one.integrator, samples=128)), tmp_path)
    assert slow.attributes["integrator"] == "stock specfilm"
    np.testing.assert_allclose(slow.radiance.mean(axis=(0, 1)), fast, rtol=0.03)
