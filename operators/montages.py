"""Pictures of renderings as Blender's images, and the Image Editors that show them."""

from __future__ import annotations

from functools import partial
from pathlib import Path

import bpy

MARK = "rtb_montage"


def load(file: Path, name: str) -> bpy.types.Image:
    """Return the image of a recipe, one however many files of it there are, as a file is now."""
    if (image := find(name)) is None:
        image = bpy.data.images.load(str(file))
        image.name = name
        image[MARK] = True
    if image.filepath != (said := _said(file)):
        image.filepath = said
    image.reload()
    return image


def _said(file: Path) -> str:
    """Return a file as the .blend names it, so that both can be moved together."""
    try:
        return bpy.path.relpath(str(file)) if bpy.data.filepath else str(file)
    except ValueError:  # on another drive
        return str(file)


def find(name: str) -> bpy.types.Image | None:
    """Return the image of a recipe."""
    return next((image for image in bpy.data.images if image.get(MARK) and image.name == name), None)


def editors_of(image: bpy.types.Image) -> list[bpy.types.Area]:
    """Return the Image Editors that show an image."""
    areas = (area for window in bpy.context.window_manager.windows for area in window.screen.areas)
    return [area for area in areas if area.type == "IMAGE_EDITOR" and area.spaces.active.image == image]


def redraw(image: bpy.types.Image) -> None:
    """Let the Image Editors that show an image be drawn anew."""
    for area in editors_of(image):
        area.tag_redraw()


def editor(context) -> bpy.types.Area | None:
    """Return the Image Editor that shows a montage already, else an empty one, else the largest."""
    areas = [area for window in context.window_manager.windows for area in window.screen.areas]
    return min(filter(_is_free, areas), key=_rank, default=None)


def _is_free(area: bpy.types.Area) -> bool:
    """Whether an area is an Image Editor, not one for UVs, whose picture nobody has pinned."""
    return area.type == area.ui_type == "IMAGE_EDITOR" and not area.spaces.active.use_image_pin


def _rank(area: bpy.types.Area) -> tuple[int, int]:
    image = area.spaces.active.image
    suits = 1 if image is None else 0 if image.get(MARK) else 2
    return suits, -area.width * area.height


def split_viewport(context) -> bpy.types.Area | None:
    """Open an Image Editor beside the 3D Viewport in hand, or the largest one, and return it."""
    window = context.window or context.window_manager.windows[0]
    viewports = [area for area in window.screen.areas if area.type == "VIEW_3D"]
    if not viewports:
        return None
    viewport = context.area if context.area in viewports else max(viewports, key=lambda a: a.width * a.height)
    before = {area.as_pointer() for area in window.screen.areas}
    with context.temp_override(window=window, area=viewport):
        bpy.ops.screen.area_split(direction="VERTICAL", factor=0.5)
    added = next(area for area in window.screen.areas if area.as_pointer() not in before)
    added.ui_type = "IMAGE_EDITOR"
    added.spaces.active.image = None  # Blender likes to put any image there
    return added


def show(image: bpy.types.Image, area: bpy.types.Area) -> None:
    """Show a montage in an Image Editor; one that was not there before is shown whole."""
    known = area.spaces.active.image == image
    area.spaces.active.image = image
    area.tag_redraw()
    if not known:
        # An area that was opened just now has no size before it has been drawn.
        bpy.app.timers.register(partial(_fit, image.name), first_interval=0.1)


def _fit(name: str) -> None:
    """Zoom so that an image fills the editors that show it."""
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "IMAGE_EDITOR" and (image := area.spaces.active.image) and image.name == name:
                region = next(region for region in area.regions if region.type == "WINDOW")
                with bpy.context.temp_override(window=window, area=area, region=region):
                    bpy.ops.image.view_all(fit_view=True)
