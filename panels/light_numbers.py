"""What a light comes to, below its amount."""

from ..rtb_addon.blender import light_words
from .numbers import draw_numbers
from .sentences import draw_sentences


def draw_told(layout, context, found) -> None:
    """Draw what is known of a light, or why there is none."""
    draw_sentences(layout, [found.sentence] if found.sentence else [], context.region.width, alert=True)
    column = layout.column()
    column.active = False
    # As many rows as there will be: a panel that grows by itself lies over the next one for a while.
    draw_numbers(column, found.rows or [("", "")] * light_words.ROWS * (not found.sentence))
