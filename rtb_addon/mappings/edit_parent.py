"""Changes of the parent scene itself, which RenderToolbox4 called mexximp, as edits of the document."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..scene.adjustments import Edit, MatrixEdit, PathEdit, Removal
from ..scene.collada.colours import read_lamp
from ..scene.collada.transforms import local_matrix
from ..scene.paths import Element, numbers_in
from ..spectra import FloatArray
from ..spectra.text import format_number
from .changes import Change, ChangedProperty
from .elements import KINDS, find_element
from .expressions import evaluate
from .filling import Filling

_LENS, _CONE = "optics:technique_common:perspective", "technique_common:spot:falloff_angle"
# What every camera of a Collada document does anyway.
_AXES = {"lookAtDirection": [0, 0, -1], "upDirection": [0, 1, 0]}


class _Part(NamedTuple):
    change: Change
    element: Element
    property: ChangedProperty


class ParentEdits:
    """
    What changes make of the parent scene, one after the other.

    Attributes
    ----------
    edits : of the document, so far
    """

    def __init__(self, filling: Filling) -> None:
        self.edits: list[Edit] = []
        self._filling = filling
        self._matrices: dict[str, FloatArray] = {}

    def take(self, change: Change) -> None:
        """Add what a change says; ValueError where it says what cannot be done."""
        if change.broad_type not in KINDS:
            known = ", ".join(KINDS)
            message = f"broadType '{change.broad_type}' is skipped, of the parent scene want one of {known}"
            self._filling.remark(message, change.line)
            return
        found = find_element(self._filling.document, change.broad_type, change.name, change.index)
        if found.remark:
            self._filling.remark(found.remark, change.line)
        if change.operation == "create":
            raise ValueError("nothing can be created in the parent scene, update what it holds")
        if found.element is None:
            return
        if not found.element.get("id"):
            raise ValueError(f"{change.name} has no id in the parent scene, export it anew")
        if change.operation == "delete":
            self.edits.append(Removal(found.element.get("id"), self._filling.file, change.line))
        for each in change.properties:
            self._set(_Part(change, found.element, each))

    def _set(self, part: _Part) -> None:
        known = {
            "nodes": {"transformation": self._move},
            "cameras": {
                "horizontalFov": self._widen,
                "aspectRatio": self._leave,
                **dict.fromkeys(_AXES, self._check_axis),
            },
            "lights": {
                "outerConeAngle": self._open,
                "innerConeAngle": self._soften,
                "diffuseColor": self._colour,
            },
        }.get(part.change.broad_type, {})
        if part.property.name not in known:
            there = f"there are {', '.join(known)}" if known else "use the destination Generic"
            raise ValueError(f"{part.property.name} of {part.change.broad_type} cannot be set, {there}")
        known[part.property.name](part)

    def _move(self, part: _Part) -> None:
        id = part.element.get("id")
        old = self._matrices[id] if id in self._matrices else local_matrix(part.element).T
        new = np.asarray(self._value(part, old), float)
        if new.size != 16:
            raise ValueError(f"a transformation is a matrix of 16 numbers, got {new.size}")
        self._matrices[id] = new.reshape(4, 4)
        if np.abs(self._matrices[id][:, 3] - [0, 0, 0, 1]).max() > 1e-12:
            raise ValueError("a transformation for row vectors has 0 0 0 1 as its last column")
        numbers = tuple(self._matrices[id].T.ravel().tolist())
        self.edits.append(MatrixEdit(id, numbers, self._filling.file, part.change.line))

    def _widen(self, part: _Part) -> None:
        radians = self._radians(part, self._degrees_at(part, f"{_LENS}:xfov"))
        if self._value_at(part, f"{_LENS}:yfov") is not None:
            self._edit(part, f"{_LENS}:yfov$", "yfov_before")
        self._edit(part, f"{_LENS}:xfov", format_number(np.degrees(radians)))

    def _open(self, part: _Part) -> None:
        radians = self._radians(part, self._degrees_at(part, _CONE))
        self._edit(part, _CONE, format_number(np.degrees(radians)))

    def _soften(self, part: _Part) -> None:
        """Set the soft edge such that full light ends at the inner angle, as a part of Blender's cone."""
        said = next((each for each in part.change.properties if each.name == "outerConeAngle"), None)
        outer = self._degrees_at(part, _CONE)
        if said is not None:
            outer = np.degrees(self._radians(part._replace(property=said), outer))
        inner = np.degrees(self._radians(part, outer))
        if not 0 <= inner <= outer + 1e-9 or not 0 < outer <= 360:
            raise ValueError(f"an inner cone of {inner:g} degrees needs a wider outer one, got {outer:g}")
        full, edge = np.cos(np.radians([inner, outer]) / 2)
        blend = max(float((full - edge) / (1 - edge)), 0.0)
        self._edit(part, "extra:technique|profile=blender:spotblend", format_number(blend))

    def _colour(self, part: _Part) -> None:
        values = np.ravel(np.asarray(self._value(part, np.ones(3)), float))
        if values.size != 3:
            raise ValueError(f"diffuseColor wants red, green and blue, got {values.size} numbers")
        kind = read_lamp(part.element).kind
        self._edit(part, f"technique_common:{kind}:color", " ".join(map(format_number, values)))

    def _leave(self, part: _Part) -> None:
        self._filling.remark("aspectRatio is left out, the picture's size says it", part.change.line)

    def _check_axis(self, part: _Part) -> None:
        wanted = _AXES[part.property.name]
        values = np.ravel(np.asarray(self._value(part, np.array(wanted, float)), float))
        if values.tolist() != wanted:
            raise ValueError(f"{part.property.name} must be {wanted}, turn the camera's node instead")

    def _radians(self, part: _Part, degrees: float) -> float:
        """Return a property's one number [radians], given the old one [degrees]."""
        value = np.ravel(np.asarray(self._value(part, float(np.radians(degrees))), float))
        if value.size != 1:
            raise ValueError(f"{part.property.name} wants one number, got {value.size}")
        return float(value[0])

    def _degrees_at(self, part: _Part, path: str) -> float:
        return (numbers_in(self._value_at(part, path) or "") or [0.0])[0]

    def _value_at(self, part: _Part, path: str) -> str | None:
        return self._filling.document.value_at(f"{part.element.get('id')}:{path}")

    def _value(self, part: _Part, old: float | FloatArray) -> float | FloatArray:
        """Return a property's new value; an expression may use its old one."""
        given = part.property.value
        numbers = _numbers(given) if given not in (None, "", []) else None
        if part.property.operation in ("", "="):
            return old if numbers is None else numbers
        return evaluate(
            part.property.operation, {"oldValue": old} | ({} if numbers is None else {"value": numbers})
        )

    def _edit(self, part: _Part, path: str, value: str) -> None:
        whole = f"{part.element.get('id')}:{path}"
        self.edits.append(PathEdit(whole, "=", value, self._filling.file, part.change.line))


def _numbers(given: object) -> float | FloatArray:
    if isinstance(given, str):
        return evaluate(given if given.lstrip().startswith("[") else f"[{given}]", {})
    try:
        return np.asarray(given, float)
    except (TypeError, ValueError):
        raise ValueError(f"a value is {given}, want numbers") from None
