"""Our path through Mitsuba: right against the stock film, repeatable, cancellable, never recompiled."""

import copy
import logging
from dataclasses import replace
from xml.etree import ElementTree as Xml

import numpy as np
import pytest

from rtb_addon.errors import Cancelled, RenderingError
from rtb_addon.renderers.interface import RenderOptions
from rtb_addon.renderers.mitsuba import llvm, renderer, session
from rtb_addon.renderers.mitsuba.native import read_native
from rtb_addon.renderers.mitsuba.one_hot import one_hot
from rtb_addon.renderers.mitsuba.xml.spectrum import element
from rtb_addon.scene.render_scene import Camera, Shape
from rtb_addon.spectra import Bands, Spectrum
from tests.renderings.mitsuba_scenes import (
    BANDS,
    FLOOR,
    FULL_TURN,
    INTENSITY,
    REFLECTANCE,
    assert_within_noise,
    at,
    globe,
    kernels,
    lamp,
    picture,
    scene,
    square,
)

GREY = Spectrum.constant(0.6)
FEW_BANDS = Bands.regular(420, 60, 5)
VIEW = Camera("Camera", "perspective", at(0, 0, 4), (-0.5, 0.5, -0.5, 0.5))
SHADED = Shape("Globe", globe(0.7), at(0.4, 0.2, 0.7), "paint")
# Lit by a panel, a point and the sky, with shadows and several bounces.
LAMPS = [lamp("point", at(-1.5, 1, 3), radius=0.0)]
PANEL = Shape("Panel", square(0.5), at(1.5, -0.5, 3, FULL_TURN), "soot", INTENSITY.scaled(2))
SKY = lamp("environment", filename="", intensity=INTENSITY.scaled(0.1))


def busy(**changes):
    facts = {"camera": VIEW, "environment": SKY, "size": (24, 24), "depth": 5, "bands": FEW_BANDS}
    return scene(LAMPS, [FLOOR, SHADED, PANEL], **{**facts, **changes})


def stock(native, samples, seeds):
    """Return renderings of a native scene by stock Mitsuba, a spectral film and a fast variant."""
    mi = session.start("llvm_ad_spectral", 1)
    loaded = mi.load_file(str(native))
    return np.stack([np.array(mi.render(loaded, spp=samples, seed=seed)) for seed in seeds])


@pytest.mark.parametrize(
    ("kind", "paint"),
    [
        ("centre", REFLECTANCE),
        ("mean", REFLECTANCE),
        # A band's average of products is the product of averages only where one factor varies.
        ("averaged", GREY),
    ],
)
def test_all_bands_agree_with_stock_mitsubas_spectral_film_within_noise(tmp_path, kind, paint):
    ours = np.stack(
        [
            picture(busy(kind=kind, reflectance=paint, seed=seed), tmp_path, name=f"s{seed}").radiance
            for seed in range(4)
        ]
    )
    theirs = stock(tmp_path / "s0.xml", 256, range(1, 9))
    # Blocks of 6 x 6 pixels, each band by itself.
    ours, theirs = (blocks(images, 6) for images in (ours, theirs))
    error = np.sqrt(ours.var(axis=0, ddof=1) / len(ours) + theirs.var(axis=0, ddof=1) / len(theirs))
    z = (ours.mean(axis=0) - theirs.mean(axis=0)) / error
    # With 4 and 8 renderings the errors are themselves uncertain, which widens z to about 1.4.
    assert abs(z.mean()) < 4 * 1.4 / np.sqrt(z.size)
    assert np.sqrt(np.mean(z**2)) < 1.8
    np.testing.assert_allclose(ours.mean(axis=(0, 1, 2)), theirs.mean(axis=(0, 1, 2)), rtol=0.01)


def blocks(images, size):
    count, height, width, bands = images.shape
    cut = images.reshape(count, height // size, size, width // size, size, bands)
    return cut.mean(axis=(2, 4), dtype=float)


def test_the_same_seed_gives_the_same_bits_and_another_seed_does_not(tmp_path):
    first, again, other = (
        picture(busy(seed=seed), tmp_path, name=name).radiance
        for seed, name in [(3, "first"), (3, "again"), (4, "other")]
    )
    assert np.array_equal(first, again)
    assert not np.array_equal(first, other)


def test_more_threads_change_nothing_but_the_order_of_sums(tmp_path):
    one, two = (picture(busy(), tmp_path, threads).radiance for threads in (1, 2))
    np.testing.assert_allclose(one, two, rtol=1e-5, atol=1e-6 * one.mean())


def test_a_big_picture_is_made_in_passes_and_can_be_cancelled_between_them(tmp_path):
    seen = []

    def cancel_soon(fraction):
        seen.append(fraction)
        if fraction > 0.2:
            raise Cancelled

    with pytest.raises(Cancelled):
        picture(busy(size=(96, 96), samples=300), tmp_path, report=cancel_soon)
    assert seen == sorted(seen)
    assert seen[0] == 0
    assert 0.2 < seen[-1] < 0.5


def test_progress_ends_at_one_and_the_samples_are_counted(tmp_path):
    seen = []
    image = picture(busy(samples=300), tmp_path, report=seen.append)
    assert seen[-1] == 1
    # Two rounds of 150 samples, which jitter spreads over 12 x 13 strata.
    assert image.attributes["samples"] == "312"
    assert image.attributes["integrator"] == "lobe path"


def test_passes_add_up_to_the_same_picture_within_noise(tmp_path):
    many = picture(busy(size=(8, 8), samples=1024), tmp_path, name="many").radiance
    few = np.stack(
        [picture(busy(size=(8, 8), samples=256, seed=s), tmp_path, name="few").radiance for s in range(1, 5)]
    )
    error = few.std(axis=0, ddof=1).mean()
    assert np.abs(many - few.mean(axis=0)).mean() < 1.5 * error


def test_other_spectra_lamps_and_cameras_never_recompile_anything(tmp_path):
    picture(busy(), tmp_path, name="first")
    moved = Camera("Other", "perspective", at(0.3, 0, 5), (-0.3, 0.5, -0.4, 0.4))
    changes = {
        "paint": {"reflectance": Spectrum.of([400, 500, 501, 700], [0.9, 0.1, 0.7, 0.3])},
        "sky": {"environment": lamp("environment", filename="", intensity=REFLECTANCE)},
        "seed": {"seed": 77},
        "depth": {"depth": 3},
        "camera": {"camera": moved},
        "bands": {"bands": Bands.regular(450, 30, 5)},
        "kind": {"kind": "centre"},
    }
    for name, change in changes.items():
        ran, compiled = kernels(busy(**change), tmp_path, name)
        assert (ran > 0, compiled) == (True, 0), name


@pytest.mark.parametrize("count", [1, 3, 31, 61])
def test_any_number_of_bands_is_rendered(tmp_path, count):
    bands = Bands.regular(500, 3, count) if count > 1 else Bands.regular(550, 300, 1)
    image = picture(scene([lamp("point", radius=0.0)], bands=bands), tmp_path)
    expected = REFLECTANCE.in_bands(bands) * INTENSITY.in_bands(bands) / (9 * np.pi)
    np.testing.assert_allclose(image.radiance[0, 0], expected, rtol=2e-5)


def test_bands_of_unequal_width_and_beyond_the_visible_are_rendered(tmp_path):
    bands = Bands.around([310.0, 352.5, 400.0, 401.0, 700.0, 900.0])
    image = picture(scene([lamp("point", radius=0.0)], bands=bands), tmp_path)
    expected = REFLECTANCE.in_bands(bands) * INTENSITY.in_bands(bands) / (9 * np.pi)
    np.testing.assert_allclose(image.radiance[0, 0], expected, rtol=2e-5)
    np.testing.assert_array_equal(image.bands.centres, bands.centres)
    np.testing.assert_array_equal(image.bands.edges, bands.edges)


def test_depth_counts_as_mitsuba_counts(tmp_path):
    seen = Shape("Floor", square(50), np.eye(4), "paint", INTENSITY)
    for depth, brightness in [(1, False), (2, True)]:
        lit = picture(scene([lamp("point", radius=0.0)], depth=depth), tmp_path)
        assert lit.radiance.any() == brightness
        assert picture(scene(shapes=[seen], depth=depth), tmp_path).radiance.all()


def test_a_blend_of_two_spectra_is_their_weighted_mean(tmp_path):
    native = renderer().translate(scene([lamp("point", radius=0.0)]), (), tmp_path, "blend")
    tree = Xml.parse(native)
    paint = tree.find("bsdf[@id='paint']")
    blend = element("bsdf", "blendbsdf", id="paint", weight=0.25)
    for factor in (1.0, 0.3):
        half = copy.deepcopy(paint)
        del half.attrib["id"]
        values = half.find("bsdf/spectrum/string")
        values.set(
            "value", ", ".join(str(factor * float(v) ** factor) for v in values.get("value").split(","))
        )
        blend.append(half)
    tree.getroot().remove(paint)
    tree.getroot().insert(4, blend)
    tree.write(native)
    image = renderer().render(native, RenderOptions(), lambda fraction: None)
    first, second = (lobe.reflectance for lobe in one_hot(read_native(native)).materials["paint"])
    assert not np.array_equal(first.values, second.values)
    paint = 0.75 * first.in_bands(BANDS) + 0.25 * second.in_bands(BANDS)
    # Blending chooses one of the two at random for the next bounce, and both for light sampling.
    assert_within_noise(image, paint * INTENSITY.in_bands(BANDS) / (9 * np.pi))


def test_nothing_but_the_renderers_own_words_reach_stdout(tmp_path, capfd):
    picture(scene([lamp("point", radius=0.0)], samples=67), tmp_path)
    assert capfd.readouterr().out == ""


def test_a_scene_that_mitsuba_refuses_is_one_sentence(tmp_path):
    native = renderer().translate(busy(), (), tmp_path, "broken")
    for mesh in (tmp_path / "meshes").iterdir():
        mesh.unlink()
    with pytest.raises(RenderingError, match=r"Mitsuba failed: .*ply") as caught:
        renderer().render(native, RenderOptions(), lambda fraction: None)
    assert "\n" not in str(caught.value)


def test_without_llvm_the_stock_film_renders_the_same_scene_and_says_so(tmp_path, monkeypatch, caplog):
    monkeypatch.setattr(llvm, "prepare", lambda: None)
    one = scene([lamp("point", radius=0.5)], samples=512, size=(8, 8), bands=FEW_BANDS, reflectance=GREY)
    with caplog.at_level(logging.WARNING):
        image = picture(one, tmp_path)
    assert_within_noise(image, 0.6 * INTENSITY.in_bands(FEW_BANDS) / np.pi / 9)
    assert image.attributes["integrator"] == "stock specfilm"
    assert "no LLVM works here" in caplog.text


def test_without_llvm_what_stock_mitsuba_cannot_do_is_refused(tmp_path, monkeypatch):
    monkeypatch.setattr(llvm, "prepare", lambda: None)
    spot = lamp("spot", cone=45.0, blend=0.5, radius=0.0)
    sun = lamp("directional", angle=0.5)
    for light, word in [(spot, "the edge of the spot Lamp"), (sun, "the disc of Lamp")]:
        with pytest.raises(RenderingError, match=f"cannot render {word}, install"):
            picture(scene([light]), tmp_path)


def test_plain_mitsuba_loads_and_renders_every_kind_of_light(tmp_path):
    kinds = [
        lamp("point", at(-1, 0, 3), radius=0.0),
        lamp("point", at(1, 0, 3), radius=0.2),
        lamp("spot", at(0, 1, 3), cone=40.0, blend=0.2, radius=0.1),
        lamp("directional", angle=0.0),
        lamp("directional", angle=0.53),
    ]
    one = scene(
        [replace(kind, id=f"Lamp{k}") for k, kind in enumerate(kinds)], environment=SKY, bands=FEW_BANDS
    )
    native = renderer().translate(one, (), tmp_path, "scene")
    stock_image = stock(native, 256, [1])[0]
    assert stock_image.shape == (4, 4, 5)
    ours = renderer().render(native, RenderOptions(), lambda fraction: None).radiance
    # Nothing is lit differently in the middle of the picture, but bands are averaged in another order.
    np.testing.assert_allclose(stock_image.mean(axis=(0, 1)), ours.mean(axis=(0, 1)), rtol=0.06)


@pytest.mark.parametrize("samples", [1, 2, 3])
def test_a_handful_of_samples_is_enough_for_a_picture(tmp_path, samples):
    image = picture(scene([lamp("point", radius=0.0)], samples=samples, size=(3, 1)), tmp_path)
    expected = REFLECTANCE.in_bands(BANDS) * INTENSITY.in_bands(BANDS) / (9 * np.pi)
    np.testing.assert_allclose(image.radiance[0, 2], expected, rtol=2e-5)
