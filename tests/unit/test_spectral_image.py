"""Radiance cubes and their files: every bit comes back, old files are read, broken ones say so."""

import os
import warnings
from pathlib import Path

import numpy as np
import OpenEXR
import pytest

from rtb_addon.errors import RecipeError
from rtb_addon.exr import is_whole, read_exr, write_exr
from rtb_addon.spectra import DEFAULT_BANDS, Bands
from rtb_addon.spectra.channels import bands_of_channels, channel_name
from rtb_addon.spectral_image import UNIT, SpectralImage

with warnings.catch_warnings():
    warnings.simplefilter("ignore")
    from colour.io.fichet2021 import PATTERN_FICHET2021

RTB4 = Path(os.environ.get("RTB4_FOLDER", Path(__file__).resolve().parents[3] / "shared" / "rtb4"))
COORDINATES_TEST = RTB4 / "Test/Automated/Fixture/CoordinatesTest.exr"


def noise(height, width, bands):
    """Radiance whose bits are random: subnormal, huge, negative, infinite and not a number too."""
    bits = np.random.default_rng(5).integers(0, 2**32, (height, width, bands), dtype=np.uint32)
    return bits.view(np.float32)


def test_a_cube_survives_its_file_to_the_last_bit(tmp_path):
    image = SpectralImage(
        noise(33, 17, 31), DEFAULT_BANDS, "centre", 0.1 + 0.2, {"condition": "café", "key": ""}
    )
    image.save(tmp_path / "new" / "cube.exr")
    again = SpectralImage.load(tmp_path / "new" / "cube.exr")
    assert again.radiance.dtype == np.float32
    assert again.radiance.tobytes() == image.radiance.tobytes()
    assert again.bands.centres.tolist() == DEFAULT_BANDS.centres.tolist()
    assert again.bands.edges.tolist() == DEFAULT_BANDS.edges.tolist()
    assert (again.band_kind, again.factor, dict(again.attributes)) == ("centre", 0.1 + 0.2, image.attributes)
    assert [path.name for path in (tmp_path / "new").iterdir()] == ["cube.exr"]


def test_uneven_bands_survive_exactly(tmp_path):
    bands = Bands(np.array([100 / 3, 99.5, 1000.25]), np.array([0.1, 60, 100.7, 1e4 / 7]))
    SpectralImage(noise(2, 3, 3), bands).save(tmp_path / "cube.exr")
    again = SpectralImage.load(tmp_path / "cube.exr").bands
    assert (again.centres.tolist(), again.edges.tolist()) == (bands.centres.tolist(), bands.edges.tolist())


def test_the_same_cube_is_the_same_file(tmp_path):
    for name in ("one.exr", "two.exr"):
        SpectralImage(noise(40, 30, 31), DEFAULT_BANDS).save(tmp_path / name)
    assert (tmp_path / "one.exr").read_bytes() == (tmp_path / "two.exr").read_bytes()


def test_a_file_is_in_the_spectral_layout(tmp_path):
    SpectralImage(np.ones((2, 3, 31), np.float32), DEFAULT_BANDS).save(tmp_path / "cube.exr")
    with OpenEXR.File(str(tmp_path / "cube.exr"), separate_channels=True) as file:
        header, channels = dict(file.header()), dict(file.channels())
        assert {channel.pixels.dtype for channel in channels.values()} == {np.dtype(np.float32)}
    assert next(iter(channels)) == "S0.400,000000nm"
    assert list(channels)[-1] == "S0.700,000000nm"
    assert len(channels) == 31
    assert header["spectralLayoutVersion"] == "1.0"
    assert header["emissiveUnits"] == "W.m^-2.sr^-1"
    assert header["polarisationHandedness"] == "right"
    assert header["rtb.unit"] == UNIT == "W sr-1 m-2 nm-1"
    assert header["rtb.band_kind"] == "averaged"
    assert header["rtb.band_edges"].split()[:2] == ["395", "405"]


def test_another_reader_of_the_layout_knows_our_channels():
    import re

    pattern = re.compile(r"S0\." + PATTERN_FICHET2021)
    found = pattern.fullmatch(channel_name(412.34))
    assert found is not None
    assert (found.group(1), found.group(3) or "", found.group(4)) == ("412,340000", "n", "m")


def test_scaling_is_recorded():
    image = SpectralImage(np.full((1, 1, 31), 3, np.float32), DEFAULT_BANDS, factor=2.0).scaled(0.25)
    assert image.factor == 0.5
    assert image.radiance.dtype == np.float32
    assert image.radiance.max() == 0.75


def test_later_attributes_win():
    image = SpectralImage(np.zeros((1, 1, 31), np.float32), DEFAULT_BANDS, attributes={"a": "1", "b": "2"})
    assert image.with_attributes({"b": "3"}).attributes == {"a": "1", "b": "3"}
    assert image.attributes == {"a": "1", "b": "2"}


def test_a_cube_of_another_number_of_bands_is_refused():
    with pytest.raises(ValueError, match=r"must be \(height, width, 31\), got \(4, 4, 3\)"):
        SpectralImage(np.zeros((4, 4, 3), np.float32), DEFAULT_BANDS)


def old_planes():
    """Half floats, named and ordered as Mitsuba 0.5 did, each plane filled with its wavelength."""
    names = {
        f"{low:.2f}-{low + 10:.2f}nm": np.full((3, 5), low + 5, np.float16) for low in range(895, 1205, 10)
    }
    return dict(sorted({**names, "A": np.ones((3, 5), np.float16)}.items()))


def test_bands_of_rendertoolbox3_are_sorted_by_number_and_others_dropped(tmp_path):
    write_exr(tmp_path / "old.exr", {}, old_planes())
    image = SpectralImage.load(tmp_path / "old.exr")
    assert image.radiance.shape == (3, 5, 31)
    assert image.radiance.dtype == np.float32
    assert image.radiance[2, 4].tolist() == image.bands.centres.tolist() == list(range(900, 1201, 10))
    assert image.bands.edges.tolist() == list(range(895, 1206, 10))


@pytest.mark.parametrize(
    ("names", "order", "centres", "edges"),
    [
        (["1000nm", "990nm", "depth"], ["990nm", "1000nm"], [990, 1000], [985, 995, 1005]),
        (["B", "410", "400", "430"], ["400", "410", "430"], [400, 410, 430], [395, 405, 420, 440]),
        (["550nm"], ["550nm"], [550], [549.5, 550.5]),
        (["395.00-405.00nm"], ["395.00-405.00nm"], [400], [395, 405]),
        (["500-510nm", "395-405"], ["395-405", "500-510nm"], [400, 505], [347.5, 452.5, 557.5]),
        (
            ["R", "S0.410,000000nm", "S0.400,500000nm", "S1.400,500000nm", "T.500,0nm"],
            ["S0.400,500000nm", "S0.410,000000nm"],
            [400.5, 410],
            [395.75, 405.25, 414.75],
        ),
    ],
)
def test_channels_are_understood_as_bands(names, order, centres, edges):
    found, bands = bands_of_channels(names)
    assert (found, bands.centres.tolist(), bands.edges.tolist()) == (order, centres, edges)


def test_two_channels_of_one_wavelength_are_refused():
    with pytest.raises(ValueError, match="two channels have the same wavelength"):
        bands_of_channels(["400nm", "395-405nm", "410"])


def test_a_picture_is_no_cube(tmp_path):
    write_exr(tmp_path / "rgb.exr", {}, {name: np.zeros((2, 2), np.float32) for name in "BGR"})
    with pytest.raises(
        RecipeError, match=r"^rgb\.exr: no channels like S0\.400,000000nm .*, it has B, G, R$"
    ):
        SpectralImage.load(tmp_path / "rgb.exr")


def test_a_missing_cube_is_one_sentence(tmp_path):
    with pytest.raises(RecipeError, match=r"there is no file .*gone\.exr$"):
        SpectralImage.load(tmp_path / "gone.exr")


def test_a_file_cut_off_anywhere_is_one_sentence_and_no_noise(tmp_path, capfd):
    SpectralImage(noise(40, 20, 31), DEFAULT_BANDS).save(tmp_path / "cube.exr")
    whole = (tmp_path / "cube.exr").read_bytes()
    assert is_whole(tmp_path / "cube.exr")
    for length in [0, 1, 4, 7, 8, 9, 100, 700, 1000, 1500, 2000, len(whole) // 2, len(whole) - 1]:
        (tmp_path / "cut.exr").write_bytes(whole[:length])
        with pytest.raises(RecipeError, match=r"^cut\.exr: not a whole OpenEXR file"):
            SpectralImage.load(tmp_path / "cut.exr")
    assert capfd.readouterr() == ("", "")


def test_a_file_whose_table_of_lines_was_never_written_is_not_whole(tmp_path):
    SpectralImage(noise(40, 20, 31), DEFAULT_BANDS).save(tmp_path / "cube.exr")
    content = bytearray((tmp_path / "cube.exr").read_bytes())
    start = find_table(content)
    content[start + 8 : start + 16] = bytes(8)
    (tmp_path / "cube.exr").write_bytes(content)
    assert not is_whole(tmp_path / "cube.exr")


def find_table(content):
    """Return where the table of forty offsets begins: it holds the place right after itself."""
    return next(at for at in range(len(content)) if content[at : at + 8] == (at + 320).to_bytes(8, "little"))


def test_something_else_is_no_openexr_file(tmp_path):
    (tmp_path / "text.exr").write_text("a text that is longer than a header of nothing")
    with pytest.raises(RecipeError, match=r"^text\.exr: not a whole OpenEXR file"):
        SpectralImage.load(tmp_path / "text.exr")


@pytest.mark.parametrize(
    ("word", "content", "sentence"),
    [
        ("rtb.unit", "W m-2 nm-1", "its numbers are W m-2 nm-1, a rendering's are W sr-1 m-2 nm-1"),
        ("rtb.band_kind", "guessed", "'guessed' is none of the band kinds averaged, mean, centre"),
        ("rtb.band_edges", "395 405", "2 edges for 31 bands"),
        ("rtb.band_centres", " ".join(map(str, range(401, 702, 10))), "differs from its channels"),
        ("rtb.factor", "one", "could not convert string to float: 'one'"),
    ],
)
def test_attributes_that_contradict_the_cube_are_refused(tmp_path, word, content, sentence):
    SpectralImage(np.ones((2, 2, 31), np.float32), DEFAULT_BANDS).save(tmp_path / "cube.exr")
    header, planes = read_exr(tmp_path / "cube.exr")
    texts = {name: value for name, value in header.items() if isinstance(value, str)}
    write_exr(tmp_path / "odd.exr", {**texts, word: content}, planes)
    with pytest.raises(RecipeError, match=rf"^odd\.exr: .*{sentence}"):
        SpectralImage.load(tmp_path / "odd.exr")


def test_a_folder_that_cannot_be_written_is_one_sentence(tmp_path):
    (tmp_path / "taken").write_text("a file, not a folder")
    with pytest.raises(RecipeError, match=r"cannot write cube\.exr into .*taken"):
        SpectralImage(np.ones((2, 2, 31), np.float32), DEFAULT_BANDS).save(tmp_path / "taken" / "cube.exr")


@pytest.mark.skipif(
    not COORDINATES_TEST.is_file(),
    reason=f"RENDERTOOLBOX4'S FILES ARE NOT HERE: no {COORDINATES_TEST}, set RTB4_FOLDER",
)
def test_the_stored_coordinates_test_of_rendertoolbox_is_read():
    image = SpectralImage.load(COORDINATES_TEST)
    assert image.radiance.shape == (240, 320, 31)
    assert image.bands.centres.tolist() == DEFAULT_BANDS.centres.tolist()
    assert image.bands.edges.tolist() == DEFAULT_BANDS.edges.tolist()
    assert image.attributes == {}
    # Where the objects' centres are known to lie: +X sphere red, +Y sphere green, -Z cube blue.
    for (column, row), brightest in {(234, 140): 700, (231, 17): 550, (179, 86): 440}.items():
        spectrum = image.radiance[row, column]
        at = {nm: spectrum[round((nm - 400) / 10)] for nm in (440, 550, 700)}
        assert max(at, key=at.get) == brightest
