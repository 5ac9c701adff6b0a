"""Pictures of pixels as icons of Blender's."""

SIDE = 32  # of an icon [pixels]


def new_icon(pictures, name: str, pixels) -> int:
    """
    Make an icon and return its number, 0 where Blender has no window.

    Parameters
    ----------
    pictures : a collection of Blender's previews, which keeps it under the name
    pixels : (SIDE * SIDE * 4,) RGBA, 0 to 1, the lowest row first
    """
    preview = pictures.new(name)
    preview.image_size = preview.icon_size = SIDE, SIDE
    preview.icon_pixels_float.foreach_set(pixels)
    preview.image_pixels_float.foreach_set(pixels)
    return preview.icon_id
