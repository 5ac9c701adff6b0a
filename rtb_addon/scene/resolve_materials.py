"""The materials of a scene: as declared, or what their Collada colours promote to."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property

from ..errors import at
from ..spectra import Spectrum, Unit
from ..spectra.promotion import promoted
from .adjustments import Remark
from .collada_colours import NO_EFFECT, Effect, read_effect
from .collada_sources import child
from .declarations import Declaration, parameters_of
from .document import Scene
from .render_scene import Material, Texture, TextureUse
from .values import Values

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
        return Material(declared.id, declared.model, parameters_of(declared, self.values))

    def _promoted(self, id: str) -> Material:
        effect = self._effect(id)
        colour = effect.diffuse or (0.5, 0.5, 0.5)
        if any(effect.emission):
            self._emissions[id] = promoted(effect.emission, Unit.RADIANCE)
            self.values.warnings.append(
                f"{id} has no mapping: its emission {_shown(effect.emission)} was promoted to a radiance"
            )
        if id not in self.native:
            why = "its texture is not read, grey" if effect.textured else "its colour"
            self.values.warnings.append(
                f"{id} has no mapping: {why} {_shown(colour)} was promoted to a reflectance"
            )
        return Material(id, "matte", {"diffuseReflectance": promoted(colour)})

    def _effect(self, id: str) -> Effect:
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
