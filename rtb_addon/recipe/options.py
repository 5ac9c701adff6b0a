"""What a recipe says about how to render it: options, conventions, montage; checked when they are born."""

from __future__ import annotations

import dataclasses
import json
import math
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Literal, NamedTuple, TypeVar, get_args

from ..layers import NAMES as LAYERS
from ..scene.render_scene import Crop, Film, Filter, Integrator
from ..spectra import BandKind, Bands

_Section = TypeVar("_Section")


class Rule(NamedTuple):
    """What a value must be, in words, and whether one is."""

    words: str
    holds: Callable[[Any], bool]


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)


def _whole(low: int, words: str) -> Rule:
    return Rule(words, lambda value: isinstance(value, int) and not isinstance(value, bool) and value >= low)


def _one_of(*choices: str) -> Rule:
    return Rule(f"one of {', '.join(choices)}", lambda value: isinstance(value, str) and value in choices)


def _are_bands(value: Any) -> bool:
    numbers = isinstance(value, tuple) and len(value) == 3 and all(map(_is_number, value))
    return numbers and value[0] > 0 and value[1] > 0 and value[2] >= 1 and value[2] == int(value[2])


def _are_centres(value: Any) -> bool:
    if not isinstance(value, tuple) or len(value) == 1 or not all(map(_is_number, value)):
        return False
    return all(a < b for a, b in zip((0, *value), value, strict=False))


def _is_crop(value: Any) -> bool:
    if value == ():
        return True
    whole = isinstance(value, tuple) and len(value) == 4 and all(_whole(0, "").holds(each) for each in value)
    return whole and value[2] > 0 and value[3] > 0


def _are_layers(value: Any) -> bool:
    return isinstance(value, tuple) and len(set(value)) == len(value) and set(value) <= set(LAYERS)


def _none_or_positive(words: str) -> Rule:
    return Rule(words, lambda value: value is None or (_is_number(value) and value > 0))


RULES: Mapping[str, Rule] = {
    "renderer": Rule(
        "a renderer's name in small letters",
        lambda v: isinstance(v, str) and bool(re.fullmatch(r"[a-z][a-z0-9_-]*", v)),
    ),
    "width": _whole(1, "a whole number of pixels"),
    "height": _whole(1, "a whole number of pixels"),
    "bands": Rule("start [nm], step [nm] and count, all positive", _are_bands),
    "centres": Rule("at least two increasing wavelengths [nm]", _are_centres),
    "band_kind": _one_of("averaged", "centre", "mean"),
    "samples": _whole(1, "a whole number of paths per pixel, 1 or more"),
    "seed": _whole(0, "a whole number, 0 or more"),
    "integrator": _one_of("path", "direct"),
    "depth": _whole(1, "a whole number, 1 or more (2 is direct light)"),
    "roulette": _whole(0, "the depth from which paths may end at random, 0 for never"),
    "filter": _one_of(*get_args(Filter)),
    "crop": Rule("left, top, width and height [pixels], or empty for the whole picture", _is_crop),
    "until_seconds": _none_or_positive("a number of seconds, or null to take all samples"),
    "until_error": _none_or_positive("a relative noise such as 0.01, or null to take all samples"),
    "layers": Rule(f"names out of {', '.join(LAYERS)}", _are_layers),
    "camera": Rule("the id of a camera, or an empty text for the scene's own", lambda v: isinstance(v, str)),
    "units": _one_of("si", "rtb3"),
    "handedness": _one_of("blender", "rtb3"),
    "columns": Rule("a whole number of columns, or null", lambda v: v is None or _whole(1, "").holds(v)),
    "fill": _one_of("columns", "rows"),
    "scale": Rule(
        "a positive number, or null for the brightest", lambda v: v is None or (_is_number(v) and v > 0)
    ),
    "tone_map": Rule("a number, 0 for none", lambda v: _is_number(v) and v >= 0),
}


class _Checked:
    """A group of values that keep their rules."""

    def __post_init__(self) -> None:
        for field in dataclasses.fields(self):  # type: ignore[arg-type]
            value, rule = getattr(self, field.name), RULES[field.name]
            if not rule.holds(value):
                raise ValueError(f"{field.name} is {_shown(value)}, it must be {rule.words}")


def _shown(value: Any) -> str:
    return json.dumps(value, ensure_ascii=False, default=str)


@dataclass(frozen=True)
class RecipeOptions(_Checked):
    """
    How to render; all of it goes into a condition's key.

    Parameters
    ----------
    renderer : name of a renderer, in small letters
    width, height : size [pixels]
    bands : first centre [nm], width [nm] and number of equally wide wavelength bands
    centres : centres of the bands [nm] instead, when they are not equally wide
    band_kind : what a band's number stands for
    samples : paths per pixel
    seed : of the random numbers, the same for every condition
    integrator : path, or direct
    depth : longest path in Mitsuba's counting: 2 is direct light
    roulette : depth from which paths may end at random; 0: they never do
    filter : reconstruction filter
    crop : left, top, width and height of the part that is rendered [pixels]; empty for all of it
    until_seconds : begin no pass of a rendering once these have passed [s], whatever its samples
    until_error : begin no pass once the relative noise is at most this, whatever its samples
    layers : what to find beside radiance: depth, normal, uv, object, material, albedo, direct, indirect,
        standard_error
    camera : id of a camera in the parent scene; empty: the scene's own
    """

    renderer: str = "mitsuba"
    width: int = 320
    height: int = 240
    bands: tuple[float, float, int] = (400.0, 10.0, 31)
    centres: tuple[float, ...] = ()
    band_kind: BandKind = "averaged"
    samples: int = 64
    seed: int = 0
    integrator: Literal["path", "direct"] = "path"
    depth: int = 6
    roulette: int = 0
    filter: Filter = "box"
    crop: tuple[int, ...] = ()
    until_seconds: float | None = None
    until_error: float | None = None
    layers: tuple[str, ...] = ()
    camera: str = ""

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.crop:
            left, top, width, height = self.crop
            if left + width > self.width or top + height > self.height:
                words = f"crop reaches to {left + width} x {top + height} pixels"
                raise ValueError(f"{words}, the picture has {self.width} x {self.height}")

    @property
    def wavelength_bands(self) -> Bands:
        """The bands, as arrays [nm]."""
        return Bands.around(self.centres) if self.centres else Bands.regular(*self.bands)

    @property
    def film(self) -> Film:
        """What the light falls on."""
        crop = Crop(*self.crop) if self.crop else None
        return Film(self.width, self.height, self.wavelength_bands, self.band_kind, self.filter, crop)

    @property
    def light_paths(self) -> Integrator:
        """How light is followed; direct light is paths of depth 2."""
        depth = 2 if self.integrator == "direct" else self.depth
        return Integrator(self.integrator, depth, self.samples, self.seed, self.roulette)


@dataclass(frozen=True)
class Conventions(_Checked):
    """
    What the numbers of a recipe mean; nothing is inferred from where a file came from.

    Parameters
    ----------
    units : si, or rtb3: light spectra are total power, so that every radiance is multiplied by 1/(4 pi)
    handedness : blender, or rtb3: the camera of an old file shows mirrored
    """

    units: Literal["si", "rtb3"] = "si"
    handedness: Literal["blender", "rtb3"] = "blender"

    @property
    def factor(self) -> float:
        """What SI radiance is multiplied by to become the radiance of these units."""
        return 1.0 if self.units == "si" else 1.0 / (4.0 * math.pi)


@dataclass(frozen=True)
class MontageOptions(_Checked):
    """
    How many renderings become one picture.

    Parameters
    ----------
    columns : of the grid; None: RenderToolbox3's grid of floor(sqrt(n)) rows
    fill : whether conditions go down the columns or along the rows
    scale : linear sRGB is multiplied by it; None: the brightest pixel becomes 1
    tone_map : pixels brighter than this times the mean luminance are scaled down to it; 0: none are
    """

    columns: int | None = None
    fill: Literal["columns", "rows"] = "columns"
    scale: float | None = None
    tone_map: float = 10.0


def section(kind: type[_Section], words: Mapping[str, Any]) -> _Section:
    """Return a group of values from the words of recipe.json; words it does not know are left out."""
    known = {field.name for field in dataclasses.fields(kind)}  # type: ignore[arg-type]
    chosen = {name: _from_json(name, value) for name, value in words.items() if name in known}
    if isinstance(words.get("bands"), dict) and "centres" in words["bands"]:
        chosen["centres"] = _from_json("centres", words["bands"]["centres"])
        del chosen["bands"]
    return kind(**chosen)


def section_words(values: Any) -> dict[str, Any]:
    """Return a group of values as recipe.json writes it."""
    words = dataclasses.asdict(values)
    if isinstance(values, RecipeOptions):
        start, step, count = values.bands
        centres = words.pop("centres")
        words["bands"] = {"centres": centres} if centres else {"start": start, "step": step, "count": count}
    return words


def _from_json(name: str, value: Any) -> Any:
    if name == "bands" and isinstance(value, dict) and "centres" not in value:
        value = [value.get(word) for word in ("start", "step", "count")]
    if name == "renderer" and isinstance(value, str):
        value = value.lower()
    return tuple(value) if isinstance(value, list) else value
