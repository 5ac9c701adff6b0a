"""What a datablock of Blender holds, as plain values by where they stand in it."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from typing import Any

import bpy

# A way from a datablock to a value: names of properties, indices, ("key", name) for a custom property,
# ("each", name) for one property of all items of a long list.
Where = tuple[Any, ...]

UNSET, DATABLOCK, _FLAG = "<not set>", "<datablock>", "<flag>"
GONE = "<was not there>"
# Computed from what else is kept, or told twice, or the interface's.
_DERIVED = {
    "*": {
        *("rna_type", "original", "preview", "depsgraph", "session_uid", "is_evaluated"),
        "library_weak_reference",
    },
    "Object": {"matrix_world", "matrix_local", "matrix_basis", "dimensions", "motion_path"},
    "Camera": {"angle", "angle_x", "angle_y", "fov"},
    "Image": {"pixels", "packed_files"},
    "Scene": {"objects", "frame_float", "frame_current_final", "cursor"},
    "PoseBone": {"matrix", "matrix_basis"},
    "Mesh": {
        *("edges", "loops", "uv_layers", "vertex_colors", "color_attributes", "vertex_normals"),
        *("uv_layer_clone", "uv_layer_stencil", "uv_layer_clone_index", "uv_layer_stencil_index"),
        *("polygon_normals", "corner_normals", "loop_triangles", "loop_triangle_polygons"),
    },
    "Collection": {"all_objects"},
    "FCurve": {"group"},
    "Key": {"reference_key"},
    "ShapeKey": {"points"},
    "SceneDisplay": {"shading"},
    "ImageFormatSettings": {"linear_colorspace_settings"},
    "Node": {"internal_links", "dimensions"},
    "NodeSocket": {"links"},
}
TYPES = {"FLOAT": "float32", "INT": "int32", "BOOLEAN": "bool", "ENUM": "int32"}


def values_of(datablock, numbers: Mapping[int, int]) -> dict[Where, Any]:
    """
    Return all that can be written in a datablock; other datablocks by their number in the session.

    Parameters
    ----------
    numbers : of datablocks that stand in the place of others, whose numbers they get
    """
    reader = _Reader(datablock, numbers)
    reader.read(datablock, ())
    return reader.found


class _Reader:
    """Reads one datablock; what was visited is not read again on another way."""

    def __init__(self, owner, numbers: Mapping[int, int]) -> None:
        self.owner, self.numbers = owner, numbers
        self.found: dict[Where, Any] = {}
        self.visited: set[tuple[int, str]] = set()

    def read(self, struct, where: Where) -> None:
        key = (struct.as_pointer(), struct.bl_rna.identifier)
        if key in self.visited:
            return
        self.visited.add(key)
        for prop in _properties(type(struct)):
            self._property(struct, prop, (*where, prop.identifier))
        self._custom(struct, where)

    def _property(self, struct, prop, where: Where) -> None:
        if prop.identifier.startswith("texspace_") and getattr(struct, "use_auto_texspace", False):
            return  # Blender's own, whenever it likes
        if prop.type == "COLLECTION":
            self._list(getattr(struct, prop.identifier), prop, where)
        elif prop.type == "POINTER":
            self._pointer(getattr(struct, prop.identifier), prop, where)
        elif not prop.is_readonly:
            if isinstance(struct, bpy.types.PropertyGroup) and not struct.is_property_set(prop.identifier):
                self.found[where] = UNSET
            else:
                self.found[where] = self._plain(getattr(struct, prop.identifier))

    def _pointer(self, value, prop, where: Where) -> None:
        if prop.identifier.startswith("active"):  # stands in a list as well
            return
        if value is None:
            self.found[where] = None
        elif isinstance(value, bpy.types.Key) or getattr(value, "is_embedded_data", False):
            owner, self.owner = self.owner, value
            self.read(value, where)
            self.owner = owner
        elif isinstance(value, bpy.types.ID):
            if not prop.is_readonly:
                self.found[where] = self._plain(value)
        elif value.id_data == self.owner:  # nothing that belongs to somebody else
            self.read(value, where)

    def _list(self, items, prop, where: Where) -> None:
        if isinstance(items, bpy.types.bpy_prop_collection) and _of_datablocks(prop):
            if hasattr(items, "link") or hasattr(items, "append"):
                self.found[where] = tuple(self._plain(each) for each in items)
            return
        names = [getattr(each, "name", "") for each in items] if len(items) < _LONG else []
        self.found[(*where, ("items",))] = (len(items), *names)
        if not len(items) or items[0] is None:
            return
        if prop.identifier == "vertices" and isinstance(self.owner, bpy.types.Mesh):
            self._weights(items, where)
        elif (columns := _columns(items[0])) is not None:
            for each in columns:
                self._column(items, each, (*where, ("each", each.identifier)))
        else:
            for index, each in enumerate(items):
                if each is not None:
                    self.read(each, (*where, index))

    def _column(self, items, prop, where: Where) -> None:
        import numpy as np  # takes longer to come than enabling may last

        values = np.empty(len(items) * max(getattr(prop, "array_length", 0), 1), TYPES[prop.type])
        items.foreach_get(prop.identifier, values)
        self.found[where] = values.tobytes()

    def _weights(self, vertices, where: Where) -> None:
        users = (each for each in bpy.data.objects if each.data == self.owner)
        if any(each.vertex_groups for each in users):
            weights = tuple(tuple((g.group, g.weight) for g in each.groups) for each in vertices)
            self.found[(*where, ("weights",))] = weights

    def _custom(self, struct, where: Where) -> None:
        try:
            names = struct.keys()
        except (TypeError, AttributeError):
            return
        known = struct.bl_rna.properties
        custom = [name for name in names if name not in known]
        for name in custom:
            self.found[(*where, ("key", name))] = self._plain(struct[name])

    def _plain(self, value):
        """Return a value that keeps no reference into Blender and is the same only to the bit."""
        if isinstance(value, bpy.types.ID):
            return (DATABLOCK, self.numbers.get(value.session_uid, value.session_uid))
        if isinstance(value, (str, int, float, bool, bytes, type(None))):
            return value
        if isinstance(value, (set, frozenset)):
            return tuple((_FLAG, each) for each in sorted(value))
        if hasattr(value, "to_dict"):
            return {name: self._plain(each) for name, each in value.items()}
        if hasattr(value, "to_list"):
            return value.to_list()
        return tuple(self._plain(each) for each in value)


_LONG = 4096


def _of_datablocks(prop) -> bool:
    """Return whether a list's items are datablocks, which are kept for themselves."""
    kind = getattr(bpy.types, prop.fixed_type.identifier, None)
    return isinstance(kind, type) and issubclass(kind, bpy.types.ID)


@cache
def _properties(kind: type) -> list:
    """Return the properties of a type that say something that no other one says."""
    skipped = set().union(_DERIVED["*"], *(_DERIVED.get(each.__name__, ()) for each in kind.__mro__))
    return [each for each in kind.bl_rna.properties if each.identifier not in skipped]


def forget_types() -> None:
    """Forget which properties types have; extensions may have come and gone."""
    _properties.cache_clear()


def is_same(one, other) -> bool:
    """Return whether two kept values are the same to the bit."""
    if one is other or isinstance(one, (bytes, str)):
        return one == other
    return repr(one) == repr(other)  # tells -0.0 from 0.0, and 1 from True


def _columns(item):
    """Return the properties of a list's items where they are nothing but numbers, else None."""
    if isinstance(item, (bpy.types.PropertyGroup, bpy.types.ID)):
        return None
    found = []
    for prop in item.bl_rna.properties:
        if prop.identifier == "rna_type":
            continue
        if prop.type in ("COLLECTION", "POINTER", "STRING"):
            return None
        if getattr(prop, "is_enum_flag", False):
            return None
        if not prop.is_readonly and prop.identifier != "vertices":  # a face's corners: as many as it has
            found.append(prop)
    return found
