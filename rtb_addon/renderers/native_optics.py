"""Native lines about the camera's lens, the film and its reconstruction filter."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Any, get_args

from ..errors import RecipeError
from ..scene.render_scene import Camera, Crop, Film, Filter, RenderScene
from .interface import NativeLine
from .native_settings import NativeSetting, count_of, number_of

# How a film is stored, and when a camera whose scene stands still is open.
_STORAGE = ("fileformat", "pixelformat", "componentformat", "banner", "attachlog")
_SHUTTER = ("shutteropen", "shutterclose")
FILMS = ("hdrfilm", "specfilm")
# Where a crop's numbers stand in a Crop.
_CROPS = {"cropoffsetx": "left", "cropoffsety": "top", "cropwidth": "width", "cropheight": "height"}
# The parameters that filters have: ours are as wide as Mitsuba's when nobody says how wide.
_WIDTHS: Mapping[str, Mapping[str, float]] = {
    "box": {"radius": 0.5},
    "tent": {"radius": 1},
    "gaussian": {"stddev": 0.5},
    "mitchell": {"b": 1 / 3, "c": 1 / 3},
    "lanczos": {"lobes": 3},
}


def declared_optics(setting: NativeSetting, scene: RenderScene) -> dict[str, Any] | None:
    """Return what a declaration changes of a scene, None where it is about something else."""
    if setting.name == "rfilter" and setting.kind in get_args(Filter):
        return {"film": replace(scene.film, filter=setting.kind)}
    if (setting.name, setting.kind) == ("sensor", "thinlens") and setting.is_of(scene.camera):
        # Sharp as far away as it sees, until a line says otherwise.
        focus = scene.camera.focus_distance if scene.camera.lens_radius else scene.camera.clip[1]
        return {"camera": replace(scene.camera, focus_distance=focus)}
    return {} if setting.name == "film" and setting.kind in FILMS else None


def changed_optics(setting: NativeSetting, line: NativeLine, scene: RenderScene) -> dict[str, Any] | None:
    """Return what a line with a value changes of a scene, None where it is about something else."""
    word = setting.word
    if setting.is_film and word in _CROPS:
        number = count_of(setting, line, 0 if "offset" in word else 1)
        return {"film": replace(scene.film, crop=scene.film.part._replace(**{_CROPS[word]: number}))}
    if setting.is_film and word in _STORAGE:
        return {}
    if setting.is_filter and word in _WIDTHS.get(scene.film.filter, {}):
        return _as_wide(setting, line, scene.film)
    return _through_lens(setting, line, scene.camera) if setting.is_of(scene.camera) else None


def _through_lens(setting: NativeSetting, line: NativeLine, camera: Camera) -> dict[str, Any] | None:
    lengths = {"apertureradius": "lens_radius", "focusdistance": "focus_distance"}
    if setting.word in _SHUTTER:
        return {}
    if setting.word not in lengths or camera.projection != "perspective":
        return None
    length = number_of(setting, line)
    if length < 0 or (length == 0 and setting.word == "focusdistance"):
        raise RecipeError(
            f"{setting.name} is '{setting.value}', want a length in metres", line.file, line.line
        )
    return {"camera": replace(camera, **{lengths[setting.word]: length})}


def _as_wide(setting: NativeSetting, line: NativeLine, film: Film) -> dict[str, Any]:
    width = _WIDTHS[film.filter][setting.word]
    if not math.isclose(number_of(setting, line), width, rel_tol=1e-3):
        message = (
            f"{setting.name} of the filter {film.filter} is {setting.value}, only {width:.3g} is known here"
        )
        raise RecipeError(message, line.file, line.line)
    return {}


def cropped(film: Film, line: NativeLine) -> Film:
    """Return a film whose crop is a true part of the picture, or none; raise where it leads out of it."""
    left, top, width, height = film.part
    if left + width > film.width or top + height > film.height:
        words = f"the film's crop reaches to {left + width} x {top + height} pixels"
        message = f"{words}, the picture has {film.width} x {film.height}"
        raise RecipeError(message, line.file, line.line)
    return replace(film, crop=None) if film.part == Crop(0, 0, film.width, film.height) else film
