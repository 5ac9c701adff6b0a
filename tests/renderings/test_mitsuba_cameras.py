"""Mitsuba's cameras: a bright square lands on the pixels that geometry says."""

import numpy as np
import pytest

from rtb_addon.scene.render_scene import Camera, Shape
from rtb_addon.spectra import Spectrum
from tests.renderings.mitsuba_scenes import FULL_TURN, at, picture, scene, square

GLOW = Spectrum.constant(1.0)
# A panel of 0.6 x 0.6 around (0.3, -0.2) on the floor, shining up.
PANEL = Shape("Panel", square(0.3), at(0.3, -0.2, 0), "soot", GLOW)
EDGES = (0.0, 0.6, -0.5, 0.1)


def covered(window, size, edges=EDGES, depth=1.0):
    """Return how much of each pixel the panel covers, row 0 on top; depth is the panel's distance."""
    (left, right, bottom, top), (width, height) = np.multiply(window, depth), size
    across = shares(np.linspace(left, right, width + 1), *edges[:2])
    up = shares(np.linspace(top, bottom, height + 1), *edges[2:])
    return up[:, None] * across


def shares(places, low, high):
    first, second = np.minimum(places[:-1], places[1:]), np.maximum(places[:-1], places[1:])
    return np.clip(np.minimum(second, high) - np.maximum(first, low), 0, None) / (second - first)


def shown(camera, folder, size):
    return picture(scene(shapes=[PANEL], camera=camera, size=size, depth=1, samples=256), folder).radiance


WINDOWS = {
    "in the middle": ((-0.4, 0.4, -0.3, 0.3), (40, 30)),
    "shifted right and up": ((-0.15, 0.65, -0.2, 0.4), (40, 30)),
    "quite beside the axis": ((0.02, 0.22, -0.28, -0.13), (40, 30)),
    "with wide pixels": ((-0.4, 0.4, -0.3, 0.3), (20, 36)),
    "with narrow pixels, shifted": ((-0.3, 0.5, -0.4, 0.2), (60, 20)),
}


@pytest.mark.parametrize("name", WINDOWS)
@pytest.mark.parametrize("projection", ["perspective", "orthographic"])
def test_a_square_lands_where_the_window_says(tmp_path, name, projection):
    window, size = WINDOWS[name]
    camera = Camera("Camera", projection, at(0, 0, 2), window)
    distance = 2.0 if projection == "perspective" else 1.0
    image = shown(camera, tmp_path, size)
    # 256 samples, 16 x 16 strata: an edge is off by a fraction of a sixteenth of a pixel.
    np.testing.assert_allclose(image[..., 0], covered(window, size, depth=distance), atol=0.03)
    assert image[..., 0].sum() == pytest.approx(covered(window, size, depth=distance).sum(), rel=2e-3)


@pytest.mark.parametrize("projection", ["perspective", "orthographic"])
def test_a_mirrored_camera_shows_the_mirror_image(tmp_path, projection):
    window, size = WINDOWS["shifted right and up"]
    mirrored = at(0, 0, 2, np.diag([-1.0, 1.0, 1.0, 1.0]))
    image = shown(Camera("Camera", projection, mirrored, window), tmp_path, size)
    distance = 2.0 if projection == "perspective" else 1.0
    expected = covered(window, size, (-0.6, 0.0, -0.5, 0.1), distance)
    np.testing.assert_allclose(image[..., 0], expected, atol=0.03)


def test_a_turned_camera_turns_the_picture(tmp_path):
    quarter = np.array([[0.0, -1, 0, 0], [1, 0, 0, 0], [0, 0, 1, 2], [0, 0, 0, 1]])
    window = (-0.4, 0.4, -0.4, 0.4)
    image = shown(Camera("Camera", "perspective", quarter, window), tmp_path, (30, 30))
    # Camera x is world y, camera y is world -x.
    expected = covered(window, (30, 30), (-0.5, 0.1, -0.6, 0.0), 2.0)
    np.testing.assert_allclose(image[..., 0], expected, atol=0.03)


def test_nothing_nearer_than_the_near_clip_or_beyond_the_far_clip_is_seen(tmp_path):
    window = (-0.4, 0.4, -0.3, 0.3)
    for clip, seen in [((1.9, 2.1), True), ((2.1, 9.0), False), ((0.1, 1.9), False)]:
        for projection in ("perspective", "orthographic"):
            camera = Camera("Camera", projection, at(0, 0, 2), window, clip)
            assert shown(camera, tmp_path, (8, 6)).any() == seen


def test_a_camera_far_from_the_origin_sees_as_sharply(tmp_path):
    window = (-0.4, 0.4, -0.3, 0.3)
    camera = Camera("Camera", "perspective", at(0, 0, -2, FULL_TURN), window)
    turned = Shape("Panel", square(0.3), at(0.3, -0.2, 0, FULL_TURN), "soot", GLOW)
    image = picture(scene(shapes=[turned], camera=camera, size=(40, 30), depth=1, samples=256), tmp_path)
    expected = covered(window, (40, 30), (0.0, 0.6, -0.1, 0.5), 2.0)
    np.testing.assert_allclose(image.radiance[..., 0], expected, atol=0.03)
