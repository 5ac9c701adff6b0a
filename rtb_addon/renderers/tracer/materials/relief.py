"""
Bumps and normal maps: pictures that turn the normals of a surface, whatever the surface is made of.

A bump is a height h over the surface: where p moves by dp/du, the raised surface moves by dp/du + n dh/du,
and its normal is across all such ways (Blinn, *Simulation of Wrinkled Surfaces*, 1978). A normal map says the
normal itself, along dp/du, across it, and along the normal to shade with.

Light that would come from behind the surface proper is left out, and near its horizon there is less of it, as
if the relief were rough (Estevez, Lecocq and Stein, *A Microfacet-Based Shadowing Function to Solve the Bump
Terminator Problem*, 2019). A normal that faces away is mirrored about that of the surface. So does Mitsuba.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Protocol

import numpy as np

from ....errors import RenderingError
from ....scene.render_scene import IntArray, Material, Texture
from ....spectra import FloatArray
from ...pictures import read_relief
from ..directions import Frame, cross, dot, normalised
from ..intersect import Places
from ..meeting import Meeting, Model, Onward, column
from ..textures import beside, pairs_of


class Relief(Protocol):
    """What turns normals."""

    def normals(self, places: Places) -> FloatArray:
        """Return (3, n) unit normals, about as places.normals and on the side that they are on."""
        ...


class _Picture:
    """The numbers of a picture between its texels, along straight lines."""

    def __init__(self, texture: Texture) -> None:
        said = texture.parameters
        texels = read_relief(Path(str(said["filename"])), float(said["gamma"]))  # type: ignore[arg-type]
        self.texels = texels.astype(float)
        self._place, self._wrap = pairs_of(texture, "scale", "offset"), str(said["wrapMode"])

    def corners(self, uvs: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return (2, 2, channels, n) texels around places, row and column first, and how far between them."""
        u, v = uvs * self._place[0, :, None] + self._place[1, :, None]
        height, width, channels = self.texels.shape
        rows, columns = beside((1 - v) * height, height, self._wrap), beside(u * width, width, self._wrap)
        flat = self.texels.reshape(-1, channels)
        found = np.array([[flat[row * width + column].T for column, _ in columns] for row, _ in rows])
        return found, rows[1][1].astype(float), columns[1][1].astype(float)

    def per_uv(self) -> FloatArray:
        """Return how many texels right and down there are per U and per V."""
        height, width, _ = self.texels.shape
        return self._place[0] * [width, -height]


class Bumps(_Picture):
    """Heights, the means of a picture's channels, times a scale [m]."""

    def __init__(self, material: Material, texture: Texture) -> None:
        super().__init__(texture)
        scale = float(material.parameters["scale"])  # type: ignore[arg-type]
        self.texels = self.texels.mean(axis=2, keepdims=True) * scale

    def normals(self, places: Places) -> FloatArray:
        """Return the normals of the raised surface."""
        assert places.uvs is not None
        assert places.tangents is not None
        assert places.across is not None
        ((a, b), (c, d)), down, along = self.corners(places.uvs)
        right = (1 - down) * (b - a) + down * (d - c)
        downwards = (1 - along) * (c - a) + along * (d - b)
        slopes = np.concatenate([right, downwards])
        slopes *= self.per_uv()[:, None]
        n = places.side * places.normals
        u, v = (
            one + (slope - dot(n, one)) * n
            for one, slope in zip((places.tangents, places.across), slopes, strict=True)
        )
        raised = normalised(cross(u, v))
        return np.where(dot(raised, places.faces) < 0, -raised, raised)


class NormalMap(_Picture):
    """Normals n, coded as colours (n + 1) / 2."""

    def __init__(self, material: Material, texture: Texture) -> None:
        super().__init__(texture)
        if (channels := self.texels.shape[2]) != 3:
            what = f"the normal map {texture.id} has {channels} channels"
            raise RenderingError(f"{what}, give a picture of colours")

    def normals(self, places: Places) -> FloatArray:
        """Return what the picture says."""
        assert places.uvs is not None
        ((a, b), (c, d)), down, along = self.corners(places.uvs)
        coded = (1 - down) * ((1 - along) * a + along * b) + down * ((1 - along) * c + along * d)
        frame = Frame.about((places.side * places.normals).astype(float), places.tangents)
        return places.side * normalised(frame.world(2 * coded - 1))


RELIEFS = {"bumpmap": Bumps, "normalmap": NormalMap}


class Relieved(Model):
    """Materials of one kind under a relief."""

    def __init__(self, under: Model, relief: Relief) -> None:
        self._under, self._relief = under, relief
        self.single, self.transmits, self.parts = under.single, under.transmits, under.parts

    def meeting(self, met: Meeting) -> Meeting:
        """Return the meeting, and in it the one that the material under the relief sees."""
        normals, turned = met.places.normals, self._relief.normals(met.places)
        hidden = dot(turned, met.directions) >= 0
        turned = np.where(hidden, 2 * dot(normals, turned) * normals - turned, turned)
        under = replace(met, places=met.places._replace(normals=turned))
        return replace(met, under=self._under.meeting(under))

    def shared(self, met: Meeting) -> FloatArray | None:
        """Return what the material shares."""
        return self._under.shared(met)

    def evaluate(self, met: Meeting, rows: IntArray, towards: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return what the material scatters in its own place, but for what the relief hides."""
        value, density = self._under.evaluate(_under(met), rows, towards)
        left = _left(met, towards).take(rows)
        return value * column(left), density * (left > 0)

    def turned(self, met: Meeting, rows: IntArray, light: FloatArray) -> FloatArray:
        """Return what the material makes of it."""
        return self._under.turned(_under(met), rows, light)

    def scattered(self, met: Meeting, u: FloatArray, v: FloatArray) -> Onward:
        """Return where the material scatters; paths into what the relief hides end."""
        onward = self._under.scattered(_under(met), u, v)
        left = _left(met, onward.directions)
        weight = column(left) if onward.weight is None else onward.weight * column(left)
        return onward._replace(density=np.where(left > 0, onward.density, 0), weight=weight)


def _under(met: Meeting) -> Meeting:
    assert met.under is not None
    return met.under


def _left(met: Meeting, towards: FloatArray) -> FloatArray:
    """Return the share of light from unit directions that a relief leaves, 0 where it hides all of it."""
    flat, turned = met.places.normals, _under(met).places.normals
    cosine = dot(flat, towards)
    there = cosine * dot(turned, towards) > 0
    roughness2 = np.minimum(_tangent2(dot(flat, turned)) / 8, 1)
    return there * 2 / (1 + np.sqrt(1 + roughness2 * _tangent2(cosine)))


def _tangent2(cosine: FloatArray) -> FloatArray:
    """Return squared tangents of angles."""
    squared = np.maximum(np.square(cosine, dtype=float), 1e-12)
    return np.maximum(1 - squared, 0) / squared


def relieved(model: Model, around: Sequence[Material], textures: Mapping[str, Texture]) -> Model:
    """Return a kind of material with reliefs around it, the first of them outermost."""
    for one in reversed(around):
        model = Relieved(model, RELIEFS[one.model](one, textures[str(one.parameters["textureID"])]))
    return model
