"""Lines of a Mitsuba block that change how a picture is taken, and those that change the noise alone."""

from dataclasses import astuple

import numpy as np
import pytest

from rtb_addon.errors import RecipeError
from rtb_addon.renderers.native_lines import ENDLESS, refused, scene_with
from rtb_addon.scene.adjustments import NativeLine
from rtb_addon.scene.render_scene import Camera, Crop, Film, Integrator, RenderScene

DIRECT, PATH = Integrator("direct", 2, 64), Integrator("path", 6, 64)
WINDOW = (-0.2, 0.2, -0.15, 0.15)


def scene(integrator=PATH, projection="perspective", camera="Camera"):
    eye = Camera(camera, projection, np.eye(4), WINDOW, (0.1, 100.0))
    return RenderScene(eye, (), {}, integrator=integrator, film=Film(32, 24))


def lines(*texts):
    return [NativeLine(text, "mappings.txt", 7) for text in texts]


def changed(integrator, *texts):
    return astuple(scene_with(scene(integrator), lines(*texts), "Mitsuba").integrator)


def seen(*texts):
    """Return lens radius, focus distance, filter and crop."""
    made = scene_with(scene(), lines(*texts), "Mitsuba")
    return made.camera.lens_radius, made.camera.focus_distance, made.film.filter, made.film.crop


def test_paths_in_a_recipe_of_direct_light_have_no_end():
    assert changed(DIRECT, "integrator:integrator:path") == ("path", ENDLESS, 64, 0, 0)
    assert changed(DIRECT, "integrator:integrator:path", "integrator:maxDepth.integer = 7")[1] == 7
    assert changed(PATH, "integrator:maxDepth.integer = -1")[1] == ENDLESS


def test_paths_in_a_recipe_of_paths_stay_as_long_as_it_says():
    assert changed(PATH, "integrator:integrator:path") == astuple(PATH)


@pytest.mark.parametrize("name", ["bdpt", "volpath", "volpath_simple"])
def test_an_integrator_that_comes_to_the_same_picture_is_a_path(name):
    assert changed(PATH, f"integrator:integrator:{name}") == astuple(PATH)


@pytest.mark.parametrize(
    "text",
    [
        "integrator:shadingSamples.integer = 32",
        "integrator:sampleDirect.boolean = true",
        "integrator:hideEmitters.boolean = false",
        "Camera-camera_sampler:sampler:ldsampler",
        "Camera-camera_sampler:pixelSamples.integer = 32",
        "Side-material:ensureEnergyConservation.boolean = false",
        "filter:rfilter:box",
        "filter:radius.float = 0.5",
        "film:film:specfilm",
        "Camera-camera_film:film:hdrfilm",
        "Camera-camera_film:componentFormat.string = float16",
        "Camera-camera_film:pixel_format.string = spectrum",
        "Camera-camera_film:highQualityEdges.boolean = false",
        "Camera-camera:shutterClose.float = 2",
    ],
)
def test_a_line_that_changes_no_more_than_the_noise_is_taken(text):
    assert changed(PATH, text) == astuple(PATH)
    assert seen(text) == (0, 1, "box", None)


@pytest.mark.parametrize(
    "text",
    [
        "integrator:integrator:photonmapper",
        "integrator:hideEmitters.boolean = true",
        "Camera-camera:sensor:fluencemeter",
        "Other-camera:sensor:thinlens",
        "Other-camera:apertureRadius.float = 0.1",
        "Camera-camera:shadingSamples.integer = 32",
        "Side-material:ensureEnergyConservation.boolean = true",
        "filter:rfilter:windowed",
        "filter:stddev.float = 0.25",
        "film:film:ldrfilm",
    ],
)
def test_a_line_that_would_change_the_picture_is_refused_where_it_stands(text):
    with pytest.raises(RecipeError, match=r"^mappings.txt:7: Mitsuba has no use for '") as caught:
        changed(PATH, text)
    assert text in str(caught.value)


def test_a_thin_lens_is_told_in_the_words_of_both_mitsubas():
    lens = ["Camera-camera:sensor:thinlens"]
    old = [*lens, "Camera-camera:apertureRadius.float = 0.1", "Camera-camera:focusDistance.float = 5"]
    new = [*lens, "Camera-camera:aperture_radius.float = 0.1", "Camera-camera:focus_distance.float = 5"]
    assert seen(*old) == seen(*new) == (0.1, 5, "box", None)


def test_a_lens_that_nobody_focuses_is_sharp_as_far_as_it_sees():
    assert seen("Camera-camera:sensor:thinlens", "Camera-camera:apertureRadius.float = 0.1")[:2] == (0.1, 100)
    assert seen("Camera-camera:sensor:thinlens")[0] == 0


def test_a_parallel_view_has_no_lens():
    with pytest.raises(RecipeError, match="no use for"):
        scene_with(scene(projection="orthographic"), lines("Camera:apertureRadius.float = 0.1"), "Mitsuba")


@pytest.mark.parametrize(
    ("kind", "width"),
    [
        ("tent", "radius.float = 1"),
        ("gaussian", "stddev.float = 0.5"),
        ("mitchell", "B.float = 0.3333"),
        ("lanczos", "lobes.integer = 3"),
        ("catmullrom", ""),
    ],
)
def test_filters_are_those_of_mitsuba_and_as_wide(kind, width):
    assert seen(f"filter:rfilter:{kind}", *([f"filter:{width}"] if width else []))[2] == kind


def test_a_filter_of_another_width_is_refused_by_its_width():
    with pytest.raises(RecipeError, match=r"7: stddev of the filter gaussian is 0\.25, only 0\.5 is known"):
        seen("filter:rfilter:gaussian", "filter:stddev.float = 0.25")


def test_a_crop_is_told_in_the_words_of_both_mitsubas():
    numbers = {"cropOffsetX": 4, "cropOffsetY": 2, "cropWidth": 10, "cropHeight": 12}
    old = [f"Camera-camera_film:{name}.integer = {number}" for name, number in numbers.items()]
    names = ("crop_offset_x", "crop_offset_y", "crop_width", "crop_height")
    new = [f"film:{name}.integer = {number}" for name, number in zip(names, numbers.values(), strict=True)]
    assert seen(*old) == seen(*new) == (0, 1, "box", Crop(4, 2, 10, 12))
    assert seen("film:cropWidth.integer = 32", "film:cropOffsetX.integer = 0")[3] is None


def test_a_crop_that_leads_out_of_the_picture_is_refused():
    texts = ("film:cropOffsetX.integer = 30", "film:cropHeight.integer = 5")
    with pytest.raises(RecipeError, match=r"crop reaches to 62 x 5 pixels, the picture has 32 x 24"):
        seen(*texts)
    assert [str(each) for each in refused(scene(), lines(*texts), "Mitsuba")] == [
        "mappings.txt:7: the film's crop reaches to 62 x 5 pixels, the picture has 32 x 24"
    ]


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("Camera:apertureRadius.float = wide", "apertureRadius is 'wide', want a number"),
        ("Camera:focusDistance.float = 0", "focusDistance is '0', want a length in metres"),
        ("Camera:apertureRadius.float = -1", "apertureRadius is '-1', want a length in metres"),
        ("film:cropWidth.integer = 0", "cropWidth is '0', want a whole number from 1"),
        ("sampler:sampleCount.integer = 1.5", r"sampleCount is '1\.5', want a whole number from 1"),
    ],
)
def test_a_number_that_cannot_be_is_refused_where_it_stands(text, sentence):
    with pytest.raises(RecipeError, match=f"^mappings.txt:7: {sentence}$"):
        seen(text)


def test_every_line_that_is_refused_is_said():
    wrong = lines("integrator:integrator:photonmapper", "filter:rfilter:gaussian", "filter:stddev.float = 1")
    assert len(list(refused(scene(), wrong, "Mitsuba"))) == 2
