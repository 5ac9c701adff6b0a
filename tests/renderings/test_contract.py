"""What every renderer does alike: progress, cancelling, noise, rendering until, and films."""

import time
from dataclasses import replace

import numpy as np
import pytest

from rtb_addon.errors import Cancelled
from rtb_addon.renderers.filters import FILTERS
from rtb_addon.renderers.interface import RenderOptions
from rtb_addon.scene.render_scene import Camera, Crop, Shape
from rtb_addon.spectra import Bands, Spectrum
from tests.renderings.every_renderer import no_process_stays, renderer
from tests.renderings.film_scenes import edge_spread, half_plane, lit_floor
from tests.renderings.mitsuba_scenes import FLOOR, INTENSITY, at, globe, lamp, scene, square

__all__ = ["no_process_stays", "renderer"]  # fixtures

THREE = Bands.regular(420, 120, 3)
VIEW = Camera("Camera", "perspective", at(0, 0, 4), (-0.5, 0.5, -0.5, 0.5))
SHAPES = (
    FLOOR,
    Shape("Globe", globe(0.7, 12), at(0.4, 0.2, 0.7), "paint"),
    Shape("Panel", square(0.5), at(1.5, -0.5, 3, np.diag([1.0, -1.0, -1.0, 1.0])), "soot", INTENSITY),
)
# Both go up and down twice in each band, together: the mean of the product is more than that of the means.
KNOTS = np.arange(400.0, 481.0, 5.0)
SPIKY = Spectrum(KNOTS, np.where(np.arange(len(KNOTS)) % 2, 0.9, 0.1))
SPIKY_LIGHT = Spectrum(KNOTS, np.where(np.arange(len(KNOTS)) % 2, 3.0, 1.0))
WIDE = Bands.regular(410, 20, 4)


def noisy(renderer, folder, options, name="scene", report=lambda fraction: None, **changes):
    """Return a picture of a globe that a lamp without a mesh and one of a mesh light."""
    facts = {"camera": VIEW, "size": (10, 10), "depth": 4, "bands": THREE, "samples": 64, **changes}
    native = renderer.translate(scene((), SHAPES, **facts), (), folder, name)
    return renderer.render(native, options, report)


def shown(renderer, one, folder, name="scene"):
    """Return a picture with its standard errors."""
    native = renderer.translate(one, (), folder, name)
    return renderer.render(native, RenderOptions(errors=True), lambda fraction: None)


class TestEveryRenderer:
    """One contract, and each renderer that keeps it."""

    def test_progress_rises_to_one_and_a_raised_cancel_stops(self, renderer, tmp_path):
        heard = []
        size = {"size": (200, 150), "samples": 64}
        noisy(renderer, tmp_path, RenderOptions(), report=heard.append, **size)
        assert heard == sorted(heard)
        assert heard[-1] == 1.0
        assert len(heard) >= 4
        told = []

        def stop(fraction):
            told.append(fraction)
            if fraction > 0.3:
                raise Cancelled

        with pytest.raises(Cancelled):
            noisy(renderer, tmp_path, RenderOptions(), report=stop, **size)
        assert told[-1] < 0.8

    def test_with_two_threads_a_picture_is_the_same(self, renderer, tmp_path):
        one, two = (
            noisy(renderer, tmp_path, RenderOptions(threads, errors=True), size=(60, 40))
            for threads in (1, 2)
        )
        floor = 1e-6 * one.radiance.mean()
        np.testing.assert_allclose(two.radiance, one.radiance, rtol=1e-6, atol=floor)
        np.testing.assert_allclose(two.standard_error, one.standard_error, rtol=1e-4, atol=floor)

    def test_the_standard_error_is_the_spread_over_many_seeds(self, renderer, tmp_path):
        images = [noisy(renderer, tmp_path, RenderOptions(errors=True), seed=seed) for seed in range(40)]
        radiance = np.stack([image.radiance for image in images]).astype(float)
        said = np.stack([image.standard_error for image in images]).astype(float) ** 2
        # Bands share their paths, pixels do not.
        away = (said.mean(axis=0) - radiance.var(axis=0, ddof=1)).mean(axis=2).ravel()
        assert abs(away.mean()) < 4 * away.std(ddof=1) / np.sqrt(len(away))
        # Nor is that for want of knowing better.
        assert away.std(ddof=1) / np.sqrt(len(away)) < 0.1 * said.mean()

    def test_the_relative_noise_is_the_root_mean_square_error_over_the_mean(self, renderer, tmp_path):
        image = noisy(renderer, tmp_path, RenderOptions(errors=True))
        error, radiance = image.standard_error.astype(float), image.radiance.astype(float)
        assert float(image.attributes["noise"]) == pytest.approx(
            np.sqrt(np.mean(error**2)) / radiance.mean(), rel=6e-3
        )
        assert image.standard_error.shape == image.radiance.shape
        assert noisy(renderer, tmp_path, RenderOptions()).standard_error is None

    def test_rendering_until_the_noise_is_low_takes_no_more_than_that(self, renderer, tmp_path):
        taken = {}
        for error in (0.02, 0.01):
            image = noisy(renderer, tmp_path, RenderOptions(error=error), samples=100_000)
            assert float(image.attributes["noise"]) <= error
            taken[error] = int(image.attributes["samples"])
        # Half the noise takes four times the paths, up to a round of 64.
        assert 2.5 * taken[0.02] - 64 < taken[0.01] < 6 * taken[0.02] + 64
        assert taken[0.01] < 50_000
        rough = noisy(renderer, tmp_path, RenderOptions(error=1e-9), samples=128)
        # Four rounds of 32 samples, or of 35, which jitter spreads over 5 x 7 strata.
        assert rough.attributes["samples"] in ("128", "140")
        assert float(rough.attributes["noise"]) > 1e-9

    def test_the_samples_that_until_took_are_those_of_any_process(self, renderer, tmp_path):
        first, again = (
            noisy(renderer, tmp_path, RenderOptions(error=0.05), samples=10_000) for _ in range(2)
        )
        assert np.array_equal(first.radiance, again.radiance)
        assert np.array_equal(first.standard_error, again.standard_error)

    def test_rendering_ends_when_its_seconds_are_over(self, renderer, tmp_path):
        noisy(renderer, tmp_path, RenderOptions(seconds=0.01), samples=64)
        seen = []
        began = time.monotonic()
        image = noisy(renderer, tmp_path, RenderOptions(seconds=0.5), samples=10**7, report=seen.append)
        passed = time.monotonic() - began
        # A round of sixteen samples takes a few thousandths of a second on an idle machine.
        assert 0.5 < passed < 5
        assert 32 <= int(image.attributes["samples"]) < 10**7
        assert seen == sorted(seen)
        assert seen[-1] == 1

    def test_a_rendering_by_the_clock_can_be_cancelled(self, renderer, tmp_path):
        def cancel(fraction):
            if fraction > 0.1:
                raise Cancelled

        with pytest.raises(Cancelled):
            noisy(renderer, tmp_path, RenderOptions(seconds=2.0), samples=10**7, report=cancel)

    @pytest.mark.parametrize("samples", [1, 2, 3])
    def test_few_samples_still_tell_an_error(self, renderer, tmp_path, samples):
        image = noisy(renderer, tmp_path, RenderOptions(errors=True), samples=samples)
        assert int(image.attributes["samples"]) >= 2
        assert np.isfinite(image.standard_error).all()
        assert image.standard_error.any()

    def test_roulette_changes_the_noise_alone_and_does_not_look_at_the_spectra(self, renderer, tmp_path):
        deep = {"depth": 10, "samples": 1024, "size": (6, 6)}
        grey = Spectrum.of([300, 500, 501, 900], [0.8, 0.8, 0.8, 0.8])
        other = Spectrum.of([300, 500, 501, 900], [0.8, 0.8, 0.1, 0.1])
        options = RenderOptions(errors=True)

        def with_roulette(name, roulette, paint):
            one = scene((), SHAPES, camera=VIEW, bands=THREE, reflectance=paint, **deep)
            one = replace(one, integrator=replace(one.integrator, roulette=roulette))
            return renderer.render(renderer.translate(one, (), tmp_path, name), options, lambda f: None)

        never, ended = with_roulette("never", 0, grey), with_roulette("ended", 3, grey)
        assert not np.array_equal(never.radiance, ended.radiance)
        error = np.hypot(never.standard_error, ended.standard_error)
        z = ((never.radiance - ended.radiance) / error)[:, :, 0]
        assert abs(z.mean()) < 4.5 / np.sqrt(z.size) * 1.2
        # The first band sees the same paths whatever the others hold.
        assert np.array_equal(with_roulette("other", 3, other).radiance[:, :, 0], ended.radiance[:, :, 0])

    @pytest.mark.parametrize("name", FILTERS)
    def test_an_edge_is_spread_as_the_filters_integral(self, renderer, tmp_path, name):
        image = shown(renderer, half_plane(name), tmp_path)
        rows = image.radiance[:, :, 0].astype(float)
        error = np.sqrt((image.standard_error[:, :, 0].astype(float) ** 2).mean(axis=0) / len(rows))
        away = rows.mean(axis=0) - 2 * edge_spread(name)
        # Eight rows of sixteen rounds each tell their error to a sixteenth, but not where of the 8192 paths
        # of a column hardly one meets the edge: five may come where none was seen.
        assert (np.abs(away) <= 4.5 * 1.2 * error + 2 * 5 / 8192).all(), away
        # A tolerance that noise has blown up would prove nothing.
        assert error.max() < 0.02

    def test_a_crop_is_that_part_of_the_whole_picture(self, renderer, tmp_path):
        part = Crop(13, 4, 8, 6)
        whole, cut = (
            shown(renderer, lit_floor(), tmp_path, "whole"),
            shown(renderer, lit_floor(crop=part), tmp_path, "cut"),
        )
        assert cut.radiance.shape == (6, 8, 3)
        there = np.s_[part.top : part.top + part.height, part.left : part.left + part.width]
        error = np.hypot(whole.standard_error[there], cut.standard_error)
        away = np.abs(cut.radiance - whole.radiance[there])
        assert (away < 6 * error + 1e-6).all()
        # Its neighbours are another part.
        beside = whole.radiance[part.top : part.top + part.height, part.left + 1 : part.left + part.width + 1]
        assert np.median(np.abs(cut.radiance - beside) / error) > 10

    def test_the_mean_of_a_band_is_that_of_the_product_of_spectra(self, renderer, tmp_path):
        # A hundred paths take each tenth of a band ten times.
        one = scene([lamp("point", radius=0.0, intensity=SPIKY_LIGHT)], reflectance=SPIKY, samples=100)
        one = replace(one, film=replace(one.film, bands=WIDE, band_kind="mean"))
        native = renderer.translate(one, (), tmp_path, "scene")
        image = renderer.render(native, RenderOptions(), lambda fraction: None)
        assert image.band_kind == "mean"
        found = image.radiance.mean(axis=(0, 1), dtype=float) * 9 * np.pi
        # The product of lines from 0.1 to 0.9 and from 1 to 3 has the mean (2 a c + a d + b c + 2 b d) / 6.
        truth = (2 * 0.1 * 1 + 0.1 * 3 + 0.9 * 1 + 2 * 0.9 * 3) / 6
        # Within a tenth of a band, 2 nm, lines rise by so much; a knot in its middle takes half of that away.
        rise = (0.8 / 5 * 2) * (2.0 / 5 * 2) / 12
        assert (found < truth + 1e-5).all()
        assert (found > truth - rise - 1e-5).all()
        averaged = replace(one, film=replace(one.film, band_kind="averaged"))
        native = renderer.translate(averaged, (), tmp_path, "averaged")
        of_means = renderer.render(native, RenderOptions(), lambda fraction: None).radiance * 9 * np.pi
        # Paths start as much above the floor, 50 m wide, as single precision wants: 5e-5 m of 3 m.
        np.testing.assert_allclose(of_means, 0.5 * 2.0, rtol=4e-5)
        assert (truth - of_means > 6 * rise).all()

    def test_any_number_of_samples_gives_the_mean_of_a_band_without_a_bias(self, renderer, tmp_path):
        # Seven paths cannot take ten parts evenly, but many pixels can.
        one = scene(
            [lamp("point", radius=0.0, intensity=SPIKY_LIGHT)], reflectance=SPIKY, samples=7, size=(64, 64)
        )
        one = replace(one, film=replace(one.film, bands=WIDE, band_kind="mean"))
        native = renderer.translate(one, (), tmp_path, "scene")
        pixels = renderer.render(native, RenderOptions(), lambda fraction: None).radiance.reshape(-1, 4)
        parts = [
            spectrum.in_bands(Bands.regular(401, 2, 40)).reshape(4, 10) for spectrum in (SPIKY, SPIKY_LIGHT)
        ]
        expected = (parts[0] * parts[1]).mean(axis=1) / (9 * np.pi)
        error = pixels.std(axis=0, ddof=1) / np.sqrt(len(pixels))
        assert (np.abs(pixels.mean(axis=0, dtype=float) - expected) < 4.5 * error + 1e-5).all()
        assert (error < 0.01 * expected).all()
