"""
Materials that are made of others: blends, masks, and what has a relief around it.

A path that meets one goes on as if it had met one of the parts, which one by chance: the mean over many
paths is the weighted sum, and each part is sampled as well as it would be alone.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ....scene.render_scene import Material, Value
from ....spectra import FloatArray


class Mixtures:
    """
    What every material of a scene is made of.

    Parameters
    ----------
    parts : for each material by number, its parts' numbers and how often it is each
    """

    def __init__(self, parts: list[dict[int, float]]) -> None:
        most = max(len(each) for each in parts)
        padded = [[*each, *[max(each)] * (most - len(each))] for each in parts]
        self._parts = np.array(padded, np.int32)
        sums = [np.cumsum([*each.values()]) for each in parts]
        # Above everything at the end, whatever rounding left of 1.
        self._sums = np.array([[*each[:-1], *[2.0] * (most - len(each) + 1)] for each in sums])

    def one_of(self, material: NDArray[np.int32], u: FloatArray) -> NDArray[np.int32]:
        """Return a part of each of (n,) materials, chosen by numbers in [0, 1)."""
        part = (u[:, None] >= self._sums[material]).sum(axis=1)
        return self._parts[material, part]


class Part(NamedTuple):
    """What a material is made of: the id of one that is made of no others, and of the reliefs around it."""

    id: str
    around: tuple[str, ...] = ()


# What masks let through.
NOTHING = Part("")


def parts_of(id: str, materials: Mapping[str, Material], around: tuple[str, ...] = ()) -> dict[Part, float]:
    """Return what a material is made of in the end, and the share of each part."""
    model, said = (materials[id].model, materials[id].parameters) if id else ("", {})
    made = [(str(said.get(name, "")), share) for name, share in _shares(model, said)]
    if not made:
        return {Part(id, around) if id else NOTHING: 1.0}
    found: dict[Part, float] = {}
    for part, share in made:
        within = (*around, id) if model in ("bumpmap", "normalmap") else around
        for inner, inside in parts_of(part, materials, within).items() if share > 0 else ():
            found[inner] = found.get(inner, 0.0) + share * inside
    return found


def _shares(model: str, said: Mapping[str, Value]) -> list[tuple[str, float]]:
    """Return the parameters that name what a material is made of, "" for nothing, and the share of each."""
    if model == "blend":
        weight = float(said["weight"])  # type: ignore[arg-type]
        return [("materialID", 1 - weight), ("otherMaterialID", weight)]
    if model == "mask":
        opacity = float(said["opacity"])  # type: ignore[arg-type]
        return [("materialID", opacity), ("", 1 - opacity)]
    return [("materialID", 1.0)] if model in ("bumpmap", "normalmap") else []


def mixtures(materials: Mapping[str, Material], numbers: Mapping[Part, int]) -> Mixtures | None:
    """Return what materials are made of; None where all are made of themselves, as they are numbered."""
    made = [parts_of(id, materials) for id in materials]
    if all(each == {Part(id): 1.0} for id, each in zip(materials, made, strict=True)):
        return None
    whole = [*({numbers[part]: share for part, share in each.items()} for each in made)]
    return Mixtures([*whole, {numbers[NOTHING]: 1.0}])
