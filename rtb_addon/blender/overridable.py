"""Blender's properties, of a kind that may be changed in a library override of a linked thing."""

from __future__ import annotations

from functools import partial

from bpy import props

_OVERRIDABLE = {"LIBRARY_OVERRIDABLE"}

BoolProperty = partial(props.BoolProperty, override=_OVERRIDABLE)
EnumProperty = partial(props.EnumProperty, override=_OVERRIDABLE)
FloatProperty = partial(props.FloatProperty, override=_OVERRIDABLE)
FloatVectorProperty = partial(props.FloatVectorProperty, override=_OVERRIDABLE)
PointerProperty = partial(props.PointerProperty, override=_OVERRIDABLE)
StringProperty = partial(props.StringProperty, override=_OVERRIDABLE)
