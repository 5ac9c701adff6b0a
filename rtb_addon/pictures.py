"""The pictures of a recipe's renderings: one montage for each renderer."""

from __future__ import annotations

import queue
import threading
from collections.abc import Callable, Iterable, Iterator, Mapping
from concurrent.futures import Future
from contextlib import suppress
from dataclasses import replace
from functools import partial
from importlib import import_module
from pathlib import Path
from typing import Any

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

    Cubes are looked at as they come, by a thread of its own, and the picture is begun when the last one is
    there, while the workers still end.
    """
    painter, picture = _Painter(recipe), None
    for event in events:
        if event.kind == "done":
            painter.look_at(Path(event.file))
        if picture is None and event.finished == event.total > 0:
            picture = painter.paint()
        if event.kind == "finished":
            event = _with_picture(event, picture or painter.paint())
        yield event


class _Painter:
    """Looks at cubes and paints montages in a thread that nobody waits for, unlike those of an executor."""

    def __init__(self, recipe: Recipe) -> None:
        self._recipe = recipe
        self._seen: dict[Path, Future[FloatArray]] = {}
        self._acts: queue.SimpleQueue[tuple[Future[Any], Callable[[], Any]]] = queue.SimpleQueue()
        threading.Thread(target=self._work, daemon=True).start()

    def look_at(self, file: Path) -> None:
        self._seen[file] = self._later(partial(tristimulus, file))

    def paint(self) -> Future[list[Path]]:
        return self._later(lambda: list(make_montages(self._recipe, anew=False, seen=self._seen)))

    def _later(self, act: Callable[[], Any]) -> Future[Any]:
        made: Future[Any] = Future()
        self._acts.put((made, act))
        return made

    def _work(self) -> None:
        with suppress(ImportError, OSError):  # then the montage says so
            import_module("PIL.Image")  # which it needs at once when all is done
        while True:
            made, act = self._acts.get()
            try:
                made.set_result(act())
            except Exception as error:  # for whoever asks for what was made
                made.set_exception(error)


def _with_picture(event: Event, picture: Future[list[Path]]) -> Event:
    """Wait for the montages; that some pictures do not fit together spoils no cube."""
    try:
        made = picture.result()
    except RecipeError as error:
        return replace(event, warnings=(f"no montage: {error}",))
    return replace(event, file=str(made[0]) if made else "")


def _is_up_to_date(picture: Path, recipe: Recipe, cubes: list[Path]) -> bool:
    """Return whether a picture is younger than its cubes, their coming and going, and the recipe."""
    tables = [recipe.folder / name for name in (RECIPE, CONDITIONS)]
    sources = [*cubes, cubes[0].parent, *(table for table in tables if table.is_file())]
    return picture.is_file() and picture.stat().st_mtime_ns > max(path.stat().st_mtime_ns for path in sources)
