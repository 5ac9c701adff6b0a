"""The materials of a scene: as declared, or what their Collada colours promote to."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path

from ..errors import RecipeError, at
from ..spectra import Spectrum, Unit
from ..spectra.donaldson import read_donaldson
from ..spectra.promotion import promoted
from .adjustments import Remark
from .collada.colours import NO_EFFECT, Effect, read_effect
from .collada.sources import child
from .collada.textures import image_file
from .declarations import Declaration, parameters_of
from .document import Scene
from .render_scene import Material, Texture, TextureUse, Value
from .values import Values
from .vocabulary import TEXTURES

# The material of what has none; a recipe may declare it.
NO_MATERIAL = "no-material"
# Pictures that are coded by the curve of sRGB (gamma -1); others hold what they say.
_CODED = (".png", ".jpg", ".jpeg", ".tga", ".bmp", ".gif")
_REFERENCES = ("materialID", "otherMaterialID")
# Declared under an id of their own, they go around the material that they name, wherever it is used.
_AROUND = ("bumpmap", "normalmap")


@dataclass
class Materials:
    """
    Makes materials as shapes ask for them, each once.

    Parameters
    ----------
    declared : what the recipe declares, by id
    native : ids that lines of the renderer's own blocks speak of
    """

    document: Scene
    declared: Mapping[str, Declaration]
    values: Values
    native: frozenset[str] = frozenset()
    made: dict[str, Material] = field(default_factory=dict)
    textures: dict[str, Texture] = field(default_factory=dict)
    _emissions: dict[str, Spectrum | None] = field(default_factory=dict)
    _effects: dict[str, Effect] = field(default_factory=dict)

    def use(self, id: str) -> None:
        """Make a material of this id, and whatever it refers to, part of the scene."""
        if id in self.made:
            return
        if (around := self._around.get(id)) is None:
            self._make(id, id)
            return
        inner = f"{id}-inner"
        wrapped = self._declared(around)
        self.made[id] = replace(wrapped, id=id, parameters={**wrapped.parameters, "materialID": inner})
        self._use_texture(str(wrapped.parameters["textureID"]), around)
        self._make(id, inner)

    def texcoord(self, id: str) -> str:
        """Return what a material's own picture calls its texture coordinates, or nothing."""
        if id == NO_MATERIAL or (picture := self._effect(id).picture) is None:
            return ""
        return picture.texcoord

    def emission(self, id: str) -> Spectrum | None:
        """Return the radiance of an undeclared material that emits, or None."""
        return self._emissions.get(id)

    def unused(self) -> list[Remark]:
        """Return a remark for each material that is declared for nothing."""
        around = {each.id for id, each in self._around.items() if id in self.made}
        return [
            Remark(f"{each.id} is the material of nothing in the scene", each.file, each.line)
            for each in self.declared.values()
            if each.category == "material" and each.id not in self.made and each.id not in around
        ]

    @cached_property
    def _around(self) -> dict[str, Declaration]:
        """What goes around materials, by their ids."""
        return {
            each.said["materialID"].value: each
            for each in self.declared.values()
            if each.model in _AROUND and "materialID" in each.said and self.document.element(each.id) is None
        }

    def _make(self, id: str, name: str) -> None:
        declared = self.declared.get(id)
        made = self._promoted(id) if declared is None else self._declared(declared)
        self.made[name] = replace(made, id=name)
        for parameter, value in made.parameters.items():
            if parameter in _REFERENCES and isinstance(value, str):
                self.use(value)
            elif declared and isinstance(value, TextureUse):
                self._use_texture(value.texture, declared)
            elif declared and parameter == "textureID" and isinstance(value, str):
                self._use_texture(value, declared)

    def _declared(self, declared: Declaration) -> Material:
        if declared.category != "material":
            raise declared.error(f"{declared.id} is the material of a shape, declare it a material")
        if self.document.element(declared.id) is not None and any(self._effect(declared.id).emission):
            self.values.warnings.append(
                f"the emission of {declared.id} is left out, declare the mesh that emits an area light"
            )
        parameters = parameters_of(declared, self.values)
        if declared.model == "fluorescent":
            # What is wrong with its file is said before anything is rendered.
            read_donaldson(Path(str(parameters["filename"])))
        return Material(declared.id, declared.model, parameters)

    def _promoted(self, id: str) -> Material:
        effect = NO_EFFECT if id == NO_MATERIAL else self._effect(id)
        if any(effect.emission):
            self._emissions[id] = promoted(effect.emission, Unit.RADIANCE)
            self.values.warnings.append(
                f"{id} has no mapping: its emission {_shown(effect.emission)} was promoted to a radiance"
            )
        return Material(id, "matte", {"diffuseReflectance": self._reflectance(id, effect)})

    def _reflectance(self, id: str, effect: Effect) -> Value:
        colour, why = effect.diffuse or (0.5, 0.5, 0.5), "its colour"
        if effect.picture is not None:
            try:
                return self._picture(id, effect.picture.image)
            except RecipeError as error:
                why = f"{error.message}, grey"
        if id not in self.native and id != NO_MATERIAL:
            self.values.warnings.append(
                f"{id} has no mapping: {why} {_shown(colour)} was promoted to a reflectance"
            )
        return promoted(colour)

    def _picture(self, id: str, image: str) -> TextureUse:
        """Make an image of the document a texture; raise where its file is not in the recipe."""
        element = self.document.element(image)
        name = "" if element is None else image_file(element)
        file = self.values.find_file(name) if name else None
        if file is None:
            raise RecipeError(f"its picture {name or image} is not in the recipe's folder or its resources/")
        defaults = {key: each.default_value() for key, each in TEXTURES["bitmap"].items()}
        parameters = {key: value for key, value in defaults.items() if value is not None}
        gamma = -1.0 if file.suffix.lower() in _CODED else 1.0
        self.textures[image] = Texture(image, "bitmap", {**parameters, "filename": str(file), "gamma": gamma})
        self.values.warnings.append(f"{id} has no mapping: its picture {name} was taken for its reflectance")
        return TextureUse(image)

    def _effect(self, id: str) -> Effect:
        if id not in self._effects:
            self._effects[id] = self._read_effect(id)
        return self._effects[id]

    def _read_effect(self, id: str) -> Effect:
        material = self.document.linked(f"#{id}", "material")
        if (used := child(material, "instance_effect")) is None:
            return NO_EFFECT
        effect = self.document.linked(used.get("url"), "effect")
        with at(self.document.file, self.document.line_of(effect)):
            return read_effect(effect)

    def _use_texture(self, id: str, user: Declaration) -> None:
        declared = self.declared.get(id)
        if declared is None or not declared.category.endswith("Texture"):
            raise user.error(f"{user.id} uses a texture {id}, declare it: {id}:spectrumTexture:bitmap")
        self.textures[id] = Texture(id, declared.model, parameters_of(declared, self.values))


def _shown(colour: Iterable[float]) -> str:
    return " ".join(f"{each:.4g}" for each in colour)
