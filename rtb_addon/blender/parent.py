"""What has been seen of a scene, written as a parent scene with the statements that its mappings make."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ..scene import primitives
from ..scene.collada import write_libraries
from ..scene.parent_document import ParentDocument
from ..scene.placement import UNMOVED, Placement, placement_of
from ..scene.surface import Corners, Surface
from ..spectra import FloatArray
from . import lights
from .cameras import View
from .lamps import Lamp
from .materials import LAMP_BLACK, Paint
from .seen import Node, Seen
from .statements import Statement
from .surfaces import statements
from .worlds import Sky

_ELLIPSES = ("DISK", "ELLIPSE")
_DOWN = np.array([1, -1, -1], np.float32)


@dataclass
class Parent:
    """
    A parent scene.

    Parameters
    ----------
    content : Collada 1.4.1
    statements : about its materials and lights
    cameras : ids of the nodes that hold cameras, by the names of their objects
    """

    content: bytes = b""
    statements: list[Statement] = field(default_factory=list)
    cameras: dict[str, str] = field(default_factory=dict)


class ParentWriter:
    """Writes one parent scene; ids are known for what has been written."""

    def __init__(self, seen: Seen, scene: str, tool: str) -> None:
        self.seen, self.parent = seen, Parent()
        self.document = ParentDocument(scene, seen.meter, tool)
        self._ids: dict[tuple[str, object], str] = {}
        self._reserve()

    def write(self) -> Parent:
        """Return the parent scene."""
        for node in self.seen.nodes.values():
            self._node(node)
        if self.seen.world is not None:
            self._sky(self.seen.world)
        self.parent.content = self.document.tobytes()
        return self.parent

    def _reserve(self) -> None:
        """Let names that are ids already keep them, whoever comes first."""
        seen, ids = self.seen, self.document.ids
        ids.reserve(node.name for node in seen.nodes.values() if node.key == node.name)
        ids.reserve({body.name for body in seen.bodies.values()}, "-mesh")
        for names, suffix in ((seen.lamps, "-light"), (seen.views, "-camera")):
            ids.reserve(names, suffix)
        for suffix in ("-material", "-effect"):
            ids.reserve(seen.paints, suffix)

    def _node(self, node: Node) -> str:
        """Write a node, what it stands relative to first, and return its id."""
        if ("node", node.key) in self._ids:
            return self._ids["node", node.key]
        above = self._above(node)
        parent = None if above is None else self._node(above)
        local = node.to_world if above is None else np.linalg.solve(above.to_world, node.to_world)
        where = local if node.as_matrix else _placement(local, node.own)
        id = self._ids["node", node.key] = self.document.node(node.name, where, parent)
        fill = {"body": self._body, "lamp": self._lamp, "camera": self._camera}.get(node.kind)
        if fill is not None:
            fill(id, node)
        return id

    def _above(self, node: Node) -> Node | None:
        """Return what a node stands relative to: the nearest one above that is not scaled to nothing."""
        above = self.seen.nodes.get(node.parent or "")
        while above is not None and np.linalg.det(above.to_world) == 0:
            above = self.seen.nodes.get(above.parent or "")
        return above

    def _body(self, id: str, node: Node) -> None:
        """Write a surface, one geometry for each radiance that it has somewhere."""
        body = self.seen.bodies[node.content]
        radiance = None
        if node.emission is not None:
            area = surface_area(body.surface, node.to_world) * self.seen.meter**2
            radiance = node.emission.spoken(node.name, area)
        key = (node.content, None if radiance is None else radiance.treatment)
        geometry = self._once("body", key, lambda: self.document.geometry(body.name, body.surface))
        bound = {
            body.surface.symbols[slot]: self._paint(self.seen.paints[name])
            for slot, name in node.materials.items()
        }
        self.document.use_geometry(id, geometry, bound)
        if radiance is not None:
            self._say(Statement(geometry, node.name, "light", "area", {"intensity": radiance}, {}))

    def _lamp(self, id: str, node: Node) -> None:
        lamp = self.seen.lamps[str(node.content)]
        if lamp.kind == "area":
            self._area_lamp(id, node, lamp)
            return
        cone, blend = lamp.numbers.get("cone", 0.0), lamp.numbers.get("blend", 0.0)
        made = self._once(
            "lamp", lamp.name, lambda: self.document.lamp(lamp.name, lamp.kind, lamp.shown, cone, blend)
        )
        self.document.use_lamp(id, made)
        self._say(lamp.statement(made))

    def _sky(self, sky: Sky) -> None:
        """Say what comes from all around; what is turned stands in the scene as a lamp that turns with it."""
        if sky.stands:
            id = self.document.lamp("World", "ambient", (0.0, 0.0, 0.0))
            self.document.use_lamp(self.document.node("World", Placement(rotation=sky.rotation)), id)
        else:
            id = self.document.ids.take("World", "-light")
        if sky.radiance is None:
            self._say(Statement(id, "World", "light", "sunsky", {}, {"turbidity": sky.turbidity}))
            return
        words = {} if sky.picture is None else {"filename": sky.picture}
        self._say(Statement(id, "World", "light", "environment", {"intensity": sky.radiance}, {}, words))

    def _area_lamp(self, id: str, node: Node, lamp: Lamp) -> None:
        """Write an area lamp as a black surface that emits, one geometry for each size in the world."""
        across, along = (node.to_world[:3, axis] * self.seen.meter for axis in (0, 1))
        area = lights.area_of(lamp.shape, *lamp.size) * float(np.linalg.norm(np.cross(across, along)))
        if area <= 0:
            self.seen.remarks.append(f"the light {lamp.name} has no area and is off")
            return
        black = self._paint(LAMP_BLACK)
        surface = lamp_surface(lamp.shape, lamp.size, black)
        width, height = (
            float(np.linalg.norm(each)) * size for each, size in zip((across, along), lamp.size, strict=True)
        )
        key = (lamp.name, f"{area:.6e}", f"{width:.6e}")
        geometry = self._once("area", key, lambda: self.document.geometry(lamp.name, surface))
        self.document.use_geometry(id, geometry, {black: black})
        self._say(lamp.statement(geometry, lamp.area_factor(width, height, area)))

    def _camera(self, id: str, node: Node) -> None:
        name = str(node.content)
        view = self.seen.views[name]
        eye = self._once(
            "camera", name, lambda: self.document.eye(name, collada_view(view), view.shift, view.lens)
        )
        self.document.use_eye(id, eye)
        self.parent.cameras.setdefault(node.name, id)

    def _paint(self, paint: Paint) -> str:
        if ("paint", paint.name) not in self._ids:
            id = self._ids["paint", paint.name] = self.document.material(paint.name, paint.colour)
            for each in statements(paint, id, self.document.ids.take, self._part):
                self._say(each)
        return self._ids["paint", paint.name]

    def _part(self, name: str) -> str:
        return self._paint(self.seen.paints[name])

    def _once(self, kind: str, key: object, make) -> str:
        """Return the id of something, which is made the first time."""
        if (kind, key) not in self._ids:
            self._ids[kind, key] = make()
        return self._ids[kind, key]

    def _say(self, statement: Statement) -> None:
        if all(each.id != statement.id for each in self.parent.statements):
            self.parent.statements.append(statement)


def lamp_surface(shape: str, size: tuple[float, float], symbol: str) -> Surface:
    """Return the surface of an area lamp, which shines along -Z [scene units]."""
    up = primitives.disk(*size) if shape in _ELLIPSES else primitives.plane(*size)
    assert up.normals is not None
    normals = Corners(up.normals.values * _DOWN, up.normals.indices)
    return Surface(up.vertices * _DOWN, up.triangles, normals, up.uvs, symbols=(symbol,))


def surface_area(surface: Surface, matrix: FloatArray) -> float:
    """Return the area of a surface where a matrix puts it."""
    placed = surface.vertices.astype(float) @ matrix[:3, :3].T
    first, second, third = (placed[surface.triangles[:, k]] for k in range(3))
    return float(np.linalg.norm(np.cross(second - first, third - first), axis=1).sum() / 2)


def collada_view(view: View):
    """Return a view as Collada says it; the height too where pixels are not square."""
    square = abs(view.pixel_aspect - 1) < 1e-9
    if view.projection == "perspective":
        return write_libraries.perspective(view.xfov, view.aspect, view.clip, None if square else view.yfov)
    height = None if square else view.width / view.aspect
    return write_libraries.orthographic(view.width, view.aspect, view.clip, height)


def _placement(local: FloatArray, own: Placement | None) -> Placement | FloatArray:
    """Return a transform as the object has it, else as the matrix can be taken apart, else the matrix."""
    if own is not None and own.is_of(local):
        return own
    if np.array_equal(local, np.eye(4)):
        return UNMOVED
    return local if (found := placement_of(local)) is None else found
