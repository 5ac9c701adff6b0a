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
    How to render a native scene, where that does not change what comes out.

    Parameters
    ----------
    threads : processor threads for one rendering
    """

    threads: int = 1


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
