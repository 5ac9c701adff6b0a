"""The scenes of lobe_path.py: a Cornell-like box, and a big mesh under a picture of the sky."""

import numpy as np

from rtb_addon.exr import write_exr
from rtb_addon.scene.render_scene import Camera, Film, Integrator, Light, Material, Mesh, RenderScene, Shape
from rtb_addon.spectra import Spectrum

WAVELENGTHS = np.arange(360.0, 831.0, 5.0)
SQUARE = Mesh(
    np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], np.float32),
    np.array([[0, 1, 2], [0, 2, 3]], np.int32),
)
REFLECTANCES = {
    "white": 0.72 + 0.06 * np.sin((WAVELENGTHS - 400) / 60),
    "red": 0.06 + 0.6 / (1 + np.exp(-(WAVELENGTHS - 600) / 12)),
    "green": 0.05 + 0.45 * np.exp(-(((WAVELENGTHS - 530) / 35) ** 2)),
    "tall": 0.35 + 0.55 / (1 + np.exp(-(WAVELENGTHS - 510) / 20)),
    "small": 0.1 + 0.5 * np.exp(-(((WAVELENGTHS - 460) / 30) ** 2)),
    "dark": np.zeros_like(WAVELENGTHS),
}
INDICES = {
    "eta": np.interp(WAVELENGTHS, [450, 600], [1.5, 0.25]),
    "k": np.interp(WAVELENGTHS, [500, 700], [1.9, 3.8]),
}
GLOSSY = {
    "matte": {},
    "metal": {**{name: Spectrum(WAVELENGTHS, values) for name, values in INDICES.items()}, "roughness": 0.15},
    "roughplastic": {"intIOR": 1.5, "extIOR": 1.0, "roughness": 0.15},
    "anisoward": {
        "specularReflectance": Spectrum.constant(0.3),
        "alphaU": 0.15,
        "alphaV": 0.15,
        "variant": "ward",
    },
}
LAMP = 8 * (0.6 + 0.5 / (1 + np.exp(-(WAVELENGTHS - 560) / 60))) * (1 + 0.2 * np.sin(WAVELENGTHS / 23))
DAYLIGHT = 0.2 * np.interp(WAVELENGTHS, [380, 460, 560, 700], [0.5, 1.17, 1.0, 0.72])


def placed(where, axis="z", degrees=0.0, scale=(1.0, 1.0, 1.0)):
    angle = np.radians(degrees)
    matrix, (i, j) = np.eye(4), {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
    matrix[[i, i, j, j], [i, j, i, j]] = np.cos(angle), -np.sin(angle), np.sin(angle), np.cos(angle)
    matrix[:3, :3] = matrix[:3, :3] @ np.diag(scale)
    matrix[:3, 3] = where
    return matrix


def cube():
    turns = [("x", 0), ("x", 90), ("x", 180), ("x", 270), ("y", 90), ("y", 270)]
    faces = [SQUARE.vertices @ placed((0, 0, 0), *turn)[:3, :3].T for turn in turns]
    faces = [face + placed((0, 0, 0), *turn)[:3, 2] for face, turn in zip(faces, turns, strict=True)]
    triangles = [SQUARE.triangles + 4 * k for k in range(6)]
    return Mesh(np.concatenate(faces).astype(np.float32), np.concatenate(triangles).astype(np.int32))


def bumpy(rings=405):
    """A ball with bumps, of 2 (rings - 1)^2 triangles, smooth."""
    down, around = np.meshgrid(np.linspace(0, np.pi, rings), np.linspace(0, 2 * np.pi, rings), indexing="ij")
    out = np.stack([np.sin(down) * np.cos(around), np.sin(down) * np.sin(around), np.cos(down)], axis=-1)
    points = out * (1 + 0.05 * np.sin(9 * down) * np.sin(8 * around))[..., None]
    across, along = np.gradient(points, axis=0), np.gradient(points, axis=1)
    normals = np.cross(across, along)
    normals /= np.maximum(np.linalg.norm(normals, axis=-1, keepdims=True), 1e-9)
    normals[[0, -1]] = out[[0, -1]]
    corner = (np.arange(rings - 1)[:, None] * rings + np.arange(rings - 1)).ravel()
    below = corner + rings
    halves = np.stack([corner, below, below + 1], 1), np.stack([corner, below + 1, corner + 1], 1)
    flat = (array.reshape(-1, 3).astype(np.float32) for array in (points, normals))
    vertices, normals = flat
    return Mesh(vertices, np.concatenate(halves).astype(np.int32), normals)


def paints(glossy, changed=None):
    """Return the materials, with the small block of a model, and perhaps with another spectrum."""
    spectra = {
        name: Spectrum(WAVELENGTHS, values) for name, values in {**REFLECTANCES, **(changed or {})}.items()
    }
    materials = {name: Material(name, "matte", {"diffuseReflectance": one}) for name, one in spectra.items()}
    own = materials["small"].parameters if glossy != "metal" else {}
    materials["small"] = Material("small", glossy, {**own, **GLOSSY[glossy]})
    return materials


def pictured(camera, shapes, materials, size, samples, **more):
    integrator, film = Integrator(samples=samples, depth=6), Film(size, size)
    return RenderScene(camera, tuple(shapes), materials, film=film, integrator=integrator, **more)


def box(size, samples, glossy="metal", changed=None, moved=0.0):
    """Matte walls of several spectra, two blocks, one of them glossy, and a small lamp."""
    shapes = [
        Shape("floor", SQUARE, placed((0, -1, 0), "x", -90), "white"),
        Shape("ceiling", SQUARE, placed((0, 1, 0), "x", 90), "white"),
        Shape("back", SQUARE, placed((0, 0, -1)), "white"),
        Shape("left", SQUARE, placed((-1, 0, 0), "y", 90), "red"),
        Shape("right", SQUARE, placed((1, 0, 0), "y", -90), "green"),
        Shape("tall", cube(), placed((-0.35, -0.4, -0.35), "y", 20, (0.3, 0.6, 0.3)), "tall"),
        Shape("block", cube(), placed((0.35 - moved, -0.7, 0.3), "y", -17, (0.3, 0.3, 0.3)), "small"),
        Shape(
            "lamp",
            SQUARE,
            placed((0, 0.99, 0), "x", 90, (0.25, 0.25, 1)),
            "dark",
            Spectrum(WAVELENGTHS, LAMP),
        ),
    ]
    half = np.tan(np.radians(39.3 / 2))
    camera = Camera("Camera", "perspective", placed((0, 0, 3.9)), (-half, half, -half, half), (0.01, 100))
    return pictured(camera, shapes, paints(glossy, changed), size, samples)


def sky(folder):
    """Write a grey picture of a sky with two suns, and return its file; stock Mitsuba's lies beside it."""
    height, width = 128, 256
    v, u = ((np.arange(n) + 0.5) / n for n in (height, width))
    rows, columns = np.meshgrid(v, u, indexing="ij")
    grey = 0.3 + 0.7 * (1 - rows)
    for row, column, power in ((0.2, 0.62, 300.0), (0.35, 0.4, 60.0)):
        grey += power * np.exp(-(((rows - row) / 0.012) ** 2 + ((columns - column) / 0.012) ** 2))
    file = folder / "sky.exr"
    write_exr(file, {}, {channel: grey.astype(np.float32) for channel in "RGB"})
    # Mitsuba's own reader of OpenEXR files waits for ever where a process has one thread.
    rows = np.repeat(grey[::-1, :, None], 3, axis=2).astype("<f4")
    file.with_suffix(".pfm").write_bytes(f"PF\n{width} {height}\n-1.0\n".encode() + rows.tobytes())
    return file


def mesh(size, samples, picture, glossy="metal", changed=None, moved=0.0):
    """A ball of 326 432 triangles, a floor, a wall and a glossy block under a picture of the sky."""
    shapes = [
        Shape("floor", SQUARE, placed((0, 0, 0), scale=(6, 6, 1)), "white"),
        Shape("wall", SQUARE, placed((0, 4, 2), "x", 90, (6, 3, 1)), "red"),
        Shape("ball", BALL, placed((-0.4 + moved, 0, 1.05)), "tall"),
        Shape("block", cube(), placed((1.4, -0.6, 0.45), "z", 25, (0.45, 0.45, 0.45)), "small"),
    ]
    half = np.tan(np.radians(36 / 2))
    camera = Camera("Camera", "perspective", placed((0.3, -6.5, 1.4), "x", 88), (-half, half, -half, half))
    light = {"intensity": Spectrum(WAVELENGTHS, DAYLIGHT), "filename": str(picture)}
    around = Light("Sky", "environment", np.eye(4), light)
    return pictured(camera, shapes, paints(glossy, changed), size, samples, environment=around)


BALL = bumpy()
