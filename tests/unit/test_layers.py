"""Layers come back from their file bit for bit, and a file that is none is refused."""

import numpy as np
import pytest

from rtb_addon.errors import RecipeError
from rtb_addon.exr import write_exr
from rtb_addon.layers import NAMES, PARTS, Layers
from rtb_addon.spectra import Bands

BANDS = Bands.regular(400, 10, 3)


def all_layers() -> Layers:
    chance = np.random.default_rng(1)
    planes = {}
    for name, (parts, _) in PARTS.items():
        if parts == ("id",):
            planes[name] = chance.integers(0, 3, (4, 5))
        else:
            depth = () if parts == ("Z",) else (len(parts or BANDS.centres),)
            planes[name] = chance.random((4, 5, *depth)).astype(np.float32)
    planes["depth"][0, 0] = np.inf
    return Layers(planes, BANDS, {"object": ("Ball", "Floor"), "material": ("Red", "Größe")})


def test_every_layer_comes_back_as_it_was_written(tmp_path):
    written = all_layers()
    written.save(tmp_path / "all.exr")
    read = Layers.load(tmp_path / "all.exr")
    assert tuple(read.planes) == NAMES
    for name in NAMES:
        np.testing.assert_array_equal(read.planes[name], written.planes[name])
    assert read.names == written.names
    np.testing.assert_array_equal(read.bands.centres, BANDS.centres)


def test_layers_without_spectra_have_no_bands(tmp_path):
    Layers({"depth": np.ones((2, 3), np.float32)}).save(tmp_path / "depth.exr")
    read = Layers.load(tmp_path / "depth.exr")
    assert read.bands is None
    assert read.planes["depth"].shape == (2, 3)


def test_a_single_band_keeps_its_third_axis(tmp_path):
    Layers({"albedo": np.ones((2, 3, 1), np.float32)}, Bands.regular(550, 10, 1)).save(tmp_path / "one.exr")
    assert Layers.load(tmp_path / "one.exr").planes["albedo"].shape == (2, 3, 1)


@pytest.mark.parametrize(
    ("channel", "complaint"),
    [("S0.400,000000nm", "S0 is no layer"), ("normal.X", "layer normal is not whole.*'Y'")],
)
def test_a_file_that_holds_no_layers_is_refused(tmp_path, channel, complaint):
    write_exr(tmp_path / "other.exr", {}, {channel: np.ones((2, 2), np.float32)})
    with pytest.raises(RecipeError, match=complaint):
        Layers.load(tmp_path / "other.exr")
