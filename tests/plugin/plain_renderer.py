"""
A renderer of somebody else, found by its entry point, for tests of the engine.

Every pixel of its pictures is the reflectance of the scene's first shape: what a camera sees in a
white furnace of radiance 1. How it behaves on the way stands in its native file's name.
"""

import json
import os
import signal
import time
from pathlib import Path

import numpy as np

from rtb_addon.errors import RenderingError
from rtb_addon.layers import Layers
from rtb_addon.renderers.interface import Installed
from rtb_addon.spectra import Bands
from rtb_addon.spectral_image import SpectralImage


class Plain:
    name = "plain"
    translation = int(os.environ.get("PLAIN_TRANSLATION", "1"))

    def version(self):
        reason = os.environ.get("PLAIN_MISSING", "")
        return Installed(None, reason) if reason else Installed(os.environ.get("PLAIN_VERSION", "1.0"))

    def translate(self, scene, extras, folder, name):
        material = scene.materials[scene.shapes[0].material]
        film = scene.film
        reflectance = material.parameters["diffuseReflectance"].in_bands(film.bands, film.band_kind)
        words = {
            "size": [film.height, film.width],
            "reflectance": list(reflectance),
            "centres": list(film.bands.centres),
            "edges": list(film.bands.edges),
            "passes": scene.integrator.samples,
        }
        folder.mkdir(parents=True, exist_ok=True)
        (folder / f"{name}.json").write_text(json.dumps(words))
        return folder / f"{name}.json"

    def render(self, native, options, report):
        words = json.loads(native.read_text())
        _misbehave(native)
        if "PLAIN_PIDS" in os.environ:
            native.with_suffix(".pid").write_text(str(os.getpid()))
        for number in range(words["passes"]):
            report(number / words["passes"])
            time.sleep(float(os.environ.get("PLAIN_PASS", "0.001")))
        radiance = np.broadcast_to(np.float32(words["reflectance"]), (*words["size"], len(words["centres"])))
        bands = Bands(np.array(words["centres"]), np.array(words["edges"]))
        limits = {"seconds": str(options.seconds), "error": str(options.error), "gpu": str(options.gpu)}
        error = radiance / 100 if options.errors else None
        return SpectralImage(np.ascontiguousarray(radiance), bands, "averaged", 1.0, limits, error)

    def layers(self, native, names, options, report):
        image = self.render(native, options, report)
        depth = np.ones(image.radiance.shape[:2], np.float32)
        known = {"depth": depth, "albedo": image.radiance, "direct": image.radiance}
        return Layers({name: known[name] for name in names}, image.bands)


def _misbehave(native: Path) -> None:
    name, marker = native.stem, native.with_suffix(".died")
    if name.startswith("chatty"):
        os.write(1, b'{"kind": "done", "this": "is what a library prints"}\n')
    if name.startswith("fails"):
        raise RenderingError("the lamp is broken")
    if name.startswith("stumbles"):
        raise ZeroDivisionError("no light\nat all")
    if name.startswith("dies") or (name.startswith("once") and not marker.exists()):
        marker.touch()
        os.write(2, b"LLVM ERROR: Cannot select: fminimum\n")
        os.kill(os.getpid(), signal.SIGKILL)
    if name.startswith("deaf"):
        time.sleep(60)
