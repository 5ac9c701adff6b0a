"""Write the tables in rtb_addon/data from colour-science: python packaging/make_library.py"""

import warnings
from pathlib import Path

with warnings.catch_warnings():
    warnings.simplefilter("ignore")  # it tells which of its own optional packages are missing
    import colour
    from colour.colorimetry import SDS_BASIS_FUNCTIONS_CIE_ILLUMINANT_D_SERIES as DAYLIGHT
    from colour.colorimetry.datasets.light_sources import sds as lamps
    from colour.quality.datasets.tcs import SDS_TCS as TEST_COLOURS

OBSERVER = colour.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"]
CONES = colour.MSDS_CMFS["Stockman & Sharpe 2 Degree Cone Fundamentals"]
DATA = Path(__file__).resolve().parents[1] / "rtb_addon" / "data"
CHECKERS = ("BabelColor Average", "ColorChecker N Ohta", "ISO 17321-1")
LAMPS = {
    "Pointer Lamps": lamps.SDS_LIGHT_SOURCES_RIT,
    "NIST Lamps": lamps.SDS_LIGHT_SOURCES_NIST_TRADITIONAL,
    "NIST LEDs": lamps.SDS_LIGHT_SOURCES_NIST_LED,
    "Philips Lamps": lamps.SDS_LIGHT_SOURCES_NIST_PHILIPS,
    "Projectors": lamps.SDS_LIGHT_SOURCES_COMMON,
}
ORIGIN = f"# from colour-science {colour.__version__}; see SOURCES.md"


def number(value: float) -> str:
    return repr(float(value)).removesuffix(".0")


def row(name: str, spectrum) -> str:
    shape = spectrum.shape
    return ",".join([name, number(shape.start), number(shape.interval), *map(number, spectrum.values)])


def write(name: str, heading: str, rows: list[str]) -> None:
    (DATA / name).write_text("\n".join([ORIGIN, f"# {heading}", *rows]) + "\n", encoding="utf-8")


def write_functions(name: str, functions, heading: str) -> None:
    """Write functions of wavelength side by side, at every nanometre."""
    lines = zip(functions.wavelengths, *functions.values.T, strict=True)
    write(name, f"wavelength [nm], {heading}", [",".join(map(number, line)) for line in lines])


def main() -> None:
    each = "name, first wavelength [nm], step [nm], values"
    illuminants = [row(name, spectrum) for name, spectrum in colour.SDS_ILLUMINANTS.items()]
    write("illuminants.csv", f"{each} [relative]", illuminants)
    sources = [
        row(f"{group}/{lamp.replace('/', '-')}", spectrum)
        for group, there in LAMPS.items()
        for lamp, spectrum in there.items()
    ]
    write("lamps.csv", f"{each} [relative]", sources)
    patches = [
        row(f"{checker}/{patch}", spectrum)
        for checker in CHECKERS
        for patch, spectrum in colour.SDS_COLOURCHECKERS[checker].items()
    ]
    write("color_checkers.csv", f"{each} [reflectance]", patches)
    columns = [DAYLIGHT["S0"].wavelengths, *(DAYLIGHT[name].values for name in ("S0", "S1", "S2"))]
    basis = [",".join(map(number, line)) for line in zip(*columns, strict=True)]
    write("daylight_basis.csv", "wavelength [nm], S0, S1, S2 [relative]", basis)
    samples = zip(
        TEST_COLOURS["TCS01"].wavelengths, *(each.values for each in TEST_COLOURS.values()), strict=True
    )
    rows = [",".join(map(number, line)) for line in samples]
    write("test_colours.csv", "wavelength [nm], reflectances of the CIE's test colours 1 to 14", rows)
    write_functions("cie_1931.csv", OBSERVER, "x, y, z of the CIE 1931 2 degree observer")
    write_functions(
        "cones.csv",
        CONES,
        "l, m, s of CIE 170-1:2006 (Stockman and Sharpe), 2 degrees, each 1 at its highest",
    )


if __name__ == "__main__":
    main()
