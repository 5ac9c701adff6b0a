"""
The neutral scene: the one thing renderers see.

Metres, world matrices, arrays, SI. World axes are Blender's: right-handed, +Z up. Matrices are
(4, 4), act on column vectors and hold no shear that a renderer would have to know about.
"""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..spectra import DEFAULT_BANDS, BandKind, Bands, FloatArray, Spectrum

IntArray = NDArray[np.integer]


@dataclass(frozen=True)
class TextureUse:
    """A material's parameter that a texture fills in."""

    texture: str


# What a parameter of the vocabulary may hold.
Value = Spectrum | float | str | TextureUse


@dataclass(frozen=True, eq=False)
class Mesh:
    """
    Triangles in their own space.

    Parameters
    ----------
    vertices : (vertices, 3) float32 array [m, times the shape's matrix]
    triangles : (triangles, 3) int32 array
        Indices of vertices, counter-clockwise seen from the side that the normal points to.
    normals : (vertices, 3) float32 array or None
        Unit shading normals; None for flat faces.
    uvs : (vertices, 2) float32 array or None
        Texture coordinates, V up.
    """

    vertices: FloatArray
    triangles: IntArray
    normals: FloatArray | None = None
    uvs: FloatArray | None = None

    @cached_property
    def digest(self) -> str:
        """Twenty hexadecimal digits that name this content, the same on every machine."""
        known = hashlib.sha256()
        for array in (self.vertices, self.triangles, self.normals, self.uvs):
            known.update(b"-" if array is None else np.ascontiguousarray(array).tobytes())
            known.update(b"|")
        return known.hexdigest()[:20]


@dataclass(frozen=True, eq=False)
class Shape:
    """
    A mesh somewhere in the world, of one material, emitting perhaps.

    Parameters
    ----------
    id : unique among the shapes
    mesh : its triangles
    to_world : (4, 4) array, from the mesh's space to the world [m]
    material : id of a material of the scene
    emission : radiance [W sr-1 m-2 nm-1], leaving the side that the triangles' normals point to
    """

    id: str
    mesh: Mesh
    to_world: FloatArray
    material: str
    emission: Spectrum | None = None


@dataclass(frozen=True, eq=False)
class Material:
    """
    How a surface reflects, in the words of the vocabulary.

    Parameters
    ----------
    id : unique among the materials
    model : a name of vocabulary.MATERIALS
    parameters : every parameter of that model, defaults filled in
    """

    id: str
    model: str
    parameters: Mapping[str, Value]


@dataclass(frozen=True, eq=False)
class Light:
    """
    A lamp without a mesh.

    Parameters
    ----------
    id : unique among the lights
    kind : a name of vocabulary.LIGHTS: point, spot, directional ...
    to_world : (4, 4) array [m]; the lamp stands at its origin and shines along its -Z axis
    parameters : every parameter of that kind, defaults filled in; angles in degrees, lengths in metres;
        ``intensity`` is W sr-1 nm-1 for point and spot, W m-2 nm-1 for directional
    """

    id: str
    kind: str
    to_world: FloatArray
    parameters: Mapping[str, Value]


@dataclass(frozen=True, eq=False)
class Texture:
    """A picture or pattern that a material's parameter may use."""

    id: str
    kind: str
    parameters: Mapping[str, Value]


@dataclass(frozen=True, eq=False)
class Camera:
    """
    Where the picture is taken from.

    Parameters
    ----------
    id : its name in the parent scene
    projection : perspective or orthographic
    to_world : (4, 4) array [m], orthonormal; looks along its -Z axis, +Y is up in the picture and +X
        right; a determinant of -1 mirrors the picture
    window : left, right, bottom, top of the picture in camera space
        perspective: on the plane one metre ahead [m]; orthographic: across the view [m]
    clip : near and far [m]
    lens_radius : of a thin lens [m], perspective only; 0: a pinhole
    focus_distance : from the lens to the plane that is sharp, along the view axis [m]
    """

    id: str
    projection: Literal["perspective", "orthographic"]
    to_world: FloatArray
    window: tuple[float, float, float, float]
    clip: tuple[float, float] = (1e-3, 1e5)
    lens_radius: float = 0.0
    focus_distance: float = 1.0


@dataclass(frozen=True, eq=False)
class Integrator:
    """
    How light is followed.

    Parameters
    ----------
    kind : path, or direct (one bounce)
    depth : longest path in Mitsuba's counting: 1 emitters only, 2 direct light, 3 one bounce more
    samples : paths per pixel
    seed : of the random numbers
    roulette : depth from which paths may end at random, whatever their spectra; 0: they never do
    """

    kind: Literal["path", "direct"] = "path"
    depth: int = 6
    samples: int = 64
    seed: int = 0
    roulette: int = 0


Filter = Literal["box", "tent", "gaussian", "mitchell", "catmullrom", "lanczos"]


class Crop(NamedTuple):
    """The part of a picture that is rendered, from its upper left corner [pixels]."""

    left: int
    top: int
    width: int
    height: int


@dataclass(frozen=True, eq=False)
class Film:
    """
    What the light falls on.

    Parameters
    ----------
    width, height : size of the whole picture [pixels]
    bands : wavelength bands
    band_kind : what a band's number stands for
    filter : reconstruction filter, with Mitsuba's default parameters
    crop : the part that is rendered; None for all of it
    """

    width: int = 320
    height: int = 240
    bands: Bands = DEFAULT_BANDS
    band_kind: BandKind = "averaged"
    filter: Filter = "box"
    crop: Crop | None = None

    @property
    def part(self) -> Crop:
        """What is rendered, the whole picture perhaps."""
        return self.crop or Crop(0, 0, self.width, self.height)


@dataclass(frozen=True, eq=False)
class RenderScene:
    """
    Everything a renderer needs, and nothing else.

    Parameters
    ----------
    environment : radiance [W sr-1 m-2 nm-1] that comes from every direction where nothing is, or None;
        its ``intensity`` times the picture ``filename``, where that is not empty
    """

    camera: Camera
    shapes: tuple[Shape, ...]
    materials: Mapping[str, Material]
    lights: tuple[Light, ...] = ()
    textures: Mapping[str, Texture] = field(default_factory=dict)
    environment: Light | None = None
    integrator: Integrator = field(default_factory=Integrator)
    film: Film = field(default_factory=Film)
