"""RenderToolbox4's changes filled in for one condition and one renderer."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from ..errors import at
from ..scene.adjustments import Adjustments, Edit, NativeLine, NeutralObject, Property, Removal
from ..scene.collada.colours import read_lamp
from ..scene.paths import Element, numbers_in
from ..spectra.text import format_number
from .changes import Change, ChangedProperty
from .edit_parent import ParentEdits
from .elements import NATIVE_KINDS, find_element
from .expressions import Number, evaluate
from .fill_blocks import native_name
from .filling import Filling
from .native_document import is_projection

_CATEGORIES = {"floatTextures": "floatTexture", "spectrumTextures": "spectrumTexture"}
_BLACK = "300:0 800:0"
# What RenderToolbox4 took where a mapping does not say; unlike RenderToolbox3 mostly black.
_DEFAULTS: dict[str, dict[str, tuple[str, str]]] = {
    "matte": {"diffuseReflectance": ("spectrum", _BLACK)},
    "anisoward": {
        "diffuseReflectance": ("spectrum", _BLACK),
        "specularReflectance": ("spectrum", "300:0.2 800:0.2"),
        "alphaU": ("float", "0.15"),
        "alphaV": ("float", "0.15"),
        "variant": ("string", "balanced"),
    },
    "metal": {"eta": ("spectrum", _BLACK), "k": ("spectrum", _BLACK), "roughness": ("float", "0.05")},
    "checkerboard": {"oddColor": ("spectrum", _BLACK), "evenColor": ("spectrum", _BLACK)},
    "area": {"intensity": ("spectrum", "300:1 800:1")},
    **{lamp: {"intensity": ("spectrum", _BLACK)} for lamp in ("point", "spot", "directional")},
}
# Ids of what there is one of, by its native word.
_ONE_OF = {"rfilter": "filter", "PixelFilter": "filter", "SurfaceIntegrator": "integrator"}
_ONE_OF |= {name: name for name in ("integrator", "sampler", "film")} | {"Sampler": "sampler", "Film": "film"}


def fill_changes(changes: Sequence[Change], filling: Filling, renderer: str) -> Adjustments:
    """Return what those changes say that apply to the filling's condition."""
    native = native_name(renderer, (change.destination for change in changes))
    filler = _Filler(filling, native)
    for change in changes:
        if change.applies(filling.group):
            with at(filling.file, change.line):
                filler.take(_substituted(change, filling))
    return filler.filled()


def _substituted(change: Change, filling: Filling) -> Change:
    """Return a change with the row's values in every text of it."""
    fill = filling.substituted
    properties = (
        ChangedProperty(
            fill(each.name), fill(each.value_type), _filled(each.value, filling), fill(each.operation)
        )
        for each in change.properties
    )
    texts = {name: fill(getattr(change, name)) for name in ("name", "broad_type", "specific_type")}
    return replace(change, **texts, properties=tuple(properties), destination=fill(change.destination))


def _filled(value: object, filling: Filling) -> object:
    if isinstance(value, list):
        return [_filled(each, filling) for each in value]
    return filling.substituted(value) if isinstance(value, str) else value


@dataclass
class _Filler:
    """What changes have said so far, one after the other."""

    filling: Filling
    renderer: str
    objects: list[NeutralObject] = field(default_factory=list)
    native: list[NativeLine] = field(default_factory=list)
    removals: list[Edit] = field(default_factory=list)
    _old: dict[tuple[str, str], str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self._parent = ParentEdits(self.filling)

    def filled(self) -> Adjustments:
        remarks = tuple(dict.fromkeys(self.filling.remarks))
        edits = (*self._parent.edits, *self.removals)
        return Adjustments(edits, tuple(self.objects), tuple(self.native), remarks)

    def take(self, change: Change) -> None:
        destination = change.destination.lower()
        if destination == "mexximp":
            self._parent.take(change)
        elif destination == "generic":
            self._take_generic(change)
        elif destination == self.renderer:
            self.native += self._native_lines(change)

    def _take_generic(self, change: Change) -> None:
        if change.broad_type in _CATEGORIES:
            self.objects.append(self._object(change, change.name, _CATEGORIES[change.broad_type]))
            return
        if change.broad_type not in ("lights", "materials", "meshes"):
            known = ", ".join(("lights", "materials", "meshes", *_CATEGORIES))
            self._remark(change, f"broadType '{change.broad_type}' is skipped, want one of {known}")
            return
        if (element := self._element(change, change.broad_type)) is None:
            return
        id = element.get("id")
        if change.operation == "delete":
            self._delete(change, id)
        elif change.operation == "blessAsAreaLight":
            self.objects.append(self._object(replace(change, specific_type="area"), id, "light"))
        elif change.operation == "blessAsBumpMap":
            self.objects.append(self._bump_map(change, id))
        elif change.broad_type == "meshes":
            self._remark(change, f"a mesh has no Generic properties, bless {change.name} as an area light")
        else:
            model = change.specific_type or self._present_model(change, element)
            category = change.broad_type.removesuffix("s")
            self.objects.append(self._object(replace(change, specific_type=model), id, category))

    def _present_model(self, change: Change, element: Element) -> str:
        if change.broad_type == "lights":
            return read_lamp(element).kind
        known = [
            each for each in self.objects if each.id == element.get("id") and each.category == "material"
        ]
        return known[-1].model if known else "matte"

    def _object(self, change: Change, id: str, category: str) -> NeutralObject:
        properties = list(self._properties(change, id))
        said = {each.name for each in properties}
        for name, (kind, value) in _DEFAULTS.get(change.specific_type, {}).items():
            if name not in said:
                self._remark(change, f"{name} of {id} is not said, RenderToolbox4 takes {value}")
                properties.append(Property(name, kind, value, self.filling.file, change.line))
        place = self.filling.file, change.line
        return NeutralObject(id, category, change.specific_type, tuple(properties), *place)

    def _bump_map(self, change: Change, id: str) -> NeutralObject:
        renamed = {"texture": "textureID"}
        place = self.filling.file, change.line
        said = [
            each._replace(name=renamed.get(each.name, each.name)) for each in self._properties(change, id)
        ]
        properties = (Property("materialID", "string", id, *place), *said)
        return NeutralObject(f"{id}-bumps", "material", "bumpmap", properties, *place)

    def _delete(self, change: Change, id: str) -> None:
        if change.broad_type == "materials":
            raise ValueError(f"a material that objects have cannot be deleted, update {change.name}")
        self.removals.append(Removal(id, self.filling.file, change.line))

    def _properties(self, change: Change, id: str) -> Iterator[Property]:
        for each in change.properties:
            value = self._value(each, id)
            self._old[id, each.name] = value
            found = self.filling.found(value) if isinstance(each.value, str) else None
            if value:
                yield Property(each.name, each.value_type, value, self.filling.file, change.line, found)

    def _value(self, each: ChangedProperty, id: str) -> str:
        """Return a new value as a text; an operation needs an old one, and nothing new keeps the old one."""
        new, old = text_of(each.value), self._old.get((id, each.name), "")
        if each.operation in ("", "="):
            return new or old
        if not old:
            return new
        names = {"oldValue": _numbers(old)}
        result = evaluate(each.operation, names | ({"value": _numbers(new)} if new else {}))
        return text_of(result)

    def _native_lines(self, change: Change) -> Iterator[NativeLine]:
        if change.operation == "delete":
            raise ValueError(f"{change.broad_type} {change.name} cannot be deleted, say what it should be")
        if (id := self._native_id(change)) is None:
            return
        place = self.filling.file, change.line, change.destination
        if change.specific_type and not is_projection(id, change.specific_type, self.filling.document):
            yield NativeLine(f"{id}:{change.broad_type}:{change.specific_type}", *place)
        for each in self._properties(change, id):
            target = f"{id}:{each.name}.{each.type}" if each.type else f"{id}:{each.name}"
            yield NativeLine(f"{target} = {each.value}", *place, each.found)

    def _native_id(self, change: Change) -> str | None:
        if change.broad_type in _ONE_OF:
            return _ONE_OF[change.broad_type]
        if change.broad_type in NATIVE_KINDS:
            element = self._element(change, NATIVE_KINDS[change.broad_type])
            return None if element is None else element.get("id")
        return change.name or change.broad_type

    def _element(self, change: Change, kind: str) -> Element | None:
        found = find_element(self.filling.document, kind, change.name, change.index)
        if found.remark:
            self._remark(change, found.remark)
        return found.element

    def _remark(self, change: Change, message: str) -> None:
        self.filling.remark(message, change.line)


def text_of(value: object) -> str:
    """Return a value of JSON, or numbers, as a text mappings file would write it."""
    if value is None:
        return ""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return value
    if isinstance(value, int | float):
        return format_number(value)
    if isinstance(value, Iterable):
        return " ".join(text_of(each) for each in value)
    raise ValueError(f"a value is {value}, want a text, a number or an array of numbers")


def _numbers(text: str) -> Number:
    found = numbers_in(text)
    if len(found) != len(text.split()):
        raise ValueError(f"'{text}' holds more than numbers, so that nothing can be computed with it")
    return found[0] if len(found) == 1 else np.array(found)
