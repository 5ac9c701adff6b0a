"""What a Collada document's libraries hold besides geometries: cameras, lights, effects and materials."""

from __future__ import annotations

from collections.abc import Sequence

from .sources import PROFILE
from .write_elements import Colour, Element, new
from .write_numbers import number, numbers


def camera(
    id: str, name: str, view: Element, shift: tuple[float, float], lens: tuple[float, float] | None = None
) -> Element:
    """
    Return a camera.

    Parameters
    ----------
    view : perspective() or orthographic()
    shift : of the picture, right and up, as fractions of its longer side
    lens : radius of a thin lens and the distance that is sharp [scene units]; None for a pinhole
    """
    optics = new("optics", new("technique_common", view))
    parts = [_technique(_extra_numbers(("shiftx", "shifty"), shift))]
    if lens is not None:
        parts.append(_technique(_extra_numbers(("lens_radius", "focus_distance"), lens), PROFILE))
    return new("camera", optics, new("extra", *parts), id=id, name=name)


def perspective(xfov: float, aspect: float, clip: tuple[float, float], yfov: float | None = None) -> Element:
    """
    Return a perspective view.

    Parameters
    ----------
    xfov : angle across the width of the picture [degrees]
    aspect : width by height of the picture; not written where yfov is given
    clip : near and far [scene units]
    yfov : angle across the height [degrees], where pixels are not square
    """
    height = _aspect(aspect) if yfov is None else new("yfov", sid="yfov", text=number(yfov))
    return new("perspective", new("xfov", sid="xfov", text=number(xfov)), height, *_clip(clip))


def orthographic(
    width: float, aspect: float, clip: tuple[float, float], height: float | None = None
) -> Element:
    """Return a parallel view of a width and perhaps a height [scene units]; Collada writes the halves."""
    second = _aspect(aspect) if height is None else new("ymag", sid="ymag", text=number(height / 2))
    return new("orthographic", new("xmag", sid="xmag", text=number(width / 2)), second, *_clip(clip))


def _aspect(aspect: float) -> Element:
    return new("aspect_ratio", text=number(aspect))


def _clip(clip: tuple[float, float]) -> list[Element]:
    near, far = map(number, clip)
    return [new("znear", sid="znear", text=near), new("zfar", sid="zfar", text=far)]


def light(id: str, name: str, kind: str, colour: Colour, cone: float, blend: float) -> Element:
    """
    Return a lamp: ``point`` or ``spot`` with the square of the distance, ``directional`` or ``ambient``.

    Parameters
    ----------
    colour : linear Rec.709 components of what the kind is measured in
    cone, blend : of a spot: the full angle [degrees] and how much of it is a soft edge, as Blender wrote them
    """
    lamp = new(kind, new("color", sid="color", text=numbers(colour)))
    if kind not in ("directional", "ambient"):
        lamp.extend(new(f"{term}_attenuation", text="0") for term in ("constant", "linear"))
        lamp.append(new("quadratic_attenuation", text="1"))
    if kind == "spot":
        lamp.append(new("falloff_angle", sid="fall_off_angle", text=number(cone)))
        lamp.append(new("falloff_exponent", sid="fall_off_exponent", text=number(blend)))
    return new("light", new("technique_common", lamp), id=id, name=name)


def effect(id: str, colour: Colour) -> Element:
    """Return what a matte surface of a colour does: linear Rec.709, and one for opaque."""
    black = new("emission", new("color", sid="emission", text="0 0 0 1"))
    diffuse = new("diffuse", new("color", sid="diffuse", text=numbers([*colour, 1])))
    technique = new("technique", new("lambert", black, diffuse), sid="common")
    return new("effect", new("profile_COMMON", technique), id=id)


def material(id: str, name: str, effect_id: str) -> Element:
    """Return a material."""
    return new("material", new("instance_effect", url=f"#{effect_id}"), id=id, name=name)


def _technique(parts: Sequence[Element], profile: str = "blender") -> Element:
    return new("technique", *parts, profile=profile)


def _extra_numbers(names: Sequence[str], values: Sequence[float]) -> list[Element]:
    return [_extra_number(name, value) for name, value in zip(names, values, strict=True)]


def _extra_number(name: str, value: float) -> Element:
    return new(name, sid=name, type="float", text=number(value))
