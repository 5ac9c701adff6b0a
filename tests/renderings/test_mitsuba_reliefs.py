"""Bumps and normal maps: slopes that a pencil can check, and what is refused."""

from dataclasses import replace

import numpy as np
import pytest
from PIL import Image

from rtb_addon.errors import RecipeError
from rtb_addon.exr import write_exr
from rtb_addon.renderers.mitsuba import renderer
from rtb_addon.scene.render_scene import Camera, Material, Texture
from rtb_addon.spectra import Spectrum
from tests.renderings.mitsuba_scenes import BANDS, REFLECTANCE, at, lamp, picture
from tests.renderings.test_mitsuba_textures import bitmap, sheet

PAINTED = REFLECTANCE.in_bands(BANDS)
# Towards the sun: up, and to the right and up in the picture.
TOWARDS = np.array([0.4, 0.25, 0.9]) / np.linalg.norm([0.4, 0.25, 0.9])


def sun(towards=TOWARDS):
    """Return a sun in a direction, so strong that paint that faces it shows its reflectance."""
    across = np.cross([0, 1.0, 0], towards)
    turn = np.eye(4)
    turn[:3, :3] = np.stack([across, np.cross(towards, across), towards], axis=1)
    return lamp("directional", turn, Spectrum.constant(np.pi), angle=0.0)


def relief(model, path, size=(4, 4), window=(-0.4, 0.4, -0.4, 0.4), inner=None, **parameters):
    """Return a sheet two metres wide under the sun, seen from above, with a picture's relief."""
    one = sheet(bitmap(path), size=size, window=window)
    paint = inner or Material("inner", "matte", {"diffuseReflectance": REFLECTANCE})
    said = {"materialID": "inner", "textureID": "texture", **parameters}
    materials = {**one.materials, "inner": paint, "paint": Material("paint", model, said)}
    return replace(one, materials=materials, lights=(sun(),))


def facing(normal, towards=TOWARDS):
    """
    Return the cosine of what leans to the light, times the share that the leaning's own shadows leave.

    Estevez, Lecocq and Stein, A Microfacet-Based Shadowing Function, Ray Tracing Gems 2019.
    """
    normal = np.array(normal) / np.linalg.norm(normal)
    slope, low = (1 / np.square(way[2]) - 1 for way in (normal, towards))
    return (towards @ normal) * 2 / (1 + np.sqrt(1 + min(slope / 8, 1) * low))


def ramp(path, right, up, size=(16, 32)):
    """Write heights that rise by so many metres over the width and the height of the picture."""
    height, width = size
    u, v = np.meshgrid((np.arange(width) + 0.5) / width, 1 - (np.arange(height) + 0.5) / height)
    plane = (right * u + up * v - 0.3).astype(np.float32)
    # The mean of the channels counts.
    write_exr(path, {}, {"R": plane - 0.1, "G": plane + 0.3, "B": plane - 0.2})
    return path


@pytest.mark.parametrize(("right", "up"), [(0.6, 0.0), (0.0, 0.8), (-0.5, 0.3)])
@pytest.mark.parametrize("scale", [1.0, 0.5, -1.0])
def test_a_ramp_of_heights_in_metres_tilts_the_surface_as_a_slope_would(tmp_path, right, up, scale):
    path = ramp(tmp_path / "ramp.exr", right, up)
    # The sheet is two metres wide and high.
    normal = np.array([-scale * right / 2, -scale * up / 2, 1])
    expected = PAINTED * facing(normal)
    image = picture(relief("bumpmap", path, scale=scale), tmp_path).radiance
    np.testing.assert_allclose(image, np.broadcast_to(expected, image.shape), rtol=1e-4)


def test_heights_repeat_and_are_moved_as_the_picture_is(tmp_path):
    path = ramp(tmp_path / "ramp.exr", 0.6, 0.0)
    one = relief("bumpmap", path, scale=1.0)
    doubled = bitmap(path, scaleU=2.0, offsetU=0.25)
    # Twice as often, twice as steep.
    normal = np.array([-0.6, 0, 1])
    near = replace(one, textures={"texture": doubled}, camera=looking(-0.1, 0.1))
    image = picture(near, tmp_path).radiance
    expected = PAINTED * facing(normal)
    np.testing.assert_allclose(image, np.broadcast_to(expected, image.shape), rtol=1e-4)


def looking(low, high):
    return Camera("Camera", "orthographic", at(0, 0, 2), (low, high, low, high))


LEAN = np.array([0.36, -0.48, 0.8])


def leaning(path, normal=LEAN):
    planes = {name: np.full((3, 5), (x + 1) / 2, np.float32) for name, x in zip("RGB", normal, strict=True)}
    write_exr(path, {}, planes)
    return path


def test_a_normal_map_leans_the_normal_to_the_right_and_up(tmp_path):
    image = picture(relief("normalmap", leaning(tmp_path / "lean.exr")), tmp_path).radiance
    expected = PAINTED * facing(LEAN)
    np.testing.assert_allclose(image, np.broadcast_to(expected, image.shape), rtol=1e-4)


def test_a_normal_map_of_eight_bits_stands_upright(tmp_path):
    left, right = (np.round((n + 1) / 2 * 255) for n in (LEAN, LEAN * [-1, 1, 1]))
    texels = np.array([[left, right], [right, left]], np.uint8)
    Image.fromarray(texels).save(tmp_path / "lean.png")
    # Four tiny windows about the middles of the texels.
    for row, v in enumerate((0.5, -0.5)):
        for column, u in enumerate((-0.5, 0.5)):
            one = relief("normalmap", tmp_path / "lean.png", size=(1, 1))
            camera = Camera("Camera", "orthographic", at(u, v, 2), (-1e-3, 1e-3, -1e-3, 1e-3))
            normal = texels[row, column] / 255.0 * 2 - 1
            expected = PAINTED * facing(normal)
            found = picture(replace(one, camera=camera), tmp_path).radiance[0, 0]
            np.testing.assert_allclose(found, expected, rtol=5e-3)


def test_a_mirror_with_a_normal_map_shows_another_part_of_the_sky(tmp_path):
    # A sky that is bright where X is above 0.
    texels = np.zeros((4, 64), np.float32)
    texels[:, 16:48] = 1
    write_exr(tmp_path / "sky.exr", {}, {"T.500,000000nm": texels, "T.600,000000nm": texels})
    sky = lamp("environment", np.eye(4), Spectrum.constant(1.0), filename=str(tmp_path / "sky.exr"))
    glossy = Material("inner", "mirror", {"specularReflectance": REFLECTANCE})
    for side, seen in ((1, 1.0), (-1, 0.0)):
        normal = np.array([side * 0.6, 0.0, 0.8])
        one = relief("normalmap", leaning(tmp_path / "lean.exr", normal), inner=glossy)
        image = picture(replace(one, lights=(), environment=sky), tmp_path).radiance
        mirrored = 2 * normal[2] * normal - [0, 0, 1]
        expected = seen * PAINTED * facing(normal, mirrored) / (mirrored @ normal)
        np.testing.assert_allclose(image, np.broadcast_to(expected, image.shape), rtol=1e-4)


def test_a_height_of_checks_and_a_normal_map_of_spectra_are_refused(tmp_path):
    one = relief("bumpmap", tmp_path / "none.exr", scale=1.0)
    colours = {"evenColor": REFLECTANCE, "oddColor": REFLECTANCE}
    board = Texture("texture", "checkerboard", {"checksPerU": 2.0, "checksPerV": 2.0, **colours})
    with pytest.raises(RecipeError, match="texture is a checkerboard, whose edges have no slope"):
        renderer().translate(replace(one, textures={"texture": board}), (), tmp_path, "board")
    write_exr(
        tmp_path / "two.exr", {}, {f"T.{nm},000000nm": np.ones((2, 2), np.float32) for nm in (500, 600)}
    )
    with pytest.raises(RecipeError, match="texture has 2 channels, give a picture of colours"):
        renderer().translate(relief("normalmap", tmp_path / "two.exr"), (), tmp_path, "two")


def test_bumps_on_a_mesh_without_coordinates_are_refused(tmp_path):
    one = relief("bumpmap", ramp(tmp_path / "ramp.exr", 1, 0), scale=1.0)
    bare = replace(one.shapes[0].mesh, uvs=None)
    with pytest.raises(RecipeError, match="no texture coordinates"):
        picture(replace(one, shapes=(replace(one.shapes[0], mesh=bare),)), tmp_path)
