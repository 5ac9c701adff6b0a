"""Mitsuba's word on its own noise, and renderings that end when it is low or the time is over."""

import time
from dataclasses import replace

import numpy as np
import pytest

from rtb_addon.errors import Cancelled, RenderingError
from rtb_addon.renderers.interface import RenderOptions
from rtb_addon.renderers.mitsuba import llvm, renderer, session
from rtb_addon.scene.render_scene import Camera, Shape
from rtb_addon.spectra import Bands, Spectrum
from tests.renderings.mitsuba_scenes import (
    FLOOR,
    INTENSITY,
    REFLECTANCE,
    at,
    globe,
    lamp,
    scene,
    square,
)

BANDS = Bands.regular(420, 120, 3)
VIEW = Camera("Camera", "perspective", at(0, 0, 4), (-0.5, 0.5, -0.5, 0.5))
SHAPES = (
    FLOOR,
    Shape("Globe", globe(0.7, 12), at(0.4, 0.2, 0.7), "paint"),
    Shape("Panel", square(0.5), at(1.5, -0.5, 3, np.diag([1.0, -1.0, -1.0, 1.0])), "soot", INTENSITY),
)


def picture(folder, options, name="scene", report=lambda fraction: None, **changes):
    facts = {"camera": VIEW, "size": (10, 10), "depth": 4, "bands": BANDS, "samples": 64, **changes}
    native = renderer().translate(scene((), SHAPES, **facts), (), folder, name)
    return renderer().render(native, options, report)


def test_the_standard_error_is_the_spread_over_many_seeds(tmp_path):
    images = [picture(tmp_path, RenderOptions(errors=True), seed=seed) for seed in range(40)]
    radiance = np.stack([image.radiance for image in images]).astype(float)
    said = np.stack([image.standard_error for image in images]).astype(float) ** 2
    # Bands share their paths, pixels do not.
    away = (said.mean(axis=0) - radiance.var(axis=0, ddof=1)).mean(axis=2).ravel()
    assert abs(away.mean()) < 4 * away.std(ddof=1) / np.sqrt(len(away))
    # Nor is that for want of knowing better.
    assert away.std(ddof=1) / np.sqrt(len(away)) < 0.1 * said.mean()


def test_the_relative_noise_is_the_root_mean_square_error_over_the_mean(tmp_path):
    image = picture(tmp_path, RenderOptions(errors=True))
    error, radiance = image.standard_error.astype(float), image.radiance.astype(float)
    assert float(image.attributes["noise"]) == pytest.approx(
        np.sqrt(np.mean(error**2)) / radiance.mean(), rel=6e-3
    )
    assert image.standard_error.shape == image.radiance.shape
    assert picture(tmp_path, RenderOptions()).standard_error is None


def test_rendering_until_the_noise_is_low_takes_no_more_than_that(tmp_path):
    taken = {}
    for error in (0.02, 0.01):
        image = picture(tmp_path, RenderOptions(error=error), samples=100_000)
        assert float(image.attributes["noise"]) <= error
        taken[error] = int(image.attributes["samples"])
    # Half the noise takes four times the paths, up to a round of 64.
    assert 2.5 * taken[0.02] - 64 < taken[0.01] < 6 * taken[0.02] + 64
    assert taken[0.01] < 50_000
    rough = picture(tmp_path, RenderOptions(error=1e-9), samples=128)
    # Four rounds of 32 samples, which jitter spreads over 5 x 7 strata.
    assert rough.attributes["samples"] == "140"
    assert float(rough.attributes["noise"]) > 1e-9


def test_the_samples_that_until_took_are_those_of_any_process(tmp_path):
    first, again = (picture(tmp_path, RenderOptions(error=0.05), samples=10_000) for _ in range(2))
    assert np.array_equal(first.radiance, again.radiance)
    assert np.array_equal(first.standard_error, again.standard_error)


def test_rendering_ends_when_its_seconds_are_over(tmp_path):
    picture(tmp_path, RenderOptions(seconds=0.01), samples=64)
    seen = []
    began = time.monotonic()
    image = picture(tmp_path, RenderOptions(seconds=0.5), samples=10**7, report=seen.append)
    passed = time.monotonic() - began
    # A round of sixteen samples takes a few thousandths of a second on an idle machine.
    assert 0.5 < passed < 5
    assert 32 <= int(image.attributes["samples"]) < 10**7
    assert seen == sorted(seen)
    assert seen[-1] == 1


def test_a_rendering_by_the_clock_can_be_cancelled(tmp_path):
    def cancel(fraction):
        if fraction > 0.1:
            raise Cancelled

    with pytest.raises(Cancelled):
        picture(tmp_path, RenderOptions(seconds=2.0), samples=10**7, report=cancel)


@pytest.mark.parametrize("samples", [1, 2, 3])
def test_few_samples_still_tell_an_error(tmp_path, samples):
    image = picture(tmp_path, RenderOptions(errors=True), samples=samples)
    assert int(image.attributes["samples"]) >= 2
    assert np.isfinite(image.standard_error).all()
    assert image.standard_error.any()


def test_the_stock_film_tells_its_error_too(tmp_path, monkeypatch, caplog):
    monkeypatch.setattr(llvm, "prepare", lambda: None)
    image = picture(tmp_path, RenderOptions(errors=True), size=(4, 4))
    assert image.attributes["samples"] == "64"
    assert (image.standard_error > 0).any()
    assert "slowly" in caplog.text


def test_roulette_changes_the_noise_alone_and_does_not_look_at_the_spectra(tmp_path):
    deep = {"depth": 10, "samples": 1024, "size": (6, 6)}
    grey = Spectrum.of([300, 500, 501, 900], [0.8, 0.8, 0.8, 0.8])
    other = Spectrum.of([300, 500, 501, 900], [0.8, 0.8, 0.1, 0.1])
    options = RenderOptions(errors=True)

    def with_roulette(name, roulette, paint):
        one = scene((), SHAPES, camera=VIEW, bands=BANDS, reflectance=paint, **deep)
        one = replace(one, integrator=replace(one.integrator, roulette=roulette))
        return renderer().render(renderer().translate(one, (), tmp_path, name), options, lambda f: None)

    never, ended = with_roulette("never", 0, grey), with_roulette("ended", 3, grey)
    assert not np.array_equal(never.radiance, ended.radiance)
    error = np.hypot(never.standard_error, ended.standard_error)
    z = ((never.radiance - ended.radiance) / error)[:, :, 0]
    assert abs(z.mean()) < 4.5 / np.sqrt(z.size) * 1.2
    # The first band sees the same paths whatever the others hold.
    assert np.array_equal(with_roulette("other", 3, other).radiance[:, :, 0], ended.radiance[:, :, 0])


def test_without_a_graphics_card_asking_for_one_is_a_sentence(tmp_path, monkeypatch):
    session.start(session.FAST, 1)
    import drjit as dr

    monkeypatch.setattr(dr, "has_backend", lambda backend: backend != dr.JitBackend.CUDA)
    with pytest.raises(RenderingError, match=r"no NVIDIA graphics card here, render without gpu$"):
        picture(tmp_path, RenderOptions(gpu=True))


def test_what_a_renderings_time_went_into_is_said(tmp_path):
    facts = picture(
        tmp_path, RenderOptions(), reflectance=REFLECTANCE, environment=lamp("environment", filename="")
    ).attributes
    spans = [float(facts[f"seconds_{what}"]) for what in ("loading", "compiling", "rendering")]
    assert all(span >= 0 for span in spans)
    assert sum(spans) > 0
    assert int(facts["kernels"]) >= 1
    assert 0 <= int(facts["kernels_compiled"]) <= int(facts["kernels"])
