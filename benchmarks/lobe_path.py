"""
The lobe path against stock Mitsuba, in one interleaved run: time of 31 bands over the time of one rgb render.

    python benchmarks/lobe_path.py [rounds] [size] [samples] [threads] [material of the small block]

Prints, for a Cornell-like box with a block that is matte, or metal, roughplastic or anisoward, each way's
processor time over that of a stock rgb render of equal samples, and its efficiency,
1 / (relative mean squared error x time), over that of the stock spectral film. The lobe path's time includes
reading and loading the scene anew; the stock ways are given theirs loaded.
"""

import sys
import tempfile
import time
from pathlib import Path

import numpy as np

from rtb_addon.renderers.interface import RenderOptions
from rtb_addon.renderers.mitsuba import llvm, renderer, session
from rtb_addon.renderers.mitsuba.native import read_native
from rtb_addon.renderers.mitsuba.one_hot import one_hot
from rtb_addon.scene.render_scene import (
    Camera,
    Film,
    Integrator,
    Material,
    Mesh,
    RenderScene,
    Shape,
)
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


def box(size, samples, small="matte"):
    lamp = Spectrum(WAVELENGTHS, LAMP)
    shapes = [
        Shape("floor", SQUARE, placed((0, -1, 0), "x", -90), "white"),
        Shape("ceiling", SQUARE, placed((0, 1, 0), "x", 90), "white"),
        Shape("back", SQUARE, placed((0, 0, -1)), "white"),
        Shape("left", SQUARE, placed((-1, 0, 0), "y", 90), "red"),
        Shape("right", SQUARE, placed((1, 0, 0), "y", -90), "green"),
        Shape("tall", cube(), placed((-0.35, -0.4, -0.35), "y", 20, (0.3, 0.6, 0.3)), "tall"),
        Shape("small", cube(), placed((0.35, -0.7, 0.3), "y", -17, (0.3, 0.3, 0.3)), "small"),
        Shape("lamp", SQUARE, placed((0, 0.99, 0), "x", 90, (0.25, 0.25, 1)), "dark", lamp),
    ]
    materials = {
        name: Material(name, "matte", {"diffuseReflectance": Spectrum(WAVELENGTHS, values)})
        for name, values in REFLECTANCES.items()
    }
    paint = materials["small"].parameters if small != "metal" else {}
    materials["small"] = Material("small", small, {**paint, **GLOSSY[small]})
    half = np.tan(np.radians(39.3 / 2))
    camera = Camera("Camera", "perspective", placed((0, 0, 3.9)), (-half, half, -half, half), (0.01, 100))
    integrator = Integrator(samples=samples, depth=6)
    return RenderScene(camera, tuple(shapes), materials, film=Film(size, size), integrator=integrator)


def ways(native, samples, threads):
    """Return each way by name, a function of the seed that returns an image; the first is the yardstick."""
    mi = session.start("llvm_ad_spectral", threads)
    spectral = mi.load_file(str(native))
    mi = session.start(session.FAST, threads)
    rgb = mi.load_string(one_hot(read_native(native)).xml)
    path = mi.load_dict({"type": "path", "max_depth": 6, "rr_depth": 7})
    text = native.read_text()

    def lobe(seed):
        native.write_text(text.replace('name="seed" value="0"', f'name="seed" value="{seed}"'))
        return renderer().render(native, RenderOptions(threads), lambda fraction: None).radiance

    def stock(variant, scene, **how):
        def render(seed):
            mi = session.start(variant, threads)
            return np.array(mi.render(scene, spp=samples, seed=seed, **how))

        return render

    return {
        "stock rgb, 3 numbers": stock(session.FAST, rgb, integrator=path),
        "stock specfilm, 31 bands": stock("llvm_ad_spectral", spectral),
        "lobe path, 31 bands": lobe,
    }


def main(rounds=5, size=128, samples=64, threads=1, small="matte"):
    if llvm.prepare() is None:
        raise SystemExit("no LLVM works here")
    with tempfile.TemporaryDirectory() as folder:
        native = renderer().translate(box(size, samples, small), (), Path(folder), "box")
        found = ways(native, samples, threads)
        seconds, images = {name: [] for name in found}, {name: [] for name in found}
        for turn in range(rounds + 1):
            for name, render in found.items():
                start = time.process_time()
                image = render(turn)
                # The first round compiles.
                if turn:
                    seconds[name].append(time.process_time() - start)
                    images[name].append(image)
    yardstick = min(seconds["stock rgb, 3 numbers"])
    mean = np.mean(images["lobe path, 31 bands"], axis=0, dtype=float)
    scale = (mean + 0.05 * mean.mean(axis=(0, 1))) ** 2
    efficiency = {
        name: 1 / (np.mean(np.var(images[name], axis=0, ddof=1) / scale) * min(seconds[name]))
        for name in list(found)[1:]
    }
    for name in found:
        line = f"{name:26} {min(seconds[name]):6.3f} s   {min(seconds[name]) / yardstick:5.2f} x rgb"
        if name in efficiency:
            ratio = efficiency[name] / efficiency["stock specfilm, 31 bands"]
            line += f"   efficiency {ratio:5.1f} x specfilm"
        print(line)


if __name__ == "__main__":
    main(*map(int, sys.argv[1:5]), *sys.argv[5:])
