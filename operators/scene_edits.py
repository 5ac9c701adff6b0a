"""
How many times the open file has been edited, as far as Blender tells: whether something may render otherwise.

What only looks (a selection, the preview of a condition, an export) does not count, nor does the table, whose
cells are compared one by one.
"""

from __future__ import annotations

import bpy

from ..rtb_addon.blender import own_changes
from ..rtb_addon.blender.table_properties import RTB_PG_mapping

# Blender evaluates these again after a mere look, too.
_TOUCHED_BY_LOOKS = ("Scene", "Collection", "ViewLayer")

count = 0
_owner = object()  # of what is listened to


def note() -> None:
    """Count an edit that Blender does not tell of: what an operator writes into our own properties."""
    global count
    count += 1


@bpy.app.handlers.persistent
def _evaluated(scene, depsgraph) -> None:
    """Count what Blender has evaluated anew, if it is more than a look."""
    if any(_is_edit(each) for each in depsgraph.updates) and not own_changes.come_now():
        note()


def _is_edit(update) -> bool:
    kind = type(update.id).__name__
    if kind in _TOUCHED_BY_LOOKS:
        return False
    if kind == "Object":  # its shading alone is evaluated again whenever somebody looks
        return update.is_updated_transform or update.is_updated_geometry
    return True


def listen() -> None:
    """Hear of mappings, which belong to the scene as the table does; to be called for each file anew."""
    bpy.msgbus.clear_by_owner(_owner)
    bpy.msgbus.subscribe_rna(key=RTB_PG_mapping, owner=_owner, args=(), notify=note)


def register() -> None:
    """Count edits."""
    bpy.app.handlers.depsgraph_update_post.append(_evaluated)
    listen()


def unregister() -> None:
    """Count no more."""
    bpy.app.handlers.depsgraph_update_post.remove(_evaluated)
    bpy.msgbus.clear_by_owner(_owner)
