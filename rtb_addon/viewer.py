"""
A child of Blender's that looks at cubes: draws pictures of them and probes them.

Blender's own process reads no cubes: whatever that takes, its window goes on. Requests and answers are lines
of JSON; pictures and pixels cross as files.
"""

from __future__ import annotations

import dataclasses
import json
import queue
import signal
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from .errors import RecipeError, RenderingError
from .files import replacing
from .lifeline import stop_for_good, watch_parent

MOST_PIXELS = 2_500_000  # of a picture; more than a screen shows only costs Blender time
MEMORY = 500_000_000  # of cubes that are kept [bytes]
GRACE = 0.5  # [s]


@dataclass(frozen=True)
class Look:
    """
    What a picture is wanted of.

    Parameters
    ----------
    folder : of the recipe
    output : the picture's file
    renderer : instead of the recipe's own
    condition : the one to show; empty: all of them
    other : the condition that differences are to
    view : words of a View
    """

    folder: str
    output: str
    renderer: str = ""
    condition: str = ""
    other: str = ""
    view: Mapping[str, Any] = field(default_factory=dict)


class Viewer:
    """Answers requests, and keeps what it has read as long as the files stay as they are."""

    def __init__(self) -> None:
        self._cubes: dict[Path, tuple[int, Any]] = {}
        self._seen: dict[tuple, np.ndarray] = {}
        self._brightest: dict[tuple[Path, int], float] = {}

    def answer(self, request: Mapping[str, Any]) -> dict[str, Any]:
        """Return the answer to a request; one that cannot be met gets a sentence."""
        verbs: Mapping[str, Callable[..., dict]] = {
            "wake": self.wake,
            "look": self.look,
            "probe": self.probe,
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

        from . import montage, recipe  # noqa: F401

        return {}

    def look(self, **words: Any) -> dict[str, Any]:
        """Draw a picture into a file and return what is where in it."""
        from .recipe import Recipe
        from .views import Tiles, View, single

        look = Look(**words)
        view = View(**look.view)
        recipe = Recipe.load(look.folder).overridden(renderer=look.renderer or None)
        names = [look.condition] if look.condition else [each.name for each in recipe.conditions]
        files = [_file_of(recipe, name) for name in names]
        other = _file_of(recipe, look.other) if view.kind == "difference" and look.other else None
        first = self._cube(next((file for file in files if file.is_file()), files[0]))
        height, width, _ = first.radiance.shape
        by = _reduction(len(files) * height * width)
        options = single(recipe.montage) if look.condition else recipe.montage
        cells = [self._part(file, view, other, by) if file.is_file() else None for file in files]
        pixels, full = view.drawn(cells, options)
        _write_picture(Path(look.output), pixels)
        tiles = Tiles.of(names, (width, height), options, by)
        return {
            "file": look.output,
            "folder": look.folder,
            "name": recipe.name,
            "renderer": files[0].parent.name,
            "tiles": tiles.to_words(),
            "full": full,
            "view": dataclasses.asdict(view),
            "bands": first.bands.centres.tolist(),
            "edges": first.bands.edges.tolist(),
            "there": [name for name, cell in zip(names, cells, strict=True) if cell is not None],
        }

    def probe(self, folder: str, renderer: str, condition: str, region: list[int]) -> dict[str, Any]:
        """Return what light comes from a region of a condition."""
        from .probing import Region, brightest, probed
        from .recipe import Recipe

        file = _file_of(Recipe.load(folder).overridden(renderer=renderer or None), condition)
        cube = self._cube(file)
        key = file, self._cubes[file][0]
        if key not in self._brightest:
            self._brightest[key] = brightest(cube)
        return {"probe": probed(cube, condition, Region(*region), self._brightest[key]).to_words()}

    def develop(self, cube: str, matrix: list[list[float]], output: str) -> dict[str, Any]:
        """Write X, Y, Z times a matrix and alpha 1 as 32-bit numbers, the lowest row first."""
        from .colorimetry import xyz

        colours = xyz(self._cube(Path(cube))) @ np.array(matrix).T
        pixels = np.ones((*colours.shape[:2], 4), np.float32)
        pixels[..., :3] = colours
        with replacing(Path(output)) as temporary:
            temporary.write_bytes(pixels[::-1].tobytes())
        return {"width": colours.shape[1], "height": colours.shape[0]}

    def _part(self, file: Path, view: Any, other: Path | None, by: int) -> np.ndarray:
        """Return what is to be seen of a cube, found out once."""
        from .views import reduced

        stamps = [each.stat().st_mtime_ns for each in (file, other) if each is not None and each.is_file()]
        key = file, other, by, replace(view, full=None), *stamps
        if key not in self._seen:
            for old in [each for each in self._seen if each[3] != key[3]]:
                del self._seen[old]
            beside = None if other is None else self._cube(other)
            self._seen[key] = reduced(view.of(self._cube(file), beside), by)
        return self._seen[key]

    def _cube(self, file: Path) -> Any:
        """Return a cube; those that were looked at last are kept."""
        from .spectral_image import SpectralImage

        if not file.is_file():
            raise RecipeError(f"{file.stem} is not rendered yet, press Render Recipe")
        stamp = file.stat().st_mtime_ns
        known = self._cubes.pop(file, None)
        if known is None or known[0] != stamp:
            known = stamp, SpectralImage.load(file)
        self._cubes[file] = known
        while len(self._cubes) > 1 and sum(cube.radiance.nbytes for _, cube in self._cubes.values()) > MEMORY:
            del self._cubes[next(iter(self._cubes))]
        return known[1]


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


def _write_picture(path: Path, pixels: np.ndarray) -> None:
    """Write a picture in the form that Blender reads soonest: it does so where its window waits."""
    from PIL import Image

    with replacing(path) as temporary:
        Image.fromarray(pixels).save(temporary, format="TIFF")


def _file_of(recipe: Any, name: str) -> Path:
    condition = next((each for each in recipe.conditions if each.name == name), None)
    if condition is None:
        raise RecipeError(f"{recipe.folder} holds no condition {name}, press Render Recipe")
    return recipe.rendering_file(condition)


def _reduction(pixels: int) -> int:
    """Return how many pixels across and down become one, so that a picture is not larger than need be."""
    by = 1
    while pixels > MOST_PIXELS * by * by:
        by += 1
    return by


if __name__ == "__main__":
    main()
