"""
Measured surfaces: a file in Mitsuba's tensor format, made up here, of a surface whose every number is known.

The format is that of Dupuy and Jakob, An Adaptive Parameterization for Efficient Material Acquisition and
Rendering, 2018: f = spectra ndf / (4 sigma), looked up by way of a distribution of half vectors.
"""

import struct
from dataclasses import replace

import numpy as np
import pytest

from rtb_addon.errors import RenderingError
from rtb_addon.renderers.mitsuba import llvm, session
from rtb_addon.scene.render_scene import Material
from rtb_addon.spectra import Spectrum
from tests.renderings.mitsuba_scenes import BANDS, INTENSITY, assert_within_noise, lamp, picture, scene

NANOMETRES = np.arange(360.0, 1001.0, 20.0)
COLOUR = 0.5 + 0.4 * np.sin(NANOMETRES / 60)
_TYPES = {np.dtype(np.float32): 10, np.dtype(np.uint8): 1}


def write_tensors(path, tensors):
    """Write a tensor file: magic, version, number of fields; each its name, type, offset and shape."""
    names = {name: name.encode() for name in tensors}
    head = 12 + 2 + 4
    head += sum(2 + len(names[name]) + 2 + 1 + 8 + 8 * each.ndim for name, each in tensors.items())
    fields, data = b"", b""
    for name, each in tensors.items():
        place = head + len(data)
        fields += struct.pack("<H", len(names[name])) + names[name]
        fields += struct.pack("<HBQ", each.ndim, _TYPES[each.dtype], place)
        fields += struct.pack(f"<{each.ndim}Q", *each.shape)
        data += np.ascontiguousarray(each).tobytes()
    path.write_bytes(b"tensor_file\0" + struct.pack("<BBI", 1, 0, len(tensors)) + fields + data)


def write_lambertian(path, n=32):
    """
    Write an isotropic surface that reflects its colour over pi, whatever the directions.

    What lies between the numbers is not even: theta = u^2 pi / 2 and phi = (2 v - 1) pi. The half vectors are
    taken to be evenly spread over (u, v), and cosines are part of the spectra: Mitsuba has f cos.
    """
    theta_i = np.linspace(0, np.pi / 2, 8, dtype=np.float32)
    phi_i = np.zeros(1, np.float32)
    cosines = _outgoing_cosines(theta_i, n)
    spectra = (COLOUR[None, None, :, None, None] / np.pi * cosines[None, :, None]).astype(np.float32)
    even = np.ones((1, len(theta_i), n, n), np.float32)
    write_tensors(
        path,
        {
            "description": np.frombuffer(b"made up", np.uint8),
            "jacobian": np.zeros(1, np.uint8),
            "luminance": even,
            "ndf": np.ones((2, 2), np.float32),
            "phi_i": phi_i,
            "sigma": np.ones((2, 2), np.float32),
            "spectra": spectra,
            "theta_i": theta_i,
            "vndf": even,
            "wavelengths": NANOMETRES.astype(np.float32),
        },
    )
    return path


def _outgoing_cosines(theta_i, n):
    """Return the (angles, n, n) cosines of directions, by v and u of their half vectors."""
    u, v = np.meshgrid(np.linspace(0, 1, n), np.linspace(0, 1, n))
    theta, phi = u**2 * np.pi / 2, (2 * v - 1) * np.pi
    half = np.stack([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)], axis=-1)
    towards = np.stack([np.sin(theta_i), 0 * theta_i, np.cos(theta_i)], axis=-1)
    both = np.einsum("ti,vui->tvu", towards, half)
    return np.maximum(2 * both * half[..., 2] - towards[:, None, None, 2], 0)


@pytest.fixture
def native_surface(tmp_path):
    """Return a floor of the surface that was made up."""
    file = write_lambertian(tmp_path / "paper.bsdf")
    one = scene(environment=lamp("environment", filename=""), samples=1024, kind="centre")
    paint = Material("paint", "measured", {"filename": str(file)})
    return replace(one, materials={**one.materials, "paint": paint})


def test_a_measured_surface_shows_the_spectrum_in_its_file(tmp_path, native_surface):
    image = picture(native_surface, tmp_path)
    assert image.attributes["integrator"] == "all-bands path"
    expected = Spectrum(NANOMETRES, COLOUR).at(BANDS.centres) * INTENSITY.in_bands(BANDS, "centre")
    # Mitsuba interpolates cosines between 32 x 32 half vectors and eight angles.
    assert_within_noise(image, expected, floor=5e-3)


def test_a_lambertian_surface_in_a_file_has_the_cosine_of_the_light(tmp_path, native_surface):
    llvm.prepare()
    file = native_surface.materials["paint"].parameters["filename"]
    mi = session.start(session.FAST_BANDS, 1)
    import drjit as dr

    paper = mi.load_dict({"type": "measured", "filename": file})
    si = dr.zeros(mi.SurfaceInteraction3f, 3)
    angle = np.radians([0.0, 20.0, 50.0])
    si.wi = mi.Vector3f(0, 0, 1)
    si.wavelengths = mi.Spectrum(400.0, 500.0, 600.0, 700.0)
    wo = mi.Vector3f(np.sin(angle), np.zeros(3), np.cos(angle))
    value = np.array(paper.eval(mi.BSDFContext(), si, wo))
    expected = Spectrum(NANOMETRES, COLOUR).at([400, 500, 600, 700])[:, None] / np.pi * np.cos(angle)
    np.testing.assert_allclose(value, expected, rtol=5e-3)


def test_a_file_that_is_none_is_said_in_one_sentence(tmp_path, native_surface):
    (tmp_path / "paper.bsdf").write_bytes(b"paper")
    with pytest.raises(RenderingError, match="Mitsuba failed") as caught:
        picture(native_surface, tmp_path)
    assert "\n" not in str(caught.value)
