"""
Materials of the all-bands path: Mitsuba's plugins asked for four bands at a time, by the same random numbers.

A path turns as the first four bands say; no material of Mitsuba's turns otherwise for other wavelengths.

This module is imported only by what renders with Mitsuba, after its variant is set.
"""

from __future__ import annotations

from typing import Any

import drjit as dr
import mitsuba as mi


def meet(tables, bsdf, si, towards, draws, active) -> tuple[Any, Any, Any, Any]:
    """
    Return what materials scatter towards a light, its density, how paths turn, and what they take along.

    The first and the last are colours that hold the coefficients of lobes; in the all-bands path they are
    lists of one mi.Float a band.

    Parameters
    ----------
    draws : a mi.Float and a mi.Point2f of random numbers
    """
    if not tables.all_bands:
        return bsdf.eval_pdf_sample(mi.BSDFContext(), si, towards, *draws, active)
    values, pdf, turn, weights = dr.dispatch(
        bsdf, _in_groups, si, towards, draws, tables.wavelengths(), mi.Bool(active)
    )
    return _flat(values), pdf, turn, _flat(weights)


def _in_groups(bsdf, si, towards, draws, wavelengths, active):
    values, weights, densities, turns = [], [], [], []
    for group in wavelengths:
        there = mi.SurfaceInteraction3f(si)
        there.wavelengths = group
        value, pdf, turn, weight = bsdf.eval_pdf_sample(mi.BSDFContext(), there, towards, *draws, active)
        values.append(value)
        weights.append(weight)
        densities.append(pdf)
        turns.append(turn)
    return values, densities[0], turns[0], weights


def _flat(groups) -> list:
    return [group[k] for group in groups for k in range(4)]
