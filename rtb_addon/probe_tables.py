"""Probes as a table that spreadsheets read."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence

from .observers import CONES
from .probing import Probe, difference
from .spectra.text import format_number


def csv_text(probes: Sequence[Probe]) -> str:
    """
    Return probes as a table that spreadsheets read: what they are, then a row for each wavelength.

    Notes
    -----
    Differences are those to the first probe. Two columns a probe: mean, and its standard error.
    """
    table = io.StringIO()
    rows = csv.writer(table, lineterminator="\n")
    for heading, values in _headings(probes):
        rows.writerow([heading, *(cell for value in values for cell in (value, ""))])
    rows.writerow(["wavelength [nm]", *("mean [W sr-1 m-2 nm-1]", "standard error") * len(probes)])
    for nm in sorted({nm for probe in probes for nm in probe.wavelengths}):
        rows.writerow([format_number(nm), *(cell for probe in probes for cell in _at(probe, nm))])
    return table.getvalue()


def _headings(probes: Sequence[Probe]) -> list[tuple[str, list[str]]]:
    differences = [difference(probes[0], probe) for probe in probes]
    named = [
        ("condition", [probe.condition for probe in probes]),
        ("renderer", [probe.renderer for probe in probes]),
        ("region [left top width height]", [" ".join(map(str, probe.region)) for probe in probes]),
        ("luminance [cd m-2]", [f"{probe.luminance:.6g}" for probe in probes]),
        ("its standard error", [f"{probe.luminance_error:.3g}" for probe in probes]),
        ("x", [f"{probe.xy[0]:.5f}" for probe in probes]),
        ("y", [f"{probe.xy[1]:.5f}" for probe in probes]),
    ]
    cones = [
        (f"{cone} (CIE 170-1:2006 2 degrees) [W sr-1 m-2]", [f"{probe.lms[number]:.6g}" for probe in probes])
        for number, cone in enumerate(CONES)
    ]
    if len(probes) == 1:
        return named + cones
    to_first = [
        (
            f"delta E 2000 to the first (white D65 at {probes[0].white:.6g} cd m-2)",
            [f"{each.delta_e:.4f}" for each in differences],
        ),
        *(
            (f"{cone} contrast to the first", [f"{each.cone_contrast[number]:.5f}" for each in differences])
            for number, cone in enumerate(CONES)
        ),
    ]
    return named + cones + to_first


def _at(probe: Probe, nm: float) -> tuple[str, str]:
    """Return a probe's mean and its error at a wavelength, nothing where it has no band."""
    if nm not in probe.wavelengths:
        return "", ""
    place = probe.wavelengths.index(nm)
    return f"{probe.radiance[place]:.7g}", f"{probe.standard_error[place]:.3g}"
