"""Spectra as text and in files: round trips, old files, and errors that help."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rtb_addon.errors import RecipeError
from rtb_addon.spectra import DEFAULT_BANDS, Spectrum, Unit
from rtb_addon.spectra.files import read_spd, spd_text, write_spd
from rtb_addon.spectra.text import format_spectrum, parse_spectrum

samples = st.dictionaries(st.floats(1, 5000), st.floats(-1e30, 1e30), min_size=1, max_size=30).map(
    lambda pairs: Spectrum.of(sorted(pairs), [pairs[w] for w in sorted(pairs)])
)


@given(samples)
def test_a_spectrum_survives_being_written_as_text(spectrum):
    again = parse_spectrum(format_spectrum(spectrum))
    assert again.wavelengths.tolist() == spectrum.wavelengths.tolist()
    assert again.values.tolist() == spectrum.values.tolist()


def test_pairs_are_read_as_rendertoolbox3_wrote_them():
    spectrum = parse_spectrum("300:0.1 550:0.5  800:0.9", Unit.INTENSITY)
    assert spectrum.unit == Unit.INTENSITY
    assert spectrum.wavelengths.tolist() == [300, 550, 800]
    assert spectrum.values.tolist() == [0.1, 0.5, 0.9]


@pytest.mark.parametrize("text", ["300:0.75", "0.75", " 0.75 ", "7.5e-1"])
def test_one_pair_or_one_number_is_a_constant(text):
    assert parse_spectrum(text).in_bands(DEFAULT_BANDS) == pytest.approx(0.75, rel=1e-14)


def test_texts_are_as_short_as_they_can_be():
    assert format_spectrum(Spectrum.of([300, 450.5], [1, 0.1])) == "300:1 450.5:0.1"


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("", "empty"),
        ("300:0.5 800", "'800' is no wavelength:value pair"),
        ("300:0.5 800:O.9", "'O.9' in '800:O.9' is no number"),
        ("0.2 0.3 0.4", "'0.2' is no wavelength:value pair"),
        ("800:1 300:1", "must increase"),
        ("300:nan", "finite"),
        ("grey", "'grey' is no number"),
    ],
)
def test_a_text_that_is_no_spectrum_says_why(text, sentence):
    with pytest.raises(ValueError, match=sentence) as raised:
        parse_spectrum(text)
    assert not str(raised.value).endswith(".")


@given(samples)
def test_a_file_keeps_nine_digits(spectrum):
    numbers = np.array(spd_text(spectrum).split(), float)
    np.testing.assert_allclose(numbers[0::2], spectrum.wavelengths, rtol=1e-8)
    np.testing.assert_allclose(numbers[1::2], spectrum.values, rtol=1e-8)


def test_a_spectrum_survives_its_file(tmp_path):
    dim = Spectrum.of([380, 500.5, 780], [1.25e-9, 3e-7, 0])
    write_spd(tmp_path / "new" / "dim.spd", dim)
    again = read_spd(tmp_path / "new" / "dim.spd", Unit.RADIANCE)
    assert again.unit == Unit.RADIANCE
    assert again.wavelengths.tolist() == dim.wavelengths.tolist()
    assert again.values.tolist() == dim.values.tolist()


def test_comments_blank_lines_and_windows_line_ends_are_understood(tmp_path):
    path = tmp_path / "paint.spd"
    path.write_bytes(b"\xef\xbb\xbf# measured\r\n% by hand\r\n\r\n380 0.1\t# dark\r\n  400 0.2\r\n\r\n")
    assert read_spd(path).values.tolist() == [0.1, 0.2]


def test_numbers_are_one_stream_of_pairs(tmp_path):
    path = tmp_path / "stream.spd"
    path.write_text("380 0.1 400\n0.2 420 0.3")
    assert read_spd(path).wavelengths.tolist() == [380, 400, 420]


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (
            b"380 0.1\n400 O.2\n",
            "bad.spd:2: 'O.2' is no number, want a wavelength [nm] and a value on each line",
        ),
        (b"380 0.1\n\n370 0.2\n", "bad.spd:3: 370 nm comes after 380 nm, wavelengths must increase"),
        (b"380 0.1\n380 0.2\n", "bad.spd:2: 380 nm comes after 380 nm, wavelengths must increase"),
        (
            b"380 0.1\n400\n",
            "bad.spd: 3 numbers are no pairs, want a wavelength [nm] and a value on each line",
        ),
        (b"# nothing\n", "bad.spd: 0 numbers are no pairs, want a wavelength [nm] and a value on each line"),
        (b"380 nan\n", "bad.spd: wavelengths and values must be finite numbers"),
        (b"\xff\xfe\x00", "bad.spd: not a text file, want a wavelength [nm] and a value on each line"),
    ],
)
def test_a_bad_file_is_reported_with_its_line(tmp_path, content, message):
    (tmp_path / "bad.spd").write_bytes(content)
    with pytest.raises(RecipeError) as raised:
        read_spd(tmp_path / "bad.spd")
    assert str(raised.value) == message


def test_a_missing_file_is_one_sentence(tmp_path):
    with pytest.raises(RecipeError, match=r"cannot read the spectrum file .*gone\.spd: No such file"):
        read_spd(tmp_path / "gone.spd")
