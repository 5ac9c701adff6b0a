"""Probes: what lies under the pointer, and those that are kept as pins."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import bpy

from ..rtb_addon.blender.folders import recipe_folder
from ..rtb_addon.blender.redrawing import redraw_panels
from . import viewing

if TYPE_CHECKING:
    from ..rtb_addon.probing import Difference, Probe

# Okabe and Ito's, which people with any colour vision tell apart, but for the dark ones.
COLOURS = (
    (0.90, 0.62, 0.00),
    (0.34, 0.71, 0.91),
    (0.00, 0.62, 0.45),
    (0.94, 0.89, 0.26),
    (0.84, 0.37, 0.00),
    (0.80, 0.47, 0.65),
)
Place = tuple[str, tuple[int, ...]]  # a condition and a region of it

under: Place | None = None  # the pixel under the pointer, or the box that is being dragged
hovered: Probe | None = None  # the last answer to what is there
sentence = ""  # why the last probe could not be taken


def hover(place: Place | None) -> None:
    """Find out what light comes from what is under the pointer; None where there is no rendering."""
    global under, hovered
    if place == under:
        return
    under = place
    if place is None:
        hovered = None
    else:
        ask(bpy.context.scene, place, _hover, "hover")
    viewing.redraw()


def ask(scene, place: Place, then: Callable[[Probe, str], None], kind: str = "probe") -> None:
    """
    Let a function have the probe of a place, and the folder of the recipe.

    The place is in the renderings that are shown; where none are, in those of a scene's recipe.
    """
    from ..rtb_addon.probing import Probe

    folder = viewing.seen["folder"] if viewing.seen else str(recipe_folder(scene))
    renderer = viewing.seen["renderer"] if viewing.seen else ""

    def arrived(answer: Mapping[str, Any]) -> None:
        global sentence
        sentence = answer.get("sentence", "")
        if not sentence:
            then(Probe.from_words(answer["probe"]), folder)

    request = {"verb": "probe", "folder": folder, "renderer": renderer}
    viewing.ask(kind, {**request, "condition": place[0], "region": list(place[1])}, arrived)


def add(probe: Probe, folder: str, compared: bool) -> None:
    """Keep a probe as a pin; a compared one belongs to the active pin, or to what that is compared to."""
    window_manager = bpy.context.window_manager
    pins, first = window_manager.rtb_pins, active(window_manager) if compared else None
    reference = (first.first or first.number) if first is not None else 0
    number = max((pin.number for pin in pins), default=0) + 1
    pin = pins.add()
    pin.number, pin.first, pin.colour = number, reference, COLOURS[(number - 1) % len(COLOURS)]
    pin.name = f"{probe.condition} {probe.region.left}, {probe.region.top}"
    pin.folder, pin.words = folder, json.dumps(probe.to_words())
    window_manager.rtb_active_pin = len(pins) - 1
    redraw_panels()
    viewing.redraw()


def is_seen(pin) -> bool:
    """Whether the picture shows what a pin has measured; there must be a picture."""
    probe, seen = probe_of(pin.words), viewing.seen
    shown = (seen["folder"], seen["renderer"]) == (pin.folder, probe.renderer)
    return shown and probe.condition in seen["there"]


def active(window_manager):
    """Return the pin that is chosen in the list, if there is one."""
    pins = window_manager.rtb_pins
    return pins[min(window_manager.rtb_active_pin, len(pins) - 1)] if len(pins) else None


def compared_to(window_manager, pin):
    """Return the pin that a pin is compared to, if it is still there."""
    return next((each for each in window_manager.rtb_pins if pin.first and each.number == pin.first), None)


@lru_cache(maxsize=64)
def probe_of(words: str) -> Probe:
    """Return what a pin has measured."""
    from ..rtb_addon.probing import Probe

    return Probe.from_words(json.loads(words))


@lru_cache(maxsize=64)
def difference_of(first: str, second: str) -> Difference:
    """Return how the second of two pins differs from the first."""
    from ..rtb_addon.probing import difference

    return difference(probe_of(first), probe_of(second))


def table(pins: Sequence) -> str:
    """Return pins as a table that spreadsheets read."""
    from ..rtb_addon.probe_tables import csv_text

    return csv_text([probe_of(pin.words) for pin in pins])


def write_table(pins: Sequence, path: Path) -> None:
    """Write pins as such a table."""
    from ..rtb_addon.files import write_text

    write_text(path, table(pins))


def clear() -> None:
    """Forget all probes."""
    global under, hovered, sentence
    under, hovered, sentence = None, None, ""
    bpy.context.window_manager.rtb_pins.clear()
    redraw_panels()
    viewing.redraw()


def _hover(probe: Probe, folder: str) -> None:
    global hovered
    if under is not None:
        hovered = probe
        viewing.redraw()


@bpy.app.handlers.persistent
def _before_loading(*_) -> None:
    clear()


def register() -> None:
    """Watch for another file being opened: pins belong to its renderings."""
    bpy.app.handlers.load_pre.append(_before_loading)


def unregister() -> None:
    """Leave nothing behind."""
    bpy.app.handlers.load_pre.remove(_before_loading)
    clear()
