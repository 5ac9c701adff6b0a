"""From places in an Image Editor to pixels of renderings, and back."""

from __future__ import annotations

from typing import TYPE_CHECKING

from . import montages, viewing

if TYPE_CHECKING:
    from ..rtb_addon.probing import Region

Box = tuple[float, float, float, float]  # left, bottom, right and top in an Image Editor's region [pixels]


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


def box_of(region, condition: str, pixels: Region) -> Box | None:
    """Return where a region of a condition is shown, None where it is not in the picture."""
    tiles = viewing.tiles()
    right, bottom = pixels.left + pixels.width, pixels.top + pixels.height
    if condition not in tiles.names or right > tiles.width or bottom > tiles.height:
        return None
    left, top = tiles.corner(tiles.names.index(condition))
    return _seen_box(
        region,
        (left + pixels.left / tiles.reduced, left + right / tiles.reduced),
        (top + pixels.top / tiles.reduced, top + bottom / tiles.reduced),
    )


def tile_box(region, number: int) -> Box:
    """Return where a condition of the montage is shown, numbers begin at 0."""
    left, top = viewing.tiles().corner(number)
    width, height = viewing.tiles().tile
    return _seen_box(region, (left, left + width), (top, top + height))


def _seen_box(region, columns: tuple[float, float], rows: tuple[float, float]) -> Box:
    """Return where a part of the picture, from its upper left corner [pixels of the picture], is shown."""
    width, height = viewing.tiles().size
    left, top = region.view2d.view_to_region(columns[0] / width, 1 - rows[0] / height, clip=False)
    right, bottom = region.view2d.view_to_region(columns[1] / width, 1 - rows[1] / height, clip=False)
    return left, bottom, right, top


def _place(context, x: float, y: float) -> tuple[float, float]:
    """Return the place in the picture, from its upper left corner [pixels of the picture]."""
    across, up = context.region.view2d.region_to_view(x, y)
    width, height = viewing.tiles().size
    return across * width, (1 - up) * height
