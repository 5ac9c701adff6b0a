"""What a finding speaks of, selected and shown."""

import bpy

from ..rtb_addon.errors import RecipeError
from . import row_states
from .table_verbs import TableVerb

_KINDS = [
    (each.upper(), each.title(), "", number)
    for number, each in enumerate(("object", "material", "light", "world", "condition", "mapping", "line"), 1)
]
_TABS = {"object": "OBJECT", "material": "MATERIAL", "light": "DATA", "world": "WORLD"}


class RTB_OT_select_culprit(TableVerb, bpy.types.Operator):
    """Select what this finding speaks of"""

    bl_idname = "rtb.select_culprit"
    bl_label = "Select"
    bl_options = {"REGISTER", "UNDO", "INTERNAL"}

    kind: bpy.props.EnumProperty(name="Kind", items=_KINDS)
    name: bpy.props.StringProperty(name="Name")

    def edit(self, context):
        kind = self.kind.lower()
        if kind == "line":
            bpy.ops.rtb.edit_mappings_text(line=int(self.name))
        elif kind == "mapping":
            context.scene.rtb.active_mapping = int(self.name)
        elif kind == "condition":
            _choose_row(context.scene, self.name)
        else:
            _select(context, kind, self.name)
            _show_tab(context, _TABS[kind])


def _choose_row(scene, name: str) -> None:
    for number, row in enumerate(scene.rtb.conditions):
        if row_states.row_name(scene, row, number) == name:
            scene.rtb.active_condition = number
            return
    raise RecipeError(f"no condition is called {name} any more")


def _select(context, kind: str, name: str) -> None:
    """Select the object that is meant, or that has what is meant."""
    if kind == "world":
        return
    from .culprits import HOMES  # enabling need not wait for it

    thing = getattr(bpy.data, HOMES[kind]).get(name)
    users = [each for each in context.view_layer.objects if _uses(each, kind, thing)] if thing else []
    if not users:
        raise RecipeError(f"no object of this view layer is or has the {kind} {name}")
    for each in context.view_layer.objects:
        each.select_set(each == users[0])
    context.view_layer.objects.active = users[0]
    if kind == "material":
        slots = [slot.material for slot in users[0].material_slots]
        users[0].active_material_index = slots.index(thing)


def _uses(object_, kind: str, thing) -> bool:
    if kind == "object":
        return object_ == thing
    if kind == "light":
        return object_.data == thing
    return any(slot.material == thing for slot in object_.material_slots)


def _show_tab(context, tab: str) -> None:
    """Turn the properties, where they are open, to what is to be seen."""
    for area in context.window.screen.areas if context.window is not None and not bpy.app.background else ():
        if area.type == "PROPERTIES":
            try:
                area.spaces.active.context = tab
            except TypeError:
                continue  # the tabs are those of the object that was active before
