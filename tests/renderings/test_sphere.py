"""The analytic sphere: RenderToolbox3's stored slice, and the other renderers beside it."""

import csv
import os
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy import ndimage

from rtb_addon.errors import RecipeError
from rtb_addon.renderers import find
from rtb_addon.renderers.interface import RenderOptions
from rtb_addon.scene.render_scene import Camera, Film, Integrator, Light, Material, RenderScene, Shape
from rtb_addon.spectra import Bands, Spectrum, Unit, library
from rtb_addon.spectra.files import read_spd
from tests.renderings.tracer_scenes import GREY, SQUARE, ball, cube, lamp, matrix, matte, polygon, sky, ward

RADIUS, LIGHT, ALPHA = 100.0, np.array([1000.0, 1000.0, 1000.0]), 0.05
ROOT = Path(__file__).parents[2]
RTB3 = Path(os.environ.get("RTB3_FOLDER", ROOT.parent / "shared" / "rtb3"))
D65 = library.find("D65")
# Patch 2 of RenderToolbox3's chart.
ORANGE = Spectrum.of([450, 520, 550, 600, 650], [0.05432, 0.12251, 0.20001, 0.58268, 0.57883])


def simple_sphere(variant="ward", size=201, rings=24, paint=ORANGE, light=D65, samples=1):
    """Return RenderToolbox3's SimpleSphere in metres: one pixel sees one square metre."""
    daylight = replace(light, unit=Unit.INTENSITY)
    return RenderScene(
        Camera("Camera", "orthographic", matrix((0, 0, 1000)), (-100.5, 100.5, -100.5, 100.5)),
        (Shape("Sphere", ball(RADIUS, rings), matrix(), "gloss"),),
        {"gloss": ward("gloss", paint, 0.07, ALPHA, variant=variant)},
        (Light("Lamp", "point", matrix(LIGHT), {"intensity": daylight, "radius": 0.0}),),
        integrator=Integrator("direct", 2, samples),
        film=Film(size, size, Bands.around([450, 520, 540, 550, 600, 650]), "centre"),
    )


def picture(name, scene, folder):
    renderer = find(name)
    native = renderer.translate(scene, (), folder / name, "scene")
    return renderer.render(native, RenderOptions(), lambda fraction: None).radiance.astype(float)


def squared_distances():
    """
    Return d^2 of the points that the pixels see to the light, NaN beside the sphere.

    SphereRendererToolbox, which made the stored slice, gives every point the same light:
    out = I [kd / pi cos + ks sqrt(cos_i / cos_r) exp(-(tan / alpha)^2) / (4 pi alpha^2)]. A point lamp's
    irradiance is I cos_i / d^2, and sqrt(cos_i / cos_r) = cos_i / sqrt(cos_i cos_r), as in Ward's
    formula: so its numbers are our radiance times d^2.
    """
    column, row = np.meshgrid(np.arange(201), np.arange(201))
    x, y = column - 100.0, 100.0 - row
    with np.errstate(invalid="ignore"):
        z = np.sqrt(RADIUS**2 - x**2 - y**2)
    return sum((a - b) ** 2 for a, b in zip((x, y, z), LIGHT, strict=True))


@pytest.fixture(scope="module")
def analytic(tmp_path_factory):
    return picture("sphere", simple_sphere(), tmp_path_factory.mktemp("sphere"))


def test_the_sphere_reproduces_the_stored_slice(tmp_path):
    if not RTB3.exists():
        pytest.fail(f"{RTB3} is not there, set RTB3_FOLDER to RenderToolbox3's old recipes")
    with (RTB3 / "extracted" / "SimpleSphere-slices-column125-540nm.csv").open() as text:
        stored = np.array([float(row["Reference"]) for row in csv.DictReader(text)])
    paint = read_spd(RTB3 / "RenderData" / "Macbeth-ColorChecker" / "mccBabel-2.spd")
    light = read_spd(RTB3 / "RenderData" / "D65.spd")
    exact = picture("sphere", simple_sphere(paint=paint, light=light), tmp_path)
    ours = np.nan_to_num((exact[..., 2] * squared_distances())[:, 124])
    np.testing.assert_allclose(ours / ours.max(), stored, atol=1e-6)


def test_the_centre_and_the_highlight_have_their_radiances(analytic):
    nanometres = [0, 1, 3, 4, 5]
    centre = [3.86524e-7, 7.80766e-7, 1.26569e-6, 3.18971e-6, 2.81733e-6]
    peak = [9.55523e-5, 8.63134e-5, 8.65390e-5, 7.84292e-5, 6.97013e-5]
    np.testing.assert_allclose(analytic[100, 100, nanometres], centre, rtol=1e-4)
    np.testing.assert_allclose(analytic[67, 133, nanometres], peak, rtol=1e-4)
    assert np.unravel_index(analytic[..., 1].argmax(), (201, 201)) == (67, 133)
    assert (analytic[..., 1] > 0).sum() == 23_798


@pytest.mark.parametrize("name", ["tracer", "mitsuba"])
@pytest.mark.parametrize("variant", ["ward", "ward-duer", "balanced"])
def test_renderers_of_triangles_see_the_same_sphere(name, variant, tmp_path):
    """Away from rim and shadow within 1e-3 of the brightest: what is left is the facets of the mesh."""
    exact = picture("sphere", simple_sphere(variant), tmp_path)[..., 1]
    # Sixteen samples of a pixel see more than its middle: the mean of the pixels beside it belongs to it too.
    traced = picture(name, simple_sphere(variant, rings=200, samples=16), tmp_path)[..., 1]
    column, row = np.meshgrid(np.arange(201) - 100, 100 - np.arange(201))
    inner = column**2 + row**2 < 80**2
    diffuse = inner & (exact > 0) & ((column - 33) ** 2 + (row - 33) ** 2 > 25**2)
    assert np.abs(traced - exact)[diffuse].max() < 1e-3 * exact.max()
    highlight = (column - 33) ** 2 + (row - 33) ** 2 < 15**2
    assert abs(traced[highlight].mean() / exact[highlight].mean() - 1) < 0.01


def test_difference_pictures_show_the_edge_and_the_highlight_alone(tmp_path):
    """As in figure 3 of RenderToolbox3's paper, where pixels are no mere points for two of the three."""
    scene = simple_sphere(rings=200, samples=16)
    seen = {name: picture(name, scene, tmp_path)[..., 2] for name in ("sphere", "tracer", "mitsuba")}
    column, row = np.meshgrid(np.arange(201) - 100, 100 - np.arange(201))
    highlight = (column - 33) ** 2 + (row - 33) ** 2 < 25**2
    lit, brightest = seen["sphere"] > 0, seen["sphere"].max()
    edge = ndimage.binary_dilation(lit, iterations=2) & ~ndimage.binary_erosion(lit, iterations=2)
    for one, other in (("sphere", "tracer"), ("sphere", "mitsuba"), ("tracer", "mitsuba")):
        away = np.abs(seen[one] - seen[other]) / brightest
        assert away[~edge & ~highlight].max() < 5e-5
        # At the edge up to the darkest of what is not the highlight; in it, what it changes within a pixel.
        assert away.max() < 0.012
    # Those that average over pixels differ less from each other than from the mere points.
    closed, sampled = (np.abs(seen[one] - seen["mitsuba"])[edge].sum() for one in ("sphere", "tracer"))
    assert sampled < 0.5 * closed


def test_two_spheres_shade_each_other(tmp_path):
    near = Shape("near", ball(0.3), matrix((0, 0, 1.5)), "grey")
    far = Shape("far", ball(1.0), matrix(), "grey")
    sun = lamp("point", matrix((0, 0.01, 900)), [1e6] * 4)
    side = Camera("c", "orthographic", matrix((0, 5, 0), (-1, 0, 0), (0, 0, 1), (0, 1, 0)), (-2, 2, -2, 2))
    one = RenderScene(
        side,
        (near, far),
        {"grey": matte("grey")},
        (sun,),
        integrator=Integrator("direct", 2, 1),
        film=Film(41, 41, Bands.regular(400, 100, 4)),
    )
    both, alone = (
        picture("sphere", scene, tmp_path / str(n))
        for n, scene in enumerate((one, replace(one, shapes=(far,))))
    )
    # From the side: the ball's top lies in the shadow of the small one, its flank does not.
    assert (alone[10, 20] > 0).all()
    assert not both[10, 20].any()
    np.testing.assert_array_equal(both[16, 32], alone[16, 32])


def test_a_sphere_is_found_wherever_it_stands(tmp_path):
    turned = matrix((3, -2, 1), (0, 2, 0), (0, 0, 2), (2, 0, 0))
    seen = [
        picture(
            "sphere",
            replace(
                simple_sphere(size=15),
                shapes=(shape,),
                camera=Camera("c", "orthographic", matrix((3, -2, 50)), (-3, 3, -3, 3)),
            ),
            tmp_path / shape.id,
        )
        for shape in (
            Shape("small", ball(1.0, 8), turned, "gloss"),
            Shape("fine", ball(2.0, 40), matrix((3, -2, 1)), "gloss"),
        )
    ]
    np.testing.assert_allclose(*seen, rtol=1e-5)
    assert seen[0].any()


GLOSS = ward("gloss", GREY)
HALF = polygon([(np.cos(a), np.sin(a), 0) for a in np.linspace(0, 2 * np.pi, 20, endpoint=False)])


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"shapes": (Shape("box", cube(), matrix(), "gloss"),)}, "shape box is no sphere"),
        ({"shapes": (Shape("disc", HALF, matrix(), "gloss"),)}, "shape disc is no sphere"),
        ({"shapes": (Shape("floor", SQUARE, matrix(), "gloss"),)}, "shape floor is no sphere"),
        (
            {"shapes": (Shape("egg", ball(), matrix((0, 0, 0), (2, 0, 0)), "gloss"),)},
            "shape egg is no sphere",
        ),
        (
            {"shapes": (Shape("glow", ball(), matrix(), "gloss", Spectrum.constant(1.0, Unit.RADIANCE)),)},
            "shape glow emits",
        ),
        ({"lights": (lamp("point", matrix(), radius=0.1),)}, "point lamp is a point light with a radius"),
        ({"lights": (lamp("spot", matrix()),)}, "spot lamp is spot"),
        ({"environment": sky()}, "the scene has an environment"),
        ({"camera": Camera("eye", "perspective", matrix(), (-1, 1, -1, 1))}, "camera eye is perspective"),
        ({"materials": {"gloss": Material("gloss", "mirror", {})}}, "material gloss is mirror"),
        ({"materials": {"gloss": ward("gloss", GREY, 0.1, 0.1, 0.2)}}, "material gloss is anisotropic"),
        (
            {
                "shapes": tuple(Shape(id, ball(), matrix(), "gloss") for id in "ab"),
                "integrator": Integrator("path", 5),
            },
            "several spheres light each other",
        ),
    ],
)
def test_what_has_no_closed_form_is_refused_in_a_sentence(tmp_path, change, sentence):
    with pytest.raises(RecipeError, match=sentence) as refused:
        find("sphere").translate(replace(simple_sphere(), **change), (), tmp_path, "scene")
    assert "the sphere renderer" in str(refused.value)
    assert not str(refused.value).endswith(".")
    assert not list(tmp_path.iterdir())
