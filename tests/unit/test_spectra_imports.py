"""Spectra from the files of instruments and toolboxes; SciPy writes and reads MATLAB's for comparison."""

import numpy as np
import pytest
import scipy.io

from rtb_addon.errors import RecipeError
from rtb_addon.spectra.imports import read_spectra
from rtb_addon.spectra.library import find, names
from rtb_addon.spectra.matlab import read_arrays

SURFACES = np.linspace(0.1, 0.9, 31 * 3).reshape(31, 3)
TOOLBOX = {"S_paint": [400, 10, 31], "sur_paint": SURFACES}


@pytest.mark.parametrize("said", [{"format": "4"}, {"format": "5"}, {"format": "5", "do_compression": True}])
def test_matlab_files_of_every_plain_kind_are_read(tmp_path, said):
    file = tmp_path / "paint.mat"
    others = {"whole": np.arange(6, dtype=np.int16).reshape(2, 3), "single": np.float32([[1.5]])}
    scipy.io.savemat(file, {**TOOLBOX, **others, "word": "red"}, **said)
    found = read_arrays(file)
    assert set(found) == {"S_paint", "sur_paint", "whole", "single"}
    np.testing.assert_array_equal(found["sur_paint"], SURFACES)
    np.testing.assert_array_equal(found["whole"], others["whole"])


def test_what_is_not_plain_is_left_out(tmp_path):
    file = tmp_path / "odd.mat"
    odd = {"cells": np.array([[1, "two"]], object), "struct": {"a": 1}, "complex": np.array([[1 + 2j]])}
    scipy.io.savemat(file, {**odd, "cube": np.zeros((2, 2, 2)), "plain": [[3.0]]})
    assert set(read_arrays(file)) == {"plain"}


def test_files_of_the_other_byte_order_are_read(tmp_path):
    # One real double called x, 2 by 1, as MATLAB on a PowerPC wrote it.
    import struct

    def element(kind, data):
        return struct.pack(">II", kind, len(data)) + data + b"\0" * (-len(data) % 8)

    matrix = (
        element(6, struct.pack(">II", 6, 0))
        + element(5, struct.pack(">ii", 2, 1))
        + element(1, b"x")
        + element(9, struct.pack(">dd", 1.25, -3.0))
    )
    head = b"MATLAB 5.0 MAT-file".ljust(124) + struct.pack(">H", 0x0100) + b"MI"
    (tmp_path / "big.mat").write_bytes(head + element(14, matrix))
    assert read_arrays(tmp_path / "big.mat")["x"].ravel().tolist() == [1.25, -3.0]


@pytest.mark.parametrize("cut", [60, 130, 200, 700])
def test_damaged_files_are_refused_in_one_sentence(tmp_path, cut):
    file = tmp_path / "paint.mat"
    scipy.io.savemat(file, TOOLBOX)
    file.write_bytes(file.read_bytes()[:cut])
    with pytest.raises(RecipeError, match=r"damaged, or no MATLAB file|it has no arrays"):
        read_spectra(file)


def test_a_toolboxs_surfaces_go_down_its_columns_and_sensitivities_along_rows(tmp_path):
    file = tmp_path / "paint.mat"
    scipy.io.savemat(file, {**TOOLBOX, "S_cones": [400, 10, 31], "T_cones": SURFACES.T})
    found = read_spectra(file)
    assert list(found) == [f"{kind}-{n}" for kind in ("sur_paint", "T_cones") for n in (1, 2, 3)]
    np.testing.assert_array_equal(found["sur_paint-2"].values, SURFACES[:, 1])
    np.testing.assert_array_equal(found["T_cones-2"].values, SURFACES[:, 1])
    assert found["sur_paint-1"].wavelengths.tolist() == list(range(400, 701, 10))


def test_a_matlab_file_without_spectra_says_what_it_has(tmp_path):
    scipy.io.savemat(tmp_path / "other.mat", {"rgbScale": [[1.0]]})
    with pytest.raises(RecipeError, match="has no spectra such as sur_name beside S_name, it has rgbScale"):
        read_spectra(tmp_path / "other.mat")


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ("400,0.1\n500,0.3\n", {"paint": (0.1, 0.3)}),
        ("wavelength,red,blue\n400,0.1,0.5\n500,0.3,0.6\n", {"red": (0.1, 0.3), "blue": (0.5, 0.6)}),
        ("nm;rot;rot\n500;0,3;0,6\n400;0,1;0,5\n", {"paint-1": (0.1, 0.3), "paint-2": (0.5, 0.6)}),
        ("# measured\n400\t0.1\n500\t0.3\n", {"paint": (0.1, 0.3)}),
        ("400 0.1 0.2\n500 0.3 0.4\n", {"paint-1": (0.1, 0.3), "paint-2": (0.2, 0.4)}),
    ],
)
def test_tables_have_a_spectrum_in_each_column(tmp_path, text, wanted):
    (tmp_path / "paint.csv").write_text(text)
    found = read_spectra(tmp_path / "paint.csv")
    assert {name: tuple(each.at([400, 500])) for name, each in found.items()} == wanted


@pytest.mark.parametrize("text", ["", "nm,red\n", "nm,red\n400,0.1\n500\n", "nm,red\n400,0.1\n400,0.2\n"])
def test_tables_that_are_no_spectra_are_refused_in_one_sentence(tmp_path, text):
    (tmp_path / "paint.csv").write_text(text)
    with pytest.raises(RecipeError) as caught:
        read_spectra(tmp_path / "paint.csv")
    assert "paint.csv" in str(caught.value)
    assert not str(caught.value).endswith(".")


def test_own_folders_are_a_part_of_the_library(tmp_path):
    (tmp_path / "paints").mkdir()
    (tmp_path / "paints/deep red.spd").write_text("400 0.1\n700 0.9\n")
    assert names([tmp_path])[-1] == "Own/paints/deep red"
    assert find("own/Paints/deep red", [tmp_path]).at(700) == 0.9
    assert find("D65", [tmp_path]) is find("D65")
    with pytest.raises(RecipeError, match="did you mean Own/paints/deep red"):
        find("Own/paints/deep rad", [tmp_path])
