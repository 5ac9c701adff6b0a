"""
The materials of a scene, sorted by how they scatter light.

Each kind is a Model (meeting.py) that knows all materials of that kind. What is made of other materials is,
wherever a path meets it, one of them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...scene.render_scene import Film, IntArray, Material, Texture, TextureUse, Value
from ...spectra import Spectrum
from .dispersion import DispersingGlass, DispersingRoughGlass, DispersingThinGlass
from .glass import Glass, ThinGlass
from .matte import Matte
from .meeting import Model
from .metal import RoughMetal, SmoothMetal
from .mixtures import mixtures
from .plastic import Plastic, RoughPlastic
from .rough_glass import RoughGlass
from .smooth import Mirror, Nothing
from .tables import Palette, table
from .textures import lookup
from .ward import Ward

# Vocabulary's word, and the same with a roughness of 0 where that is another kind -> what makes the kind.
KINDS: dict[str, Callable[[Sequence[Material], Palette], Model]] = {
    "matte": Matte,
    "anisoward": Ward,
    "mirror": Mirror,
    "metal": RoughMetal,
    "smooth metal": SmoothMetal,
    "plastic": Plastic,
    "roughplastic": RoughPlastic,
    "glass": Glass,
    "thinglass": ThinGlass,
    "roughglass": RoughGlass,
    "dispersing glass": DispersingGlass,
    "dispersing thinglass": DispersingThinGlass,
    "dispersing roughglass": DispersingRoughGlass,
    "nothing": Nothing,
}
_SMOOTH = {"metal": "smooth metal", "roughplastic": "plastic", "roughglass": "glass"}


class Plain(NamedTuple):
    """
    Materials that scatter one spectrum each, times numbers.

    Parameters
    ----------
    spectra : (rows, bands) float32 array
    first : the row of each kind's first material
    """

    spectra: NDArray[np.float32]
    first: Mapping[Model, int]


class Materials:
    """
    The materials of a scene by number, and after them nothing, what masks let through.

    Attributes
    ----------
    numbers : id -> number
    reflects : (materials,) bool array, False for those that are black in every band
    oriented : whether some material has a direction of its own on the surface
    textured : whether some material has a texture
    mixtures : what materials that are made of others are on average, None where none is
    plain : the spectra of all, None where some scatter more than one spectrum times numbers
    """

    def __init__(
        self, materials: Mapping[str, Material], film: Film, textures: Mapping[str, Texture] | None = None
    ) -> None:
        self.numbers = {id: number for number, id in enumerate(materials)}
        simple = [*materials.values(), Material("", "nothing", {})]
        self.reflects = np.array([_reflects(one, film) for one in simple], bool)
        self.oriented = any(_oriented(one) for one in simple)
        self.mixtures = mixtures(materials)
        kinds = [_kind(one) for one in simple]
        present = [kind for kind in dict.fromkeys(kinds) if kind[0] in KINDS]
        members = {kind: [one for one in simple if _kind(one) == kind] for kind in present}
        used = {id: lookup(texture, film) for id, texture in (textures or {}).items()}
        self.textured = bool(used)
        self._models = [KINDS[kind[0]](members[kind], Palette(film, used)) for kind in present]
        self._kind = np.array([present.index(kind) if kind in present else -1 for kind in kinds], np.int32)
        self._row = np.array([kinds[:number].count(kind) for number, kind in enumerate(kinds)], np.int32)
        self.parts = any(model.parts for model in self._models)
        self.plain = _plain(self._models)
        # Nothing is met only where something is a mask.
        self._alone = len(present) == 2 and self.mixtures is None

    def sorted(self, material: NDArray[np.int32]) -> Iterator[tuple[Model, IntArray | slice, IntArray]]:
        """Yield each kind among (n,) numbers of materials: where in them, and rows among that kind."""
        if self._alone:
            if len(material):
                yield self._models[0], slice(None), self._row.take(material)
            return
        kind = self._kind[material]
        for number, model in enumerate(self._models):
            where = np.nonzero(kind == number)[0]
            if len(where):
                yield model, where, self._row[material[where]]


def _plain(models: Sequence[Model]) -> Plain | None:
    """Return the spectra of kinds of materials that have no more than one each, None where others are."""
    plain = (one.plain if isinstance(one, Matte | Mirror | Nothing) else None for one in models)
    spectra = [each for each in plain if each is not None]
    if len(spectra) < len(models):
        return None
    first = np.cumsum([0, *map(len, spectra[:-1])])
    return Plain(np.concatenate(spectra), dict(zip(models, first.tolist(), strict=True)))


def _kind(material: Material) -> tuple[str, str]:
    """Return which of KINDS a material is (blends and masks are none) and how its slopes are distributed."""
    said = material.parameters
    word = _SMOOTH.get(material.model, material.model) if said.get("roughness") == 0 else material.model
    disperses = any(_varies(said.get(name)) for name in ("intIOR", "extIOR"))
    slopes = str(said.get("distribution", "")) if "roughness" in said and said["roughness"] != 0 else ""
    return f"dispersing {word}" if disperses else word, slopes


def _varies(value: Value | None) -> bool:
    return isinstance(value, Spectrum) and bool(np.ptp(value.values))


def _reflects(material: Material, film: Film) -> bool:
    """Return whether a material reflects at all: it does unless it is matte and black."""
    reflectance = material.parameters.get("diffuseReflectance")
    if material.model != "matte" or isinstance(reflectance, TextureUse):
        return True
    return bool(table([(f"material {material.id}", reflectance)], film).any())


def _oriented(material: Material) -> bool:
    return material.parameters.get("alphaU") != material.parameters.get("alphaV")
