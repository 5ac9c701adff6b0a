"""How image files name the channels of their bands."""

from __future__ import annotations

import re
from collections.abc import Iterable

import numpy as np

from .bands import Bands

_NUMBER = r"\d+(?:[.,]\d+)?"
_LAYOUT = re.compile(rf"S0\.({_NUMBER})nm")
_SINGLE = re.compile(rf"({_NUMBER})(?:nm)?")
_RANGE = re.compile(rf"({_NUMBER})-({_NUMBER})(?:nm)?")


def channel_name(nanometres: float) -> str:
    """Return the name of a band's channel in the spectral layout for OpenEXR, as ``S0.400,000000nm``."""
    return f"S0.{nanometres:.6f}nm".replace(".", ",").replace(",", ".", 1)


def bands_of_channels(names: Iterable[str]) -> tuple[list[str], Bands]:
    """
    Return the channels that are bands, sorted by wavelength, and their bands.

    Parameters
    ----------
    names : ``S0.400,000000nm`` in the spectral layout; ``395.00-405.00nm`` as Mitsuba 0.5 wrote for
        RenderToolbox3, or ``400nm``. Others (alpha, depth, previews) are no bands.

    Raises
    ------
    ValueError : with one sentence, when there are no bands or they overlap
    """
    found = _in_layout(names := list(names)) or _by_numbers(names)
    if not found:
        listed = f", it has {', '.join(sorted(names)[:6])}" if names else ""
        raise ValueError(f"no channels like S0.400,000000nm or 395.00-405.00nm{listed}")
    found.sort(key=lambda band: band[1])
    ordered = [name for name, *_ in found]
    if len(found) == 1 and found[0][2] is None:
        return ordered, Bands.regular(found[0][1], 1, 1)  # as RenderToolbox3: a single wavelength has step 1
    if all(limits is not None for _, _, limits in found):
        return ordered, _between([centre for _, centre, _ in found], [limits for *_, limits in found])
    return ordered, _around([centre for _, centre, _ in found])


Limits = tuple[float, float] | None


def _in_layout(names: list[str]) -> list[tuple[str, float, Limits]]:
    return [(name, _nm(match.group(1)), None) for name in names if (match := _LAYOUT.fullmatch(name))]


def _by_numbers(names: list[str]) -> list[tuple[str, float, Limits]]:
    found: list[tuple[str, float, Limits]] = []
    for name in names:
        if match := _RANGE.fullmatch(name):
            low, high = _nm(match.group(1)), _nm(match.group(2))
            found.append((name, (low + high) / 2, (low, high)))
        elif match := _SINGLE.fullmatch(name):
            found.append((name, _nm(match.group(1)), None))
    return found


def _between(centres: list[float], limits: list) -> Bands:
    """Return bands of known limits; those that do not meet are taken to meet halfway."""
    lows, highs = np.array(limits).T
    if not np.allclose(lows[1:], highs[:-1], rtol=0, atol=0.011):  # the names have two decimals
        return _around(centres)
    return Bands(np.array(centres), np.append(lows, highs[-1]))


def _around(centres: list[float]) -> Bands:
    if min(np.diff(centres)) <= 0:
        raise ValueError("two channels have the same wavelength")
    return Bands.around(centres)


def _nm(text: str) -> float:
    return float(text.replace(",", "."))
