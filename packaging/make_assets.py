"""
Write a folder of spectral materials for Blender's Asset Browser: python packaging/make_assets.py FOLDER

Runs where bpy is, as a module or as ``blender -b --python packaging/make_assets.py -- FOLDER``. All of it is
made from the tables in rtb_addon/data, and may be used by anybody for anything (CC0).
"""

import sys
from pathlib import Path
from uuid import NAMESPACE_URL, uuid5

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

import bpy  # noqa: E402
import numpy as np  # noqa: E402

import rtb_addon.blender  # noqa: E402
from rtb_addon import swatches  # noqa: E402
from rtb_addon.blender.material_words import MODELS  # noqa: E402
from rtb_addon.curves import curve_icon  # noqa: E402
from rtb_addon.spectra import Spectrum, library  # noqa: E402

FILE, CATALOGS = "spectral_materials.blend", "blender_assets.cats.txt"
PREVIEW = 128  # side of a picture [pixels]
PLACES = range(380, 781, 5)


def wanted():
    """Yield catalog, name, what its properties are, and the spectrum that it shows, for each material."""
    for name in library.patches():
        patch = name.rpartition("/")[2]
        yield "ColorChecker", patch, {"reflectance": name}, library.find(name)
    for percent in (3, 9, 18, 36, 59, 90):
        yield (
            "Grey",
            f"grey {percent} %",
            {"reflectance": f"{percent / 100:g}"},
            Spectrum.constant(percent / 100),
        )
    for name in library.metals():
        word = name.split(" ", 1)[1]
        said = {"model": "metal", "eta": f"{name} eta", "k": f"{name} k"}
        shown = straight_on(*(library.find(f"{name} {part}") for part in ("eta", "k")))
        yield "Metal", f"{word}, polished", {**said, "roughness": 0.0}, shown
        yield "Metal", f"{word}, brushed", {**said, "roughness": 0.2}, shown
    for name in library.names():
        if name.startswith("Glasses/"):
            said = {"model": "glass", "ior": name}
            yield "Glass", name.rpartition("/")[2], said, Spectrum.constant(0.9)
    for name in library.patches()[12:18]:
        patch, spectrum = name.rpartition("/")[2], library.find(name)
        yield "Plastic", f"{patch} plastic", {"model": "plastic", "reflectance": name}, spectrum
        rough = {"model": "roughplastic", "reflectance": name, "roughness": 0.15}
        yield "Plastic", f"{patch} satin plastic", rough, spectrum
    yield "Mirror", "mirror", {"model": "mirror", "specular_reflectance": "0.95"}, Spectrum.constant(0.95)


def straight_on(eta: Spectrum, k: Spectrum) -> Spectrum:
    """Return what a metal reflects of light that falls straight on it."""
    n, m = eta.at(PLACES), k.at(PLACES)
    return Spectrum.of(PLACES, ((n - 1) ** 2 + m**2) / ((n + 1) ** 2 + m**2))


def between_0_and_1(index: Spectrum) -> Spectrum:
    """Return how an index falls with wavelength, whatever it is."""
    n = index.at(PLACES)
    return Spectrum.of(PLACES, (n - n.min()) / np.ptp(n))


def make(catalog: str, name: str, said: dict, shown: Spectrum):
    """Make a material and mark it as an asset."""
    material = bpy.data.materials.new(name)
    settings = material.rtb
    settings.use_spectra, settings.model = True, said.get("model", "matte")
    for key, value in said.items():
        setattr(settings, key, value)
    colour = swatches.surface_colour(shown, library.find("D65"))
    show(material, [(each / 255) ** 2.2 for each in colour])
    material.asset_mark()
    data = material.asset_data
    data.catalog_id, data.license, data.author = id_of(f"Spectral/{catalog}"), "CC0", "RenderToolbox"
    data.description = f"{MODELS[settings.model][0]}, in spectra measured from 380 to 780 nm"
    preview = material.preview_ensure()
    preview.image_size = PREVIEW, PREVIEW
    # A glass is told from others by how it disperses, and not by its colour.
    drawn = between_0_and_1(library.find(said["ior"])) if "ior" in said else shown
    preview.image_pixels_float.foreach_set(curve_icon(drawn, PREVIEW, colour).ravel())
    return material


def show(material, colour: list[float]) -> None:
    """Let Blender's own renderers show about the same."""
    material.diffuse_color = (*colour, 1)
    material.use_nodes = True
    shader = next(node for node in material.node_tree.nodes if node.type == "BSDF_PRINCIPLED")
    model = material.rtb.model
    shader.inputs["Base Color"].default_value = (*colour, 1)
    shader.inputs["Metallic"].default_value = float(model in ("metal", "mirror"))
    shader.inputs["Transmission Weight"].default_value = float(model == "glass")
    shader.inputs["Roughness"].default_value = 1.0 if model == "matte" else 0.0
    if model in ("metal", "roughplastic"):
        shader.inputs["Roughness"].default_value = material.rtb.roughness**0.5


def id_of(catalog: str) -> str:
    return str(uuid5(NAMESPACE_URL, f"rendertoolbox/{catalog}"))


def main(folder: Path) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    rtb_addon.blender.register()
    made = [(each[0], make(*each)) for each in wanted()]
    catalogs = dict.fromkeys(catalog for catalog, _ in made)
    paths = ["Spectral", *(f"Spectral/{each}" for each in catalogs)]
    lines = ["VERSION 1", *(f"{id_of(each)}:{each}:{each.replace('/', '-')}" for each in paths)]
    (folder / CATALOGS).write_text("\n".join(lines) + "\n", encoding="utf-8")
    materials = {material for _, material in made}
    bpy.data.libraries.write(str(folder / FILE), materials, fake_user=True, compress=True)
    size = (folder / FILE).stat().st_size
    print(f"{len(made)} materials, {size / 1000:.0f} kB in {folder / FILE}")


if __name__ == "__main__":
    main(Path(sys.argv[-1]))
