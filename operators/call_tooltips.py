"""Every button's tooltip says how a script does the same."""

from __future__ import annotations


def describe(cls, context, properties) -> str:
    """Return what an operator does, and its call with what the button sets."""
    names = (each.identifier for each in properties.bl_rna.properties if each.identifier != "rna_type")
    said = [
        f"{name}={_plain(getattr(properties, name))!r}" for name in names if properties.is_property_set(name)
    ]
    does = cls.does(context, properties) if hasattr(cls, "does") else cls.__doc__
    return f"{does}.\n\nPython: bpy.ops.{cls.bl_idname}({', '.join(said)})"


def add_to(classes) -> None:
    """Let the tooltips of some operators say their calls."""
    for each in classes:
        if hasattr(each, "execute"):
            each.description = classmethod(describe)


def _plain(value):
    return tuple(value) if hasattr(value, "to_list") or hasattr(value, "foreach_get") else value
