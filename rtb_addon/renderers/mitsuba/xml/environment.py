"""What surrounds a scene as Mitsuba's emitter: an even sky, or a picture."""

from __future__ import annotations

import os
from pathlib import Path
from xml.etree import ElementTree as Xml

import numpy as np

from ....errors import RecipeError
from ....scene.render_scene import Light
from ....spectra import FloatArray, Spectrum, Unit
from ...pictures import sky_gamma
from .camera import matrix
from .lights import Span, intensity_of, light
from .names import Names
from .spectrum import comment, element, format_spectrum, plugin_remark
from .textures import AROUND


def environment(lamp: Light, names: Names, span: Span, folder: Path) -> list[Xml.Element]:
    """Return the environment's elements, none if it is dark; files are seen from a folder."""
    if lamp.kind == "sunsky":
        return _sunsky(lamp, names, span, folder)
    if lamp.kind != "environment":
        raise RecipeError(f"Mitsuba knows no {lamp.kind} around a scene, make {lamp.id} an environment")
    intensity = intensity_of(lamp)
    if not intensity.values.any():
        return []
    place = names.of("emitter", lamp.id)
    if file := str(lamp.parameters.get("filename") or ""):
        node = element("emitter", "skypicture", id=place)
        node.append(format_spectrum("intensity", intensity, span))
        node.append(_picture(file, folder))
        node.append(matrix("to_world", _turn(lamp)))
        return [plugin_remark(place), node]
    node = element("emitter", "constant", id=place)
    node.append(format_spectrum("radiance", intensity, span))
    return [node]


def _sunsky(lamp: Light, names: Names, span: Span, folder: Path) -> list[Xml.Element]:
    """Return a sky of Mitsuba's own as a picture, and its sun as a disc."""
    from .sunsky import ANGLE, bake

    turbidity = lamp.parameters["turbidity"]
    if not isinstance(turbidity, int | float):
        raise RecipeError(f"light {lamp.id} has {turbidity} as its turbidity, give a number")
    turn = _turn(lamp)
    found = bake(turn[:3, 2], turbidity, folder)
    even = {"intensity": Spectrum.constant(1.0, Unit.RADIANCE), "filename": str(found.sky)}
    # The picture is that of the world; the light stands where the sun does and shines down from there.
    sky = Light(lamp.id, "environment", np.eye(4), even)
    sun = Light(f"{lamp.id}-sun", "directional", turn, {"intensity": found.sun, "angle": ANGLE})
    said = comment(f"{lamp.id} is Mitsuba's sunsky of turbidity {turbidity:g}, in 512 x 256 directions")
    return [said, *environment(sky, names, span, folder), *light(sun, names, span)]


def _picture(file: str, folder: Path) -> Xml.Element:
    return element(
        "texture",
        "picture",
        name="picture",
        filename=Path(os.path.relpath(file, folder)).as_posix(),
        gamma=sky_gamma(Path(file)),
        wrap_mode=AROUND,
        filter_type="bilinear",
        scale_u=1.0,
        scale_v=1.0,
        offset_u=0.0,
        offset_v=0.0,
    )


def _turn(lamp: Light) -> FloatArray:
    """Return the matrix without its place and size, which the sky has none of."""
    axes = lamp.to_world[:3, :3]
    lengths = np.linalg.norm(axes, axis=0)
    if not lengths.min() > 0:
        raise RecipeError(f"the environment {lamp.id} is scaled to nothing, give it a size")
    turn = np.eye(4)
    turn[:3, :3] = axes / lengths
    return turn
