"""What each verb of the command line does; __main__.py reads the words."""

from __future__ import annotations

import json
import signal
import sys
import threading
from argparse import Namespace
from collections.abc import Iterable, Iterator
from contextlib import suppress

from . import renderers
from .background import Event
from .batch import render_recipe, up_to_date
from .compare import COLUMNS, compare_renderers, table
from .errors import RecipeError
from .lifeline import watch_parent
from .old_recipes import import_recipe
from .pictures import make_montages, with_montages
from .progress import ProgressBar
from .recipe import Recipe
from .recipe.options import section_words
from .recipe.packing import pack_recipe
from .recipe.problems import findings
from .recipe.remodeler import remodeled
from .recipe.unpacking import unpack_recipe

FAILED, WRONG, CANCELLED = 1, 2, 130


def render(said: Namespace) -> int:
    """Render a recipe, showing progress, and make its montage."""
    stopped = _asked_to_stop()
    events = render_recipe(
        said.folder,
        renderer=said.renderer,
        conditions=said.conditions,
        samples=said.samples,
        size=said.size,
        jobs=said.jobs,
        threads=said.threads,
        gpu=said.gpu,
        fresh=said.fresh,
        trust=said.trust,
        scheduler=said.scheduler,
        cancelled=stopped.is_set,
    )
    events = with_montages(Recipe.load(said.folder).overridden(renderer=said.renderer), events)
    if said.json:
        return _status(_told(events))
    with ProgressBar() as bar:
        return _status(bar.shown(events))


def check(said: Namespace) -> int:
    """Say everything that is wrong with a recipe, and what its numbers mean."""
    recipe = Recipe.load(said.folder).overridden(renderer=said.renderer)
    with suppress(RecipeError):  # of a remodeler that nobody trusts, which is among the findings
        recipe = remodeled(recipe, trust=said.trust)
    found = findings(recipe)
    for finding in found:
        if said.json:
            print(json.dumps({"problem": finding.is_problem, "sentence": finding.sentence}))
        else:
            print(finding.sentence, file=sys.stderr if finding.is_problem else sys.stdout)
    if said.json:
        words = section_words(recipe.conventions) | {"band_kind": recipe.options.band_kind}
        done = up_to_date(recipe)
        print(json.dumps({"problem": False, "sentence": _meaning(recipe), "meaning": words, "done": done}))
    else:
        print(_meaning(recipe))
    return WRONG if any(finding.is_problem for finding in found) else 0


def import_files(said: Namespace) -> int:
    """Make a recipe folder of old files."""
    recipe, warnings = import_recipe(
        said.parent, said.conditions, said.mappings, said.output, units=said.convention, data=said.data
    )
    for sentence in warnings:
        print(sentence, file=sys.stderr)
    count = len(recipe.conditions)
    print(f"{recipe.name}: {count} condition{'s' * (count != 1)} in {recipe.folder}")
    return 0


def pack(said: Namespace) -> int:
    """Put a recipe into one file."""
    for sentence in pack_recipe(said.folder, said.file, renderings=said.renderings):
        print(f"warning: {sentence}", file=sys.stderr)
    print(said.file)
    return 0


def unpack(said: Namespace) -> int:
    """Make a recipe's folder of such a file."""
    recipe = unpack_recipe(said.file, said.folder)
    print(recipe.folder)
    return 0


def montage(said: Namespace) -> int:
    """Make one picture of the renderings that are there."""
    recipe = Recipe.load(said.folder).overridden(renderer=said.renderer)
    made = list(make_montages(recipe, said.output))
    if not made:
        print(f"{said.folder} holds no renderings yet, render it first", file=sys.stderr)
        return FAILED
    for file in made:
        print(file)
    return 0


def compare(said: Namespace) -> int:
    """Say how far two renderers' cubes lie apart."""
    made = []
    first, second = said.renderers
    for each in compare_renderers(said.folder, first, second, said.conditions):
        made.append(each)
        if said.json:
            print(json.dumps(dict(zip(COLUMNS, each.numbers, strict=True))), flush=True)
    if not said.json:
        print(table(made), end="")
    return 0


def renderers_installed(said: Namespace) -> int:
    """Say which renderers are here, in which version, and why not."""
    for name in renderers.names():
        version, reason = _found(name)
        if said.json:
            print(json.dumps({"renderer": name, "version": version, "reason": reason}))
        else:
            print(f"{name:<10} {version or 'missing: ' + reason}")
    return 0


def _found(name: str) -> tuple[str | None, str]:
    """Return a renderer's version, or None and why; a package that does not even load is one more reason."""
    try:
        return renderers.find(name).version()
    except Exception as error:
        return None, f"{type(error).__name__}: {error}"


def _told(events: Iterable[Event]) -> Iterator[Event]:
    for event in events:
        print(event.to_json(), flush=True)
        yield event


def _status(events: Iterable[Event]) -> int:
    """Return the exit status of a batch: wrong when nothing could be rendered because of the recipe."""
    faults, good, cancelled = set(), 0, False
    for event in events:
        good += event.kind in {"done", "cached"}
        faults |= {event.fault} if event.kind == "failed" else set()
        cancelled |= event.kind == "cancelled" and not event.condition
    if cancelled:
        return CANCELLED
    if not faults:
        return 0
    return WRONG if faults == {"recipe"} and not good else FAILED


def _asked_to_stop() -> threading.Event:
    """Return a flag that Ctrl-C, a termination signal or the end of our parent raises."""
    flag = threading.Event()

    def ask(*_) -> None:
        flag.set()
        signal.signal(signal.SIGINT, signal.default_int_handler)  # a second Ctrl-C does not wait

    signal.signal(signal.SIGINT, ask)
    signal.signal(signal.SIGTERM, ask)
    watch_parent(None, flag.set, signal.SIGTERM)
    return flag


def _meaning(recipe: Recipe) -> str:
    units = {
        "si": "a point light's numbers are W sr-1 nm-1",
        "rtb3": "light spectra are total power, every radiance is multiplied by 1/(4 pi)",
    }[recipe.conventions.units]
    hand = {
        "blender": "pictures show what Blender's camera shows",
        "rtb3": "pictures are mirrored unless a mapping flips the camera, as in RenderToolbox3",
    }[recipe.conventions.handedness]
    return (
        f"{recipe.name}: units {recipe.conventions.units}: {units}; "
        f"handedness {recipe.conventions.handedness}: {hand}; band values: {recipe.options.band_kind}"
    )
