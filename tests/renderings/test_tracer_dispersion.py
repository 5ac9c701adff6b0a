"""Glass that bends each band by an index of its own, against Snell, and against glass of one index."""

from dataclasses import replace

import numpy as np
import pytest

from rtb_addon.errors import RecipeError
from rtb_addon.renderers.tracer.meeting import Meeting
from rtb_addon.scene.render_scene import Camera, Light, Mesh, Shape
from rtb_addon.spectra import Spectrum, Unit
from tests.renderings.scattering import (
    assert_samples_as_it_says,
    direction,
    evaluate,
    met,
    model_of,
)
from tests.renderings.spectral_pictures import write_spectra
from tests.renderings.tracer_scenes import (
    BANDS,
    GREY,
    SQUARE,
    assert_within_noise,
    ball,
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
)

# Stronger than any glass, so that bands are far apart.
INDICES = [1.7, 1.6, 1.5, 1.4]
MODELS = {"glass": None, "thinglass": None, "roughglass": 0.2}


def dispersing(model="glass", roughness=None, indices=None, **tints):
    one = glass(model, roughness, **tints)
    return replace(one, parameters={**one.parameters, "intIOR": per_band(indices or INDICES)})


def prism(apex):
    """Return a prism about Z whose sides meet under an angle [radians], pointing along Y."""
    half = np.tan(apex / 2)
    corners = [(-half, 0, -1), (half, 0, -1), (0, 1, -1), (-half, 0, 1), (half, 0, 1), (0, 1, 1)]
    faces = [(1, 2, 5), (1, 5, 4), (2, 0, 3), (2, 3, 5), (0, 1, 4), (0, 4, 3), (0, 2, 1), (3, 4, 5)]
    return Mesh(np.array(corners, np.float32), np.array(faces, np.int32))


def through(apex, incidence, n):
    """Return the angle by which a prism turns light [radians], and the share that goes through both sides."""
    inside = np.arcsin(np.sin(incidence) / n)
    leaving = np.arcsin(n * np.sin(apex - inside))
    shares = [1 - reflected_by(n, 0, np.degrees(a)) for a in (incidence, leaving)]
    return incidence + leaving - apex, shares[0] * shares[1]


@pytest.mark.parametrize("kind", ["averaged", "mean"])
def test_a_prism_turns_each_band_as_snell_says(tmp_path, kind):
    """
    A ray along X meets the left side of a prism; behind it a sky whose radiance tells the direction.

    In each band the sky is as bright as its columns are far from -X, so that what is seen is the angle. Of
    true means both halves of a band, that have two indices, are turned by themselves.
    """
    apex, height, columns = np.radians(40), 0.5, 720
    texels = np.zeros((2, columns, len(BANDS)))
    # Light that comes from where the turned ray goes: within a right angle of +X.
    azimuth = (0.5 - (np.arange(columns) + 0.5) / columns) * 2 * np.pi
    ahead = np.abs(azimuth) < np.pi / 2
    texels[:, ahead] = (np.pi - azimuth[ahead])[None, :, None]
    write_spectra(tmp_path / "sky.exr", texels, BANDS)
    parameters = {"intensity": Spectrum.constant(1.0, Unit.RADIANCE), "filename": str(tmp_path / "sky.exr")}
    around = Light("sky", "environment", np.eye(4), parameters)
    camera = Camera("c", "orthographic", facing((-3, height, 0), (0, height, 0)), (-1e-4, 1e-4, -1e-4, 1e-4))
    shape, bands = Shape("prism", prism(apex), matrix(), "glass"), BANDS.centres
    # Steps in the middle of each band: half of it is turned by this index, half by the next.
    steps = [nm + side for nm in bands for side in (-1e-9, 1e-9)]
    halves = [1.75, *np.repeat([1.6, 1.5, 1.4], 2), 1.3]
    stepped = replace(glass(), parameters={**glass().parameters, "intIOR": Spectrum.of(steps, halves)})
    material = dispersing() if kind == "averaged" else stepped

    def seen(seed):
        # Two surfaces, then the sky: what goes back and forth inside is longer.
        one = scene([shape], [], [material], camera, 3, 2048, seed=seed, environment=around)
        return replace(one, film=replace(one.film, band_kind=kind))

    def shown(n):
        # The side leans by half the apex from the vertical; the base lies below, so light is turned down.
        angle, share = through(apex, apex / 2, n)
        return (np.pi + angle) * share

    expected = np.array([shown(n) for n in INDICES])
    if kind == "mean":
        both = zip(halves[::2], halves[1::2], strict=True)
        expected = np.array([(shown(one) + shown(two)) / 2 for one, two in both])
    assert np.ptp([np.degrees(through(apex, apex / 2, n)[0]) for n in INDICES]) > 12
    assert_within_noise(seen, tmp_path, expected)


def room(material, depth=6, **options):
    """Return a ball of some glass over a floor, under a sky and two lamps, one of them small."""
    shapes = [
        Shape("ball", ball(0.7, 12), matrix((0, 0, 0.1)), "glass"),
        Shape("floor", SQUARE, matrix((0, 0, -0.8), (3, 0, 0), (0, 3, 0)), "grey"),
    ]
    lights = [lamp("point", matrix((1, 1, 3)), radius=0.6), lamp("point", matrix((-2, 0, 2)))]
    camera = Camera("c", "perspective", facing((2, -3, 2), (0, 0, -0.1)), (-0.35, 0.35, -0.35, 0.35))
    return scene(
        shapes, lights, [material, matte("grey", GREY)], camera, depth, environment=sky(0.5), **options
    )


@pytest.mark.parametrize("model", MODELS)
def test_each_band_looks_as_if_all_glass_had_its_index(tmp_path, model):
    seeds, options = 8, {"samples": 32, "size": (12, 12)}

    def means(material, first):
        runs = [
            picture(room(material, seed=first + seed, **options), tmp_path).mean(axis=(0, 1))
            for seed in range(seeds)
        ]
        return np.mean(runs, axis=0), np.std(runs, axis=0, ddof=1) / np.sqrt(seeds)

    ours, error = means(dispersing(model, MODELS[model]), 0)
    for band, index in enumerate(INDICES):
        plain = glass(model, MODELS[model])
        alone = replace(plain, parameters={**plain.parameters, "intIOR": index})
        theirs, their_error = means(alone, 100 * (band + 1))
        assert abs(ours[band] - theirs[band]) < 4 * np.hypot(error[band], their_error[band])
        assert error[band] < 0.02 * ours[band]


@pytest.mark.parametrize("model", ["glass", "thinglass"])
def test_a_dispersing_ball_vanishes_before_an_even_sky(tmp_path, model):
    body = Shape("body", ball(1.0, 16, normals=False), matrix(), "glass")
    camera = Camera("c", "perspective", facing((4, 3, 5), (0, 0, 0)), (-0.1, 0.1, -0.1, 0.1))

    def lit(seed):
        material = [dispersing(model)]
        return scene([body], [], material, camera, 160, 64, (8, 8), seed, environment=sky(2.0))

    means = np.array([picture(lit(seed), tmp_path).mean(axis=(0, 1)) for seed in range(6)])
    error = means.std(axis=0, ddof=1) / np.sqrt(6)
    # One path in a thousand is still inside.
    assert (np.abs(means.mean(axis=0) - 2) < 4 * error + 4e-3).all()
    assert (error < 0.02).all()


def test_glass_in_a_liquid_that_disperses_alike_does_not_disperse(tmp_path):
    """Only the ratio of the indices counts."""
    body, camera = (
        Shape("body", ball(1.0, 8), matrix(), "glass"),
        Camera("c", "perspective", facing((4, 3, 5), (0, 0, 0)), (-0.3, 0.3, -0.3, 0.3)),
    )
    one = dispersing(indices=[2 * index for index in INDICES])
    one = replace(one, parameters={**one.parameters, "extIOR": per_band([2 * i / 1.5 for i in INDICES])})
    floor = Shape("floor", SQUARE, matrix((0, 0, -2), (9, 0, 0), (0, 9, 0)), "grey")
    materials = [one, matte("grey", Spectrum.constant(0.5))]
    sun = lamp("directional", matrix(), [1, 1, 1, 1])
    runs = [
        picture(
            scene([body, floor], [sun], materials, camera, 6, 64, (8, 8), seed, environment=sky(1.0)),
            tmp_path,
        ).mean(axis=(0, 1))
        for seed in range(8)
    ]
    means, error = np.mean(runs, axis=0), np.std(runs, axis=0, ddof=1) / np.sqrt(8)
    assert (np.abs(means - means.mean()) < 4 * error + 1e-9).all()
    assert (error < 0.02 * means).all()


def test_an_index_that_is_the_same_everywhere_is_a_number(tmp_path):
    even, plain = (
        picture(room(one, samples=4, size=(8, 8)), tmp_path)
        for one in (dispersing(indices=[1.5] * 4), glass())
    )
    np.testing.assert_array_equal(even, plain)


@pytest.mark.parametrize("back", [(0, 0), (40, 30), (75, 100)])
@pytest.mark.parametrize("side", [1, -1])
def test_rough_dispersing_glass_samples_as_it_says(back, side):
    assert_samples_as_it_says(model_of(dispersing("roughglass", 0.3)), direction(*back), side)


def test_a_path_of_one_band_meets_rough_glass_of_that_index():
    back, n = direction(40), 1000
    ways = direction(150, 60).repeat(n, axis=1)
    for band, index in enumerate(INDICES):
        plain = glass("roughglass", 0.3)
        alone = model_of(replace(plain, parameters={**plain.parameters, "intIOR": index}))
        value, density = evaluate(alone, back, ways[:, :1])
        free = met(back, n)
        meeting = Meeting(free.row, free.places, free.directions, np.full(n, band))
        ours, our_density = model_of(dispersing("roughglass", 0.3)).evaluate(meeting, np.arange(n), ways)
        np.testing.assert_allclose(ours[:, band], value[0, 0], rtol=1e-5)
        np.testing.assert_allclose(our_density, density[0], rtol=1e-5)


def test_an_index_that_cannot_be_is_refused(tmp_path):
    with pytest.raises(RecipeError, match=r"material glass has intIOR 0\.05, give a number from 0\.1 to 10"):
        picture(room(dispersing(indices=[1.5, 0.05, 1.5, 1.5])), tmp_path)
