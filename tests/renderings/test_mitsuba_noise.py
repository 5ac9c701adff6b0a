"""Mitsuba's word on its own noise, and renderings that end when it is low or the time is over."""

import numpy as np
import pytest

from rtb_addon.errors import RenderingError
from rtb_addon.renderers.interface import RenderOptions
from rtb_addon.renderers.mitsuba import llvm, renderer, session
from rtb_addon.scene.render_scene import Camera, Shape
from rtb_addon.spectra import Bands
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


def test_the_stock_film_tells_its_error_too(tmp_path, monkeypatch, caplog):
    monkeypatch.setattr(llvm, "prepare", lambda: None)
    image = picture(tmp_path, RenderOptions(errors=True), size=(4, 4))
    assert image.attributes["samples"] == "64"
    assert (image.standard_error > 0).any()
    assert "slowly" in caplog.text


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


def test_without_llvm_there_are_no_layers_and_a_sentence_says_so(tmp_path, monkeypatch):
    monkeypatch.setattr(llvm, "prepare", lambda: None)
    native = renderer().translate(scene(), (), tmp_path, "scene")
    with pytest.raises(RenderingError, match="without LLVM Mitsuba has no layers"):
        renderer().layers(native, ["depth"], RenderOptions(), lambda fraction: None)
