"""The tracer's materials against closed forms: what they scatter, where, and how they sample it."""

from dataclasses import replace

import numpy as np
import pytest
from scipy import special

from rtb_addon.errors import RecipeError
from rtb_addon.renderers.tracer.directions import normalised
from rtb_addon.scene.render_scene import Camera, Material, Shape
from rtb_addon.spectra import Spectrum
from tests.renderings.scattering import (
    albedo,
    assert_samples_as_it_says,
    direction,
    evaluate,
    grid,
    met,
    model_of,
)
from tests.renderings.tracer_scenes import (
    BANDS,
    BLACK,
    GREY,
    IOR,
    RADIANCE,
    SHAPE_OF_LIGHT,
    SQUARE,
    TINTS,
    WHITE,
    assert_within_noise,
    ball,
    cube,
    facing,
    glass,
    lamp,
    matrix,
    matte,
    per_band,
    picture,
    reflected_by,
    scene,
    sky,
    ward,
)


def mirror(id="mirror", reflectance=GREY):
    return Material(id, "mirror", {"specularReflectance": reflectance})


# Mirrors


def test_a_mirror_shows_what_is_on_the_other_side(tmp_path):
    floor = Shape("floor", SQUARE, matrix(), "mirror")
    glow = Shape("glow", SQUARE, matrix((0, 0, 3), (9, 0, 0), (0, -9, 0), (0, 0, -1)), "black", RADIANCE)
    camera = Camera("c", "perspective", facing((1, 0, 1), (0, 0, 0)), (-0.1, 0.1, -0.1, 0.1))
    materials = [mirror(), matte("black", BLACK)]
    seen = picture(scene([floor, glow], [], materials, camera, depth=2), tmp_path)[0, 0]
    np.testing.assert_allclose(seen, GREY.in_bands(BANDS) * SHAPE_OF_LIGHT, rtol=1e-6)
    assert not picture(scene([floor, glow], [], materials, camera, depth=1), tmp_path).any()


def test_a_perfect_mirror_vanishes_before_an_even_sky(tmp_path):
    body = Shape("body", ball(), matrix(), "mirror")
    seen = picture(
        scene(
            [body],
            materials=[mirror(reflectance=WHITE)],
            camera=Camera("c", "perspective", facing((4, 3, 5), (0, 0, 0)), (-0.3, 0.3, -0.3, 0.3)),
            environment=sky(2.0),
            size=(16, 16),
            depth=6,
        ),
        tmp_path,
    )
    # A smooth normal may send a ray into its own triangle at the very rim.
    assert (np.abs(seen - 2.0) < 1e-6).mean() > 0.99


def test_no_light_without_size_is_seen_in_a_mirror(tmp_path):
    floor = Shape("floor", SQUARE, matrix(), "mirror")
    assert not picture(scene([floor], [lamp("point", matrix((0, 0, 2)))], [mirror()]), tmp_path).any()


def test_a_mirror_throws_light_on_a_wall(tmp_path):
    """A lamp with a radius beside a mirror lights a wall as its image behind the mirror would."""
    mirrored = Shape("mirror", SQUARE, matrix((0, 0, 0), (50, 0, 0), (0, 50, 0)), "mirror")
    wall = Shape("wall", SQUARE, matrix((0, 0, 1), (0, 0.05, 0), (0, 0, 0.05), (1, 0, 0)), "grey")
    place = np.array([2.0, 0, 1.0])
    screen = Shape("screen", SQUARE, matrix((1, 0, 1), (0, 0.3, 0), (0, 0, 0.3), (1, 0, 0)), "black")
    camera = Camera("c", "orthographic", facing((0.9, 0, 1), (0, 0, 1)), (-1e-3, 1e-3, -1e-3, 1e-3))
    materials = [mirror(reflectance=WHITE), matte("grey"), matte("black", BLACK)]

    def lit(seed):
        lights = [lamp("point", matrix(place), radius=0.5)]
        return scene([mirrored, wall, screen], lights, materials, camera, depth=3, samples=8192, seed=seed)

    way = place * [1, 1, -1] - [0, 0, 1]
    falloff = way[0] / np.linalg.norm(way) ** 3
    expected = GREY.in_bands(BANDS) / np.pi * falloff * np.array(SHAPE_OF_LIGHT)
    assert_within_noise(lit, tmp_path, expected)


# Metals

# Index and extinction at 589 nm (Rakic 1998 for gold; Weaver 1975 for rhodium).
INDICES = {"gold": (0.27, 2.78), "rhodium": (2.0, 5.11), "glass without loss": (1.5, 0.0)}


def metal(eta, k, roughness=0.0, id="metal"):
    said = {"eta": Spectrum.constant(eta), "k": Spectrum.constant(k), "roughness": roughness}
    return Material(id, "metal", said)


@pytest.mark.parametrize("name", INDICES)
@pytest.mark.parametrize("degrees", [0, 30, 60, 85])
def test_metals_reflect_as_fresnel_says(name, degrees):
    eta, k = INDICES[name]
    onward = model_of(metal(eta, k)).scattered(met(direction(degrees), 1), np.zeros(1), np.zeros(1))
    expected = reflected_by(eta, k, degrees)
    if degrees == 0:
        assert expected == pytest.approx(((eta - 1) ** 2 + k**2) / ((eta + 1) ** 2 + k**2))
    np.testing.assert_allclose(onward.weight[0], expected, rtol=2e-6)
    np.testing.assert_allclose(onward.directions, direction(degrees, 180), atol=1e-12)


def test_a_metal_has_the_colour_of_its_index_in_every_band(tmp_path):
    eta, k = [0.2, 0.4, 1.0, 3.0], [4.0, 2.5, 1.9, 1.0]
    gold = Material("mirror", "metal", {"eta": per_band(eta), "k": per_band(k), "roughness": 0.0})
    floor = Shape("floor", SQUARE, matrix(), "mirror")
    seen = picture(scene([floor], [], [gold], environment=sky(2.0)), tmp_path)[0, 0]
    np.testing.assert_allclose(
        seen, [2 * reflected_by(*each, 0) for each in zip(eta, k, strict=True)], rtol=1e-5
    )


def test_a_rough_metal_is_a_torrance_and_sparrow_surface():
    alpha, back, towards = 0.3, direction(35, 20), direction(50, 190)
    h = normalised(back + towards)
    tangent2 = 1 / h[2] ** 2 - 1
    d = np.exp(-tangent2 / alpha**2) / (np.pi * alpha**2 * h[2] ** 4)
    g = 1.0
    for w in (back, towards):
        # Smith's masking of normally distributed slopes, exactly; Walter's form of it is within 0.35 %.
        a = w[2] / (alpha * np.sqrt(1 - w[2] ** 2))
        g *= 2 / (1 + special.erf(a) + np.exp(-(a**2)) / (a * np.sqrt(np.pi)))
    f = reflected_by(0.27, 2.78, np.degrees(np.arccos((back * h).sum())))
    seen, _ = evaluate(model_of(metal(0.27, 2.78, alpha)), back, towards)
    np.testing.assert_allclose(seen[0], (f * d * g / (4 * back[2])).repeat(4), rtol=8e-3)


# All that sample


SAMPLED = {
    "rough metal": metal(0.27, 2.78, 0.3),
    "plastic": Material("m", "plastic", {**IOR, "diffuseReflectance": GREY}),
    "rough plastic": Material("m", "roughplastic", {**IOR, "diffuseReflectance": GREY, "roughness": 0.2}),
    "rough glass": Material("m", "roughglass", {**IOR, **TINTS, "roughness": 0.3}),
}


@pytest.mark.parametrize("name", SAMPLED)
@pytest.mark.parametrize("back", [(0, 0), (40, 30), (75, 100)])
@pytest.mark.parametrize("side", [1, -1])
def test_a_material_samples_as_it_says(name, back, side):
    if side > 0 or name == "rough glass":
        assert_samples_as_it_says(model_of(SAMPLED[name]), direction(*back), side)
    else:
        # What is opaque is the same from behind.
        ways, _ = grid(40, 40)
        above, below = (evaluate(model_of(SAMPLED[name]), direction(*back), ways, s)[0] for s in (1, -1))
        np.testing.assert_array_equal(above, below)


# Plastics


def test_a_smooth_plastic_is_a_coat_over_a_body():
    model = model_of(SAMPLED["plastic"])
    back, towards = direction(30), direction(60, 70)
    inside = 2 * np.mean(
        [c * reflected_by(1 / 1.5, 0, np.degrees(np.arccos(c))) for c in (np.arange(2000) + 0.5) / 2000]
    )
    through = (1 - reflected_by(1.5, 0, 30)) * (1 - reflected_by(1.5, 0, 60))
    expected = GREY.in_bands(BANDS) / np.pi * 0.5 * through / (1.5**2 * (1 - inside))
    # The fit of what is reflected inside is good to a tenth of a per cent.
    np.testing.assert_allclose(evaluate(model, back, towards)[0][0], expected, rtol=2e-3)


def test_the_coat_of_a_smooth_plastic_shows_the_sky(tmp_path):
    black = Material("coat", "plastic", {**IOR, "diffuseReflectance": BLACK})
    floor = Shape("floor", SQUARE, matrix(), "coat")
    lit = scene([floor], [], [black], environment=sky(2.0), samples=1024)
    np.testing.assert_allclose(picture(lit, tmp_path)[0, 0], 2 * 0.04, rtol=1e-2)


@pytest.mark.parametrize("roughness", [0.0, 0.1, 0.4])
@pytest.mark.parametrize("degrees", [0, 45, 80])
def test_white_plastic_returns_no_more_light_than_came(roughness, degrees):
    white = Material("m", "roughplastic", {**IOR, "diffuseReflectance": WHITE, "roughness": roughness})
    share = albedo(model_of(white), direction(degrees))[0]
    if roughness == 0:
        share += reflected_by(1.5, 0, degrees)
    assert 0.6 < share < 1.005


# Blends and masks


def blend(weight, one="grey", other="white", id="mix"):
    return Material(id, "blend", {"materialID": one, "otherMaterialID": other, "weight": weight})


def mask(opacity, of="grey", id="mix"):
    return Material(id, "mask", {"materialID": of, "opacity": opacity})


def patch_of(materials, folder, samples=4096, more=(), depth=2, **options):
    floor = Shape("floor", SQUARE, matrix(), "mix")
    named = [matte("grey"), matte("white", WHITE), matte("black", BLACK), *materials]
    lit = scene(
        [floor, *more], [lamp("point", matrix((0, 0, 2)))], named, depth=depth, samples=samples, **options
    )
    return picture(lit, folder)[0, 0]


@pytest.mark.parametrize("weight", [0.0, 0.3, 1.0])
def test_a_blend_is_the_weighted_sum(tmp_path, weight):
    grey = GREY.in_bands(BANDS)
    expected = ((1 - weight) * grey + weight) / np.pi / 4 * SHAPE_OF_LIGHT
    # 4096 numbers that fill the unit interval evenly choose exactly, up to one.
    np.testing.assert_allclose(patch_of([blend(weight)], tmp_path), expected, rtol=2e-3)


def test_blends_of_blends_and_masks_multiply_out(tmp_path):
    inner = blend(0.5, "white", "black", "inner")
    materials = [inner, mask(0.5, "inner", "holes"), blend(0.25, "grey", "holes")]
    expected = (0.75 * GREY.in_bands(BANDS) + 0.25 * 0.5 * 0.5) / np.pi / 4 * SHAPE_OF_LIGHT
    np.testing.assert_allclose(patch_of(materials, tmp_path), expected, rtol=3e-3)


def test_through_a_mask_one_sees_what_is_behind(tmp_path):
    glow = Shape("glow", SQUARE, matrix((0, 0, -1), (9, 0, 0), (0, 9, 0)), "black", RADIANCE)
    expected = (0.25 * GREY.in_bands(BANDS) / np.pi / 4 + 0.75) * SHAPE_OF_LIGHT
    seen = patch_of([mask(0.25)], tmp_path, more=[glow])
    np.testing.assert_allclose(seen, expected, rtol=3e-3)
    clear = patch_of([mask(0.0)], tmp_path, more=[glow], samples=16)
    np.testing.assert_allclose(clear, SHAPE_OF_LIGHT, rtol=1e-6)


def test_a_mask_of_full_opacity_is_the_material(tmp_path):
    expected = GREY.in_bands(BANDS) / np.pi / 4 * SHAPE_OF_LIGHT
    np.testing.assert_allclose(patch_of([mask(1.0)], tmp_path, samples=1), expected, rtol=1e-6)


@pytest.mark.parametrize(
    ("material", "sentence"),
    [
        (blend(0.5, "grey", "mix"), "material mix is made of itself, give it other materials"),
        (blend(0.5, "grey", "gold"), "material mix is made of gold, which the scene has not"),
        (blend(1.5), "material mix has weight 1.5, give a number from 0 to 1"),
        (mask(-0.1), "material mix has opacity -0.1, give a number from 0 to 1"),
        (
            ward("mix", variant="phong"),
            "material mix has variant phong, choose one of ward, ward-duer, balanced",
        ),
        (ward("mix", alpha_u=0.0), "material mix has alphaU 0.0, give a number from 0.0001 to 10"),
        (metal(1.0, 1.0, -1.0, "mix"), "material mix has roughness -1.0, give a number from 0 to 10"),
    ],
)
def test_materials_that_cannot_be_are_refused_in_a_sentence(tmp_path, material, sentence):
    with pytest.raises(RecipeError) as refused:
        patch_of([material], tmp_path)
    assert str(refused.value) == sentence


# All of them


def everything(seed=0):
    """Return balls of every kind of material in a row, in a glowing box."""
    kinds = [*SAMPLED.values(), metal(0.27, 2.78), mirror(), glass("thinglass"), glass(), ward("gloss")]
    materials = [replace(one, id=f"m{k}") for k, one in enumerate(kinds)]
    materials += [mask(0.5, "m0", "holes"), blend(0.5, "m1", "holes", "mix"), matte("grey")]
    balls = [Shape(one.id, ball(0.4, 8), matrix((k, 0, 0)), one.id) for k, one in enumerate(materials)]
    room = Shape(
        "room", cube(inwards=True), matrix((5.5, 0, 0), (7, 0, 0), (0, 3, 0), (0, 0, 3)), "grey", RADIANCE
    )
    camera = Camera("c", "orthographic", matrix((5.5, 0, 2)), (-6, 6, -0.5, 0.5))
    return scene([*balls, room], [], materials, camera, depth=5, samples=4, size=(48, 4), seed=seed)


def test_a_scene_of_all_materials_gives_the_same_bits_and_another_seed_others(tmp_path):
    first = picture(everything(), tmp_path)
    np.testing.assert_array_equal(picture(everything(), tmp_path), first)
    assert (picture(everything(seed=1), tmp_path) != first).any()
    assert np.isfinite(first).all()
