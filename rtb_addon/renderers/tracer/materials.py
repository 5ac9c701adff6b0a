"""
The materials of a scene, sorted by how they scatter light.

Each kind is a Model (meeting.py) in a module of its own, which knows all materials of that kind.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from ...scene.render_scene import Film, IntArray, Material, TextureUse
from .matte import Matte
from .meeting import Model
from .smooth import Mirror
from .tables import Palette, table
from .ward import Ward

KINDS: dict[str, Callable[[Sequence[Material], Palette], Model]] = {
    "matte": Matte,
    "anisoward": Ward,
    "mirror": Mirror,
}


class Materials:
    """
    The materials of a scene by number.

    Attributes
    ----------
    numbers : id -> number
    reflects : (materials,) bool array, False for those that are black in every band
    oriented : whether some material has a direction of its own on the surface
    """

    def __init__(self, materials: Iterable[Material], film: Film) -> None:
        materials = list(materials)
        self.numbers = {material.id: number for number, material in enumerate(materials)}
        self.reflects = np.array([_reflects(one, film) for one in materials], bool)
        self.oriented = any(_oriented(one) for one in materials)
        kinds = [one.model for one in materials]
        present = list(dict.fromkeys(kinds))
        self._kind = np.array([present.index(kind) for kind in kinds], np.int32)
        self._row = np.array([kinds[:number].count(kind) for number, kind in enumerate(kinds)], np.int32)
        self._models = [
            KINDS[kind]([one for one in materials if one.model == kind], Palette(film)) for kind in present
        ]

    def sorted(self, material: NDArray[np.int32]) -> Iterator[tuple[Model, IntArray | slice, IntArray]]:
        """Yield each kind among (n,) numbers of materials: where in them, and rows among that kind."""
        if len(self._models) == 1:
            if len(material):
                yield self._models[0], slice(None), self._row.take(material)
            return
        kind = self._kind[material]
        for number, model in enumerate(self._models):
            where = np.nonzero(kind == number)[0]
            if len(where):
                yield model, where, self._row[material[where]]


def _reflects(material: Material, film: Film) -> bool:
    """Return whether a material reflects at all: it does unless it is matte and black."""
    reflectance = material.parameters.get("diffuseReflectance")
    if material.model != "matte" or isinstance(reflectance, TextureUse):
        return True
    return bool(table([(f"material {material.id}", reflectance)], film).any())


def _oriented(material: Material) -> bool:
    return material.parameters.get("alphaU") != material.parameters.get("alphaV")
