"""
Write rtb_addon/data/indices.csv from a clone of the refractiveindex.info database (CC0):

    git clone https://github.com/polyanskiy/refractiveindex.info-database
    python packaging/make_indices.py refractiveindex.info-database
"""

import re
import subprocess
import sys
from pathlib import Path

import numpy as np

TARGET = Path(__file__).resolve().parents[1] / "rtb_addon/data/indices.csv"
RANGE = (0.36, 0.83)  # [um]
# name -> page of the database, below database/data
METALS = {
    "Ag silver": "main/Ag/nk/Johnson",
    "Al aluminium": "main/Al/nk/Rakic",
    "Au gold": "main/Au/nk/Johnson",
    "Co cobalt": "main/Co/nk/Johnson",
    "Cr chromium": "main/Cr/nk/Johnson",
    "Cu copper": "main/Cu/nk/Johnson",
    "Fe iron": "main/Fe/nk/Johnson",
    "Mn manganese": "main/Mn/nk/Johnson",
    "Ni nickel": "main/Ni/nk/Johnson",
    "Pd palladium": "main/Pd/nk/Johnson",
    "Ti titanium": "main/Ti/nk/Johnson",
    "V vanadium": "main/V/nk/Johnson",
    "W tungsten": "main/W/nk/Weaver",
}
GLASSES = {
    "N-BK7": "specs/schott/optical/N-BK7",
    "N-SF11": "specs/schott/optical/N-SF11",
    "F2": "specs/schott/optical/F2",
    "soda-lime": "glass/misc/soda-lime/nk/Rubin-clear",
    "fused silica": "main/SiO2/nk/Malitson",
    "water": "main/H2O/nk/Daimon-20.0C",
    "ethanol": "organic/C2H6O - ethanol/nk/Rheims",
    "acrylic": "organic/(C5H8O2)n - poly(methyl methacrylate)/nk/Sultanova",
    "polycarbonate": "organic/(C16H14O3)n - polycarbonate/nk/Sultanova",
    "sapphire": "main/Al2O3/nk/Malitson-o",
    "diamond": "main/C/nk/Peter",
    "rock salt": "main/NaCl/nk/Li",
}


def page(database: Path, name: str) -> str:
    """Return a page of the database, from its files or from the git objects of a bare clone."""
    file = f"database/data/{name}.yml"
    if (database / file).is_file():
        return (database / file).read_text(encoding="utf-8")
    show = ["git", "-C", str(database), "show", f"HEAD:{file}"]
    return subprocess.run(show, capture_output=True, check=True).stdout.decode()


def table(text: str) -> np.ndarray:
    """Return wavelength [um], n and k of a measured metal, one sample beyond each end of the range."""
    block = re.search(r"type: tabulated nk\s+data: \|\n((?:\s+[-\d.eE+ ]+\n?)+)", text)[1]
    rows = np.array([line.split() for line in block.splitlines() if line.strip()], float)
    rows = rows[np.argsort(rows[:, 0])]
    first = max(np.searchsorted(rows[:, 0], RANGE[0], "right") - 1, 0)
    last = min(np.searchsorted(rows[:, 0], RANGE[1]), len(rows) - 1)
    return rows[first : last + 1]


def index(text: str, um: np.ndarray) -> np.ndarray:
    """Return the index that a page's dispersion formula gives; formulas are numbered as in the database."""
    kind = int(re.search(r"type: formula (\d)", text)[1])
    c = [float(each) for each in re.search(r"coefficients: (.*)", text)[1].split()]
    if kind in (1, 2):
        poles = [(b, p**2 if kind == 1 else p) for b, p in zip(c[1::2], c[2::2], strict=True)]
        return np.sqrt(1 + c[0] + sum(b * um**2 / (um**2 - p) for b, p in poles))
    powers = sum((b * um**p for b, p in zip(c[1::2], c[2::2], strict=True)), np.full_like(um, c[0]))
    if kind == 3:
        return np.sqrt(powers)
    if kind == 5:
        return powers
    raise SystemExit(f"formula {kind} is not known here")


def row(name: str, nanometres: np.ndarray, values: np.ndarray) -> str:
    pairs = zip(nanometres, values, strict=True)
    return ",".join([name, *(f"{nm:.6g}:{value:.6g}" for nm, value in pairs)])


def main() -> None:
    database = Path(sys.argv[1])
    lines = ["# from the refractiveindex.info database; see SOURCES.md", "# name, wavelength [nm]:value ..."]
    for name, source in METALS.items():
        um, n, k = table(page(database, source)).T
        lines += [row(f"Metals/{name} eta", 1000 * um, n), row(f"Metals/{name} k", 1000 * um, k)]
    nanometres = np.arange(360.0, 831.0, 10)
    for name, source in GLASSES.items():
        lines.append(row(f"Glasses/{name}", nanometres, index(page(database, source), nanometres / 1000)))
    TARGET.write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
