"""The internal tracer against closed forms: both sides, every camera, the same bits again."""

import re
import sys

import numpy as np
import pytest

from rtb_addon.errors import Cancelled, RenderingError
from rtb_addon.renderers import find
from rtb_addon.renderers.interface import RenderOptions
from rtb_addon.renderers.tracer import intersect, passes
from rtb_addon.renderers.tracer.bvh import Bvh
from rtb_addon.renderers.tracer.kernels import Embree
from rtb_addon.scene.render_scene import Camera, Shape
from rtb_addon.spectra import Spectrum, Unit, library
from tests.renderings.tracer_scenes import (
    BANDS,
    GREY,
    RADIANCE,
    SHAPE_OF_LIGHT,
    SQUARE,
    assert_within_noise,
    cube,
    facing,
    lamp,
    looking_down,
    matrix,
    matte,
    per_band,
    picture,
    polygon,
    reflected,
    scene,
    sky,
)

FLOOR = Shape("floor", SQUARE, matrix(), "grey")


def test_matte_surfaces_reflect_on_both_sides(tmp_path):
    camera = Camera("c", "orthographic", facing((0, 0, -5), (0, 0, 0)), (-1e-3, 1e-3, -1e-3, 1e-3))
    seen = picture(scene([FLOOR], [lamp("point", matrix((0, 0, -2)))], camera=camera), tmp_path)[0, 0]
    np.testing.assert_allclose(seen, reflected(0.25), rtol=1e-6)
    assert not picture(scene([FLOOR], [lamp("point", matrix((0, 0, 2)))], camera=camera), tmp_path).any()


@pytest.mark.parametrize("smooth", [False, True])
@pytest.mark.parametrize("signs", [(1, 1, 1), (-1, 1, 1), (1, -1, 1), (1, 1, -1), (-1, -1, -1)])
def test_a_mirrored_shape_keeps_its_outside(tmp_path, signs, smooth):
    axes = np.diag(signs)
    body = Shape("body", cube(normals=smooth), matrix((0, 0, 0), *axes), "black", RADIANCE)
    np.testing.assert_allclose(picture(scene([body]), tmp_path)[0, 0], SHAPE_OF_LIGHT)
    panel = Shape("panel", SQUARE, matrix((0, 0, 1), *axes), "black", RADIANCE)
    assert picture(scene([panel]), tmp_path).any() == (signs[2] > 0)


def test_no_light_leaks_through_a_coarse_smooth_ball(tmp_path):
    ball = Shape("ball", cube(normals=True), matrix(), "grey")
    camera = Camera("c", "perspective", facing((4, 3, 5), (0, 0, 0)), (-0.4, 0.4, -0.4, 0.4))
    inside = scene(
        [ball], [lamp("point", matrix((0.5, 0, 0)))], camera=camera, depth=6, samples=16, size=(16, 16)
    )
    assert not picture(inside, tmp_path).any()


@pytest.mark.parametrize("place", [(0, 0, 0), (5e4, -2e4, 1e4)])
def test_a_wide_floor_under_a_grazing_sun_does_not_shade_itself(tmp_path, place):
    wide = Shape("floor", SQUARE, matrix(place, (100, 0, 0), (0, 100, 0)), "grey")
    a = np.radians(89.5)
    sun = lamp("directional", facing((np.sin(a), 0, np.cos(a)), (0, 0, 0)))
    camera = Camera("c", "orthographic", matrix(np.add(place, (0, 0, 5))), (-90, 90, -90, 90))
    seen = picture(scene([wide], [sun], camera=camera, size=(32, 32)), tmp_path)
    np.testing.assert_allclose(seen, np.broadcast_to(reflected(np.cos(a)), seen.shape), rtol=1e-5)


@pytest.mark.parametrize("depth", [1, 2, 3, 4])
def test_a_white_convex_body_vanishes_before_a_white_sky(tmp_path, depth):
    body = Shape("body", cube(), matrix(), "white")
    camera = Camera("c", "perspective", facing((4, 3, 5), (0, 0, 0)), (-0.5, 0.5, -0.5, 0.5))
    white = scene(
        [body],
        materials=[matte("white", Spectrum.constant(1.0))],
        camera=camera,
        depth=depth,
        samples=4,
        size=(8, 8),
        environment=sky(3.0),
    )
    seen = picture(white, tmp_path)
    if depth == 1:
        assert seen[4, 4].max() == 0
        assert seen[0, 0].min() == 3
    else:
        np.testing.assert_allclose(seen, 3.0, rtol=1e-6)


@pytest.mark.parametrize("depth", [1, 2, 5])
def test_light_in_a_closed_luminous_box_is_a_geometric_series(tmp_path, depth):
    room = Shape("room", cube(inwards=True), matrix(), "grey", RADIANCE)
    camera = Camera("c", "perspective", facing((0.3, 0.2, 0.1), (-1, -1, -1)), (-0.5, 0.5, -0.5, 0.5))
    series = sum(GREY.in_bands(BANDS) ** bounce for bounce in range(depth))

    def lit(seed):
        return scene([room], camera=camera, depth=depth, samples=64, size=(8, 8), seed=seed)

    assert_within_noise(lit, tmp_path, np.array(SHAPE_OF_LIGHT) * series)


def test_a_spiky_reflectance_under_daylight_mixes_no_bands(tmp_path):
    spike = Spectrum.of([300, 490, 500, 510, 800], [0, 0, 0.9, 0, 0])
    daylight = library.find("D65")
    sun = lamp("directional", matrix())
    sun.parameters["intensity"] = daylight
    seen = picture(scene([FLOOR], [sun], materials=[matte("grey", spike)]), tmp_path)[0, 0]
    assert seen[[0, 2, 3]].tolist() == [0, 0, 0]
    # The averages of both over the band, then their product: 0.9 over a triangle 20 nm wide in 100 nm.
    mean = daylight.at(450 + (np.arange(10000) + 0.5) / 100).mean()
    assert seen[1] == pytest.approx(0.09 * mean / np.pi, rel=1e-6)


def luminous_square(projection, window, to_world, size=(8, 8), **more):
    """Return a picture of a luminous square metre around the origin, 1 where it is seen."""
    mesh = polygon([(-0.5, -0.5, 0), (0.5, -0.5, 0), (0.5, 0.5, 0), (-0.5, 0.5, 0)])
    glow = Shape("glow", mesh, matrix(), "black", per_band([1, 1, 1, 1], Unit.RADIANCE))
    return scene([glow], camera=Camera("c", projection, to_world, window, **more), size=size, samples=4)


@pytest.mark.parametrize("projection", ["orthographic", "perspective"])
def test_edges_land_on_the_pixels_that_the_window_says(tmp_path, projection):
    # The square's edges fall on edges of pixels: columns 1 to 4 and rows 3 to 6 of eight.
    window = np.array([-0.75, 1.25, -0.75, 1.25])
    if projection == "perspective":
        window = window / 2
    seen = picture(luminous_square(projection, tuple(window), matrix((0, 0, 2))), tmp_path)[..., 0]
    expected = np.zeros((8, 8))
    expected[3:7, 1:5] = 1
    np.testing.assert_array_equal(seen, expected)


def test_a_mirrored_camera_mirrors_the_picture(tmp_path):
    window = (-1, 1, -1, 1)
    straight = picture(luminous_square("orthographic", window, matrix((0.25, 0, 2))), tmp_path)
    mirrored = picture(luminous_square("orthographic", window, matrix((0.25, 0, 2), x=(-1, 0, 0))), tmp_path)
    assert straight[2:6, 1:5].min() == 1
    np.testing.assert_array_equal(mirrored, straight[:, ::-1])


@pytest.mark.parametrize("clip", [(0.1, 1.9), (2.1, 9.0)])
def test_what_lies_beyond_the_camera_s_clip_is_not_seen(tmp_path, clip):
    for projection in ("orthographic", "perspective"):
        window = (-0.1, 0.1, -0.1, 0.1)
        assert not picture(luminous_square(projection, window, matrix((0, 0, 2)), clip=clip), tmp_path).any()
        seen = picture(luminous_square(projection, window, matrix((0, 0, 2)), clip=(1.9, 2.1)), tmp_path)
        assert seen.min() == 1


def busy_room(**more):
    """Return a room with a smooth and a flat body, and a lamp of every kind."""
    room = Shape("room", cube(inwards=True), matrix(), "grey")
    flat = Shape("flat", cube(), matrix((-0.4, 0.1, -0.7), (0.3, 0.1, 0), (-0.1, 0.3, 0), (0, 0, 0.3)), "red")
    smooth = Shape(
        "smooth", cube(normals=True), matrix((0.5, 0.4, -0.2), (0.2, 0, 0), (0, 0.2, 0), (0, 0, 0.2)), "grey"
    )
    panel = Shape(
        "panel", SQUARE, matrix((0, 0, 0.95), (0.3, 0, 0), (0, -0.3, 0), (0, 0, -1)), "black", RADIANCE
    )
    lights = [
        lamp("point", matrix((0.5, -0.5, 0.5)), radius=0.1),
        lamp("point", matrix((-0.5, -0.5, 0.5)), radius=0.0),
        lamp("spot", facing((0, 0, 0.9), (0.4, 0.4, -1)), blend=0.5),
    ]
    materials = [
        matte("grey"),
        matte("red", per_band([0.1, 0.2, 0.9, 0.8])),
        matte("black", Spectrum.constant(0.0)),
    ]
    camera = Camera("c", "perspective", facing((0, -0.95, 0), (0, 1, -0.3)), (-1, 1, -1, 1))
    options = {"materials": materials, "camera": camera, "depth": 5, "samples": 3, "size": (24, 16), **more}
    return scene([room, flat, smooth, panel], lights, **options)


def alone(one, kernel):
    """Return the radiance of a scene by a ray kernel of one's choice."""
    return passes.render(one, passes.Alone(one, kernel), RenderOptions(), lambda fraction: None).mean()


def test_the_same_scene_gives_the_same_bits_and_another_seed_others(tmp_path):
    first = picture(busy_room(), tmp_path)
    np.testing.assert_array_equal(picture(busy_room(), tmp_path), first)
    assert (picture(busy_room(seed=1), tmp_path) != first).any()


def test_numpy_and_embree_give_the_same_picture():
    numpys, embrees = (alone(busy_room(), kernel) for kernel in (Bvh, Embree))
    np.testing.assert_allclose(numpys, embrees, atol=1e-6 * embrees.max())


def test_without_embree_the_tracer_renders_with_numpy(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "embreex.mesh_construction", None)
    monkeypatch.setattr(intersect, "_warm", {})
    tracer = find("tracer")
    native = tracer.translate(scene([FLOOR], [lamp("directional", matrix())]), (), tmp_path, "scene")
    image = tracer.render(native, RenderOptions(), lambda fraction: None)
    assert image.attributes["ray_kernel"] == "numpy"
    np.testing.assert_allclose(image.radiance[0, 0], reflected(1.0), rtol=1e-6)


@pytest.mark.parametrize("kernel", [Bvh, Embree])
def test_an_empty_scene_shows_its_sky(kernel):
    np.testing.assert_array_equal(alone(scene([], environment=sky(2.0)), kernel), 2.0)


def test_progress_rises_to_one_and_a_raised_cancel_stops(tmp_path):
    heard = []
    tall = busy_room(size=(80, 80), samples=12, depth=2)
    picture(tall, tmp_path, heard.append)
    assert heard == sorted(heard)
    assert (heard[0], heard[-1]) == (0.0, 1.0)
    assert len(heard) >= 4

    def stop(fraction):
        if fraction > 0.3:
            raise Cancelled

    with pytest.raises(Cancelled):
        picture(tall, tmp_path, stop)


def test_tiles_do_not_show(tmp_path, monkeypatch):
    lights = [lamp("point", matrix((0, 0, 2)))]
    whole = scene([FLOOR], lights, camera=looking_down(0.9), size=(8, 8), samples=16)
    expected = picture(whole, tmp_path)
    monkeypatch.setattr(passes, "WAVE", 7)
    monkeypatch.setattr(passes, "TILE", 20)
    np.testing.assert_allclose(picture(whole, tmp_path), expected, rtol=1e-6)


@pytest.mark.parametrize("value", [-1.0, 1e39])
def test_a_lamp_with_numbers_that_cannot_be_is_named(tmp_path, value):
    lit = scene([FLOOR], [lamp("directional", matrix(), [1, 1, value, 1])])
    with pytest.raises(
        RenderingError, match=re.escape(f"light directional lamp is {value:g} at 600 nm, give")
    ):
        picture(lit, tmp_path)


def test_radiance_that_is_no_number_is_refused_in_one_sentence(tmp_path):
    near = lamp("point", matrix((0, 0, 1e-5)), [1, 9e29, 1, 1])
    with pytest.raises(RenderingError, match=r"row 0, column 0 is inf at 500 nm"):
        picture(scene([FLOOR], [near], camera=looking_down(1e-12)), tmp_path)
