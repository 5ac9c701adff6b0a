"""The tracer's lights against closed forms: how they fall off, how they look, which side they shine on."""

import numpy as np
import pytest

from rtb_addon.scene.render_scene import Camera, Shape
from tests.renderings.tracer_scenes import (
    RADIANCE,
    SHAPE_OF_LIGHT,
    SQUARE,
    assert_within_noise,
    facing,
    lamp,
    looking_down,
    matrix,
    picture,
    polygon,
    reflected,
    scene,
)

FLOOR = Shape("floor", SQUARE, matrix(), "grey")


def patch_under(light, folder, **more):
    """Return the radiance per band of a spot of the floor."""
    return picture(scene([FLOOR], [light], **more), folder)[0, 0]


@pytest.mark.parametrize("distance", [0.5, 10, 210])
@pytest.mark.parametrize("tilt", [0, 60, 85])
def test_a_point_light_falls_off_with_the_square_and_the_cosine(tmp_path, distance, tilt):
    angle = np.radians(tilt)
    place = distance * np.array([np.sin(angle), 0, np.cos(angle)])
    seen = patch_under(lamp("point", matrix(place)), tmp_path, camera=looking_down(1e-5))
    np.testing.assert_allclose(seen, reflected(np.cos(angle) / distance**2), rtol=1e-4)


def test_a_far_light_over_a_unit_square_is_right_to_a_ten_thousandth(tmp_path):
    lit = scene(
        [FLOOR], [lamp("point", matrix((0, 0, 210)))], camera=looking_down(0.5), size=(8, 8), samples=4
    )
    grid = (np.arange(200) + 0.5) / 200 - 0.5
    x, y = np.meshgrid(grid, grid)
    irradiance = (210 / (x**2 + y**2 + 210**2) ** 1.5).mean()
    np.testing.assert_allclose(picture(lit, tmp_path).mean(axis=(0, 1)), reflected(irradiance), rtol=1e-6)


def test_a_lamp_with_a_radius_lights_like_a_point_and_looks_like_a_ball(tmp_path):
    def lit(seed):
        ball = lamp("point", matrix((0, 0, 1)), radius=0.6)
        return scene(
            [FLOOR],
            [ball],
            camera=Camera("c", "orthographic", matrix((0, 0, 0.3)), (-1e-3, 1e-3, -1e-3, 1e-3)),
            samples=256,
            seed=seed,
        )

    assert_within_noise(lit, tmp_path, reflected(1.0))


def test_a_lamp_with_a_radius_is_seen_as_bright_as_its_intensity_says(tmp_path):
    ball = lamp("point", matrix((0, 0, 0)), radius=0.5)
    camera = Camera("c", "orthographic", matrix((0, 0, 5)), (-1, 1, -1, 1))
    seen = picture(scene([], [ball], camera=camera, size=(64, 64), samples=16), tmp_path)
    np.testing.assert_allclose(seen[32, 32], np.array(SHAPE_OF_LIGHT) / (np.pi * 0.25), rtol=1e-6)
    # The disc's area from jittered samples: the boundary crosses about 100 pixels of 1/1024 square metres.
    covered = seen.mean(axis=(0, 1)) / seen[32, 32] * 4
    np.testing.assert_allclose(covered, np.pi * 0.25, atol=4 * np.sqrt(100 / 16) / 2 / 1024)


def test_a_ball_of_light_hides_what_is_behind_it(tmp_path):
    ball, behind = (
        lamp("point", matrix((0, 0, 2)), [0, 0, 0, 0], radius=0.5),
        lamp("point", matrix((0, 0, 4))),
    )
    camera = Camera("c", "orthographic", facing((0, -1, 1), (0, 0, 0)), (-1e-3, 1e-3, -1e-3, 1e-3))
    assert not picture(scene([FLOOR], [ball, behind], camera=camera, samples=64), tmp_path).any()


@pytest.mark.parametrize("angle", [0.0, 60.0])
@pytest.mark.parametrize("tilt", [0, 50])
def test_the_sun_gives_its_irradiance_whatever_its_width(tmp_path, angle, tilt):
    a = np.radians(tilt)
    sun = lamp("directional", facing((np.sin(a), 0, np.cos(a)), (0, 0, 0)), angle=angle)

    def lit(seed):
        return scene([FLOOR], [sun], samples=64, seed=seed)

    assert_within_noise(lit, tmp_path, reflected(np.cos(a)))


def test_a_wide_sun_is_a_disc_in_the_sky(tmp_path):
    sun = lamp("directional", matrix(), angle=60.0)
    edge = np.tan(np.radians(30))
    camera = Camera(
        "c", "perspective", facing((0, 0, 0), (0, 0, 1)), (-2 * edge, 2 * edge, -2 * edge, 2 * edge)
    )
    seen = picture(scene([], [sun], camera=camera, size=(65, 65)), tmp_path)
    across = (np.arange(65) + 0.5) / 65 * 4 - 2
    r = np.hypot(*np.meshgrid(across, across))
    disc = np.array(SHAPE_OF_LIGHT) / (np.pi * np.sin(np.radians(30)) ** 2)
    np.testing.assert_allclose(seen[r < 0.95], np.broadcast_to(disc, seen[r < 0.95].shape), rtol=1e-6)
    assert not seen[r > 1.05].any()


@pytest.mark.parametrize("blend", [0.0, 0.3, 1.0])
@pytest.mark.parametrize("angle", [0, 10, 20, 25, 29, 31, 80])
@pytest.mark.parametrize("radius", [0.0, 1e-4])
def test_a_spot_fades_by_blenders_smooth_step(tmp_path, angle, blend, radius):
    a, edge = np.radians(angle), np.cos(np.radians(30))
    away = np.array([np.sin(a), 0, np.cos(a)])
    # The lamp straight above shines along -away, so the floor is seen from it under this angle.
    spot = lamp("spot", facing((0, 0, 2), (0, 0, 2) - away), cone=60.0, blend=blend, radius=radius)
    t = np.clip((np.cos(a) - edge) / ((1 - edge) * blend), 0, 1) if blend else float(np.cos(a) > edge)
    camera = Camera("c", "orthographic", matrix((0, 0, 1)), (-1e-5, 1e-5, -1e-5, 1e-5))
    seen = picture(scene([FLOOR], [spot], camera=camera, samples=16), tmp_path)[0, 0]
    # A lamp of radius 0.1 mm at 2 m blurs the edge by 5e-5 in the angle, 1e-3 in the profile.
    np.testing.assert_allclose(seen, reflected(t * t * (3 - 2 * t) / 4), rtol=1e-4, atol=1e-3 * (radius > 0))


def seen_from(polygon_corners, place=(0, 0, 0), normal=(0, 0, 1)):
    """Return irradiance per radiance of a polygon above the horizon (Lambert 1760)."""
    ways = np.subtract(polygon_corners, place, dtype=float)
    ways /= np.linalg.norm(ways, axis=1, keepdims=True)
    after = np.roll(ways, -1, axis=0)
    angles = np.arccos((ways * after).sum(axis=1))
    across = np.cross(ways, after)
    across /= np.linalg.norm(across, axis=1, keepdims=True)
    return abs((angles * (across @ normal)).sum()) / 2


@pytest.mark.parametrize("sides", [32, 1024])
def test_a_luminous_disc_lights_as_its_polygon_says(tmp_path, sides):
    turn = -2 * np.pi * np.arange(sides) / sides
    corners = np.stack([0.5 * np.cos(turn), 0.5 * np.sin(turn), np.full(sides, 1.0)], axis=1)
    irradiance = seen_from(np.float32(corners))
    if sides == 1024:
        assert irradiance == pytest.approx(np.pi * 0.25 / 1.25, rel=1e-5)
    disc = Shape("disc", polygon(corners), matrix(), "black", RADIANCE)
    camera = Camera("c", "orthographic", matrix((0, 0, 0.5)), (-1e-3, 1e-3, -1e-3, 1e-3))

    def lit(seed):
        return scene([FLOOR, disc], camera=camera, samples=256, seed=seed)

    assert_within_noise(lit, tmp_path, reflected(irradiance))


@pytest.mark.parametrize("scale", [1.0, 0.5])
def test_a_scaled_shape_emits_over_its_area_in_the_world(tmp_path, scale):
    to_world = matrix((0.3, 0, 1), (scale, 0, 0), (0, -scale, 0), (0, 0, -1))
    corners = SQUARE.vertices * [scale, -scale, -1] + [0.3, 0, 1]
    camera = Camera("c", "orthographic", matrix((0, 0, 0.5)), (-1e-3, 1e-3, -1e-3, 1e-3))

    def lit(seed):
        panel = Shape("panel", SQUARE, to_world, "black", RADIANCE)
        return scene([FLOOR, panel], camera=camera, samples=256, seed=seed)

    assert_within_noise(lit, tmp_path, reflected(seen_from(corners)))


def test_two_lamps_of_different_kinds_add_up(tmp_path):
    dim = lamp("point", matrix((0, 0, 2)), [0.02, 0.03, 0.01, 0.005])
    sun = lamp("directional", matrix())

    def lit(seed):
        return scene([FLOOR], [dim, sun], samples=256, seed=seed)

    assert_within_noise(lit, tmp_path, reflected(1 + 0.01 / 4))


def test_surfaces_emit_on_the_side_of_their_normals_only(tmp_path):
    panel = Shape("panel", SQUARE, matrix((0, 0, 1)), "black", RADIANCE)
    from_above, from_below = (
        looking_down(),
        Camera("c", "orthographic", facing((0, 0, 0.5), (0, 0, 1)), (-0.1, 0.1, -0.1, 0.1)),
    )
    np.testing.assert_allclose(picture(scene([panel], camera=from_above), tmp_path)[0, 0], SHAPE_OF_LIGHT)
    assert not picture(scene([panel], camera=from_below), tmp_path).any()
    under = Camera("c", "orthographic", matrix((0, 0, 0.5)), (-1e-3, 1e-3, -1e-3, 1e-3))
    assert not picture(scene([FLOOR, panel], camera=under, samples=64), tmp_path).any()
