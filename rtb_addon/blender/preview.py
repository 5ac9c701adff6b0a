"""
The active condition, shown in the viewport: properties as it sets them, spectra as their colours.

What a property was is written into the scene before it is changed. So every state of the file tells how to be
taken back, whether undo, an automatic save or a crash has brought it: take_back() needs nothing else.
"""

from __future__ import annotations

import json
import threading
from collections.abc import Iterator
from contextlib import contextmanager

import bpy

from ..errors import RecipeError
from . import own_changes
from .mapped import cells_by_name, value_for
from .nodes import base_colour
from .own_spectra import heard
from .places import Place, changed_along, found_at, give_back, kept_value, set_value, value_at
from .table_edits import SPECTRA

_CAMERA = "camera"
_state: dict = {"suspended": 0, "problems": []}


def is_on() -> bool:
    """Whether the window wants the active condition shown."""
    return getattr(bpy.context.window_manager, "rtb_preview", False)


def refresh() -> None:
    """Show the active condition of the scene in hand, or nothing where the preview is off."""
    if _state["suspended"]:
        return
    if threading.current_thread() is not threading.main_thread():
        bpy.app.timers.register(refresh)
        return
    with _paused():  # what is set here asks for no refreshing
        take_back()
        _state["problems"] = show(bpy.context.scene) if is_on() else []
        if len(bpy.context.scene.rtb.kept):
            own_changes.note()


def begin_rendering(scene, of_ours: bool) -> None:
    """Take the preview back, for Blender renders; an engine of ours is shown the active condition instead."""
    with _paused():
        take_back()
        _state["problems"] = _show_properties(scene) if of_ours else []


def problems() -> list[str]:
    """Return a sentence for each thing that the preview cannot show."""
    return _state["problems"]


def show(scene) -> list[str]:
    """Show a scene's active condition; return a sentence for each thing that cannot be shown."""
    if scene.rtb.active_condition >= len(scene.rtb.conditions):
        return []
    return _show_properties(scene) + _show_spectra(scene)


def _show_properties(scene) -> list[str]:
    """Let properties be what the active condition says; spectra of materials and lights are none."""
    settings, problems = scene.rtb, []
    if settings.active_condition >= len(settings.conditions):
        return problems
    cells = cells_by_name(settings, settings.conditions[settings.active_condition])
    for mapping in settings.mappings:
        try:
            place, value = value_for(mapping, cells)
            _set(scene, mapping.thing, mapping.path, mapping.index, place, value)
        except (RecipeError, TypeError, ValueError) as error:
            problems.append(str(error))
    camera = bpy.data.objects.get(cells.get(_CAMERA, ""))
    if camera is not None and camera.type == "CAMERA":
        _set(scene, scene, _CAMERA, -1, found_at(scene, _CAMERA, -1, _CAMERA), camera)
    return problems


def take_back(scenes=None) -> None:
    """Let all properties be as they were, but for those that somebody has changed meanwhile."""
    for scene in bpy.data.scenes if scenes is None else scenes:
        settings = getattr(scene, "rtb", None)
        if settings is None:  # the extension could not be enabled, or goes
            continue
        for kept in reversed(settings.kept):
            if kept.thing is not None:
                _give_back(kept)
        if len(settings.kept):
            settings.kept.clear()
            own_changes.note()


@contextmanager
def suspended() -> Iterator[None]:
    """Take the preview back while somebody looks at the scene."""
    try:
        with _paused():
            take_back()
            yield
    finally:
        if is_on():
            refresh()


@contextmanager
def _paused() -> Iterator[None]:
    _state["suspended"] += 1
    try:
        yield
    finally:
        _state["suspended"] -= 1


def _set(scene, thing, path: str, index: int, place: Place, value) -> None:
    """Set a property, once it is written down what it was, and what changes along with it."""
    for owner, name, part, other in changed_along(place):
        _keep(scene, owner, name, part, other)
    kept = _keep(scene, thing, path, index, place)
    set_value(place, value)
    kept.shown, kept.shown_thing = _words(value_at(place))


def _keep(scene, thing, path: str, index: int, place: Place):
    kept = scene.rtb.kept.add()
    kept.thing, kept.path, kept.index = thing, path, index
    kept.was, kept.was_thing = _words(kept_value(place))
    return kept


def _give_back(kept) -> None:
    try:
        place = found_at(kept.thing, kept.path, kept.index, kept.path)
    except RecipeError:
        return
    along = not kept.shown  # with the frame, which has been given back before this
    if along or _words(value_at(place)) == (kept.shown, kept.shown_thing):
        give_back(place, kept.was_thing if kept.was_thing is not None else json.loads(kept.was))


def _words(value) -> tuple[str, bpy.types.ID | None]:
    """Return a value as text that tells every bit, or as the datablock that it is."""
    return ("null", value) if isinstance(value, bpy.types.ID) else (json.dumps(value), None)


def _show_spectra(scene) -> list[str]:
    """Give what speaks of variables the colours of its spectra in this condition."""
    from .fields import varies

    problems = []
    for home, names in SPECTRA:
        for thing in getattr(bpy.data, home):
            field = next((name for name in names if varies(getattr(thing.rtb, name))), None)
            if field is None or thing.library is not None or not getattr(thing.rtb, "use_spectra", False):
                continue
            try:
                colour = _colour(thing.rtb, field, scene.rtb, shines=home != "materials")
            except (RecipeError, OSError) as error:
                problems.append(str(error))
                continue
            for path in _coloured(thing):
                place = found_at(thing, path, -1, path)
                alpha = [1.0] * (len(value_at(place)) - 3)
                _set(scene, thing, path, -1, place, [*colour, *alpha])
    return problems


def _colour(group, field: str, settings, shines: bool) -> list[float]:
    """Return the colour of a spectrum in Blender's working space."""
    # numpy takes longer to come than enabling may last.
    from .. import swatches
    from ..spectra import Unit, library
    from .colours import in_working_space
    from .fields import typed_in

    unit = Unit.SHAPE if shines else Unit.RATIO
    spectrum = heard(typed_in(group, field, settings), unit)
    if shines:
        return in_working_space(swatches.light_colour(spectrum))
    return in_working_space(swatches.surface_colour(spectrum, library.find("D65")))


def _coloured(thing) -> list[str]:
    """Return the paths of what shows a thing's colour in viewports."""
    kind = type(thing).__name__
    found = ["diffuse_color"] if kind == "Material" else ["color"]
    if kind in ("Material", "World") and (socket := base_colour(thing)) is not None:
        found.append(f"node_tree.{socket.path_from_id()}.default_value")
    return found
