"""
A child of Blender's that looks at cubes: draws pictures of them and probes them.

Blender's own process reads no cubes: whatever that takes, its window goes on. Requests and answers are lines
of JSON; pictures and pixels cross as files.
"""

from __future__ import annotations

import base64
import json
import queue
import signal
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np

from .errors import RecipeError, RenderingError
from .files import replacing
from .lifeline import stop_for_good, watch_parent

GRACE = 0.5  # [s]


class Viewer:
    """Answers requests, and keeps what it has read as long as the files stay as they are."""

    def __init__(self) -> None:
        from .kept_cubes import KeptCubes

        self._kept = KeptCubes()

    def answer(self, request: Mapping[str, Any]) -> dict[str, Any]:
        """Return the answer to a request; one that cannot be met gets a sentence."""
        verbs: Mapping[str, Callable[..., dict]] = {
            "wake": self.wake,
            "look": self.look,
            "probe": self.probe,
            "thumbnails": self.thumbnails,
            "develop": self.develop,
        }
        words = dict(request)
        verb = words.pop("verb")
        try:
            return {"verb": verb, **verbs[verb](**words)}
        except (RecipeError, RenderingError) as error:
            return {"verb": verb, "sentence": str(error)}

    def wake(self) -> dict[str, Any]:
        """Import what takes a moment, before it is needed."""
        import OpenEXR  # noqa: F401
        from PIL import Image  # noqa: F401

        from . import looks  # noqa: F401

        return {}

    def look(self, **words: Any) -> dict[str, Any]:
        """Draw a picture into a file and return what is where in it."""
        from .looks import Look, draw_look

        return draw_look(Look(**words), self._kept)

    def probe(self, folder: str, renderer: str, condition: str, region: list[int]) -> dict[str, Any]:
        """Return what light comes from a region of a condition."""
        from .looks import file_of
        from .probing import Region, probed
        from .recipe import Recipe

        file = file_of(Recipe.load(folder).overridden(renderer=renderer or None), condition)
        probe = probed(self._kept.cube(file), condition, Region(*region), self._kept.brightest(file))
        return {"probe": probe.to_words()}

    def thumbnails(self, folder: str, names: Sequence[str], side: int) -> dict[str, Any]:
        """Return a small picture of each condition that is rendered: RGBA bytes, the lowest row first."""
        from .looks import file_of
        from .recipe import Recipe
        from .thumbnails import thumbnail

        recipe, pictures = Recipe.load(folder), {}
        for name in names:
            with suppress(RecipeError):
                picture = thumbnail(self._kept.cube(file_of(recipe, name)), side)
                pictures[name] = base64.b64encode(picture[::-1].tobytes()).decode()
        return {"pictures": pictures}

    def develop(self, cube: str, matrix: list[list[float]], output: str) -> dict[str, Any]:
        """Write X, Y, Z times a matrix and alpha 1 as 32-bit numbers, the lowest row first."""
        from .colorimetry import xyz

        colours = xyz(self._kept.cube(Path(cube))) @ np.array(matrix).T
        pixels = np.ones((*colours.shape[:2], 4), np.float32)
        pixels[..., :3] = colours
        with replacing(Path(output)) as temporary:
            temporary.write_bytes(pixels[::-1].tobytes())
        return {"width": colours.shape[1], "height": colours.shape[0]}


def main() -> None:
    """Answer what Blender asks until it asks no more."""
    from .worker import own_output

    outgoing, requests = own_output(), queue.SimpleQueue()

    def close() -> None:
        requests.put("")
        stop_for_good(GRACE)

    watch_parent(requests.put, close, getattr(signal, "SIGKILL", None))
    viewer = Viewer()
    while line := requests.get():
        outgoing.write(json.dumps(viewer.answer(json.loads(line))) + "\n")
        outgoing.flush()


if __name__ == "__main__":
    main()
