"""What a recipe says about how to render it: options, conventions, montage; checked when they are born."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal, TypeVar

from ..scene.render_scene import Crop, Film, Filter, Integrator
from ..spectra import BandKind, Bands
from .rules import Checked

_Section = TypeVar("_Section")


@dataclass(frozen=True)
class RecipeOptions(Checked):
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
class Conventions(Checked):
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
class MontageOptions(Checked):
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
