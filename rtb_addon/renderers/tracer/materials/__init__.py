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

from ....scene.render_scene import Film, IntArray, Material, Texture, TextureUse, Value
from ....spectra import Spectrum
from ..meeting import Model
from ..tables import Lookup, Palette, table
from ..textures import lookup
from .dispersion import DispersingGlass, DispersingRoughGlass, DispersingThinGlass
from .fluorescence import Fluorescent
from .glass import Glass, ThinGlass
from .matte import Matte
from .metal import RoughMetal, SmoothMetal
from .mixtures import NOTHING, Part, mixtures, parts_of
from .plastic import Plastic, RoughPlastic
from .relief import relieved
from .rough_glass import RoughGlass
from .smooth import Mirror, Nothing
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
    "fluorescent": Fluorescent,
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
        textures = textures or {}
        self.numbers = {id: number for number, id in enumerate(materials)}
        reliefs = {part: None for id in materials for part in parts_of(id, materials) if part.around}
        all_parts = [*map(Part, materials), NOTHING, *reliefs]
        self.mixtures = mixtures(materials, {part: number for number, part in enumerate(all_parts)})
        simple = [materials.get(part.id, Material("", "nothing", {})) for part in all_parts]
        self.reflects = np.array([_reflects(one, film) for one in simple], bool)
        self.oriented = bool(reliefs) or any(_oriented(one) for one in simple)
        palette = Palette(film, _lookups(simple, textures, film))
        self.textured = bool(palette.textures or reliefs)
        kinds = [_kind(one, part) for one, part in zip(simple, all_parts, strict=True)]
        present = [kind for kind in dict.fromkeys(kinds) if kind.word in KINDS]
        self._models: list[Model] = []
        for kind in present:
            members = [one for one, its in zip(simple, kinds, strict=True) if its == kind]
            around = [materials[id] for id in kind.around]
            self._models.append(relieved(KINDS[kind.word](members, palette), around, textures))
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


class _Kind(NamedTuple):
    """What materials of one Model have in common: a word of KINDS, the distribution of slopes, reliefs."""

    word: str
    slopes: str
    around: tuple[str, ...]


def _kind(material: Material, part: Part) -> _Kind:
    """Return which kind a material is; the word of what is made of others is none of KINDS."""
    said = material.parameters
    word = _SMOOTH.get(material.model, material.model) if said.get("roughness") == 0 else material.model
    if any(_varies(said.get(name)) for name in ("intIOR", "extIOR")):
        word = f"dispersing {word}"
    return _Kind(word, str(said.get("distribution", "")) if said.get("roughness") else "", part.around)


def _lookups(
    materials: Sequence[Material], textures: Mapping[str, Texture], film: Film
) -> Mapping[str, Lookup]:
    """Return the textures whose spectra some material has, ready to be asked."""
    values = (value for one in materials for value in one.parameters.values())
    used = dict.fromkeys(value.texture for value in values if isinstance(value, TextureUse))
    return {id: lookup(textures[id], film) for id in used}


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
