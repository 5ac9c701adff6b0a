"""
What Blender holds, kept while somebody's code changes it, and given back afterwards.

Blender's own undo would end all references that Python has into the file, those of the user's code too. So
whatever can be written is read before, and written back after where it differs; what came is removed. What
was lost (a modifier, vertices, whole datablocks) comes back from a copy of the file's datablocks on disk.
"""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from pathlib import Path
from types import TracebackType
from typing import Any

import bpy

from ..errors import RecipeError
from .kept_values import GONE, forget_types, is_same, values_of
from .kept_writing import write_value

# Datablocks that decide nothing of how a scene looks.
_LEFT_OUT = {"window_managers", "screens", "workspaces", "brushes", "texts", "libraries", "palettes"}
_LEFT_OUT |= {"paint_curves", "all_ids", "shape_keys"}  # shape keys are a part of what they shape
_PICTURES_OF_BLENDER = ("RENDER_RESULT", "COMPOSITING")
_MOST_PASSES = 5


class Kept:
    """
    The datablocks of the open file as they were when this was made.

    Used as a context, it keeps a spare of them on disk as long.
    """

    def __init__(self) -> None:
        forget_types()
        self._datablocks = {each.session_uid: each for _, each in _all()}
        self._numbers: dict[int, int] = {}
        self._values = {number: values_of(each, self._numbers) for number, each in self._datablocks.items()}
        self._seen = _layers()
        self._homes = {each.session_uid: (home, each.name_full) for home, each in _all()}

    def __enter__(self) -> Kept:
        self._folder = tempfile.TemporaryDirectory(prefix="rtb-spare-")
        self._spare = Path(self._folder.name) / "spare.blend"
        whole = {each for home, each in _all() if home != "scenes" and each.library is None}
        bpy.data.libraries.write(str(self._spare), whole)
        return self

    def __exit__(self, kind: type | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self._folder.cleanup()

    def give_back(self) -> None:
        """Let everything be as it was, or say in one sentence what cannot."""
        self._remove_what_came()
        if lost := self._lost():
            self._replace(lost)
            self._refuse(self._lost())
        if left := self._write_back():
            self._replace(left)
            self._refuse(self._write_back())
        _show_layers(self._seen, self._datablocks)

    def _lost(self) -> set[int]:
        return {number for number, each in self._datablocks.items() if not _is_alive(each)}

    def _refuse(self, left: set[int]) -> None:
        if left:
            names = ", ".join(sorted(self._homes[each][1] for each in left))
            raise RecipeError(f"what was done to {names} cannot be taken back, load the .blend file again")

    def _remove_what_came(self) -> None:
        came = [each for _, each in _all() if each.session_uid not in self._values]
        known = {each.session_uid for each in self._datablocks.values() if _is_alive(each)}
        bpy.data.batch_remove([each for each in came if each.session_uid not in known])

    def _write_back(self) -> set[int]:
        """Write what differs, as often as one value brings others along; return what still differs."""
        for _ in range(_MOST_PASSES):
            differences = dict(self._differences())
            if not differences:
                return set()
            for number, changes in differences.items():
                for where, value in changes:
                    try:
                        write_value(self._datablocks[number], where, value, self._datablocks)
                    except (AttributeError, TypeError, ValueError, RuntimeError, LookupError):
                        continue  # there is nothing there any more; the next look says whether it matters
                self._datablocks[number].update_tag()
        return {number for number, _ in self._differences()}

    def _differences(self) -> Iterator[tuple[int, list[tuple[tuple, Any]]]]:
        for number, wanted in self._values.items():
            found = values_of(self._datablocks[number], self._numbers)
            changes = [each for each in wanted.items() if not is_same(found.get(each[0], GONE), each[1])]
            changes += [(where, GONE) for where in found if where not in wanted and where[-1][0] == "key"]
            if changes:
                # The frame first: it writes what is animated.
                yield number, sorted(changes, key=lambda each: each[0] != ("frame_current",))

    def _replace(self, numbers: set[int]) -> None:
        """Put datablocks from the spare in the place of those that lost something."""
        spares = self._load_spare()
        for number, (home, name) in self._homes.items():
            if (spare := spares.get((home, name))) is None:  # a scene, or of a library
                continue
            old = self._datablocks[number]
            if number not in numbers:
                spare.user_remap(old)
                continue
            if _is_alive(old):
                old.user_remap(spare)
                bpy.data.batch_remove([old])
            self._datablocks[number] = spare
            self._numbers[spare.session_uid] = number
            spare.name = name
        kept = {each.session_uid for each in self._datablocks.values() if _is_alive(each)}
        bpy.data.batch_remove([each for each in spares.values() if each.session_uid not in kept])

    def _load_spare(self) -> dict[tuple[str, str], Any]:
        """Return the datablocks of the spare, by kind and name."""
        names = {}
        with bpy.data.libraries.load(str(self._spare), link=False) as (there, wanted):
            for home in {home for home, _ in self._homes.values()} & set(dir(there)):
                names[home] = list(getattr(there, home))
                setattr(wanted, home, list(names[home]))
        return {
            (home, name): loaded
            for home, known in names.items()
            for name, loaded in zip(known, getattr(wanted, home), strict=True)
            if loaded is not None
        }


def _all() -> Iterator[tuple[str, Any]]:
    """Yield the datablocks that decide how a scene looks, with the names of their lists in bpy.data."""
    for prop in bpy.data.bl_rna.properties:
        if prop.type != "COLLECTION" or prop.identifier in _LEFT_OUT:
            continue
        for each in getattr(bpy.data, prop.identifier):
            if getattr(each, "type", "") not in _PICTURES_OF_BLENDER:
                yield prop.identifier, each


def _is_alive(datablock) -> bool:
    try:
        return bool(datablock.session_uid)
    except ReferenceError:
        return False


def _layers() -> list[tuple[int, str, int | None, dict[int, tuple[bool, bool]]]]:
    """Return what is selected, hidden and active in each view layer."""
    found = []
    for scene in bpy.data.scenes:
        for layer in scene.view_layers:
            active = layer.objects.active
            state = {
                each.session_uid: (each.select_get(view_layer=layer), each.hide_get(view_layer=layer))
                for each in layer.objects
            }
            found.append((scene.session_uid, layer.name, active and active.session_uid, state))
    return found


def _show_layers(seen, datablocks) -> None:
    for scene, name, active, state in seen:
        layer = datablocks[scene].view_layers[name]
        for number, (selected, hidden) in state.items():
            object_ = datablocks[number]
            if object_.hide_get(view_layer=layer) != hidden:
                object_.hide_set(hidden, view_layer=layer)
            if object_.select_get(view_layer=layer) != selected:
                object_.select_set(selected, view_layer=layer)
        if layer.objects.active != (wanted := datablocks.get(active)):
            layer.objects.active = wanted
