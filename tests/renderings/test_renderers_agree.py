"""
The two renderers, which share no code, see the same light go back and forth between surfaces.

Their noise itself is the tolerance: every renderer renders with many seeds, which gives the mean and
the error of the mean, and the difference of the means is measured in its own error (Welch's t).
"""

import numpy as np
import pytest

from rtb_addon import renderers
from rtb_addon.renderers.interface import RenderOptions
from rtb_addon.scene.render_scene import Camera, Film, Integrator, Light, Material, Mesh, RenderScene, Shape
from rtb_addon.spectra import FloatArray, Spectrum, Unit, library
from tests.renderings.noise import CHANCE, error_of_mean, in_blocks, least_probability

NAMES = ("mitsuba", "tracer")
SEEDS = 16


def rectangle(corner, one, other):
    """Two triangles whose normal is one x other."""
    corner, one, other = (np.array(vector, float) for vector in (corner, one, other))
    vertices = np.array([corner, corner + one, corner + one + other, corner + other], np.float32)
    return Mesh(vertices, np.array([[0, 1, 2], [0, 2, 3]], np.int32))


def matte(name, reflectance):
    return Material(name, "matte", {"diffuseReflectance": reflectance})


def patch(name):
    return library.find(f"BabelColor Average/{name}")


def shape(name, mesh, material, emission=None):
    return Shape(name, mesh, np.eye(4), material, emission)


def corner(seed, depth, samples=256):
    """
    A corner of a room: white floor and ceiling, red and blue walls, a panel and a lamp without size.

    Most of the light on the walls' shaded parts comes from other walls, in their colours.
    """
    walls = {
        "floor": rectangle((0, 0, 0), (1, 0, 0), (0, 1, 0)),
        "red": rectangle((0, 0, 0), (0, 1, 0), (0, 0, 1)),
        "blue": rectangle((0, 1, 0), (1, 0, 0), (0, 0, 1)),
        "panel": rectangle((0.3, 0.3, 1), (0, 0.4, 0), (0.4, 0, 0)),
        "ceiling": rectangle((0, 0, 1.02), (0, 1, 0), (1, 0, 0)),
        "shelf": rectangle((0.3, 0.5, 0.25), (0.4, 0, 0), (0, 0.3, 0)),
    }
    paints = {
        "floor": patch("white 9.5 (.05 D)"),
        "red": patch("red"),
        "blue": patch("blue"),
        "panel": Spectrum.constant(0),
        "ceiling": patch("white 9.5 (.05 D)"),
        "shelf": patch("yellow"),
    }
    panel = library.find("FL11").scaled(0.01, Unit.RADIANCE)
    shapes = [shape(n, mesh, n, panel if n == "panel" else None) for n, mesh in walls.items()]
    lamp = np.eye(4)
    lamp[:3, 3] = 0.5, 0.2, 0.6
    parameters = {"intensity": library.find("D65").scaled(0.0005, Unit.INTENSITY), "radius": 0.0}
    return RenderScene(
        Camera("Camera", "perspective", view((1.7, -0.9, 1.1), (0.35, 0.6, 0.35)), (-0.4, 0.4, -0.4, 0.4)),
        tuple(shapes),
        {name: matte(name, paint) for name, paint in paints.items()},
        (Light("Lamp", "point", lamp, parameters),),
        integrator=Integrator("path", depth, samples, seed),
        film=Film(16, 16),
    )


def view(place, target):
    """The matrix of a camera at a place that looks at a target, the world's Z up in the picture."""
    back = np.subtract(place, target) / np.linalg.norm(np.subtract(place, target))
    right = np.cross((0, 0, 1), back) / np.linalg.norm(np.cross((0, 0, 1), back))
    matrix = np.eye(4)
    matrix[:3] = np.stack([right, np.cross(back, right), back, place], axis=1)
    return matrix


def render(name, scene, folder) -> FloatArray:
    renderer = renderers.find(name)
    native = renderer.translate(scene, (), folder / name, f"seed-{scene.integrator.seed}")
    return renderer.render(native, RenderOptions(), lambda fraction: None).radiance


@pytest.fixture(scope="module")
def pictures(tmp_path_factory):
    """Each renderer's (seeds, 17, bands) means; no two renderings share a seed."""
    folder = tmp_path_factory.mktemp("corner")
    return {
        name: np.stack(
            [in_blocks(render(name, corner(100 * first + seed, 6), folder), 4) for seed in range(SEEDS)]
        )
        for first, name in enumerate(NAMES, start=1)
    }


def test_both_renderers_see_the_same_in_every_band_within_noise(pictures):
    assert least_probability(*pictures.values()) > CHANCE


def test_the_noise_is_small_enough_to_tell_a_wrong_renderer(pictures):
    assert max(error_of_mean(seeds[:, -1]).max() for seeds in pictures.values()) < 0.0015


def test_a_renderer_that_is_one_per_cent_too_bright_is_told(pictures):
    ours, theirs = pictures.values()
    assert least_probability(ours, 1.01 * theirs) < CHANCE


@pytest.mark.parametrize("name", NAMES)
def test_walls_light_each_other(pictures, name, tmp_path):
    direct = in_blocks(render(name, corner(7, 2), tmp_path), 4)
    share = 1 - direct[-1] / pictures[name].mean(axis=0)[-1]
    assert share.min() > 0.1
    # White and red paint throw more long-wave light about than short-wave.
    assert share[25:].mean() > 1.2 * share[15:20].mean()


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("depth", [1, 2, 3, 8])
def test_inside_a_glowing_box_every_bounce_adds_its_share(name, depth, tmp_path):
    """A closed box whose walls emit L and reflect r shows L (1 + r + r^2 ...) everywhere, a term a bounce."""
    reflectance, radiance = (
        Spectrum.of([400, 700], [0.2, 0.8]),
        Spectrum.of([400, 700], [3, 1], Unit.RADIANCE),
    )
    scene = RenderScene(
        Camera("Camera", "perspective", np.eye(4), (-0.5, 0.5, -0.5, 0.5)),
        tuple(shape(f"wall{n}", wall, "paint", radiance) for n, wall in enumerate(inside_of_a_cube())),
        {"paint": matte("paint", reflectance)},
        integrator=Integrator("path", depth, 256, 3),
        film=Film(8, 8),
    )
    picture = render(name, scene, tmp_path)
    r, light = (spectrum.in_bands(scene.film.bands) for spectrum in (reflectance, radiance))
    expected = light * (1 - r**depth) / (1 - r)
    seen = picture.reshape(64, -1)
    error_of_mean = seen.std(axis=0, ddof=1) / 8
    assert error_of_mean.max() / expected.min() < 0.01
    assert (abs(seen.mean(axis=0) - expected) < 5 * error_of_mean + 1e-5 * expected).all()


def inside_of_a_cube():
    """Six walls of side 2 around the origin, their normals inwards."""
    for axis in range(3):
        for side in (-1.0, 1.0):
            one, other, start = np.zeros(3), np.zeros(3), -np.ones(3)
            one[(axis + 1) % 3], other[(axis + 2) % 3], start[axis] = 2, 2, side
            yield rectangle(start, *((one, other) if side < 0 else (other, one)))
