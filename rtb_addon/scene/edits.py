"""Changes of a Collada document, made where it is: in a copy that nobody else has."""

from __future__ import annotations

from ..spectra.text import format_number
from .adjustments import Edit, MatrixEdit, PathEdit
from .collada.transforms import TRANSFORMS
from .paths import Element, find_id, local_name, parse_path, write


def apply(root: Element, edit: Edit) -> str:
    """Make a change; return the id that was not there, or nothing."""
    if isinstance(edit, PathEdit):
        path = parse_path(edit.path)
        return "" if write(root, path, edit.operator, edit.value) else path.id
    id = edit.node if isinstance(edit, MatrixEdit) else edit.id
    if (element := find_id(root, id)) is None:
        return id
    if isinstance(edit, MatrixEdit):
        _place(element, edit.numbers)
    else:
        _remove(root, element)
    return ""


def _place(node: Element, numbers: tuple[float, ...]) -> None:
    for each in [each for each in node if local_name(each) in TRANSFORMS]:
        node.remove(each)
    namespace = node.tag[: node.tag.rindex("}") + 1] if node.tag.startswith("{") else ""
    matrix = node.makeelement(f"{namespace}matrix", {"sid": "transform"})
    matrix.text = " ".join(map(format_number, numbers))
    node.insert(0, matrix)


def _remove(root: Element, element: Element) -> None:
    url = f"#{element.get('id')}"
    links = [each for each in root.iter("{*}*") if each.get("url") == url]
    for each in links if local_name(element) != "node" else [*links, element]:
        each.getparent().remove(each)
