"""Parent scenes without Blender: planes, disks, spheres, meshes, lamps and cameras, a line each."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from . import primitives
from .collada import write_libraries
from .collada.write_elements import Colour
from .parent_document import ParentDocument, Where
from .placement import UNMOVED, Placement
from .surface import IntArray, Surface, corners

WHITE = (1.0, 1.0, 1.0)
GREY = (0.8, 0.8, 0.8)
_CLIP = (0.1, 1000.0)

__all__ = ["GREY", "WHITE", "Placement", "SceneBuilder"]


class SceneBuilder(ParentDocument):
    """
    A parent scene built from shapes, every verb making a node of that name and returning its id.

    Everywhere ``placement`` says where the node stands relative to the node ``parent``: a Placement
    (location, rotation in degrees, scale), or a (4, 4) matrix. A shape's ``material`` is a name; a grey
    one is made where none has that name yet. The names and ids are those of ParentDocument.
    """

    def __init__(self, name: str = "Scene", meter: float = 1.0, tool: str = "RenderToolbox") -> None:
        super().__init__(name, meter, tool)
        self._materials: dict[str, str] = {}

    def material(self, name: str, colour: Colour = GREY) -> str:
        """Make a matte material of a colour (linear Rec.709)."""
        self._materials[name] = super().material(name, colour)
        return self._materials[name]

    def mesh(
        self,
        name: str,
        vertices: ArrayLike,
        triangles: IntArray,
        normals: ArrayLike | None = None,
        uvs: ArrayLike | None = None,
        material: str = "Grey",
        placement: Where = UNMOVED,
        parent: str | None = None,
    ) -> str:
        """
        Make triangles.

        Parameters
        ----------
        vertices : (vertices, 3) array [scene units]
        triangles : (triangles, 3) array, counter-clockwise seen from the front
        normals, uvs : one per vertex, or (triangles, 3, n): one per corner
        """
        triangles = np.asarray(triangles, np.int32)
        normal, uv = (None if each is None else corners(each, triangles) for each in (normals, uvs))
        surface = Surface(np.asarray(vertices, np.float32), triangles, normal, uv)
        return self.surface(name, surface, material, placement, parent)

    def surface(
        self,
        name: str,
        surface: Surface,
        material: str = "Grey",
        placement: Where = UNMOVED,
        parent: str | None = None,
    ) -> str:
        """Make a surface, all of one material."""
        bound = self._materials.get(material) or self.material(material)
        geometry = self.geometry(name, replace(surface, symbols=(bound,)))
        node = self.node(name, placement, parent)
        self.use_geometry(node, geometry, {bound: bound})
        return node

    def plane(
        self,
        name: str,
        width: float = 2.0,
        depth: float = 2.0,
        material: str = "Grey",
        placement: Where = UNMOVED,
        parent: str | None = None,
    ) -> str:
        """Make a rectangle [scene units] that faces +Z."""
        return self.surface(name, primitives.plane(width, depth), material, placement, parent)

    def disk(
        self,
        name: str,
        radius: float = 1.0,
        material: str = "Grey",
        placement: Where = UNMOVED,
        parent: str | None = None,
        segments: int = 128,
    ) -> str:
        """Make a disk [scene units] that faces +Z, a polygon of exactly the disk's area."""
        surface = primitives.disk(2 * radius, 2 * radius, segments)
        return self.surface(name, surface, material, placement, parent)

    def sphere(
        self,
        name: str,
        radius: float = 1.0,
        material: str = "Grey",
        placement: Where = UNMOVED,
        parent: str | None = None,
        segments: int = 64,
    ) -> str:
        """Make a smooth sphere [scene units]."""
        surface = primitives.sphere(radius, segments, segments // 2)
        return self.surface(name, surface, material, placement, parent)

    def instance(self, name: str, of: str, placement: Where = UNMOVED, parent: str | None = None) -> str:
        """Make a node that shows what the node ``of`` shows, not what is below it."""
        node = self.node(name, placement, parent)
        self.use_the_same(node, of)
        return node

    def point(
        self, name: str, colour: Colour = WHITE, placement: Where = UNMOVED, parent: str | None = None
    ) -> str:
        """Make a point lamp; its colour is radiant intensity [W sr-1 nm-1] where the mappings say none."""
        return self._lit(name, self.lamp(name, "point", colour), placement, parent)

    def spot(
        self,
        name: str,
        cone: float = 45.0,
        blend: float = 0.15,
        colour: Colour = WHITE,
        placement: Where = UNMOVED,
        parent: str | None = None,
    ) -> str:
        """Make a spot lamp that shines along -Z in a cone, the full angle [degrees], with a soft edge."""
        return self._lit(name, self.lamp(name, "spot", colour, cone, blend), placement, parent)

    def sun(
        self, name: str, colour: Colour = WHITE, placement: Where = UNMOVED, parent: str | None = None
    ) -> str:
        """Make a sun that shines along -Z; its colour is irradiance [W m-2 nm-1]."""
        return self._lit(name, self.lamp(name, "directional", colour), placement, parent)

    def camera(
        self,
        name: str = "Camera",
        xfov: float = 40.0,
        aspect: float = 4 / 3,
        clip: tuple[float, float] = _CLIP,
        shift: tuple[float, float] = (0.0, 0.0),
        placement: Where = UNMOVED,
        parent: str | None = None,
        lens: tuple[float, float] | None = None,
        width: float | None = None,
    ) -> str:
        """
        Make a camera that looks along -Z, with +Y up.

        Parameters
        ----------
        xfov : angle across the width of the picture [degrees]
        aspect : width by height of the picture
        clip : near and far [scene units]
        shift : of the picture, right and up, as fractions of its longer side
        lens : radius of a thin lens and the distance that is sharp [scene units]; None for a pinhole
        width : of a parallel view [scene units], which has no angle and no lens; None for a perspective
        """
        if width is None:
            view = write_libraries.perspective(xfov, aspect, clip)
        else:
            view = write_libraries.orthographic(width, aspect, clip)
        node = self.node(name, placement, parent)
        self.use_eye(node, self.eye(name, view, shift, lens))
        return node

    def _lit(self, name: str, lamp: str, placement: Where, parent: str | None) -> str:
        node = self.node(name, placement, parent)
        self.use_lamp(node, lamp)
        return node
