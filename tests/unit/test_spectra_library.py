"""The library and the formulas of light sources, against colour-science."""

import subprocess
import sys
import warnings
from pathlib import Path

import numpy as np
import pytest

from rtb_addon.errors import RecipeError
from rtb_addon.spectra import DEFAULT_BANDS, Unit, library
from rtb_addon.spectra.files import write_spd
from rtb_addon.spectra.sources import blackbody, daylight
from rtb_addon.spectra.spoken import spectrum_from

with warnings.catch_warnings():
    warnings.simplefilter("ignore")
    import colour

ROOT = Path(__file__).resolve().parents[2]
CHECKERS = ("BabelColor Average", "ColorChecker N Ohta", "ISO 17321-1")


def same(ours, theirs):
    return np.array_equal(ours.wavelengths, theirs.wavelengths) and np.array_equal(ours.values, theirs.values)


def test_every_illuminant_is_the_one_of_colour_science():
    assert all(same(library.find(name), sd) for name, sd in colour.SDS_ILLUMINANTS.items())
    assert library.find("FL2").unit == Unit.SHAPE


@pytest.mark.parametrize("checker", CHECKERS)
def test_every_patch_is_the_one_of_colour_science_in_the_charts_order(checker):
    patches = colour.SDS_COLOURCHECKERS[checker]
    assert library.patches(checker) == [f"{checker}/{patch}" for patch in patches]
    assert all(same(library.find(f"{checker}/{patch}"), sd) for patch, sd in patches.items())
    assert library.find(library.patches(checker)[0]).unit == Unit.RATIO


def test_the_library_holds_nothing_twice_and_finds_all_it_names():
    names = library.names()
    assert len(names) == len({name.lower() for name in names})
    indices = [name for name in names if name.startswith(("Metals/", "Glasses/"))]
    lights = len(colour.SDS_ILLUMINANTS) + len(colour.SDS_LIGHT_SOURCES)
    assert len(names) - len(indices) == lights + 24 * 3
    assert all(library.find(name.upper()) is library.find(name) for name in names)


def test_every_lamp_of_colour_science_is_there():
    names = [name for name in library.names() if library.is_light(name)]
    ours = {name.rpartition("/")[2]: name for name in names}
    for name, spectrum in colour.SDS_LIGHT_SOURCES.items():
        found = library.find(ours[name.replace("/", "-")])
        np.testing.assert_array_equal(found.at(spectrum.wavelengths), spectrum.values)
    assert library.is_light("D65")
    assert not library.is_light("BabelColor Average/blue")


def test_a_name_that_is_nearly_right_is_suggested():
    with pytest.raises(
        RecipeError, match=r"no spectrum of the library is called 'babelcolor averge/bleu', did you"
    ):
        library.find("babelcolor averge/bleu")
    with pytest.raises(RecipeError, match="like D65"):
        library.find("qqqqqqqqqqqq")


def test_old_patches_are_numbered_down_the_columns_of_the_chart():
    first_column = ["dark skin", "orange", "blue", "white 9.5 (.05 D)"]
    for number, patch in enumerate(first_column, start=1):
        assert library.served(f"mccBabel-{number}.spd") is library.find(f"BabelColor Average/{patch}")
    assert library.served("RenderData\\Macbeth\\mccBabel-24.spd") is library.find(
        "BabelColor Average/black 2 (1.5 D)"
    )
    assert len({id(library.served(f"mccBabel-{number}.spd")) for number in range(1, 25)}) == 24


def test_old_patches_are_nearly_the_old_measurement():
    # Reflectance at 700 nm of the measurement that RenderToolbox3 shipped.
    old = {1: 0.1855, 2: 0.6443, 5: 0.6721, 11: 0.7339, 15: 0.7920, 18: 0.3761, 20: 0.0814, 22: 0.6709}
    for number, reflectance in old.items():
        assert library.served(f"mccBabel-{number}.spd").at(700) == pytest.approx(reflectance, abs=0.03)


def test_metals_and_glasses_have_their_measured_indices():
    for metal in library.metals():
        eta, k = (library.find(f"{metal} {part}") for part in ("eta", "k"))
        assert eta.wavelengths[0] <= 390
        assert eta.wavelengths[-1] >= 780
        assert eta.wavelengths.tolist() == k.wavelengths.tolist()
    # The index of Schott's data sheet at the helium line, and Abbe's number from its neighbours.
    d, f, c = library.find("Glasses/N-BK7").at([587.5618, 486.1327, 656.2725])
    assert d == pytest.approx(1.51680, abs=2e-5)
    assert (d - 1) / (f - c) == pytest.approx(64.17, rel=0.01)  # read between samples 10 nm apart
    assert library.served("al.ETA.spd") is library.find("Metals/Al aluminium eta")
    assert library.served("unobtainium.eta.spd") is None


def test_other_old_files_are_served_under_their_names():
    assert library.served("resources/D65.spd").at(560) == 100
    assert library.served("DimFlat.spd").at([380, 500, 780]).tolist() == [1, 1, 1]
    for stranger in ("mccBabel-0.spd", "mccBabel-25.spd", "mccD65Metamer-1.spd", "D65.txt", "paint.spd"):
        assert library.served(stranger) is None


@pytest.mark.parametrize("kelvin", [4000, 5000, 6504, 7000, 7001, 10000, 25000])
def test_daylight_is_the_cies(kelvin):
    xy = colour.CCT_to_xy(kelvin, method="CIE Illuminant D Series")
    theirs = colour.sd_CIE_illuminant_D_series(xy)
    ours = daylight(kelvin)
    np.testing.assert_array_equal(ours.wavelengths, theirs.wavelengths)
    np.testing.assert_allclose(ours.values, theirs.values, rtol=1e-12, atol=1e-12)
    assert ours.at(560) == pytest.approx(100, abs=1e-9)


def test_daylight_of_6504_kelvin_is_d65():
    wavelengths = np.arange(380, 781, 5)
    np.testing.assert_allclose(daylight(6504).at(wavelengths), library.find("D65").at(wavelengths), rtol=1e-3)


@pytest.mark.parametrize("kelvin", [1000, 2856, 6500, 20000])
def test_a_blackbody_has_plancks_radiance(kelvin):
    ours = blackbody(kelvin)
    assert ours.unit == Unit.RADIANCE
    metres = ours.wavelengths * 1e-9
    c1, c2 = 2 * np.pi * 6.62607015e-34 * 299792458**2, 6.62607015e-34 * 299792458 / 1.380649e-23
    theirs = colour.colorimetry.planck_law(metres, kelvin, c1=c1, c2=c2) * 1e-9
    np.testing.assert_allclose(ours.values, theirs, rtol=1e-9)
    # colour-science's own constants are rounded to four or five digits.
    rough = colour.sd_blackbody(kelvin, colour.SpectralShape(360, 830, 1))
    np.testing.assert_allclose(ours.values / ours.at(560), rough.values / rough[560], rtol=2e-3)


def test_a_blackbody_obeys_wien_and_stefan_boltzmann():
    hot = blackbody(5000)
    assert hot.wavelengths[hot.values.argmax()] == pytest.approx(2897771.955 / 5000, abs=0.5)
    # 360 to 830 nm hold this share of sigma T^4 / pi: the series of the integral of x^3 / (e^x - 1).
    share = band_share(830, 5000) - band_share(360, 5000)
    assert hot.integral() == pytest.approx(share * 5.670374419e-8 * 5000**4 / np.pi, rel=1e-5)


def band_share(nanometres, kelvin):
    x = 14387768.775 / (nanometres * kelvin)
    n = np.arange(1, 60)
    return 15 / np.pi**4 * np.sum(np.exp(-n * x) * (x**3 / n + 3 * x**2 / n**2 + 6 * x / n**3 + 6 / n**4))


def test_a_cold_body_is_dark_without_a_word():
    assert blackbody(1).values.tolist() == [0] * 471


@pytest.mark.parametrize("kelvin", [3999, 25001, float("nan")])
def test_daylight_that_the_cie_does_not_define_is_refused(kelvin):
    with pytest.raises(ValueError, match="want 4000 to 25000 K"):
        daylight(kelvin)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("D65", lambda: library.find("D65").values),
        ("  babelcolor average/Blue ", lambda: library.find("BabelColor Average/blue").values),
        ("daylight 5000", lambda: daylight(5000).values),
        ("Daylight 5000 K", lambda: daylight(5000).values),
        ("blackbody 3e3", lambda: blackbody(3000).values),
        ("300:0.2 800:0.4", lambda: [0.2, 0.4]),
        (".5", lambda: [0.5, 0.5]),
        ("-1", lambda: [-1, -1]),
        ("mccBabel-3.spd", lambda: library.find("BabelColor Average/blue").values),
        ("mine.spd", lambda: [0.25, 0.5]),
    ],
)
def test_a_person_may_say_a_spectrum_in_many_ways(tmp_path, text, expected):
    (tmp_path / "mine.spd").write_text("380 0.25\n780 0.5\n")
    spectrum = spectrum_from(text, Unit.INTENSITY, tmp_path)
    assert spectrum.unit == Unit.INTENSITY
    np.testing.assert_array_equal(spectrum.values, expected())


def test_a_file_beside_the_recipe_comes_before_the_librarys(tmp_path):
    write_spd(tmp_path / "D65.spd", library.find("A"))
    assert spectrum_from("D65.spd", folder=tmp_path).at(700) == pytest.approx(library.find("A").at(700))


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("", "an empty text is no spectrum"),
        ("D64", "no spectrum of the library is called 'D64', did you mean D6"),
        ("gold", "did you mean Metals/Au gold eta, Metals/Au gold k"),
        ("gone.spd", r"there is no spectrum file gone\.spd in "),
        ("daylight 3000", "'daylight 3000': daylight of 3000 K is not defined"),
        ("daylight noon", "'noon' is no temperature"),
        ("blackbody -5", "want a temperature above 0 K"),
        ("300:1 800:x", "'x' in '800:x' is no number"),
        ("0.2 0.3", "'0.2' is no wavelength:value pair"),
    ],
)
def test_what_is_no_spectrum_is_one_sentence(tmp_path, text, sentence):
    with pytest.raises(RecipeError, match=sentence):
        spectrum_from(text, folder=tmp_path)


def test_the_librarys_numbers_need_no_heavy_package():
    program = (
        "import sys; from rtb_addon.spectra import library, sources, spoken;"
        "library.names(); sources.daylight(5000);"
        "print(sorted({'colour', 'scipy', 'mitsuba', 'bpy'} & set(sys.modules)))"
    )
    command = [sys.executable, "-c", program]
    done = subprocess.run(command, capture_output=True, text=True, check=True, cwd=ROOT)
    assert done.stdout.strip() == "[]"


def test_a_line_lamp_keeps_its_power_in_the_bands():
    lamp = library.find("FL11")
    sum_of_bands = lamp.in_bands(DEFAULT_BANDS) @ DEFAULT_BANDS.widths
    assert sum_of_bands == pytest.approx(lamp.integral(395, 705), rel=1e-12)
