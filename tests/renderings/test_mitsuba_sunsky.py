"""Sun and sky: what Mitsuba's own plugin shows, in the sky, on a plane and in shadows."""

from dataclasses import replace

import numpy as np
import pytest

from rtb_addon.errors import RecipeError
from rtb_addon.renderers.mitsuba import renderer, session
from rtb_addon.scene.render_scene import Light
from rtb_addon.spectra import Bands
from tests.renderings.mitsuba_scenes import FLOOR, REFLECTANCE, picture, scene
from tests.renderings.test_mitsuba_environments import towards

SUN = np.array([0.3, 0.1, 0.8]) / np.linalg.norm([0.3, 0.1, 0.8])
# Between the samples of the plugin's spectra.
BANDS = Bands.around([385.0, 465.0, 500.0, 590.0, 660.0, 700.0])


def sunsky(direction=SUN, turbidity=3.0):
    """Return the light whose +Z axis points to the sun."""
    across = np.cross([0, 1.0, 0], direction)
    turn = np.eye(4)
    turn[:3, :3] = np.stack([across, np.cross(direction, across), direction], axis=1)
    return Light("Sky", "sunsky", turn, {"turbidity": turbidity})


def stock(scene_of, samples, seeds):
    """Return pictures by stock Mitsuba's spectral film of what a function of mitsuba makes."""
    mi = session.start(session.FAST_BANDS, 1)
    loaded = mi.load_dict(scene_of(mi))
    return np.stack([np.array(mi.render(loaded, spp=samples, seed=seed)) for seed in seeds])


def table(low, high, values):
    words = ", ".join(map(str, values))
    return {"type": "regular", "wavelength_min": low, "wavelength_max": high, "values": words}


def film(size):
    bands = {f"b{k:02d}": table(c - 0.5, c + 0.5, [1, 1]) for k, c in enumerate(BANDS.centres.tolist())}
    shape = {"width": size, "height": size, "component_format": "float32", "rfilter": {"type": "box"}}
    return {"type": "specfilm", **shape, **bands}


def lit(one, tmp_path):
    return picture(replace(one, environment=sunsky()), tmp_path)


@pytest.mark.parametrize("direction", [(1, 0, 0.4), (-0.2, 0.9, 0.3), (0.5, -0.4, 0.9)])
def test_the_sky_has_the_radiance_of_mitsubas_own(tmp_path, direction):
    one = scene(shapes=(), camera=towards(direction), bands=BANDS, kind="centre", size=(1, 1))
    found = lit(one, tmp_path).radiance[0, 0]
    mi = session.start(session.FAST_BANDS, 1)
    import drjit as dr

    sky = mi.load_dict({"type": "sunsky", "turbidity": 3.0, "sun_direction": SUN.tolist()})
    mi.load_dict({"type": "scene", "sky": sky, "ball": {"type": "sphere"}})
    si = dr.zeros(mi.SurfaceInteraction3f)
    way = -np.array(direction) / np.linalg.norm(direction)
    si.wi = mi.Vector3f(*way.tolist())
    expected = []
    for start in (0, 2):
        si.wavelengths = mi.Spectrum(*BANDS.centres[start : start + 4].tolist())
        expected[start:] = np.array(sky.eval(si)).ravel().tolist()
    # Between texels lines are straight.
    np.testing.assert_allclose(found, expected, rtol=2e-3)


def test_a_plane_under_sun_and_sky_is_as_bright_as_under_mitsubas_own(tmp_path):
    one = scene(shapes=(FLOOR,), bands=BANDS, kind="centre", samples=256)
    ours = lit(one, tmp_path)

    def made(mi):
        paint = table(360.0, 830.0, REFLECTANCE.at(np.linspace(360, 830, 471)).tolist())
        wide = mi.ScalarTransform4f().scale(50.0)
        return {
            "type": "scene",
            "integrator": {"type": "path", "max_depth": 2},
            "sky": {"type": "sunsky", "turbidity": 3.0, "sun_direction": SUN.tolist()},
            "floor": {
                "type": "rectangle",
                "to_world": wide,
                "bsdf": {"type": "diffuse", "reflectance": paint},
            },
            "sensor": {
                "type": "perspective",
                "fov": 0.01,
                "to_world": mi.ScalarTransform4f().look_at([0, 0, 2], [0, 0, 0], [0, 1, 0]),
                "film": film(4),
                "sampler": {"type": "independent"},
            },
        }

    theirs = stock(made, 4096, range(6)).mean(axis=(1, 2))
    mean, error = theirs.mean(axis=0), theirs.std(axis=0, ddof=1) / np.sqrt(len(theirs))
    found = ours.radiance.mean(axis=(0, 1))
    noise = ours.radiance.std(axis=(0, 1)) / 4
    assert (error < 0.01 * mean).all()
    # Six seeds give a t distribution with long tails; a thousandth for the sky's texels.
    assert (np.abs(found - mean) < 7 * np.hypot(error, noise) + 1e-3 * mean).all(), found / mean


def test_a_sun_below_the_horizon_or_a_sky_of_mud_is_refused(tmp_path):
    for light, words in [
        (sunsky(np.array([0.6, 0.0, -0.8])), "below the horizon"),
        (sunsky(turbidity=20.0), "turbidity is 20, give 1 to 10"),
    ]:
        with pytest.raises(RecipeError, match=words):
            renderer().translate(replace(scene(), environment=light), (), tmp_path, "scene")
