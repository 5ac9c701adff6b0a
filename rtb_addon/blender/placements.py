"""Where an object stands, in its own numbers."""

from __future__ import annotations

import numpy as np

from ..scene.collada.write_numbers import shortest
from ..scene.placement import Placement


def own_placement(object_) -> Placement | None:
    """Return location, rotation and scale as they stand in the object, if they are its XYZ ones."""
    if object_.rotation_mode != "XYZ":
        return None
    turns = np.degrees(np.array(object_.rotation_euler, float))
    x, y, z = (shortest(angle) for angle in turns)
    return Placement(_shorts(object_.location), (x, y, z), _shorts(object_.scale))


def _shorts(vector) -> tuple[float, float, float]:
    x, y, z = map(shortest, vector)
    return x, y, z
