"""
The plugin picture: a texture of spectra for Mitsuba's spectral variants, the scalar one aside.

Mitsuba's own bitmap takes one or three channels, and makes spectra of colours by a rule of its own. The lobe
path does not use this plugin: it looks the bands of texels up itself (see pictures.py).
"""

from __future__ import annotations

from functools import cached_property
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

from ....spectra import Bands
from ...pictures import Picture, read_picture
from ..xml.textures import ALL_WRAPS


def picture_plugin(mi: ModuleType) -> Any:
    """
    Return the plugin's class for Mitsuba's present variant.

    Its parameters are filename, gamma, wrap_mode, filter_type, scale_u, scale_v, offset_u and offset_v; and
    band_centres, band_edges [nm] and band_kind, where it is to hold the values of bands at their centres.
    """
    import drjit as dr

    class PictureTexture(mi.Texture):
        def __init__(self, props):
            mi.Texture.__init__(self, props)
            resolved = mi.file_resolver().resolve(props["filename"])
            self.picture = read_picture(Path(str(resolved)), props.get("gamma", 1.0))
            if "band_centres" in props:
                self.picture = _in_bands(self.picture, props)
            self.size = self.picture.texels.shape
            self.average = float(self.picture.texels.mean())
            self.wavelengths = mi.Float(self.picture.wavelengths.astype(np.float32))
            self.wrap = ALL_WRAPS.index(props.get("wrap_mode", "repeat"))
            self.nearest = props.get("filter_type", "bilinear") == "nearest"
            place = [props.get(f"scale_{x}", 1.0) for x in "uv"] + [
                props.get(f"offset_{x}", 0.0) for x in "uv"
            ]
            self.place: Any = mi.Vector4f(*place)

        @cached_property
        def texels(self):
            # The lobe path never asks for them.
            return mi.Float(np.ravel(self.picture.texels).astype(np.float32))

        def eval(self, si, active=True):
            from ..picture_lookup import Layout, taps

            height, width, channels = self.size
            first, width, height, wrap, nearest = (
                mi.UInt32(number) for number in (0, width, height, self.wrap, int(self.nearest))
            )
            around = taps(Layout(first, width, height, wrap, nearest, self.place), si.uv)
            bands = [self.at(nm, around, channels, active) for nm in si.wavelengths]
            return mi.Spectrum(*bands)

        def at(self, nanometres, around, channels, active):
            """Return the mixture of texels at a wavelength [nm], between two of their channels."""
            last = channels - 1
            above = dr.binary_search(
                0, channels, lambda k: dr.gather(mi.Float, self.wavelengths, k, active) < nanometres
            )
            high = dr.minimum(above, last)
            low = dr.maximum(mi.UInt32(above), 1) - 1
            start, end = (dr.gather(mi.Float, self.wavelengths, k, active) for k in (low, high))
            share = dr.clip((nanometres - start) / dr.maximum(end - start, 1e-6), 0, 1)
            total = mi.Float(0)
            for texel, weight in around:
                first, second = (
                    dr.gather(mi.Float, self.texels, texel * channels + k, active) for k in (low, high)
                )
                total += weight * dr.lerp(first, second, share)
            return total

        def mean(self):
            return mi.Float(self.average)

        def is_spatially_varying(self):
            return True

        def to_string(self):
            return f"Picture[{self.size}]"

    return PictureTexture


def _in_bands(picture: Picture, props: Any) -> Picture:
    """Return a picture with a channel for each band."""
    centres, edges = (np.array(props[f"band_{name}"].split(), float) for name in ("centres", "edges"))
    weights = picture.weights(Bands(centres, edges), props["band_kind"]).astype(np.float32)
    return Picture(picture.texels @ weights, centres, measured=True)
