"""The pictures of a recipe's renderings: one montage for each renderer."""

from __future__ import annotations

import queue
import threading
from collections.abc import Iterable, Iterator, Mapping
from concurrent.futures import Future
from contextlib import suppress
from dataclasses import replace
from importlib import import_module
from pathlib import Path

from .background import Event
from .errors import RecipeError
from .montage import make_montage, tristimulus, write_png
from .recipe import CONDITIONS, RECIPE, Recipe
from .spectra import FloatArray

Seen = Mapping[Path, "Future[FloatArray]"]


def make_montages(
    recipe: Recipe, output: Path | None = None, *, anew: bool = True, seen: Seen | None = None
) -> Iterator[Path]:
    """
    Write one picture for each renderer that a recipe's conditions are rendered by.

    Parameters
    ----------
    output : the picture's file, else one below images/
    anew : make even a picture that is younger than all it comes from
    seen : what is known of cubes already
    """
    seen, cells = seen or {}, {}
    for condition in recipe.conditions:
        file = recipe.rendering_file(condition)
        # A rendering that is not there leaves its cell black, so that the others keep their places.
        cells.setdefault(file.parent.name, []).append(file if file.is_file() else None)
    for renderer, files in cells.items():
        if any(files):
            target = output or recipe.montage_file(renderer)
            if anew or not _is_up_to_date(target, recipe, [file for file in files if file]):
                looks = (seen[file].result() if file in seen else file for file in files)
                write_png(target, make_montage(looks, recipe.montage))
            yield target


def with_montages(recipe: Recipe, events: Iterable[Event]) -> Iterator[Event]:
    """
    Yield a batch's events, the last one with its montage.

    Cubes are looked at as they come, by a thread of its own, so that the picture is soon there at the end.
    """
    eye = _Eye()
    for event in events:
        if event.kind == "done":
            eye.look_at(Path(event.file))
        yield _with_pictures(recipe, event, eye.seen) if event.kind == "finished" else event


class _Eye:
    """Looks at cubes in a thread that nobody waits for at the end, unlike those of an executor."""

    def __init__(self) -> None:
        self.seen: dict[Path, Future[FloatArray]] = {}
        self._ahead: queue.SimpleQueue[Path] = queue.SimpleQueue()
        threading.Thread(target=self._look, daemon=True).start()

    def look_at(self, file: Path) -> None:
        self.seen[file] = Future()
        self._ahead.put(file)

    def _look(self) -> None:
        with suppress(ImportError, OSError):  # then the montage says so
            import_module("PIL.Image")  # which it needs at once when all is done
        while True:
            file = self._ahead.get()
            try:
                self.seen[file].set_result(tristimulus(file))
            except Exception as error:  # for whoever asks what was seen
                self.seen[file].set_exception(error)


def _with_pictures(recipe: Recipe, event: Event, seen: Seen) -> Event:
    """Make the montages; that some pictures do not fit together spoils no cube."""
    try:
        made = [str(file) for file in make_montages(recipe, anew=False, seen=seen)]
    except RecipeError as error:
        return replace(event, warnings=(f"no montage: {error}",))
    return replace(event, file=made[0] if made else "")


def _is_up_to_date(picture: Path, recipe: Recipe, cubes: list[Path]) -> bool:
    """Return whether a picture is younger than its cubes, their coming and going, and the recipe."""
    tables = [recipe.folder / name for name in (RECIPE, CONDITIONS)]
    sources = [*cubes, cubes[0].parent, *(table for table in tables if table.is_file())]
    return picture.is_file() and picture.stat().st_mtime_ns > max(path.stat().st_mtime_ns for path in sources)
