"""A layout that draws nothing and notes what it is asked to draw, for panels without a window."""

from __future__ import annotations

import bpy


class RecordingLayout:
    """
    Stands in for a panel's layout; complains about properties and operators that are not there.

    Parameters
    ----------
    drawn : one (kind, name) for everything drawn, shared by all rows and columns of a layout
    """

    def __init__(self, drawn: list | None = None) -> None:
        self.drawn = [] if drawn is None else drawn

    def row(self, **_):
        return RecordingLayout(self.drawn)

    column = box = grid_flow = split = row

    def panel(self, name: str, **_):
        return self.row(), self.row()

    def prop(self, owner, name: str, **_) -> None:
        assert name in owner.bl_rna.properties, f"{owner} has no {name}"
        self.drawn.append(("prop", name))

    def operator(self, name: str, text: str | None = None, **_):
        operator = getattr(getattr(bpy.ops, name.split(".")[0]), name.split(".")[1])
        operator.get_rna_type()  # raises for an operator that is not there
        self.drawn.append(("operator", name))
        return type("Properties", (), {})()

    prop_menu_enum = prop

    def popover(self, panel: str, **_) -> None:
        assert hasattr(bpy.types, panel), f"there is no panel {panel}"
        self.drawn.append(("popover", panel))

    def context_string_set(self, name: str, value: str) -> None:
        self.drawn.append(("context", f"{name}={value}"))

    def operator_menu_enum(self, name: str, choice: str, **_) -> None:
        self.operator(name)
        kind = getattr(getattr(bpy.ops, name.split(".")[0]), name.split(".")[1]).get_rna_type()
        assert choice in kind.properties

    def prop_search(self, owner, name: str, listed, listed_name: str, **_) -> None:
        assert listed_name in listed.bl_rna.properties
        self.prop(owner, name)

    def menu(self, name: str, **_) -> None:
        assert hasattr(bpy.types, name), f"there is no menu {name}"
        self.drawn.append(("menu", name))

    def template_list(self, kind: str, _, owner, listed: str, active_owner, active: str, **__) -> None:
        assert hasattr(bpy.types, kind), f"there is no list {kind}"
        assert listed in owner.bl_rna.properties
        assert active in active_owner.bl_rna.properties
        self.drawn.append(("list", kind))

    def template_ID(self, owner, name: str, **_) -> None:  # noqa: N802  Blender calls it that
        assert name in owner.bl_rna.properties, f"{owner} has no {name}"
        self.drawn.append(("prop", name))

    def template_icon(self, icon_value: int, scale: float) -> None:
        assert icon_value >= 0
        self.drawn.append(("icon", icon_value))

    def label(self, text: str = "", **_) -> None:
        self.drawn.append(("label", text))

    def progress(self, factor: float = 0.0, text: str = "", **_) -> None:
        assert 0.0 <= factor <= 1.0
        self.drawn.append(("progress", text))

    def separator(self, **_) -> None:
        self.drawn.append(("separator", ""))

    def names(self, kind: str) -> list[str]:
        """Return the names of what was drawn of a kind."""
        return [name for drawn, name in self.drawn if drawn == kind]
