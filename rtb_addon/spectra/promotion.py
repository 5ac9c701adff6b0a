"""
Colours made into spectra, where a scene gives nothing better.

Three trapezoids that add up to one carry a colour's linear Rec.709 components. Their edges are those
for which a surface under D65 shows its colour again, within 0.03 in each component; grey stays flat.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .spectrum import Spectrum, Unit

# Blue falls and green rises between the first two [nm], green falls and red rises between the others.
EDGES = (460.0, 520.0, 570.0, 610.0)


def promoted(colour: Sequence[float], unit: Unit = Unit.RATIO) -> Spectrum:
    """
    Return the spectrum of a colour.

    Parameters
    ----------
    colour : red, green, blue, linear Rec.709, each [unit]; negative ones count as 0
    unit : of the spectrum's values
    """
    red, green, blue = np.maximum(np.asarray(colour, float)[:3], 0.0)
    return Spectrum.of(EDGES, [blue, green, green, red], unit)
