"""Spectrum, bands and watts, against fine integration and closed forms."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from rtb_addon.spectra import DEFAULT_BANDS, FULL_RANGE, Bands, Part, Spectrum, Unit

JAGGED = Spectrum.of([411, 413.5, 520, 520.25, 640], [0.1, 3, 0.4, 2, 1])
UNEVEN = Bands(np.array([400, 412, 500, 700.0]), np.array([390, 411.5, 414, 600, 730.0]))


def fine_average(spectrum, low, high):
    """The average by brute force: steps so small that the midpoint rule errs by less than 1e-6."""
    count = 200_000
    middles = low + (high - low) * (np.arange(count) + 0.5) / count
    return spectrum.at(middles).mean()


@pytest.mark.parametrize("bands", [DEFAULT_BANDS, UNEVEN, Bands.around([405, 409, 480, 660])])
def test_a_bands_value_is_the_exact_average_of_the_straight_lines(bands):
    limits = zip(bands.edges[:-1], bands.edges[1:], strict=True)
    fine = [fine_average(JAGGED, low, high) for low, high in limits]
    np.testing.assert_allclose(JAGGED.in_bands(bands), fine, rtol=2e-6)


def test_the_averages_of_a_slope_are_its_values_at_the_centres():
    slope = Spectrum.of([300, 900], [0, 6])
    np.testing.assert_allclose(slope.in_bands(DEFAULT_BANDS), slope.at(DEFAULT_BANDS.centres), rtol=1e-14)


def test_the_parts_of_a_band_average_to_the_band():
    bands = Bands.around([400, 433.3, 500, 610])
    parts = [JAGGED.in_bands(bands, Part(number, 4)) for number in range(4)]
    np.testing.assert_allclose(np.mean(parts, axis=0), JAGGED.in_bands(bands), rtol=1e-12)
    quarter = bands.edges[0] + bands.widths[0] * np.array([0.25, 0.5])
    assert parts[1][0] == pytest.approx(JAGGED.integral(*quarter) / np.diff(quarter)[0], rel=1e-12)


def test_a_triangle_inside_one_band_keeps_its_area():
    line = Spectrum.of([499, 500, 501], [0, 7, 0])
    averages = line.in_bands(DEFAULT_BANDS)
    assert averages[10] == pytest.approx(7 / 10, rel=1e-13)
    assert np.delete(averages, 10).max() == 0


def test_a_spectrum_goes_on_with_its_end_values():
    short = Spectrum.of([500, 600], [0.2, 0.8])
    assert short.at([360, 500, 550, 600, 830]).tolist() == [0.2, 0.2, 0.5, 0.8, 0.8]
    assert short.integral() == pytest.approx(0.2 * 140 + 0.5 * 100 + 0.8 * 230)


def test_a_single_sample_is_a_constant():
    assert Spectrum.of([300], [0.75]).in_bands(DEFAULT_BANDS).tolist() == [0.75] * 31


def test_the_integral_between_two_places_is_that_of_the_lines_between_them():
    assert Spectrum.of([400, 500], [0, 1]).integral(450, 475) == pytest.approx(25 * (0.5 + 0.75) / 2)


def test_centre_values_are_the_spectrum_at_the_centres():
    np.testing.assert_array_equal(JAGGED.in_bands(UNEVEN, "centre"), JAGGED.at(UNEVEN.centres))


def test_watts_are_the_integral_over_the_full_range():
    lamp = JAGGED.with_watts(60)
    assert lamp.unit == Unit.POWER
    assert lamp.integral(*FULL_RANGE) == pytest.approx(60, rel=1e-14)
    np.testing.assert_allclose(lamp.values / JAGGED.values, lamp.values[0] / JAGGED.values[0])


def test_the_power_in_adjacent_bands_adds_up_to_the_whole():
    bands = Bands.regular(365, 10, 47)  # 360 to 830 nm
    lamp = JAGGED.with_watts(3)
    assert lamp.in_bands(bands) @ bands.widths == pytest.approx(3, rel=1e-13)


@given(
    st.lists(st.floats(330, 900), min_size=1, max_size=20, unique=True).map(sorted),
    st.lists(st.floats(365, 825), min_size=2, max_size=12, unique=True).map(sorted),
    st.data(),
)
def test_bands_lose_no_power(wavelengths, edges, data):
    values = data.draw(st.lists(st.floats(0, 1e3), min_size=len(wavelengths), max_size=len(wavelengths)))
    low, high = np.array(edges[:-1]), np.array(edges[1:])
    assume(np.diff(edges).min() > 1e-6)
    bands = Bands((low + high) / 2, np.array(edges))
    spectrum = Spectrum.of(wavelengths, values)
    total = spectrum.in_bands(bands) @ bands.widths
    assert total == pytest.approx(spectrum.integral(edges[0], edges[-1]), rel=1e-9, abs=1e-9)
    assert spectrum.in_bands(bands).max() <= max(values) * (1 + 1e-6) + 1e-9


def test_scaling_keeps_the_shape_and_can_change_the_unit():
    light = JAGGED.scaled(2, Unit.RADIANCE)
    assert light.unit == Unit.RADIANCE
    np.testing.assert_array_equal(light.values, 2 * JAGGED.values)
    assert JAGGED.scaled(2).unit == JAGGED.unit


def test_the_default_bands_are_those_of_rendertoolbox3():
    assert DEFAULT_BANDS.centres.tolist() == list(range(400, 701, 10))
    assert DEFAULT_BANDS.edges.tolist() == list(range(395, 706, 10))


def test_bands_around_centres_meet_halfway():
    assert Bands.around([400, 410, 440]).edges.tolist() == [395, 405, 425, 455]


@pytest.mark.parametrize(
    ("make", "sentence"),
    [
        (lambda: Spectrum.of([], []), "at least one sample"),
        (lambda: Spectrum.of([400, 400], [1, 2]), "must increase"),
        (lambda: Spectrum.of([500, 400], [1, 2]), "must increase"),
        (lambda: Spectrum.of([400, 500], [1]), "values for"),
        (lambda: Spectrum.of([400, np.nan], [1, 2]), "finite"),
        (lambda: Spectrum.of([400, 500], [1, np.inf]), "finite"),
        (lambda: Spectrum.constant(0).with_watts(5), "cannot carry watts"),
        (lambda: Bands.regular(400, 0, 31), "positive step"),
        (lambda: Bands.regular(400, 10, 0), "positive step"),
        (lambda: Bands.around([400]), "single centre"),
        (lambda: Bands(np.array([400.0]), np.array([395.0])), "edges for 1 bands"),
        (lambda: Bands(np.array([400, 410.0]), np.array([395, 411, 415.0])), "between its edges"),
    ],
)
def test_a_wrong_spectrum_or_band_says_what_is_wrong(make, sentence):
    with pytest.raises(ValueError, match=sentence):
        make()
