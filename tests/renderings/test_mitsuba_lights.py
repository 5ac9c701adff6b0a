"""Mitsuba's lights against closed forms."""

import numpy as np
import pytest

from rtb_addon.scene.render_scene import Camera, Shape
from rtb_addon.spectra import Bands, Spectrum, library
from tests.renderings.mitsuba_scenes import (
    BANDS,
    FLOOR,
    FULL_TURN,
    INTENSITY,
    REFLECTANCE,
    assert_within_noise,
    at,
    disc,
    globe,
    lamp,
    looking_down,
    picture,
    scene,
    square,
)

PAINTED = REFLECTANCE.in_bands(BANDS) / np.pi
SHINING = INTENSITY.in_bands(BANDS)


@pytest.mark.parametrize("kind", ["averaged", "centre"])
@pytest.mark.parametrize(("x", "height"), [(0.0, 3.0), (0.0, 6.0), (2.0, 3.0)])
def test_a_point_light_obeys_the_inverse_square_and_the_cosine(tmp_path, kind, x, height):
    image = picture(scene([lamp("point", at(x, 0, height), radius=0.0)], kind=kind), tmp_path)
    distance = np.hypot(x, height)
    expected = REFLECTANCE.in_bands(BANDS, kind) * INTENSITY.in_bands(BANDS, kind) / np.pi
    expected = expected * height / distance**3
    np.testing.assert_allclose(image.radiance, np.broadcast_to(expected, image.radiance.shape), rtol=2e-5)
    assert image.band_kind == kind
    assert image.factor == 1


def test_matte_surfaces_reflect_on_both_sides(tmp_path):
    turned = Shape("Floor", square(50), FULL_TURN, "paint")
    image = picture(scene([lamp("point", radius=0.0)], [turned]), tmp_path)
    np.testing.assert_allclose(image.radiance[0, 0], PAINTED * SHINING / 9, rtol=2e-5)


def test_a_point_with_a_radius_is_an_emitting_sphere(tmp_path):
    image = picture(scene([lamp("point", radius=0.5)], samples=256), tmp_path)
    assert_within_noise(image, PAINTED * SHINING / 9)


def test_the_camera_sees_the_sphere_of_a_point_with_a_radius(tmp_path):
    image = picture(scene([lamp("point", at(0, 0, 1), radius=0.5)]), tmp_path)
    expected = SHINING / (np.pi * 0.25)
    np.testing.assert_allclose(image.radiance[1, 2], expected, rtol=1e-6)


def test_a_directional_light_gives_its_irradiance_times_the_cosine(tmp_path):
    tilt = np.radians(40)
    turn = np.eye(4)
    turn[1:3, 1:3] = [[np.cos(tilt), -np.sin(tilt)], [np.sin(tilt), np.cos(tilt)]]
    image = picture(scene([lamp("directional", turn, angle=0.0)]), tmp_path)
    expected = PAINTED * SHINING * np.cos(tilt)
    np.testing.assert_allclose(image.radiance[0, 0], expected, rtol=2e-6)


@pytest.mark.parametrize("degrees", [0.53, 10.0, 60.0])
def test_a_sun_is_a_disc_of_its_irradiance(tmp_path, degrees):
    image = picture(scene([lamp("directional", angle=degrees)], samples=1024), tmp_path)
    assert_within_noise(image, PAINTED * SHINING)


def test_the_camera_sees_the_disc_of_a_sun_at_its_place_and_no_larger(tmp_path):
    # The sun stands straight above and the camera looks up; a tangent of 0.1 is 5.71 degrees.
    up = Camera("Camera", "perspective", FULL_TURN, (-0.2, 0.2, -0.2, 0.2))
    degrees = 2 * np.degrees(np.arctan(0.1))
    one = scene([lamp("directional", angle=degrees)], [], camera=up, size=(40, 40), samples=256)
    disc_radiance = SHINING / (np.pi * np.sin(np.radians(degrees / 2)) ** 2)
    shown = picture(one, tmp_path).radiance / disc_radiance
    np.testing.assert_allclose(shown[20, 20], 1, rtol=1e-5)
    covered = shown[..., 3].mean() * 0.4**2
    assert covered == pytest.approx(np.pi * 0.1**2, rel=3e-3)
    rows, columns = np.nonzero(shown[..., 3] > 0.5)
    assert (rows.mean(), columns.mean()) == pytest.approx((19.5, 19.5), abs=0.05)


def test_a_sun_behind_something_casts_a_shadow(tmp_path):
    lid = Shape("Lid", square(20), at(0, 0, 5), "soot")
    image = picture(scene([lamp("directional", angle=5.0)], [FLOOR, lid]), tmp_path)
    assert not image.radiance.any()


def expected_spot(x, height, cone, blend):
    """Irradiance of a spot of unit intensity on the floor, by Blender's smooth step."""
    cosine = height / np.hypot(x, height)
    outer = np.cos(np.radians(cone / 2))
    t = np.clip((cosine - outer) / ((1 - outer) * max(blend, 1e-12)), 0, 1)
    return t * t * (3 - 2 * t) * cosine**3 / height**2


@pytest.mark.parametrize(("cone", "blend"), [(45.0, 0.0), (45.0, 0.3), (70.0, 1.0), (20.0, 0.15)])
def test_a_spot_fades_as_blenders_smooth_step_does(tmp_path, cone, blend):
    reach, pixels, fine = 2.4, 48, 400
    across = Camera("Camera", "orthographic", at(0, 0, 2), (-reach, reach, -1e-3, 1e-3))
    spot = lamp("spot", cone=cone, blend=blend, radius=0.0)
    image = picture(scene([spot], camera=across, size=(pixels, 1), samples=1024), tmp_path)
    x = (np.arange(pixels * fine) + 0.5) / (pixels * fine) * 2 * reach - reach
    profile = expected_spot(x, 3.0, cone, blend).reshape(pixels, fine).mean(axis=1)
    expected = profile[:, None] * PAINTED * SHINING
    # 1024 samples stratified along a row miss an edge by at most a 1/1024 of the pixel's height.
    np.testing.assert_allclose(image.radiance[0], expected, rtol=2e-4, atol=2e-3 * expected.max())


def test_a_spot_with_a_radius_has_its_intensity_on_the_axis_and_its_edge(tmp_path):
    spot = lamp("spot", cone=40.0, blend=0.1, radius=0.1)
    image = picture(scene([spot], samples=256), tmp_path)
    assert_within_noise(image, PAINTED * SHINING / 9)
    outside = picture(scene([spot], camera=looking_down(x=1.4)), tmp_path)
    assert not outside.radiance.any()


def test_the_sphere_of_a_spot_is_bright_only_from_inside_its_beam(tmp_path):
    spot = lamp("spot", at(0, 0, 4), cone=60.0, blend=0.0, radius=0.1)
    below = Camera("Camera", "perspective", at(0, 0, 1, FULL_TURN), (-1e-4, 1e-4, -1e-4, 1e-4))
    image = picture(scene([spot], [], camera=below), tmp_path)
    np.testing.assert_allclose(image.radiance[0, 0], SHINING / (np.pi * 0.01), rtol=1e-5)
    above = picture(scene([spot], [], camera=looking_down(height=6)), tmp_path)
    assert not above.radiance.any()


def emitting(mesh, matrix, emission=INTENSITY):
    return Shape("Panel", mesh, matrix, "soot", emission)


def test_a_disc_gives_the_irradiance_of_a_disc(tmp_path):
    panel = emitting(disc(1.5), at(0, 0, 3, FULL_TURN))
    image = picture(scene(shapes=[FLOOR, panel], samples=1024), tmp_path)
    # On the axis, irradiance is pi L r^2 / (r^2 + h^2); a polygon of a circle's area differs by 1e-4.
    assert_within_noise(image, PAINTED * np.pi * SHINING * 2.25 / 11.25, floor=3e-4)


def test_a_panel_emits_on_the_side_of_its_normals_only(tmp_path):
    away = emitting(disc(1.5), at(0, 0, 3))
    assert not picture(scene(shapes=[FLOOR, away]), tmp_path).radiance.any()


def test_mirroring_a_panel_leaves_its_light_on_the_same_side(tmp_path):
    mirrored = at(0, 0, 3, FULL_TURN @ np.diag([-1.0, 1.0, 1.0, 1.0]))
    image = picture(scene(shapes=[FLOOR, emitting(disc(1.5), mirrored)], samples=1024), tmp_path)
    assert_within_noise(image, PAINTED * np.pi * SHINING * 2.25 / 11.25, floor=3e-4)


def test_smooth_normals_do_not_change_what_a_mesh_emits(tmp_path):
    smooth, flat = (emitting(globe(0.5, smooth=smooth), at(0, 0, 3)) for smooth in (True, False))
    one = picture(scene(shapes=[FLOOR, smooth]), tmp_path).radiance
    assert one.mean() > 0
    assert np.array_equal(one, picture(scene(shapes=[FLOOR, flat]), tmp_path).radiance)


def test_a_surface_under_an_even_sky_has_the_skys_radiance_times_its_reflectance(tmp_path):
    sky = lamp("environment", filename="")
    image = picture(scene(environment=sky, samples=1024), tmp_path)
    assert_within_noise(image, PAINTED * np.pi * SHINING)


def test_a_white_corner_under_an_even_sky_stays_white(tmp_path):
    wall = np.array([[0.0, 0, 1, 2], [0, 1, 0, 0], [-1, 0, 0, 0], [0, 0, 0, 1]])
    corner = [Shape("Floor", square(2), np.eye(4), "paint"), Shape("Wall", square(2), wall, "paint")]
    sky = lamp("environment", filename="")
    white = Spectrum.constant(1.0)
    camera = looking_down(half=0.3, x=1)
    one = scene(shapes=corner, reflectance=white, environment=sky, camera=camera, samples=1024, depth=60)
    assert_within_noise(picture(one, tmp_path), SHINING)


def test_a_closed_room_whose_walls_all_emit_is_a_geometric_series(tmp_path):
    turns = [("x", 0), ("x", 90), ("x", 180), ("x", 270), ("y", 90), ("y", 270)]
    walls = [Shape(f"Wall{k}", square(1), inward(*turn), "paint", INTENSITY) for k, turn in enumerate(turns)]
    one = scene(shapes=walls, camera=looking_down(height=0.2), samples=1024, depth=5)
    rho = REFLECTANCE.in_bands(BANDS)
    assert_within_noise(picture(one, tmp_path), SHINING * (1 - rho**5) / (1 - rho))


def inward(axis, degrees):
    """Return the place of a wall of a room of two metres, seen from inside."""
    angle = np.radians(degrees)
    matrix, (i, j) = np.eye(4), {"x": (1, 2), "y": (2, 0)}[axis]
    matrix[[i, i, j, j], [i, j, i, j]] = np.cos(angle), -np.sin(angle), np.sin(angle), np.cos(angle)
    matrix[:3, 3] = -matrix[:3, 2]
    return matrix


def test_daylight_on_a_spiky_paint_leaks_into_no_other_band(tmp_path):
    bands = Bands.regular(400, 10, 31)
    daylight = library.find("D65")
    for spike in (400.0, 550.0, 700.0):
        paint = Spectrum.of([spike - 5, spike, spike + 5], [0, 1, 0])
        one = scene([lamp("directional", intensity=daylight, angle=0.0)], reflectance=paint, bands=bands)
        image = picture(one, tmp_path)
        expected = paint.in_bands(bands) * daylight.in_bands(bands) / np.pi
        np.testing.assert_allclose(image.radiance[0, 0], expected, rtol=1e-5, atol=1e-9 * expected.max())
        assert np.count_nonzero(expected) == 1
