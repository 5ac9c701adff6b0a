"""Numbers out of a Collada document: lists in elements, sources with strides and offsets."""

from __future__ import annotations

import warnings

import numpy as np

from ...spectra import FloatArray
from ..paths import Element, local_name
from ..render_scene import IntArray

# What Collada calls the parts of a document that are ours alone.
PROFILE = "RenderToolbox"
# Texts shorter than this are quicker to read word by word.
_SHORT = 300


def child(element: Element, *names: str) -> Element | None:
    """Return the element that names lead to, from child to child, or None."""
    found = element
    for name in names:
        found = next((each for each in found if local_name(each) == name), None)
        if found is None:
            return None
    return found


def children(element: Element, name: str) -> list[Element]:
    """Return the children of a name, in the order of the document."""
    return [each for each in element if local_name(each) == name]


def extra_child(element: Element, name: str, profile: str = "blender") -> Element | None:
    """Return the element of a name in the part of an element that a program wrote for itself, or None."""
    for extra in children(element, "extra"):
        for technique in children(extra, "technique"):
            if technique.get("profile") == profile and (found := child(technique, name)) is not None:
                return found
    return None


def text_of(element: Element | None) -> str:
    """Return an element's text without blanks around it; nothing for no element."""
    return "" if element is None else (element.text or "").strip()


def floats(element: Element, count: int | None = None) -> FloatArray:
    """Return the numbers in an element; ValueError where some are none, infinite, or not as many."""
    return _checked(_numbers(element, np.float64), element, count)


def integers(element: Element) -> IntArray:
    """Return the whole numbers in an element."""
    return _numbers(element, np.int64)


def number(element: Element | None, default: float) -> float:
    """Return the one number in an element, or a default where there is no element."""
    return default if element is None else float(floats(element, 1)[0])


def read_source(source: Element, by_id: dict[str, Element], width: int) -> FloatArray:
    """
    Return a source's table.

    Parameters
    ----------
    by_id : elements of the same geometry, where its accessor may point
    width : columns wanted; others are left out

    Returns
    -------
    (rows, width) float32 array
    """
    accessor = child(source, "technique_common", "accessor")
    if accessor is None:
        raise ValueError(f"the source {source.get('id')} has no accessor")
    array = by_id.get(accessor.get("source", "")[1:])
    if array is None or local_name(array) != "float_array":
        raise ValueError(f"the accessor of {source.get('id')} points to no float_array")
    parameters = children(accessor, "param")
    # A parameter without a name stands for a column to skip, unless none has one.
    named = [column for column, each in enumerate(parameters) if each.get("name")]
    columns = (named or list(range(len(parameters) or width)))[:width]
    if len(columns) < width:
        raise ValueError(f"the source {source.get('id')} has {len(columns)} columns, want {width}")
    return _rows(floats(array), accessor, columns).astype(np.float32)


def _rows(numbers: FloatArray, accessor: Element, columns: list[int]) -> FloatArray:
    stride, offset, count = (
        int(accessor.get(name, default)) for name, default in (("stride", 1), ("offset", 0), ("count", 0))
    )
    if stride <= max(columns) or len(numbers) < offset + count * stride:
        raise ValueError(
            f"{len(numbers)} numbers are too few for {count} rows of {stride} in {accessor.get('source')}"
        )
    return numbers[offset : offset + count * stride].reshape(count, stride)[:, columns]


def _numbers(element: Element, kind: type) -> np.ndarray:
    text = element.text or ""
    if not text or text.isspace():
        return np.zeros(0, kind)
    if len(text) < _SHORT:
        try:
            return np.array(text.split(), kind)
        except ValueError:
            raise ValueError(f"{_named(element)} must hold numbers only") from None
    with warnings.catch_warnings():
        # numpy warns where it meets something that is no number.
        warnings.simplefilter("error", DeprecationWarning)
        try:
            return np.fromstring(text, kind, sep=" ")
        except (DeprecationWarning, ValueError):
            raise ValueError(f"{_named(element)} must hold numbers only") from None


def _checked(numbers: FloatArray, element: Element, count: int | None) -> FloatArray:
    if count is not None and len(numbers) != count:
        raise ValueError(f"{_named(element)} holds {len(numbers)} numbers, want {count}")
    if not np.isfinite(numbers).all():
        raise ValueError(f"{_named(element)} holds numbers that are not finite")
    return numbers


def _named(element: Element) -> str:
    name = element.get("id") or element.get("sid")
    return f"{local_name(element)} {name}" if name else f"a {local_name(element)}"
