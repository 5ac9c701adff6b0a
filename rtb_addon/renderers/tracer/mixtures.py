"""
Materials that are made of others: blends and masks.

A path that meets one goes on as if it had met one of the parts, which one by chance: the mean over many
paths is the weighted sum, and each part is sampled as well as it would be alone.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np
from numpy.typing import NDArray

from ...scene.render_scene import Material
from ...spectra import FloatArray


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


def mixtures(materials: Mapping[str, Material]) -> Mixtures | None:
    """Return what materials are made of, nothing being last; None where none is made of others."""
    if not any(one.model in ("blend", "mask") for one in materials.values()):
        return None
    numbers = {id: number for number, id in enumerate([*materials, ""])}
    parts: list[dict[int, float]] = []
    for id in numbers:
        shares: dict[int, float] = {}
        for part, share in _parts(id, materials):
            shares[numbers[part]] = shares.get(numbers[part], 0.0) + share
        parts.append(shares)
    return Mixtures(parts)


def _parts(id: str, materials: Mapping[str, Material]) -> Iterator[tuple[str, float]]:
    """Yield the ids of what a material is made of in the end, and the share of each; nothing has none."""
    model = materials[id].model if id else ""
    said = materials[id].parameters if id else {}
    if model == "blend":
        weight = float(said["weight"])  # type: ignore[arg-type]
        made = [(str(said["materialID"]), 1 - weight), (str(said["otherMaterialID"]), weight)]
    elif model == "mask":
        opacity = float(said["opacity"])  # type: ignore[arg-type]
        made = [(str(said["materialID"]), opacity), ("", 1 - opacity)]
    else:
        yield id, 1.0
        return
    for part, share in made:
        if share > 0:
            for inner, inside in _parts(part, materials):
                yield inner, share * inside
