"""A scene as it is to be rendered in each condition, looked at one condition after the other."""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass

import bpy

from ..conditions import Condition
from ..errors import RecipeError
from .baked import PARENT_COLUMNS, Remodel, at_condition, baked
from .conditions import IMAGE_NAME
from .evaluation import as_rendered
from .mapped import set_for, values_for
from .parent import Parent, ParentWriter
from .places import set_value, subject_of
from .seen import Seen, seen_in
from .table import Table


@dataclass(frozen=True)
class Look:
    """A scene at one time: its parent scene, the name of its camera, and remarks."""

    parent: Parent
    camera: str
    remarks: tuple[str, ...]


def looks_in_steps(scene, table: Table) -> Generator[float, None, list[Look]]:
    """
    Return the scene once, or as the properties that conditions set make it for each of them.

    Yields how much is done, 0 to 1; the scene is as before whenever it does.
    """
    if not len(scene.rtb.mappings):
        return [look_at(scene)]
    if not table.names:
        raise RecipeError(f"{subject_of(scene.rtb.mappings[0])} varies, but there are no conditions: add one")
    looks: dict[str, Look] = {}
    found = []
    for name, cells in zip(table.names, table.typed, strict=True):
        with at_condition(name):
            values = repr([value for _, value in values_for(scene.rtb, cells)])
            if values not in looks:
                with set_for(scene.rtb, cells):
                    looks[values] = look_at(scene)
        found.append(looks[values])
        yield len(found) / len(table.names)
    return found


def remodeled_looks(scene, table: Table, remodel: Remodel) -> list[Look]:
    """Return the scene as a function remodels it for each condition, after what mappings set."""
    if not table.names:
        raise RecipeError("there are no conditions to remodel the scene for, add one")
    if own := [each for each in PARENT_COLUMNS if each in table.variables]:
        raise RecipeError(f"the column {own[0]} is written from what the function does, take it out")
    rows = zip(table.names, table.typed, strict=True)
    conditions = [Condition(name, {IMAGE_NAME: name, **cells}, 0) for name, cells in rows]
    known: dict[bytes, bytes] = {}  # parents that are the same take their room in memory once

    def both(scene, condition) -> None:
        for place, value in values_for(scene.rtb, condition.cells):
            set_value(place, value)
        remodel(scene, condition)

    def look() -> Look:
        found = look_at(scene)
        found.parent.content = known.setdefault(found.parent.content, found.parent.content)
        return found

    return baked(scene, conditions, both, look)


def look_at(scene) -> Look:
    """Return the scene as it is now."""
    if scene.camera is None:
        raise RecipeError(f"the scene {scene.name} has no camera, add one")
    return look_of(scene, as_rendered(scene, seen_in))


def look_of(scene, seen: Seen) -> Look:
    """Return a scene as an engine has been shown it."""
    parent = ParentWriter(seen, scene.name, f"RenderToolbox in Blender {bpy.app.version_string}").write()
    if not any(each.category == "light" for each in parent.statements):
        raise RecipeError(f"the scene {scene.name} has no light, add a lamp or let a mesh or the world shine")
    return Look(parent, scene.camera.name_full, tuple(seen.remarks))
