"""What properties and datablocks are called in sentences: Location Z of the object Lamp."""

from __future__ import annotations

import bpy

from .places import found_at

_AXES = {"COLOR": "RGBA", "COLOR_GAMMA": "RGBA", "QUATERNION": "WXYZ", "AXISANGLE": "WXYZ"}


def subject(thing, path: str, index: int) -> str:
    """Return what a property is called: Location Z of the object Lamp."""
    place = found_at(thing, path, index, path)
    name = place.name.replace("_", " ") if place.kind is None else place.kind.name
    if index >= 0:
        letters = _AXES.get(getattr(place.kind, "subtype", ""), "XYZW")
        name = f"{name} {letters[index]}" if index < len(letters) else f"{name} {index + 1}"
    inner = getattr(place.owner, "name", "") if place.owner != thing else ""
    part = f" of {inner}" if inner and inner != thing.name else ""
    return f"{name}{part} of the {thing_word(thing)} {thing.name}"


def thing_word(thing) -> str:
    """Return what a datablock is, in small letters: object, light, camera."""
    kinds = {"Key": "shapes", "ShaderNodeTree": "nodes", "GeometryNodeTree": "nodes"}
    for kind in ("Object", "Light", "Camera", "Material", "World", "Mesh", "Scene"):
        if isinstance(thing, getattr(bpy.types, kind)):
            return kind.lower()
    name = type(thing).__name__
    return kinds.get(name, name.lower())
