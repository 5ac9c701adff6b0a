"""
Native lines taken apart.

A line is ``id:category:type``, which declares, or ``id:property.type = value``; RenderToolbox3 took
any of ``. : $`` between the parts (formats.md, scene targets).
"""

from __future__ import annotations

import math
import re
from typing import NamedTuple

from ..errors import RecipeError
from ..scene.render_scene import Camera
from .interface import NativeLine


class NativeSetting(NamedTuple):
    """
    A native line taken apart.

    Parameters
    ----------
    id : of the object that it declares or changes
    name : category of a declaration, else the property
    kind : type of the object or of the value
    value : None in a declaration
    """

    id: str
    name: str
    kind: str
    value: str | None

    @property
    def is_sampler(self) -> bool:
        """Whether this is about a sampler; RenderToolbox3 names them CAMERA_sampler."""
        return self.name == "sampler" or self.id == "sampler" or self.id.endswith("_sampler")

    @property
    def is_integrator(self) -> bool:
        """Whether this is about the integrator."""
        return self.name == "integrator" or self.id == "integrator"

    @property
    def is_filter(self) -> bool:
        """Whether this is about the reconstruction filter."""
        return self.name == "rfilter" or self.id in ("filter", "rfilter") or self.id.endswith("_rfilter")

    @property
    def is_film(self) -> bool:
        """Whether this is about the film; RenderToolbox3 names it CAMERA_film."""
        return self.name == "film" or self.id == "film" or self.id.endswith("_film")

    def is_of(self, camera: Camera) -> bool:
        """Whether this is about a camera, by its own name or that of its node."""
        return self.id in (camera.id, f"{camera.id}-camera")

    @property
    def word(self) -> str:
        """The property as Mitsuba 0.5 and 3 both write it, but for capitals and underscores."""
        return self.name.lower().replace("_", "")


def parse_native_line(line: NativeLine) -> NativeSetting:
    """Return the parts of a native line; RecipeError when it has too few or too many."""
    target, equals, value = line.text.partition("=")
    parts = [part.strip() for part in re.split(r"[.:$]", target)]
    if len(parts) == 3 or (len(parts) == 2 and equals):
        return NativeSetting(
            parts[0], parts[1], parts[2] if len(parts) == 3 else "", value.strip() if equals else None
        )
    raise RecipeError(
        f"cannot read '{line.text}', want id:category:type or id:property.type = value", line.file, line.line
    )


def number_of(setting: NativeSetting, line: NativeLine) -> float:
    """Return a setting's value as a number."""
    try:
        number = float(setting.value or "")
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        raise RecipeError(f"{setting.name} is '{setting.value}', want a number", line.file, line.line)
    return number


def count_of(setting: NativeSetting, line: NativeLine, least: int = 1) -> int:
    """Return a setting's value as a whole number."""
    try:
        count = int(setting.value or "")
    except ValueError:
        count = least - 1
    if count < least:
        message = f"{setting.name} is '{setting.value}', want a whole number from {least}"
        raise RecipeError(message, line.file, line.line)
    return count
