"""Experimental designs: what generators put into a table."""

import numpy as np
import pytest

from rtb_addon.designs import (
    graded,
    grid,
    parse_lists,
    parse_ranges,
    random_numbers,
    sobol,
    sobol_numbers,
    spaced,
)
from rtb_addon.errors import RecipeError
from rtb_addon.spectra import FULL_RANGE, Spectrum
from rtb_addon.spectra.spoken import spectrum_from


def test_spaced_numbers_begin_and_end_where_said_and_are_equally_far_apart():
    assert spaced(1, 2, 5) == ["1", "1.25", "1.5", "1.75", "2"]
    assert spaced(0.01, 100, 5, logarithmic=True) == ["0.01", "0.1", "1", "10", "100"]
    assert spaced(-1, -100, 3, logarithmic=True) == ["-1", "-10", "-100"]


def test_equal_ratios_through_zero_are_refused():
    with pytest.raises(RecipeError, match="one sign"):
        spaced(0, 10, 3, logarithmic=True)


def test_a_seed_gives_the_same_random_numbers_and_another_others():
    ranges = [(0.0, 1.0), (-5.0, 5.0)]
    assert random_numbers(ranges, 6, 3) == random_numbers(ranges, 6, 3)
    assert random_numbers(ranges, 6, 3) != random_numbers(ranges, 6, 4)
    numbers = np.array(random_numbers(ranges, 400, 1), float)
    assert (np.abs(numbers[:, 1]) <= 5).all()
    # The mean of n uniform numbers spreads by width / sqrt(12 n).
    assert abs(numbers[:, 1].mean()) < 4 * 10 / np.sqrt(12 * 400)


@pytest.mark.parametrize("seed", [0, 1, 7])
def test_sobols_points_are_one_to_each_interval_of_every_dimension(seed):
    points = sobol(64, 10, seed)
    for column in points.T:
        assert sorted(np.floor(column * 64).astype(int)) == list(range(64))


@pytest.mark.parametrize("across", [0, 1, 2, 3, 4, 5, 6])
def test_sobols_first_two_dimensions_are_one_to_each_elementary_interval(across):
    points = sobol(64, 2, seed=5)
    boxes = {(int(x * 2**across), int(y * 2 ** (6 - across))) for x, y in points.tolist()}
    assert len(boxes) == 64


def test_sobols_points_are_those_of_the_published_direction_numbers():
    # Joe and Kuo's third and fourth points, relative to the shifted first one, by exclusive or.
    bits = (sobol(4, 5, seed=2) * 2**32).astype(np.uint64)
    relative = (bits ^ bits[0]) / 2**32
    assert np.allclose(relative[1], 0.5, atol=1e-9)
    assert np.allclose(relative[2], [0.75, 0.25, 0.25, 0.25, 0.75], atol=1e-9)


def test_sobol_fills_ranges_and_says_how_many_variables_it_has():
    rows = np.array(sobol_numbers([(2, 4), (0, 1)], 32, 0), float)
    assert 2 <= rows[:, 0].min() < 2.1
    assert 3.9 < rows[:, 0].max() <= 4
    with pytest.raises(RecipeError, match="1 to 10 variables"):
        sobol(4, 11, 0)


def test_graded_spectra_go_from_one_to_the_other_in_equal_steps():
    first, last = Spectrum.constant(0.2), Spectrum.of([400, 700], [0.4, 0.8])
    steps = [spectrum_from(text) for text in graded(first, last, 3)]
    places = np.linspace(400, 700, 7)
    assert np.allclose(steps[0].at(places), 0.2)
    assert np.allclose(steps[1].at(places), (0.2 + last.at(places)) / 2, atol=1e-6)
    assert np.allclose(steps[2].at(places), last.at(places), atol=1e-6)
    assert steps[1].wavelengths.min() >= FULL_RANGE[0]


def test_a_grid_holds_every_combination_once():
    rows = grid({"gloss": ["0", "1"], "paint": ["a", "b", "c"]})
    assert rows == [["0", "a"], ["0", "b"], ["0", "c"], ["1", "a"], ["1", "b"], ["1", "c"]]


def test_lists_and_ranges_are_read_as_a_person_writes_them():
    assert parse_lists("gloss = 0.1, 0.2; paint=BabelColor Average/blue") == {
        "gloss": ["0.1", "0.2"],
        "paint": ["BabelColor Average/blue"],
    }
    assert parse_ranges("gloss = 0 1;distance = -2 5.5;") == {"gloss": (0, 1), "distance": (-2, 5.5)}


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("gloss 0 1", "says nothing of a variable"),
        ("gloss = a b", "no range of gloss"),
        ("", "no variable is named"),
    ],
)
def test_what_is_no_range_is_said_in_a_sentence(text, sentence):
    with pytest.raises(RecipeError, match=sentence):
        parse_ranges(text)
