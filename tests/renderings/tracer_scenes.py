"""Small scenes with closed forms, and what their pictures are compared by."""

import numpy as np

from rtb_addon.renderers import find
from rtb_addon.renderers.interface import RenderOptions
from rtb_addon.scene.render_scene import (
    Camera,
    Film,
    Integrator,
    Light,
    Material,
    Mesh,
    RenderScene,
)
from rtb_addon.spectra import Bands, Spectrum, Unit

BANDS = Bands.regular(400, 100, 4)
GREY = Spectrum.of([350, 750], [0.2, 0.6])
SHAPE_OF_LIGHT = [2.0, 3.0, 1.0, 0.5]


def per_band(values, unit=Unit.RATIO):
    """Return a spectrum that has these averages in BANDS, with steep steps between them."""
    steps = [edge + side for edge in BANDS.edges[1:-1] for side in (-1e-9, 1e-9)]
    return Spectrum.of([BANDS.edges[0], *steps, BANDS.edges[-1]], np.repeat(values, 2), unit)


RADIANCE = per_band(SHAPE_OF_LIGHT, Unit.RADIANCE)


def matte(id, reflectance=GREY):
    return Material(id, "matte", {"diffuseReflectance": reflectance})


def matrix(place=(0, 0, 0), x=(1, 0, 0), y=(0, 1, 0), z=(0, 0, 1)):
    out = np.eye(4)
    out[:3] = np.array([x, y, z, place], float).T
    return out


def facing(place, at):
    """Return a matrix at a place whose -Z axis points at another."""
    z = np.subtract(place, at, dtype=float)
    z /= np.linalg.norm(z)
    x = np.cross(np.roll(z, 1) + np.array([0, 0, 0.5]), z)
    x /= np.linalg.norm(x)
    return matrix(place, x, np.cross(z, x), z)


def polygon(corners):
    fan = [[0, k, k + 1] for k in range(1, len(corners) - 1)]
    return Mesh(np.array(corners, np.float32), np.array(fan, np.int32))


SQUARE = polygon([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)])


def cube(inwards=False, normals=False):
    """Return the cube from -1 to 1, its normals outwards unless said."""
    vertices = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], np.float32)
    faces = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    triangles = np.array([t for a, b, c, d in faces for t in ((a, b, c), (a, c, d))], np.int32)
    if inwards:
        triangles = triangles[:, ::-1].copy()
    smooth = (vertices / np.sqrt(3) * (-1 if inwards else 1)).astype(np.float32)
    return Mesh(vertices, triangles, smooth if normals else None)


def ball(radius=1.0, rings=24, normals=True):
    """Return a ball of triangles about the origin, smooth unless said."""
    polar, turn = np.meshgrid(
        np.linspace(0, np.pi, rings + 1), np.linspace(0, 2 * np.pi, 2 * rings + 1), indexing="ij"
    )
    out = np.stack([np.sin(polar) * np.cos(turn), np.sin(polar) * np.sin(turn), np.cos(polar)], -1)
    out = out.reshape(-1, 3)
    i, j = (index.ravel() for index in np.meshgrid(np.arange(rings), np.arange(2 * rings)))
    a, b = i * (2 * rings + 1) + j, (i + 1) * (2 * rings + 1) + j
    triangles = np.concatenate([np.stack([a, b, b + 1], 1), np.stack([a, b + 1, a + 1], 1)])
    smooth = out.astype(np.float32) if normals else None
    return Mesh((radius * out).astype(np.float32), triangles.astype(np.int32), smooth)


def ward(id, diffuse=GREY, specular=0.3, alpha_u=0.2, alpha_v=None, variant="ward"):
    alpha_v = alpha_u if alpha_v is None else alpha_v
    specular = Spectrum.constant(specular) if isinstance(specular, float) else specular
    said = {"diffuseReflectance": diffuse, "specularReflectance": specular}
    return Material(id, "anisoward", {**said, "alphaU": alpha_u, "alphaV": alpha_v, "variant": variant})


WHITE = Spectrum.constant(1.0)
BLACK = Spectrum.constant(0.0)
IOR = {"intIOR": 1.5, "extIOR": 1.0}
TINTS = {"specularReflectance": WHITE, "specularTransmittance": WHITE}


def glass(model="glass", roughness=None, **tints):
    rough = {} if roughness is None else {"roughness": roughness}
    return Material("glass", model, {**IOR, **TINTS, **tints, **rough})


def reflected_by(eta, k, degrees):
    """Return Fresnel's reflectance from complex amplitudes, mean of both polarisations."""
    index, cosine = eta + 1j * k, np.cos(np.radians(degrees))
    behind = np.sqrt(1 - (1 - cosine**2) / index**2 + 0j)
    across = (cosine - index * behind) / (cosine + index * behind)
    along = (index * cosine - behind) / (index * cosine + behind)
    return (abs(across) ** 2 + abs(along) ** 2) / 2


def lamp(kind, to_world, intensity=SHAPE_OF_LIGHT, **parameters):
    unit = Unit.IRRADIANCE if kind == "directional" else Unit.INTENSITY
    defaults = {"point": {"radius": 0.0}, "spot": {"cone": 45.0, "blend": 0.0, "radius": 0.0}}
    numbers = {**defaults.get(kind, {"angle": 0.0}), **parameters}
    return Light(f"{kind} lamp", kind, to_world, {"intensity": per_band(intensity, unit), **numbers})


def sky(radiance=1.0):
    return Light("sky", "environment", np.eye(4), {"intensity": Spectrum.constant(radiance), "filename": ""})


def looking_down(half=1e-3, place=(0, 0, 5), shift=(0, 0)):
    """Return an orthographic camera above a place that sees 2 half x 2 half metres."""
    x, y = shift
    return Camera("camera", "orthographic", matrix(place), (x - half, x + half, y - half, y + half))


def scene(shapes, lights=(), materials=None, camera=None, depth=2, samples=1, size=(1, 1), seed=0, **more):
    materials = materials or [matte("grey"), matte("black", Spectrum.constant(0.0))]
    return RenderScene(
        camera or looking_down(),
        tuple(shapes),
        {material.id: material for material in materials},
        tuple(lights),
        integrator=Integrator("path", depth, samples, seed),
        film=Film(*size, bands=BANDS),
        **more,
    )


def picture(one, folder, report=lambda fraction: None):
    """Translate and render a scene as everybody does; return the (height, width, bands) radiance."""
    tracer = find("tracer")
    native = tracer.translate(one, (), folder, "scene")
    return tracer.render(native, RenderOptions(), report).radiance.astype(float)


def reflected(irradiance):
    """Return the radiance per band of the grey material under an irradiance times SHAPE_OF_LIGHT."""
    return GREY.in_bands(BANDS) / np.pi * irradiance * np.array(SHAPE_OF_LIGHT)


def assert_within_noise(make, folder, expected, runs=8):
    """
    Compare the mean picture of make(seed) with the expected radiance per band.

    The tolerance is four standard errors of the mean, estimated from the runs, plus a floor for
    single precision.
    """
    means = np.array([picture(make(seed), folder).mean(axis=(0, 1)) for seed in range(runs)])
    error = means.std(axis=0, ddof=1) / np.sqrt(runs)
    # Seven degrees of freedom: Student's t leaves one chance in 200, and the seeds are fixed.
    np.testing.assert_array_less(np.abs(means.mean(axis=0) - expected), 4 * error + 3e-6 * np.abs(expected))
    assert (error < 0.01 * np.max(expected)).all(), "too noisy to tell"
