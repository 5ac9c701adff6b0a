"""Colours of Blender's working spaces, which only Blender 5 has several of: tests/gui asks it itself."""

import warnings

import numpy as np
import pytest

NAMES = {"Linear Rec.709": "ITU-R BT.709", "Linear Rec.2020": "ITU-R BT.2020", "ACEScg": "ACEScg"}


@pytest.mark.parametrize("space", NAMES)
def test_working_spaces_become_rec709_as_colour_science_has_it(library, space):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        import colour

    spaces = colour.RGB_COLOURSPACES
    wanted = colour.matrix_RGB_to_RGB(spaces[NAMES[space]], spaces["ITU-R BT.709"], "Bradford")
    np.testing.assert_allclose(library("blender.colours").to_rec709(space), wanted, atol=2e-4)


def test_blender_4_works_in_rec709(library):
    colours = library("blender.colours")
    assert colours.working_space() == "Linear Rec.709"
    assert colours.linear_rec709((0.8, 0.2, 0.1, 1.0)) == (0.8, 0.2, 0.1)


def test_a_colour_that_rec709_cannot_show_has_no_negative_part(library, monkeypatch):
    colours = library("blender.colours")
    monkeypatch.setattr(colours, "working_space", lambda: "ACEScg")
    red, green, blue = colours.linear_rec709((0.0, 1.0, 0.0))
    assert red == blue == 0.0
    assert green > 1.0
