"""Small scenes for the tests of Mitsuba."""

import gc

import numpy as np

from rtb_addon.renderers.interface import RenderOptions
from rtb_addon.renderers.mitsuba import renderer
from rtb_addon.scene.render_scene import (
    Camera,
    Film,
    Integrator,
    Light,
    Material,
    Mesh,
    RenderScene,
    Shape,
)
from rtb_addon.spectra import Bands, Spectrum

REFLECTANCE = Spectrum.of([400, 550, 700], [0.2, 0.9, 0.4])
INTENSITY = Spectrum.of([400, 500, 700], [1, 2, 3])
BANDS = Bands.regular(400, 20, 16)
FULL_TURN = np.diag([1.0, -1.0, -1.0, 1.0])
DOWN = np.eye(4)


def at(x, y, z, turn=DOWN):
    matrix = turn.copy()
    matrix[:3, 3] = x, y, z
    return matrix


def square(half):
    corners = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], np.float32)
    return Mesh(corners * np.float32(half), np.array([[0, 1, 2], [0, 2, 3]], np.int32))


def disc(radius, corners=256):
    """A regular polygon of the area of a circle, facing +Z."""
    step = 2 * np.pi / corners
    angles = np.arange(corners) * step
    reach = radius * np.sqrt(step / np.sin(step))
    rim = np.stack([reach * np.cos(angles), reach * np.sin(angles), 0 * angles], axis=1)
    vertices = np.concatenate([np.zeros((1, 3)), rim]).astype(np.float32)
    k = np.arange(corners)
    triangles = np.stack([0 * k, 1 + k, 1 + (k + 1) % corners], axis=1).astype(np.int32)
    return Mesh(vertices, triangles)


def globe(radius, rings=24, smooth=True):
    """A ball of triangles with smooth normals, outside out, and a map of the world's coordinates."""
    polar, azimuth = np.meshgrid(
        np.linspace(0, np.pi, rings), np.linspace(0, 2 * np.pi, 2 * rings), indexing="ij"
    )
    normals = np.stack(
        [np.sin(polar) * np.cos(azimuth), np.sin(polar) * np.sin(azimuth), np.cos(polar)], axis=-1
    ).reshape(-1, 3)
    i, j = (index.ravel() for index in np.meshgrid(np.arange(rings - 1), np.arange(2 * rings - 1)))
    a, b = i * 2 * rings + j, (i + 1) * 2 * rings + j
    triangles = np.concatenate([np.stack([a, b, b + 1], 1), np.stack([a, b + 1, a + 1], 1)])
    vertices = (radius * normals).astype(np.float32)
    uvs = np.stack([azimuth / (2 * np.pi), 1 - polar / np.pi], axis=-1).reshape(-1, 2).astype(np.float32)
    return Mesh(vertices, triangles.astype(np.int32), normals.astype(np.float32) if smooth else None, uvs)


def looking_down(height=2.0, half=1e-5, x=0.0):
    return Camera("Camera", "perspective", at(x, 0, height), (-half, half, -half, half), (1e-3, 1e5))


def lamp(kind, matrix=None, intensity=INTENSITY, **parameters):
    place = at(0, 0, 3) if matrix is None else matrix
    return Light("Lamp", kind, place, {"intensity": intensity, **parameters})


FLOOR = Shape("Floor", square(50), np.eye(4), "paint")


def scene(
    lights=(),
    shapes=(FLOOR,),
    reflectance=REFLECTANCE,
    camera=None,
    environment=None,
    bands=BANDS,
    kind="averaged",
    size=(4, 4),
    **integrator,
):
    return RenderScene(
        camera=camera or looking_down(),
        shapes=tuple(shapes),
        materials={
            "paint": Material("paint", "matte", {"diffuseReflectance": reflectance}),
            "soot": Material("soot", "matte", {"diffuseReflectance": Spectrum.constant(0)}),
        },
        lights=tuple(lights),
        environment=environment,
        integrator=Integrator(**{"samples": 64, "depth": 2, **integrator}),
        film=Film(*size, bands, kind),
    )


def picture(one, folder, threads=1, report=lambda fraction: None, name="scene"):
    native = renderer().translate(one, (), folder, name)
    return renderer().render(native, RenderOptions(threads), report)


def kernels(one, folder, name):
    """Return how many kernels a rendering ran, and how many it had to compile."""
    # Kernels know every material that is alive: those of scenes that nobody needs any more must be gone.
    gc.collect()
    facts = picture(one, folder, name=name).attributes
    return int(facts["kernels"]), int(facts["kernels_compiled"])


def mean_and_error(image):
    """Return the mean over the pixels and its standard error, a number for each band."""
    pixels = image.radiance.reshape(-1, image.radiance.shape[2]).astype(float)
    return pixels.mean(axis=0), pixels.std(axis=0, ddof=1) / np.sqrt(len(pixels))


def assert_within_noise(image, expected, floor=1e-4):
    """Four and a half standard errors, and a floor for what single precision leaves."""
    mean, error = mean_and_error(image)
    assert (np.abs(mean - expected) <= 4.5 * error + floor * np.abs(expected)).all(), mean / expected
    # A tolerance that noise has blown up would prove nothing.
    assert (error < 0.02 * np.abs(expected)).all()
