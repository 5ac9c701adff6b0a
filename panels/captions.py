"""The names of the conditions over their tiles of the montage, with what is amiss with them."""

from __future__ import annotations

from collections.abc import Iterator

from ..operators import row_states, viewing
from ..operators.picture_places import tile_box

NARROWEST, LOWEST, HIGH = 44, 34, 18  # tiles that have room for a name, and its strip [pixels at scale 1]
GROUND, INK, FAINT = (0.0, 0.0, 0.0, 0.55), (0.92, 0.92, 0.92, 1.0), (0.92, 0.92, 0.92, 0.5)
AMISS = {"changed": "changed since", "failed": "failed", "running": "rendering"}
Box = tuple[float, float, float, float]  # left, bottom, right and top [pixels of the region]


def draw(context) -> None:
    """Write the name of each condition at the lower edge of its tile, where that is large enough."""
    from . import strokes

    unit = strokes.scale()
    tiles = dict(_seen_tiles(context.region, NARROWEST * unit, LOWEST * unit))
    amiss = dict(_amiss(context.scene, tiles))
    for name, (left, bottom, right, _) in tiles.items():
        said = amiss.get(name) or viewing.seen["absent"].get(name, "")
        strokes.fill(left, bottom, right, bottom + HIGH * unit, GROUND)
        begin = max(left, 0) + 4 * unit  # of the tile's part that is seen
        text = strokes.shortened(f"{name} ({said})" if said else name, right - begin - 4 * unit)
        strokes.words(text, begin, bottom + 5 * unit, FAINT if said else INK)


def _seen_tiles(region, narrowest: float, lowest: float) -> Iterator[tuple[str, Box]]:
    """Yield the conditions whose tiles lie in a region, if they are that wide and high [pixels]."""
    for number, name in enumerate(viewing.tiles().names):
        left, bottom, right, top = tile_box(region, number)
        if right - left < narrowest or top - bottom < lowest:
            return  # all of them are alike
        if right > 0 and top > 0 and left < region.width and bottom < region.height:
            yield name, (left, bottom, right, top)


def _amiss(scene, names) -> Iterator[tuple[str, str]]:
    """Yield which of some conditions are not as they should be, where the picture is of a scene's recipe."""
    if not names or not viewing.shows_recipe(scene):
        return
    for number, row in enumerate(scene.rtb.conditions):
        if (name := row_states.row_name(scene, row, number)) in names:
            state = row_states.state(scene, row, number)
            if state in AMISS:
                yield name, AMISS[state]
