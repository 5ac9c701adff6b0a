"""
The internal spectral tracer: a path tracer in numpy that carries all bands along every path.

To read it, follow a path from the camera to a light in integrate.py. The other modules are what it
meets on its way: camera.py, intersect.py (bvh.py where Embree is missing), materials/, lights/, and
carried.py, what its light is multiplied by in each band; sampler.py gives the random numbers, directions.py
the arithmetic, native.py the file. What a material can do stands in meeting.py, the kinds of material are in
materials/: matte.py, ward.py, metal.py and so on. What a light can do stands in lights/groups.py, beside the
kinds. passes.py makes pictures of paths, together.py in several processes, layers.py what is known beside
light.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from ...errors import RenderingError
from ...layers import Layers
from ...scene.render_scene import RenderScene
from ...spectral_image import SpectralImage
from ..interface import Extras, Installed, RenderOptions, Report
from ..rounds import tells_noise
from . import native, passes
from .together import Together

# Goes up when a picture of the same native scene changes.
VERSION = "1.2"


class Tracer:
    """The internal tracer, as a renderer like the others; it runs wherever numpy does."""

    name = "tracer"
    translation = native.VERSION

    def version(self) -> Installed:
        """Return the tracer's version; it is never missing."""
        return Installed(VERSION)

    def translate(self, scene: RenderScene, extras: Extras, folder: Path, name: str) -> Path:
        """Write a scene as folder/NAME.json and its meshes beside it; return that file."""
        return native.translate(scene, extras, folder, name)

    def render(self, native_file: Path, options: RenderOptions, report: Report) -> SpectralImage:
        """Render a native scene [W sr-1 m-2 nm-1]; the same file gives the same bits on every run."""
        scene = native.read(native_file)
        report(0.0)
        painter = _painter(native_file, scene, options)
        rounds = passes.render(scene, painter, options, report)
        attributes = {
            "renderer": self.name,
            "renderer_version": VERSION,
            "integrator": f"{scene.integrator.kind}, depth {scene.integrator.depth}",
            "samples": str(rounds.count * rounds.samples),
            "seed": str(scene.integrator.seed),
            "ray_kernel": painter.kernel,
        }
        error = rounds.error() if tells_noise(options) else None
        if error is not None:
            attributes["noise"] = f"{rounds.noise():.4g}"
        film = scene.film
        return SpectralImage(rounds.mean(), film.bands, film.band_kind, 1.0, attributes, error)

    def layers(
        self, native_file: Path, names: Sequence[str], options: RenderOptions, report: Report
    ) -> Layers:
        """Return some layers of a native scene's picture, out of layers.NAMES but the standard error."""
        from .layers import render_layers

        scene = native.read(native_file)
        report(0.0)
        return render_layers(scene, _painter(native_file, scene, options), names, options, report)


def _painter(native_file: Path, scene: RenderScene, options: RenderOptions) -> passes.Painter:
    if options.gpu:
        raise RenderingError("the tracer has no use for a graphics card, render without gpu")
    return passes.Alone(scene) if options.threads == 1 else Together(native_file, options.threads)


def renderer() -> Tracer:
    """Return the internal tracer."""
    return Tracer()
