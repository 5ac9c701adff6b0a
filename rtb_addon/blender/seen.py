"""Everything of an evaluated scene that ends up in the parent scene, in plain arrays and texts."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np

from ..errors import RecipeError
from ..scene.collada.ids import Ids
from ..scene.collada.write_numbers import shortest
from ..scene.placement import Placement
from ..scene.surface import Surface
from ..spectra import FloatArray, Unit
from . import lights
from .cameras import View, lens_of, not_round, view_of
from .folders import typed
from .lamps import Lamp, read_lamp
from .materials import Paint, parts_of, read_material
from .meshes import surface_of
from .placements import own_placement
from .properties import rendered_size
from .statements import Spoken
from .worlds import Sky, read_world

# Objects that hold something to render, but nothing that can be written as triangles.
_UNKNOWN = {
    "CURVES": "hair",
    "VOLUME": "a volume",
    "POINTCLOUD": "a point cloud",
    "GREASEPENCIL": "a drawing",
}
# Blender's switches that let only some rays see an object.
_RAYS = ("visible_camera", "visible_diffuse", "visible_glossy", "visible_transmission", "visible_shadow")
_SLOT = "slot"


@dataclass(frozen=True)
class Emission:
    """What a mesh sends out: a spectrum as typed, times an amount of radiance, watts, lumens or cd/m2."""

    spectrum: str
    measure: Literal["radiance", "watts", "lumens", "nits"]
    amount: float

    def spoken(self, name: str, area: float) -> Spoken:
        """Return the radiance of a surface of an area [m2]."""
        owner = f"the object {name}"
        if self.measure == "radiance":
            return Spoken(self.spectrum, owner, Unit.RADIANCE, self.amount)
        if self.measure == "nits":
            return Spoken(self.spectrum, owner, Unit.RADIANCE, 1.0, lumens=self.amount)
        if self.measure == "lumens":
            return Spoken(self.spectrum, owner, Unit.RADIANCE, lights.area_radiance(area), lumens=self.amount)
        return Spoken(self.spectrum, owner, Unit.RADIANCE, lights.area_radiance(area), self.amount)


@dataclass(frozen=True, eq=False)
class Body:
    """
    A surface that objects may share.

    Parameters
    ----------
    name : of its data in Blender
    materials : names of its own, by slot
    slots : those that have faces
    """

    name: str
    surface: Surface
    materials: tuple[str, ...]
    slots: tuple[int, ...]


@dataclass(frozen=True, eq=False)
class Node:
    """
    An object, or an instance of one.

    Parameters
    ----------
    key : tells it from all others; parent is the key of what it stands relative to
    own : location, rotation and scale as the object itself has them
    as_matrix : whether its place is written as one matrix
    content : key of a body, lamp or camera
    materials : names of this object's for those slots of its body that have faces
    """

    key: str
    name: str
    parent: str | None
    to_world: FloatArray
    own: Placement | None
    kind: Literal["empty", "body", "lamp", "camera"] = "empty"
    content: object = None
    materials: Mapping[int, str] = field(default_factory=dict)
    emission: Emission | None = None
    as_matrix: bool = False


@dataclass
class Seen:
    """What has been seen of a scene, each thing once."""

    meter: float
    nodes: dict[str, Node] = field(default_factory=dict)
    bodies: dict[object, Body] = field(default_factory=dict)
    lamps: dict[str, Lamp] = field(default_factory=dict)
    views: dict[str, View] = field(default_factory=dict)
    paints: dict[str, Paint] = field(default_factory=dict)
    world: Sky | None = None
    remarks: list[str] = field(default_factory=list)


def seen_in(depsgraph) -> Seen:
    """Return what an evaluated scene shows."""
    scene = depsgraph.scene
    units = scene.unit_settings
    seen = Seen(1.0 if units.system == "NONE" else shortest(units.scale_length))
    for instance in depsgraph.object_instances:
        _look(seen, instance, depsgraph)
    seen.world, remarks = read_world(scene.world)
    for source in (*seen.paints.values(), *seen.lamps.values()):
        seen.remarks.extend(source.remarks)
    seen.remarks.extend(remarks)
    return seen


def _look(seen: Seen, instance, depsgraph) -> None:
    object_ = instance.object
    name = object_.name_full
    to_world = np.array(instance.matrix_world, float)
    content = _content(seen, object_, depsgraph) if instance.show_self or instance.is_instance else {}
    if not instance.is_instance:
        above = None if object_.parent is None else object_.parent.name_full
        own, whole = own_placement(object_), object_.rtb.as_matrix
        seen.nodes[name] = Node(name, name, above, to_world, own, as_matrix=whole, **content)
        return
    above = instance.parent.name_full
    if not content:
        return
    if name == above and _is_free(seen, above, to_world):  # the triangles of a curve, a text, a metaball
        seen.nodes[above] = replace(seen.nodes[above], **content)
        return
    key = f"{above}\n{len(seen.nodes)}"
    seen.nodes[key] = Node(key, f"{above}_{name}", above, to_world, None, **content)


def _is_free(seen: Seen, name: str, to_world: FloatArray) -> bool:
    """Return whether the node of an object shows nothing yet and stands in a place."""
    node = seen.nodes.get(name)
    return node is not None and node.kind == "empty" and np.array_equal(node.to_world, to_world)


def _content(seen: Seen, object_, depsgraph) -> dict:
    """Return what a node of an object shows, as arguments of Node."""
    if object_.type == "LIGHT":
        name = object_.data.name_full
        if name not in seen.lamps:
            seen.lamps[name] = read_lamp(object_.data, seen.meter)
        return {"kind": "lamp", "content": name}
    if object_.type == "CAMERA":
        return {"kind": "camera", "content": _camera(seen, object_, depsgraph.scene)}
    if object_.type == "MESH":
        return _body(seen, object_, depsgraph.view_layer_eval.material_override)
    if object_.type in _UNKNOWN:
        what = _UNKNOWN[object_.type]
        seen.remarks.append(f"the object {object_.name_full} is {what} and left out: make it a mesh")
    return {}


def _camera(seen: Seen, object_, scene) -> str:
    camera = object_.data
    if camera.name_full not in seen.views:
        view = view_of(camera, scene.render, rendered_size(scene), object_.name_full)
        lens = lens_of(camera, np.array(object_.matrix_world, float))
        seen.views[camera.name_full] = replace(view, lens=lens)
        seen.remarks.extend(f"the camera {object_.name_full} {clause}" for clause in not_round(camera))
    return camera.name_full


def _body(seen: Seen, object_, override) -> dict:
    """Return the surface of an object, shared with those that have the same evaluated mesh."""
    mesh = object_.data
    key = mesh.as_pointer()
    if key not in seen.bodies:
        own = tuple(_name(each) for each in mesh.materials)
        surface = surface_of(mesh, _symbols(own))
        if surface is None:
            return {}
        slots = tuple(np.unique(surface.parts).tolist())
        seen.bodies[key] = Body(object_.original.data.name_full, surface, own, slots)
    if not all(getattr(object_, name) for name in _RAYS):
        seen.remarks.append(f"the object {object_.name_full} is visible to all light, not only to some rays")
    body = seen.bodies[key]
    materials = {slot: _material(seen, object_, slot, override) for slot in body.slots}
    return {"kind": "body", "content": key, "materials": materials, "emission": _emission(object_)}


def _symbols(materials: tuple[str, ...]) -> tuple[str, ...]:
    """Return a name for each material slot that no other slot of the mesh has."""
    ids = Ids()
    return tuple(ids.take(name or _SLOT, "-material") for name in materials or ("",))


def _material(seen: Seen, object_, slot: int, override) -> str:
    """Return the name of the material of an object's slot, which is then known."""
    slots, own = object_.material_slots, object_.data.materials
    material = override
    if material is None and slot < len(slots) and slots[slot].link == "OBJECT":
        material = slots[slot].material
    elif material is None and slot < len(own):
        material = own[slot]
    if material is None:
        where = f"in slot {slot + 1}" if len(own) > 1 else "give it one"
        raise RecipeError(f"the object {object_.name_full} has no material, {where}")
    _know(seen, material)
    return material.name_full


def _know(seen: Seen, material) -> None:
    """Read a material and those that it is made of."""
    if material.name_full not in seen.paints:
        seen.paints[material.name_full] = read_material(material, seen.meter)
        for part in parts_of(material):
            _know(seen, part)


def _emission(object_) -> Emission | None:
    settings = object_.rtb
    if not settings.emits:
        return None
    return Emission(typed(settings.spectrum, object_), settings.emission, settings.amount)


def _name(material) -> str:
    return "" if material is None else material.name_full
