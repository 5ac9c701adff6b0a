"""Parent scenes made into the neutral scene: what a camera sees."""

from dataclasses import replace

import numpy as np
import pytest

from rtb_addon.errors import RecipeError
from rtb_addon.scene.build import Placement, SceneBuilder
from rtb_addon.scene.render_scene import Film
from rtb_addon.scene.resolve import SceneSettings
from tests.unit.small_rooms import SETTINGS, resolved, room

# Cameras.


def view(film, **camera):
    builder = room(camera=False)
    builder.camera(**camera)
    return resolved(builder, settings=SceneSettings(film)).scene.camera


def test_xfov_spans_the_width_whatever_the_aspect_ratio_says():
    half = np.tan(np.radians(49.13434) / 2)
    for film in (Film(320, 240), Film(100, 100), Film(100, 300)):
        window = view(film, xfov=49.13434, aspect=1.777778).window
        high = half * film.height / film.width
        assert window == pytest.approx((-half, half, -high, high))


@pytest.mark.parametrize(
    ("size", "expected"),
    [  # as Blender 4.5's view_frame() gives them for a shift of (0.1, 0.2), times 35 / 32 for a lens of 35 mm
        ((320, 240), (-0.4, 0.6, -0.175, 0.575)),
        ((240, 320), (-0.275, 0.475, -0.3, 0.7)),
    ],
)
def test_shift_is_a_fraction_of_the_longer_side(size, expected):
    width = (expected[1] - expected[0]) / 1.09375
    window = view(Film(*size), xfov=np.degrees(2 * np.arctan(width / 2)), shift=(0.1, 0.2)).window
    assert window == pytest.approx([each / 1.09375 for each in expected])


def test_an_orthographic_view_is_twice_xmag_wide():
    builder = room(camera=False)
    builder.camera(width=6.0, shift=(0.1, 0.2))
    camera = resolved(builder).scene.camera
    assert camera.projection == "orthographic"
    assert camera.window == pytest.approx((-2.4, 3.6, -1.05, 3.45))  # Blender's view_frame() again


def test_yfov_alone_spans_the_height_and_both_make_pixels_that_are_not_square():
    text = room().tobytes().decode()
    xfov = text[text.index("<xfov") : text.index("</xfov>") + len("</xfov>")]
    high = np.tan(np.radians(30) / 2)
    only = resolved(text.replace(xfov, "<yfov>30</yfov>").encode()).scene.camera
    assert only.window == pytest.approx((-high * 4 / 3, high * 4 / 3, -high, high))
    both = resolved(text.replace(xfov, f"{xfov}<yfov>30</yfov>").encode()).scene.camera
    wide = np.tan(np.radians(20))
    assert both.window == pytest.approx((-wide, wide, -high, high))


def test_the_scale_of_a_camera_changes_nothing_but_its_sign():
    def orientation(scale, handedness):
        scene = room(camera=False)
        scene.camera(placement=Placement((1, 2, 3), (10, 20, 30), scale))
        return resolved(scene, settings=replace(SETTINGS, handedness=handedness)).scene.camera.to_world

    straight = orientation((1, 1, 1), "blender")
    np.testing.assert_allclose(straight[:3, :3] @ straight[:3, :3].T, np.eye(3), atol=1e-12)
    np.testing.assert_allclose(orientation((2, 3, 4), "blender"), straight, atol=1e-7)
    flipped = straight @ np.diag([-1, 1, 1, 1])
    np.testing.assert_allclose(orientation((-1, 1, 1), "blender"), flipped, atol=1e-7)
    np.testing.assert_allclose(orientation((1, 1, 1), "rtb3"), flipped, atol=1e-7)
    np.testing.assert_allclose(orientation((-2, 1, 1), "rtb3"), straight, atol=1e-7)


def test_a_camera_is_chosen_by_its_id_or_its_nodes():
    builder = room()
    builder.camera("Second", xfov=20.0)
    for name in ("Second", "Second-camera"):
        assert resolved(builder, settings=replace(SETTINGS, camera=name)).scene.camera.id == "Second"
    assert resolved(builder).scene.camera.id == "Camera"
    with pytest.raises(RecipeError, match="no camera is called Secnd, there are Second, Camera"):
        resolved(builder, settings=replace(SETTINGS, camera="Secnd"))


def test_clip_distances_are_in_metres():
    builder = SceneBuilder(meter=0.01)
    builder.plane("Wall", material="Paint")
    builder.camera(clip=(10, 1000))
    builder.point("Lamp")
    assert resolved(builder).scene.camera.clip == pytest.approx((0.1, 10))
