"""Fluorescent surfaces in the tracer: energy in closed form, and light to and fro between two of them."""

from dataclasses import replace

import numpy as np
import pytest

from rtb_addon.errors import RecipeError
from rtb_addon.exr import write_exr
from rtb_addon.renderers.tracer.materials import fluorescence
from rtb_addon.scene.render_scene import Camera, Material, Shape
from rtb_addon.spectra import Bands, Spectrum, Unit, library
from rtb_addon.spectra.donaldson import Donaldson, read_donaldson
from tests.renderings.tracer_scenes import (
    BANDS,
    SQUARE,
    assert_within_noise,
    facing,
    lamp,
    looking_down,
    matrix,
    matte,
    picture,
    polygon,
    scene,
    sky,
)

# Excited below the film, and in its first two bands; whatever comes back is of longer waves.
INCOMING, OUTGOING = np.array([300.0, 400, 500, 600, 700]), np.array([400.0, 500, 600, 700])
SHARES = np.array(
    [
        [0.10, 0.15, 0.00, 0.00, 0.00],
        [0.25, 0.30, 0.20, 0.00, 0.00],
        [0.05, 0.15, 0.40, 0.45, 0.00],
        [0.00, 0.02, 0.10, 0.00, 0.60],
    ]
)
ALL = Bands.regular(300, 100, 5)


def table(path, shares=SHARES, incoming=INCOMING, outgoing=OUTGOING):
    """Write a matrix as a table, and return the file's name."""
    lines = ["# incoming", " ".join(map(str, incoming))]
    lines += [" ".join(map(str, [out, *row])) for out, row in zip(outgoing, shares, strict=True)]
    path.write_text("\n".join(lines))
    return str(path)


def glowing(file, id="glow"):
    return Material(id, "fluorescent", {"filename": file})


def bispectral(path, shares=SHARES):
    """Write a matrix as a spectral EXR, and return the file's name."""
    planes = {}
    for out, row in zip(OUTGOING, shares, strict=True):
        for into, share in zip(INCOMING, row, strict=True):
            name = f"T.{into:.0f},000000nm" + (f".{out:.0f},000000nm" if into != out else "")
            if share or into == out:
                planes[name] = np.full((2, 3), share, np.float32)
    planes["T.300,000000nm"] = np.zeros((2, 3), np.float32)
    write_exr(path, {}, planes)
    return str(path)


@pytest.mark.parametrize("write", [table, bispectral])
def test_a_matrix_is_read_from_a_table_and_from_a_picture(tmp_path, write):
    found = read_donaldson(tmp_path / write(tmp_path / ("m.exr" if write is bispectral else "m.txt")))
    out = np.isin(found.outgoing, OUTGOING)
    np.testing.assert_array_equal(found.incoming, INCOMING)
    np.testing.assert_allclose(found.shares[out], SHARES, rtol=1e-6)
    assert found.exciting == (250, 550)
    plain, turned = found.in_bands(ALL, "averaged")
    np.testing.assert_allclose(plain[1:], [0.15, 0.2, 0.45, 0.6], atol=0.03)
    np.testing.assert_allclose(turned[1:, 0], SHARES[:, 0], rtol=1e-6)
    np.testing.assert_allclose(turned[2:, 1], SHARES[1:, 1], rtol=1e-6)
    assert turned[1, 1] == 0


def test_finer_and_wider_bands_get_the_same_energy():
    """What comes back per nanometre, over the whole spectrum, for light of one step of the matrix."""
    found = Donaldson(INCOMING, OUTGOING, SHARES)
    expected = SHARES[1:, 1].sum() * 100
    for step in (100, 50, 20, 10):
        bands = Bands.regular(250 + step / 2, step, 500 // step)
        light = (np.abs(bands.centres - 400) < 50) * 1.0
        _, turned = found.in_bands(bands, "averaged")
        assert (turned @ light * bands.widths).sum() == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("illuminant", ["D65", "FL2"])
def test_a_flat_fluorescent_reflector_returns_the_matrix_times_the_light(tmp_path, illuminant):
    """No noise: under a sun the whole sum is taken at once, what lies below the film included."""
    floor = Shape("floor", SQUARE, matrix(), "glow")
    sun, light = lamp("directional", matrix()), library.find(illuminant)
    sun.parameters["intensity"] = light
    seen = picture(scene([floor], [sun], [glowing(table(tmp_path / "m.txt"))]), tmp_path)[0, 0]
    incoming = light.in_bands(ALL)
    found = Donaldson(INCOMING, OUTGOING, SHARES)
    plain, turned = found.in_bands(ALL, "averaged")
    expected = (plain * incoming + turned @ incoming)[1:] / np.pi
    np.testing.assert_allclose(seen, expected, rtol=1e-5)
    # Off the diagonal it is the matrix itself that was typed in above.
    typed = np.where(OUTGOING[:, None] == INCOMING, 0, SHARES) @ incoming
    np.testing.assert_allclose(turned[1:] @ incoming, typed, rtol=1e-9)
    assert (typed / np.pi / seen > 0.1).any()


def test_light_that_paths_find_by_themselves_counts_as_much(tmp_path):
    """Under an even sky only scattering finds light: one band at a time, the sum on average."""
    floor, light = Shape("floor", SQUARE, matrix(), "glow"), Spectrum.of([300, 700], [3.0, 0.5])
    around = sky()
    around.parameters["intensity"] = Spectrum.of(light.wavelengths, light.values, Unit.RADIANCE)
    plain, turned = Donaldson(INCOMING, OUTGOING, SHARES).in_bands(ALL, "averaged")
    incoming = light.in_bands(ALL)
    file = table(tmp_path / "m.txt")

    def lit(seed):
        return scene([floor], [], [glowing(file)], samples=4096, seed=seed, environment=around)

    assert_within_noise(lit, tmp_path, (plain * incoming + turned @ incoming)[1:])


def facing_factor(width, gap, n=12):
    """Return the (n n, n n) form factors between patches of two parallel squares, and their middles."""
    edges = np.linspace(-width / 2, width / 2, n + 1)
    middles = (edges[1:] + edges[:-1]) / 2
    x, y = (each.ravel() for each in np.meshgrid(middles, middles))
    # Each patch sees the mean of a finer grid of points.
    fine = ((np.arange(4) + 0.5) / 4 - 0.5) * width / n
    total = np.zeros((n * n, n * n))
    for a in fine:
        for b in fine:
            apart2 = (x[:, None] - x - a) ** 2 + (y[:, None] - y - b) ** 2 + gap**2
            total += gap**2 / (np.pi * apart2**2) / 16
    return total * (width / n) ** 2, x, y


def test_two_fluorescent_plates_light_each_other_as_radiosity_says(tmp_path):
    """
    Two parallel plates of different matrices; the sun shines between them from the side, at 45 degrees.

    The radiosity of every patch of either plate, in every band, bounce by bounce.
    """
    width, gap, depth = 2.0, 1.0, 5
    other = np.where(OUTGOING[:, None] == INCOMING, 0.3, 0.25 * (OUTGOING[:, None] > INCOMING))
    a, sun = np.radians(45), lamp("directional", facing((1, 0, 1), (0, 0, 0)), [1, 1, 1, 1])
    light = Spectrum.of([300, 400, 500, 600, 700], [4.0, 2.0, 1.0, 1.0, 1.0], Unit.IRRADIANCE)
    sun.parameters["intensity"] = light
    factors, x, _ = facing_factor(width, gap)
    matrices = [
        np.diag(plain) + turned
        for plain, turned in (
            Donaldson(INCOMING, OUTGOING, shares).in_bands(ALL, "averaged") for shares in (SHARES, other)
        )
    ]
    # The sun comes from +X under the upper plate: it lights what is within the gap's shadow of the edge.
    share = np.clip((x + width / 2 / 12 - (width / 2 - gap)) / (width / 12), 0, 1)
    incoming = light.in_bands(ALL) * np.cos(a)
    lower, upper = share[:, None] * incoming @ matrices[0].T, np.zeros((len(x), 5))
    total = lower.copy()
    for _ in range(depth - 2):
        lower, upper = factors @ upper @ matrices[0].T, factors @ lower @ matrices[1].T
        total += lower
    expected = total.mean(axis=0)[1:] / np.pi
    plates = [
        Shape("lower", SQUARE, matrix((0, 0, 0)), "lower"),
        Shape("upper", SQUARE, matrix((0, 0, gap)), "upper"),
    ]
    materials = [
        glowing(table(tmp_path / "a.txt"), "lower"),
        glowing(table(tmp_path / "b.txt", other), "upper"),
    ]
    # The camera looks from between the plates.
    camera = Camera("c", "orthographic", matrix((0, 0, gap / 2)), (-1, 1, -1, 1))

    def lit(seed):
        return scene(plates, [sun], materials, camera, depth, 64, (16, 16), seed)

    runs = np.array([picture(lit(seed), tmp_path).mean(axis=(0, 1)) for seed in range(8)])
    error = runs.std(axis=0, ddof=1) / np.sqrt(8)
    assert (error < 0.01 * expected).all()
    # Patches of a sixth of a metre leave half a per cent.
    assert (np.abs(runs.mean(axis=0) - expected) < 4 * error + 5e-3 * expected).all()


def test_without_excitation_it_is_matte(tmp_path):
    """A matrix of a diagonal alone."""
    values = [0.2, 0.5, 0.7, 0.4]
    file = table(tmp_path / "m.txt", np.diag(values), OUTGOING)
    plain = matte("glow", Spectrum.of(OUTGOING, values))
    floor, around = Shape("floor", SQUARE, matrix(), "glow"), sky()
    fluorescent, expected = (
        picture(scene([floor], [], [one], looking_down(), environment=around, samples=16), tmp_path)
        for one in (glowing(file), plain)
    )
    np.testing.assert_allclose(fluorescent, expected, rtol=1e-5)


def test_only_bands_that_excite_something_are_added(tmp_path):
    one = scene([], [], [glowing(table(tmp_path / "m.txt"))])
    wide, seen = fluorescence.widened(one)
    np.testing.assert_allclose(wide.film.bands.edges, ALL.edges)
    np.testing.assert_allclose(wide.film.bands.centres[seen], BANDS.centres)
    assert fluorescence.widened(scene([]))[1] == slice(None)


def test_a_far_wall_sees_the_glow_of_a_plate_in_bands_that_no_lamp_has(tmp_path):
    """The lamp has invisible light alone; a white wall shows what a plate makes of it."""
    plate = polygon([(-0.5, -0.5, 0), (0.5, -0.5, 0), (0.5, 0.5, 0), (-0.5, 0.5, 0)])
    shapes = [
        Shape("plate", plate, matrix(), "glow"),
        Shape("wall", SQUARE, matrix((0, 0, 3), (3, 0, 0), (0, -3, 0), (0, 0, -1)), "white"),
    ]
    lights = [lamp("point", matrix((0, 0, 1)))]
    lights[0].parameters["intensity"] = Spectrum.of(
        [300, 349.9, 350.1, 800], [1.0, 1.0, 0.0, 0.0], Unit.INTENSITY
    )
    camera = Camera("c", "orthographic", facing((0, 0, 1.5), (0, 0, 3)), (-0.1, 0.1, -0.1, 0.1))
    materials = [glowing(table(tmp_path / "m.txt")), matte("white", Spectrum.constant(1.0))]
    seen = picture(scene(shapes, lights, materials, camera, 3, 4096, (2, 2)), tmp_path).mean(axis=(0, 1))
    assert seen[3] < 1e-3 * seen[1]
    np.testing.assert_allclose(seen[:3] / seen[1], SHARES[:3, 0] / SHARES[1, 0], rtol=0.03)


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("300 400\n400 0.1", "2 numbers, want an outgoing wavelength and 2 shares"),
        ("300 400\n400 0.1 -0.2\n500 0 0", "it holds numbers below 0"),
        ("300 blue\n400 0.1 0.2", "'300 blue' are no numbers"),
        ("400 300\n400 0.1 0.2\n500 0 0", "wavelengths must increase"),
        ("300 400", "no table, want incoming wavelengths"),
    ],
)
def test_what_is_no_matrix_is_refused_in_a_sentence(tmp_path, text, sentence):
    (tmp_path / "m.txt").write_text(text)
    with pytest.raises(RecipeError, match=sentence):
        read_donaldson(tmp_path / "m.txt")


def test_a_picture_of_several_materials_is_refused(tmp_path):
    plane = np.array([[0.1, 0.2]], np.float32)
    write_exr(tmp_path / "m.exr", {}, {"T.400,000000nm": plane, "T.500,000000nm": plane})
    with pytest.raises(RecipeError, match=r"the pixels of T\.400,000000nm differ"):
        read_donaldson(tmp_path / "m.exr")


def test_a_fluorescent_part_of_a_blend_counts_by_its_weight(tmp_path):
    glow, black = glowing(table(tmp_path / "m.txt")), matte("black", Spectrum.constant(0.0))
    said = {"materialID": "glow", "otherMaterialID": "black", "weight": 0.25}
    floor, sun = Shape("floor", SQUARE, matrix(), "glow"), lamp("directional", matrix())
    whole = scene([floor], [sun], [glow, black, Material("mix", "blend", said)], samples=4096)
    mixed = replace(whole, shapes=(replace(floor, material="mix"),))
    alone, blended = (picture(one, tmp_path)[0, 0] for one in (whole, mixed))
    np.testing.assert_allclose(blended, 0.75 * alone, rtol=2e-3)
