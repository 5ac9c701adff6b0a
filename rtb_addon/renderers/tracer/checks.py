"""Numbers and names that a scene must get right before it can be rendered."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from ...errors import RecipeError
from ...scene.render_scene import Material, RenderScene, Texture, TextureUse, Value
from ...scene.vocabulary import MATERIALS
from ...spectra import Spectrum

_LIGHTS = {"radius": (0, 1e30), "cone": (0, 180), "blend": (0, 1), "angle": (0, 180)}
_LENSES = {"lens_radius": (0, 1e6), "focus_distance": (1e-6, 1e30)}
_MATERIALS = {
    "alphaU": (1e-4, 10),
    "alphaV": (1e-4, 10),
    "roughness": (0, 10),
    "intIOR": (0.1, 10),
    "extIOR": (0.1, 10),
    "weight": (0, 1),
    "opacity": (0, 1),
    "scale": (-1e6, 1e6),
}
_TEXTURES = {f"{name}{axis}": (-1e6, 1e6) for name in ("checksPer", "offset", "scale") for axis in "UV"}
_TEXTURES["gamma"] = (-1, 10)
_WORDS = {
    "wrapMode": ("repeat", "mirror", "clamp"),
    "filterMode": ("ewa", "trilinear", "bilinear", "nearest"),
}
# Numbers that may be spectra.
_INDICES = ("intIOR", "extIOR")
_REFERENCES = ("materialID", "otherMaterialID")


def check(scene: RenderScene) -> None:
    """Raise RecipeError for numbers, and names of materials, that have no meaning."""
    lens = {"lens_radius": scene.camera.lens_radius, "focus_distance": scene.camera.focus_distance}
    _check_numbers(f"camera {scene.camera.id}", lens, _LENSES)
    for light in scene.lights:
        _check_numbers(f"light {light.id}", light.parameters, _LIGHTS)
    for material in scene.materials.values():
        _check_numbers(f"material {material.id}", material.parameters, _MATERIALS)
        _check_choices(material)
        _check_references(material, scene.materials)
        _check_relief(material, scene.textures)
    for texture in scene.textures.values():
        _check_texture(texture)
    for shape in scene.shapes:
        if shape.material not in scene.materials:
            raise RecipeError(f"shape {shape.id} is of material {shape.material}, which the scene has not")
        if shape.mesh.uvs is None and (texture := _texture_of(shape.material, scene.materials)):
            raise RecipeError(
                f"shape {shape.id} has no texture coordinates for texture {texture}, unwrap its mesh"
            )


def parts(material: Material) -> Iterator[str]:
    """Yield the ids of the materials that a material is made of."""
    for name in _REFERENCES:
        if name in material.parameters:
            yield str(material.parameters[name])


def _check_numbers(what: str, said: Mapping[str, Value], ranges: Mapping[str, tuple[float, float]]) -> None:
    for name, (low, high) in ranges.items():
        value = said.get(name, low)
        if name in _INDICES and isinstance(value, Spectrum):
            value = next((one for one in value.values.tolist() if not low <= one <= high), low)
        if not (isinstance(value, int | float) and low <= value <= high):
            raise RecipeError(f"{what} has {name} {value}, give a number from {low:g} to {high:g}")


def _check_choices(material: Material) -> None:
    """Raise RecipeError for a word that is none of those that there are."""
    for name, parameter in MATERIALS.get(material.model, {}).items():
        word, words = material.parameters.get(name), parameter.choices
        if words and word is not None and word not in words:
            raise RecipeError(f"material {material.id} has {name} {word}, choose one of {', '.join(words)}")


def _check_references(material: Material, materials: Mapping[str, Material]) -> None:
    """Raise RecipeError where a material is made of one that is missing, or of itself."""
    above, here = [material.id], list(parts(material))
    while here:
        id = here.pop()
        if id not in materials:
            raise RecipeError(f"material {material.id} is made of {id}, which the scene has not")
        if id in above[:1]:
            raise RecipeError(f"material {material.id} is made of itself, give it other materials")
        if id not in above:
            above.append(id)
            here.extend(parts(materials[id]))


def _check_relief(material: Material, textures: Mapping[str, Texture]) -> None:
    """Raise RecipeError for a relief of what is no picture."""
    if (id := str(material.parameters.get("textureID", ""))) and textures[id].kind != "bitmap":
        kind = textures[id].kind
        raise RecipeError(f"texture {id} is a {kind}, whose edges have no slope, give {material.id} a bitmap")


def _texture_of(id: str, materials: Mapping[str, Material]) -> str:
    """Return the id of a texture that a material or one of its parts uses, or nothing."""
    said = materials[id].parameters
    used = [one.texture for one in said.values() if isinstance(one, TextureUse)]
    used.append(str(said.get("textureID", "")))
    inside = (_texture_of(part, materials) for part in parts(materials[id]))
    return next((each for each in (*used, *inside) if each), "")


def _check_texture(texture: Texture) -> None:
    _check_numbers(f"texture {texture.id}", texture.parameters, _TEXTURES)
    for name, choices in _WORDS.items():
        if (word := texture.parameters.get(name, choices[0])) not in choices:
            raise RecipeError(f"texture {texture.id} has {name} {word}, choose one of {', '.join(choices)}")
