"""
The plugin skypicture: a picture of spectra around the scene, seen in Blender's equirectangular way.

Mitsuba's own envmap takes three channels, makes spectra of them by a rule of its own that brings D65 with it,
and has its first and last rows at the poles, not half a texel away from them.
"""

from __future__ import annotations

from types import ModuleType
from typing import Any

import numpy as np


def sky_plugin(mi: ModuleType) -> Any:
    """
    Return the plugin's class for Mitsuba's present variant.

    Its parameters are to_world, intensity, the picture (see picture.py) that multiplies it, and even:
    then directions are drawn as the picture says, but the radiance is the intensity alone.
    """
    import drjit as dr

    from ..sky_sampling import SkySampling, axes_of, uv_of

    class SkyPicture(mi.Emitter):
        def __init__(self, props):
            mi.Emitter.__init__(self, props)
            self.picture, self.intensity = props["picture"], props["intensity"]
            self.even = props.get("even", False)
            self.sampling = SkySampling(self.picture.picture.texels.mean(axis=2))
            self.axes = axes_of(np.array(props["to_world"].matrix)[:3, :3])
            self.reach = dr.opaque(mi.Float, 1.0)
            self.m_flags = mi.EmitterFlags.Infinite | mi.EmitterFlags.SpatiallyVarying

        def set_scene(self, scene):
            if scene.bbox().valid():
                radius = scene.bbox().bounding_sphere().radius
                # Behind everything, seen from anywhere inside.
                self.reach = dr.opaque(mi.Float, 2.2 * max(float(np.ravel(radius)[0]), 1e-3))

        def local(self, direction):
            return mi.Vector3f(*(dr.dot(axis, direction) for axis in self.axes))

        def world(self, local):
            x, y, z = self.axes
            return x * local.x + y * local.y + z * local.z

        def eval(self, si, active=True):
            return self.radiance(si, -si.wi, active)

        def radiance(self, si, direction, active):
            if self.even:
                return self.intensity.eval(si, active) & active
            there = mi.SurfaceInteraction3f(si)
            there.uv = uv_of(self.local(direction))
            return (self.picture.eval(there, active) * self.intensity.eval(there, active)) & active

        def sample_direction(self, it, sample, active=True):
            local, density = self.sampling.sample(sample)
            found = dr.zeros(mi.DirectionSample3f)
            found.d = self.world(local)
            found.dist = self.reach
            found.p = it.p + found.d * found.dist
            found.n = -found.d
            found.time, found.pdf = it.time, density
            found.emitter = mi.EmitterPtr(self)
            weight = self.eval_direction(it, found, active) / dr.maximum(density, 1e-30)
            return found, dr.select(active & (density > 0), weight, 0)

        def pdf_direction(self, it, ds, active=True):
            return dr.select(active, self.sampling.density(self.local(ds.d)), 0)

        def eval_direction(self, it, ds, active=True):
            si = dr.zeros(mi.SurfaceInteraction3f)
            si.wavelengths, si.wi = it.wavelengths, -ds.d
            return self.radiance(si, ds.d, active)

        def bbox(self):
            return mi.ScalarBoundingBox3f()

        def to_string(self):
            return f"SkyPicture[{self.picture}]"

    return SkyPicture
