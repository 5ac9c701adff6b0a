"""The tracer's glass: where light goes at clear surfaces, and how much of it."""

import numpy as np
import pytest

from rtb_addon.scene.render_scene import Camera, Shape
from tests.renderings.scattering import direction, evaluate, met, model_of
from tests.renderings.tracer_scenes import (
    BANDS,
    BLACK,
    RADIANCE,
    SHAPE_OF_LIGHT,
    SQUARE,
    assert_within_noise,
    ball,
    facing,
    glass,
    lamp,
    looking_down,
    matrix,
    matte,
    per_band,
    picture,
    reflected_by,
    scene,
    sky,
)


@pytest.mark.parametrize("degrees", [0, 20, 56.31, 80])
@pytest.mark.parametrize("side", [1, -1])
def test_glass_bends_light_as_snell_says(degrees, side):
    eta = 1.5**side
    u = (np.arange(4000) + 0.5) / 4000
    onward = model_of(glass()).scattered(met(direction(degrees), 4000, side), u, u)
    back = onward.directions[2] > 0
    expected = reflected_by(eta, 0, degrees)
    assert back.mean() == pytest.approx(expected, abs=1e-3)
    if degrees == 56.31 and side > 0:
        # Brewster's angle: only the light across the plane is reflected.
        assert expected == pytest.approx(((1.5**2 - 1) / (1.5**2 + 1)) ** 2 / 2, rel=1e-4)
    sine = np.sin(np.radians(degrees)) / eta
    if sine < 1:
        np.testing.assert_allclose(onward.directions[0, ~back], -sine, rtol=1e-9)
        np.testing.assert_allclose(onward.weight[~back], 1 / eta**2, rtol=1e-6)
    else:
        assert back.all()


def test_a_thin_pane_counts_what_goes_back_and_forth():
    u = (np.arange(4000) + 0.5) / 4000
    onward = model_of(glass("thinglass")).scattered(met(direction(40), 4000), u, u)
    r = reflected_by(1.5, 0, 40)
    assert (onward.directions[2] > 0).mean() == pytest.approx(2 * r / (1 + r), abs=1e-3)
    np.testing.assert_allclose(
        onward.directions[:, onward.directions[2] < 0][:, :1], -direction(40), atol=1e-12
    )


@pytest.mark.parametrize("model", ["glass", "thinglass"])
def test_clear_glass_vanishes_before_an_even_sky(tmp_path, model):
    body = Shape("body", ball(1.0, 16, normals=False), matrix(), "glass")
    camera = Camera("c", "perspective", facing((4, 3, 5), (0, 0, 0)), (-0.1, 0.1, -0.1, 0.1))
    lit = scene([body], [], [glass(model)], camera, depth=40, environment=sky(2.0), samples=16, size=(8, 8))
    seen = picture(lit, tmp_path)
    # Flat sides trap a path in a thousand for longer than its depth.
    assert seen.max() < 2 + 1e-5
    assert seen.mean() > 2 * (1 - 3e-3)


def test_rough_glass_loses_a_little_light_and_makes_none(tmp_path):
    body = Shape("body", ball(1.0, 16), matrix(), "glass")
    camera = Camera("c", "perspective", facing((4, 3, 5), (0, 0, 0)), (-0.1, 0.1, -0.1, 0.1))
    rough = glass("roughglass", 0.1)
    lit = scene([body], [], [rough], camera, depth=40, environment=sky(2.0), samples=256, size=(8, 8))
    assert 1.85 < picture(lit, tmp_path).mean() < 2.005


def test_rough_glass_of_no_roughness_is_glass(tmp_path):
    body = Shape("body", ball(1.0, 8), matrix(), "glass")
    camera = Camera("c", "perspective", facing((4, 3, 5), (0, 0, 0)), (-0.3, 0.3, -0.3, 0.3))
    floor = Shape("floor", SQUARE, matrix((0, 0, -1), (5, 0, 0), (0, 5, 0)), "grey")
    lights = [lamp("point", matrix((0, 0, 3)), radius=1.0)]
    smooth, rough = (
        picture(scene([body, floor], lights, [one, matte("grey")], camera, 6, 4, (8, 8)), tmp_path)
        for one in (glass(), glass("roughglass", 0.0))
    )
    np.testing.assert_array_equal(smooth, rough)


def test_a_tint_colours_each_passage(tmp_path):
    """Two passages, and 0.96 goes through each; what goes back and forth is left out by the depth."""
    tint = per_band([0.9, 0.5, 0.2, 1.0])
    pane = [Shape(f"side {z}", SQUARE, matrix((0, 0, z), z=(0, 0, z)), "glass") for z in (1, -1)]
    glow = Shape("glow", SQUARE, matrix((0, 0, -3), (9, 0, 0), (0, 9, 0)), "black", RADIANCE)
    turned = [
        Shape(one.id, one.mesh, one.to_world @ np.diag([1, one.to_world[2, 2], 1, 1]), "glass")
        for one in pane
    ]
    materials = [glass(specularTransmittance=tint), matte("black", BLACK)]
    seen = picture(scene([*turned, glow], [], materials, looking_down(), depth=3, samples=4096), tmp_path)[
        0, 0
    ]
    expected = (0.96 * tint.in_bands(BANDS)) ** 2 * SHAPE_OF_LIGHT
    # Of 4096 paths 0.92 get through: the error is a sixtieth of a root of 0.08 / 0.92.
    np.testing.assert_allclose(seen, expected, rtol=4 * np.sqrt(0.08 / 0.92 / 4096))


def test_the_noise_of_rough_glass_falls_as_the_root_of_the_samples(tmp_path):
    """Of 16 times the samples remains a quarter of the noise, or less: samples are spread evenly."""
    floor, dark = (
        Shape("floor", SQUARE, matrix(), "glass"),
        glass("roughglass", 0.2, specularTransmittance=BLACK),
    )

    def noise(samples):
        lit = scene([floor], [], [dark], size=(32, 32), environment=sky(1.0), samples=samples)
        return picture(lit, tmp_path)[..., 0].std()

    assert noise(256) < 1.5 * noise(16) / 4


@pytest.mark.parametrize("side", [1, -1])
def test_a_light_behind_rough_glass_is_as_bright_as_all_its_points_together(tmp_path, side):
    """The integral over a luminous square below a sheet of glass, by a grid of points of our own."""
    sheet = Shape("sheet", SQUARE, matrix((0, 0, 0), (1, 0, 0), (0, side, 0), (0, 0, side)), "glass")
    half, rough = 0.3, glass("roughglass", 0.25)
    glow = Shape("glow", SQUARE, matrix((0, 0, -1), (half, 0, 0), (0, half, 0)), "black", RADIANCE)
    x, y = np.meshgrid(*[((np.arange(400) + 0.5) / 200 - 1) * half] * 2)
    way = np.stack([x, y, np.full_like(x, -1)]).reshape(3, -1)
    distance = np.linalg.norm(way, axis=0)
    value, _ = evaluate(model_of(rough), direction(0), way / distance, side)
    expected = (value[:, 0] / distance**3).sum(dtype=float) * (2 * half / 400) ** 2 * np.array(SHAPE_OF_LIGHT)

    def lit(seed):
        materials = [rough, matte("black", BLACK)]
        return scene([sheet, glow], [], materials, looking_down(), samples=1024, seed=seed)

    assert_within_noise(lit, tmp_path, expected)
