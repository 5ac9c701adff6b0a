"""From places in an Image Editor to pixels of renderings, and back."""

from __future__ import annotations

from typing import TYPE_CHECKING

from . import montages, viewing

if TYPE_CHECKING:
    from ..rtb_addon.probing import Region


def shows_renderings(context) -> bool:
    """Whether the Image Editor in hand shows what the viewer has drawn."""
    space = context.space_data
    image = space.image if space is not None and space.type == "IMAGE_EDITOR" else None
    return bool(image and viewing.seen) and image == montages.find(viewing.seen["name"])


def pixel_at(context, x: float, y: float) -> tuple[str, int, int] | None:
    """Return condition, column and row of the rendered pixel at a place in the region [pixels]."""
    if not shows_renderings(context):
        return None
    found = viewing.tiles().at(*_place(context, x, y))
    return found if found is not None and found[0] in viewing.seen["there"] else None


def pixel_within(context, condition: str, x: float, y: float) -> tuple[int, int]:
    """Return column and row of the pixel of a condition that is nearest to a place in the region [pixels]."""
    return viewing.tiles().within(condition, *_place(context, x, y))


def box_of(region, condition: str, pixels: Region) -> tuple[float, float, float, float]:
    """Return left, bottom, right and top of a region of a condition, in an Image Editor's region [pixels]."""
    tiles = viewing.tiles()
    width, height = tiles.size
    left, top = tiles.corner(condition)
    columns = left + pixels.left / tiles.reduced, left + (pixels.left + pixels.width) / tiles.reduced
    rows = top + (pixels.top + pixels.height) / tiles.reduced, top + pixels.top / tiles.reduced
    corners = zip(columns, rows, strict=True)
    (x1, y1), (x2, y2) = (
        region.view2d.view_to_region(column / width, 1 - row / height, clip=False) for column, row in corners
    )
    return x1, y1, x2, y2


def _place(context, x: float, y: float) -> tuple[float, float]:
    """Return the place in the picture, from its upper left corner [pixels of the picture]."""
    across, up = context.region.view2d.region_to_view(x, y)
    width, height = viewing.tiles().size
    return across * width, (1 - up) * height
