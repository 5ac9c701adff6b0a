"""What the values of recipe.json must be."""

from __future__ import annotations

import dataclasses
import json
import math
import re
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple, get_args

from ..layers import NAMES as LAYERS
from ..scene.render_scene import Filter


class Rule(NamedTuple):
    """What a value must be, in words, and whether one is."""

    words: str
    holds: Callable[[Any], bool]


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)


def _whole(low: int, words: str) -> Rule:
    return Rule(words, lambda value: isinstance(value, int) and not isinstance(value, bool) and value >= low)


def _one_of(*choices: str) -> Rule:
    return Rule(f"one of {', '.join(choices)}", lambda value: isinstance(value, str) and value in choices)


def _are_bands(value: Any) -> bool:
    numbers = isinstance(value, tuple) and len(value) == 3 and all(map(_is_number, value))
    return numbers and value[0] > 0 and value[1] > 0 and value[2] >= 1 and value[2] == int(value[2])


def _are_centres(value: Any) -> bool:
    if not isinstance(value, tuple) or len(value) == 1 or not all(map(_is_number, value)):
        return False
    return all(a < b for a, b in zip((0, *value), value, strict=False))


def _is_crop(value: Any) -> bool:
    if value == ():
        return True
    whole = isinstance(value, tuple) and len(value) == 4 and all(_whole(0, "").holds(each) for each in value)
    return whole and value[2] > 0 and value[3] > 0


def _are_layers(value: Any) -> bool:
    return isinstance(value, tuple) and len(set(value)) == len(value) and set(value) <= set(LAYERS)


def _none_or_positive(words: str) -> Rule:
    return Rule(words, lambda value: value is None or (_is_number(value) and value > 0))


RULES: Mapping[str, Rule] = {
    "renderer": Rule(
        "a renderer's name in small letters",
        lambda v: isinstance(v, str) and bool(re.fullmatch(r"[a-z][a-z0-9_-]*", v)),
    ),
    "width": _whole(1, "a whole number of pixels"),
    "height": _whole(1, "a whole number of pixels"),
    "bands": Rule("start [nm], step [nm] and count, all positive", _are_bands),
    "centres": Rule("at least two increasing wavelengths [nm]", _are_centres),
    "band_kind": _one_of("averaged", "centre", "mean"),
    "samples": _whole(1, "a whole number of paths per pixel, 1 or more"),
    "seed": _whole(0, "a whole number, 0 or more"),
    "integrator": _one_of("path", "direct"),
    "depth": _whole(1, "a whole number, 1 or more (2 is direct light)"),
    "roulette": _whole(0, "the depth from which paths may end at random, 0 for never"),
    "filter": _one_of(*get_args(Filter)),
    "crop": Rule("left, top, width and height [pixels], or empty for the whole picture", _is_crop),
    "until_seconds": _none_or_positive("a number of seconds, or null to take all samples"),
    "until_error": _none_or_positive("a relative noise such as 0.01, or null to take all samples"),
    "layers": Rule(f"names out of {', '.join(LAYERS)}", _are_layers),
    "camera": Rule("the id of a camera, or an empty text for the scene's own", lambda v: isinstance(v, str)),
    "units": _one_of("si", "rtb3"),
    "handedness": _one_of("blender", "rtb3"),
    "columns": Rule("a whole number of columns, or null", lambda v: v is None or _whole(1, "").holds(v)),
    "fill": _one_of("columns", "rows"),
    "scale": Rule(
        "a positive number, or null for the brightest", lambda v: v is None or (_is_number(v) and v > 0)
    ),
    "tone_map": Rule("a number, 0 for none", lambda v: _is_number(v) and v >= 0),
}


class Checked:
    """A group of values that keep their rules."""

    def __post_init__(self) -> None:
        for field in dataclasses.fields(self):  # type: ignore[arg-type]
            value, rule = getattr(self, field.name), RULES[field.name]
            if not rule.holds(value):
                raise ValueError(f"{field.name} is {_shown(value)}, it must be {rule.words}")


def _shown(value: Any) -> str:
    return json.dumps(value, ensure_ascii=False, default=str)
