"""
A parent scene in the making: materials, geometries, lamps, cameras and nodes, one by one.

What Blender's exporter called them is what they are called here: ``Name`` for a node, ``Name-mesh``,
``Name-light``, ``Name-camera``, ``Name-material``, ``Name-effect``. The same calls make the same bytes.
"""

from __future__ import annotations

from collections.abc import Mapping
from copy import deepcopy

from numpy.typing import ArrayLike

from .collada import write_document, write_libraries, write_meshes
from .collada.ids import Ids
from .collada.write_elements import Colour, Element, new
from .placement import UNMOVED, Placement
from .surface import Surface

# A Placement, or a (4, 4) matrix that acts on column vectors.
Where = Placement | ArrayLike

_LIBRARIES = ("cameras", "lights", "effects", "materials", "geometries")


class ParentDocument:
    """
    A Collada 1.4.1 document that grows; every verb returns the id of what it made.

    Parameters
    ----------
    name : of the scene
    meter : length of the scene's unit [m]
    tool : who writes it

    Attributes
    ----------
    ids : those that are taken; names can be reserved there
    """

    def __init__(self, name: str = "Scene", meter: float = 1.0, tool: str = "RenderToolbox") -> None:
        self.ids = Ids()
        self._head = write_document.asset(tool, meter)
        self._libraries: dict[str, list[Element]] = {name: [] for name in _LIBRARIES}
        self._scene = new("visual_scene", id=self.ids.take(name), name=name)
        self._texts = write_meshes.LongTexts()
        self._nodes: dict[str, Element] = {}
        self._used: dict[str, list[Element]] = {}
        self._with_uvs: set[str] = set()

    def material(self, name: str, colour: Colour) -> str:
        """Make a matte material of a colour (linear Rec.709)."""
        effect_id, id = self.ids.take(name, "-effect"), self.ids.take(name, "-material")
        self._libraries["effects"].append(write_libraries.effect(effect_id, colour))
        self._libraries["materials"].append(write_libraries.material(id, name, effect_id))
        return id

    def geometry(self, name: str, surface: Surface) -> str:
        """Make triangles that nodes may use, the same ones in many places."""
        id = self.ids.take(name, "-mesh")
        self._libraries["geometries"].append(write_meshes.geometry(id, name, surface, self._texts))
        if surface.uvs is not None:
            self._with_uvs.add(id)
        return id

    def lamp(self, name: str, kind: str, colour: Colour, cone: float = 45.0, blend: float = 0.0) -> str:
        """
        Make a lamp that shines along -Z, ``point``, ``spot`` or ``directional``, or is ``ambient``.

        Parameters
        ----------
        colour : linear Rec.709 components of radiant intensity [W sr-1 nm-1] or irradiance [W m-2 nm-1]
        cone : full angle of a spot [degrees]
        blend : the part of a spot's cone that is a soft edge, 0 to 1
        """
        id = self.ids.take(name, "-light")
        self._libraries["lights"].append(write_libraries.light(id, name, kind, colour, cone, blend))
        return id

    def eye(
        self,
        name: str,
        view: Element,
        shift: tuple[float, float] = (0.0, 0.0),
        lens: tuple[float, float] | None = None,
    ) -> str:
        """
        Make a camera that looks along -Z, with +Y up.

        Parameters
        ----------
        view : write_libraries.perspective() or orthographic()
        shift : of the picture, right and up, as fractions of its longer side
        lens : radius of a thin lens and the distance that is sharp [scene units]; None for a pinhole
        """
        id = self.ids.take(name, "-camera")
        self._libraries["cameras"].append(write_libraries.camera(id, name, view, shift, lens))
        return id

    def node(self, name: str, placement: Where = UNMOVED, parent: str | None = None) -> str:
        """Make a node, empty until it uses something, that stands relative to its parent node."""
        id = self.ids.take(name)
        self._nodes[id] = write_document.node(id, name, *write_document.transform(placement))
        self._used[id] = []
        (self._scene if parent is None else self._nodes[parent]).append(self._nodes[id])
        return id

    def use_geometry(self, node: str, geometry: str, bound: Mapping[str, str]) -> None:
        """Put a geometry into a node, with the ids of materials by the geometry's symbols."""
        name = self._nodes[node].get("name") or node
        has_uvs = geometry in self._with_uvs
        self._use(node, write_meshes.instance_geometry(geometry, name, bound, has_uvs))

    def use_lamp(self, node: str, lamp: str) -> None:
        """Put a lamp into a node."""
        self._use(node, write_document.instance("light", lamp))

    def use_eye(self, node: str, eye: str) -> None:
        """Put a camera into a node."""
        self._use(node, write_document.instance("camera", eye))

    def use_the_same(self, node: str, other: str) -> None:
        """Put into a node what another one uses."""
        for used in self._used[other]:
            self._use(node, deepcopy(used))

    def tobytes(self) -> bytes:
        """Return the document."""
        libraries = {f"library_{name}": elements for name, elements in self._libraries.items()}
        return write_document.document(self._head, libraries, self._scene, self._texts)

    def _use(self, node: str, used: Element) -> None:
        """Put something where the format wants it: after the transform, before the nodes below."""
        element = self._nodes[node]
        below = [k for k, each in enumerate(element) if each.tag == element.tag]
        element.insert(below[0] if below else len(element), used)
        self._used[node].append(used)
