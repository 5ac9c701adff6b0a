"""What every renderer can do."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple, Protocol

from ..scene.adjustments import NativeLine
from ..scene.render_scene import RenderScene
from ..spectral_image import SpectralImage


class Installed(NamedTuple):
    """A renderer's version here, or None and the reason in one sentence."""

    version: str | None
    reason: str = ""


class Report(Protocol):
    """Called between passes with the fraction done, 0 to 1; raises Cancelled when somebody asked to stop."""

    def __call__(self, fraction: float, /) -> None: ...


Extras = Sequence[NativeLine]


@dataclass(frozen=True)
class RenderOptions:
    """
    How to render, where a native scene does not say it.

    Parameters
    ----------
    threads : processor threads for one rendering
    seconds : begin no pass once these have passed [s]; None: until the samples are taken
    error : begin no pass once the relative noise is at most this; None: until the samples are taken
    errors : find the standard error of every pixel and band
    gpu : render on a graphics card, or raise RenderingError where there is none

    Notes
    -----
    The relative noise is the root of the mean squared standard error over the mean radiance, both means
    over all pixels and bands.
    """

    threads: int = 1
    seconds: float | None = None
    error: float | None = None
    errors: bool = False
    gpu: bool = False


class Renderer(Protocol):
    """
    What every renderer can do.

    Attributes
    ----------
    name : as recipes, folders and the command line say it
    translation : version of our translation; goes into each condition's key
    """

    name: str
    translation: int

    def version(self) -> Installed:
        """Return the version installed here, or None and why the renderer is missing."""
        ...

    def translate(self, scene: RenderScene, extras: Extras, folder: Path, name: str) -> Path:
        """Write the scene into a folder as NAME.* in the renderer's own format; return its main file."""
        ...

    def render(self, native: Path, options: RenderOptions, report: Report) -> SpectralImage:
        """Render a translated scene, in physical radiance; report() raises when cancelled."""
        ...
