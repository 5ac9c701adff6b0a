"""A native scene read back: the XML and the facts that a renderer needs before it loads it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import cast, get_args
from xml.etree import ElementTree as Xml

import numpy as np

from ...errors import RenderingError
from ...scene.render_scene import Crop
from ...spectra import BandKind, Bands
from ..filters import FILTERS
from .xml.called import names_in_order
from .xml.spectrum import properties


@dataclass(frozen=True, eq=False)
class Native:
    """
    A native scene.

    Parameters
    ----------
    path : its XML file
    root : the whole of it
    width, height : size of the whole picture [pixels]
    part : what of it is rendered [pixels]
    filter : reconstruction filter
    bands, band_kind : what its channels are
    samples, seed : paths per pixel, and where their random numbers begin
    depth : longest path, in Mitsuba's counting
    roulette : depth from which paths may end at random; 0: they never do
    defaults : what stock Mitsuba has no word for, by name
    """

    path: Path
    root: Xml.Element
    width: int
    height: int
    part: Crop
    filter: str
    bands: Bands
    band_kind: BandKind
    samples: int
    seed: int
    depth: int
    roulette: int
    defaults: dict[str, str]

    @property
    def pixel_stretch(self) -> float:
        """Height of a pixel over its width."""
        return float(self.defaults.get("pixel_stretch", 1.0))

    @property
    def shift(self) -> tuple[float, float]:
        """How far the view through a lens is shifted, to the right and down over the picture's size."""
        return float(self.defaults.get("shift_x", 0.0)), float(self.defaults.get("shift_y", 0.0))

    def names(self, kind: str) -> dict[str, str]:
        """Return what the scene calls its objects or materials, by their ids here, in its own order."""
        return names_in_order(self.defaults, kind)

    @property
    def has_lens(self) -> bool:
        """Whether the camera has a lens of some width."""
        return any(node.get("type") == "thinlens" for node in self.root.iter("sensor"))

    def beyond_stock(self) -> list[str]:
        """Return what only our own path renders right, in the words of the file's comments."""
        spots = [node.get("id", "") for node in self.root.iter("emitter") if node.get("type") == "spot"]
        suns = [name[: -len("_angle")] for name in self.defaults if name.endswith("_angle")]
        blends = [node.get("id", "") for node in self.root.iter("bsdf") if node.get("type") == "blendbsdf"]
        said = [f"the edge of the spot {name}" for name in spots] + [f"the disc of {name}" for name in suns]
        said += [f"the blend {name}" for name in blends]
        pictured = (
            node.get("id", "")
            for node in self.root.iter("bsdf")
            if node.get("id") and any(each.get("type") == "picture" for each in node.iter("texture"))
        )
        said += [f"the picture on {name}" for name in pictured]
        skies = [node.get("id", "") for node in self.root.iter("emitter") if node.get("type") == "skypicture"]
        said += [f"the picture {name} around the scene" for name in skies]
        said += ["pixels that are not square"] if self.pixel_stretch != 1 else []
        return said + (["a lens that looks past the middle"] if any(self.shift) else [])


def read_native(path: Path) -> Native:
    """Read a native scene as translate() writes it."""
    root = _parse(path)
    try:
        defaults = {node.get("name", ""): node.get("value", "") for node in root.iter("default")}
        film, sampler = properties(_only(root, "film")), properties(_only(root, "sampler"))
        integrator = properties(_only(root, "integrator"))
        depth, roulette = (int(integrator[name]) for name in ("max_depth", "rr_depth"))
        return Native(
            path,
            root,
            width=int(film["width"]),
            height=int(film["height"]),
            part=_part(film),
            filter=_filter(root),
            bands=Bands(_numbers(defaults["band_centres"]), _numbers(defaults["band_edges"])),
            band_kind=_band_kind(defaults["band_kind"]),
            samples=int(sampler["sample_count"]),
            seed=int(sampler["seed"]),
            depth=depth,
            roulette=roulette if roulette <= depth else 0,
            defaults=defaults,
        )
    except (KeyError, ValueError) as error:
        raise RenderingError(
            f"{path.name} is no native scene of ours ({error}), translate it again"
        ) from error


def _parse(path: Path) -> Xml.Element:
    try:
        text = path.read_text("utf-8")
        if "<!DOCTYPE" in text:
            raise RenderingError(f"{path.name} declares entities, remove its DOCTYPE")
        return Xml.fromstring(text)
    except (OSError, UnicodeDecodeError, Xml.ParseError) as error:
        raise RenderingError(f"cannot read the native scene {path.name}: {error}") from error


def _only(root: Xml.Element, tag: str) -> Xml.Element:
    nodes = list(root.iter(tag))
    if len(nodes) != 1:
        raise ValueError(f"{len(nodes)} elements {tag}, want one")
    return nodes[0]


def _part(film: Mapping[str, str]) -> Crop:
    if "crop_width" not in film:
        return Crop(0, 0, int(film["width"]), int(film["height"]))
    offset, size = ("crop_offset_x", "crop_offset_y"), ("crop_width", "crop_height")
    return Crop(*(int(film[name]) for name in (*offset, *size)))


def _filter(root: Xml.Element) -> str:
    name = _only(root, "rfilter").get("type", "")
    if name not in FILTERS:
        raise ValueError(f"filter {name}, want one of {', '.join(FILTERS)}")
    return name


def _band_kind(word: str) -> BandKind:
    if word not in get_args(BandKind):
        raise ValueError(f"band_kind {word}, want one of {', '.join(get_args(BandKind))}")
    return cast("BandKind", word)


def _numbers(text: str) -> np.ndarray:
    return np.array([float(word) for word in text.split()])
