"""
The curves that panels show, as previews of Blender's.

A panel asks with the text of a spectrum and gets what is there: drawing costs it a look into a dictionary.
What is not there yet is made when Blender is idle, a few milliseconds each, and the panels are drawn anew.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import bpy
import bpy.utils.previews

from ..errors import RecipeError
from .icons import SIDE, new_icon
from .own_spectra import heard, own_folders
from .redrawing import redraw_panels

MOST = 128  # pictures that are kept
UNIT = 20  # of Blender's layouts [pixels at scale 1]
BORDER = 4  # that Blender leaves around a picture [pixels at scale 1]


class Shown(NamedTuple):
    """
    What a panel shows of a spectrum.

    Parameters
    ----------
    icon : the number of its picture; 0 while there is none
    sentence : why there is none, if the text is no spectrum
    """

    icon: int = 0
    sentence: str = ""


_shown: dict[tuple, Shown] = {}
_wanted: dict[tuple, None] = {}
_pictures = None
_thumbnails = None


def shown(text: str, shines: bool, side: int, under: str = "D65") -> Shown:
    """
    Return what there is to see of a spectrum; what is not there yet comes by itself.

    Parameters
    ----------
    shines : whether it is light, and not what a surface does with light
    side : of the square picture [pixels]
    under : the illuminant that a surface's colour is shown in; empty for no colour
    """
    key = _key(text, shines, side, under)
    if key not in _shown and key not in _wanted:
        _wanted[key] = None
        if not bpy.app.background and not bpy.app.timers.is_registered(_make_and_redraw):
            bpy.app.timers.register(_make_and_redraw)
    return _shown.get(key, Shown())


def show_now(text: str, shines: bool, side: int, under: str = "D65") -> None:
    """Make what shown() is to return at once, for dialogs: Blender draws them only where they change."""
    if (key := _key(text, shines, side, under)) not in _shown:
        if len(_shown) >= MOST:
            forget()
        _shown[key] = _made(key)


def side_of(units: int, context) -> int:
    """Return the side of a picture [pixels] that is shown as so many units of Blender's layouts."""
    return round((units * UNIT - BORDER) * (context.preferences.system.ui_scale or 1.0))  # 0 without a window


def _key(text: str, shines: bool, side: int, under: str) -> tuple:
    return text, shines, side, under, bpy.data.filepath


def icons(names: Sequence[str], shines: bool) -> list[int]:
    """Return an icon for each of some names of the library, made when first asked for."""
    from .. import curves, swatches
    from ..spectra import library

    assert _thumbnails is not None
    own, daylight = own_folders(), library.find("D65")
    for name in names:
        if (key := f"{name} {shines}") in _thumbnails:
            continue
        try:
            spectrum = library.find(name, own)
        except RecipeError:
            spectrum = library.find("E").scaled(0.0)  # a file of the user's own that is none
        colour = swatches.light_colour(spectrum) if shines else swatches.surface_colour(spectrum, daylight)
        new_icon(_thumbnails, key, curves.curve_icon(spectrum, SIDE, colour).ravel())
    return [_thumbnails[f"{name} {shines}"].icon_id for name in names]


def forget_icons() -> None:
    """Forget the icons of the library's names, for some mean something else now."""
    if _thumbnails is not None:
        _thumbnails.clear()


def make_wanted() -> int:
    """Make what panels have asked for, and return how much that was."""
    wanted = list(_wanted)
    _wanted.clear()
    if len(_shown) + len(wanted) > MOST:
        forget()
    for key in wanted:
        _shown[key] = _made(key)
    return len(wanted)


def forget() -> None:
    """Forget all pictures and wishes, for files that they were made from may have changed."""
    _shown.clear()
    _wanted.clear()
    if _pictures is not None:
        _pictures.clear()


def _made(key: tuple) -> Shown:
    *asked, _ = key
    try:
        pixels = _pixels(*asked)
    except (RecipeError, OSError) as error:
        return Shown(0, str(error))
    assert _pictures is not None
    preview = _pictures.new(repr(key))
    preview.image_size = pixels.shape[1], pixels.shape[0]
    preview.image_pixels_float.foreach_set(pixels.ravel())
    return Shown(preview.icon_id)


def _pixels(text: str, shines: bool, side: int, under: str):
    # numpy and what stands on it take longer to come than enabling may last.
    from .. import curves, swatches
    from ..spectra import Unit, library

    spectrum = heard(text, Unit.SHAPE if shines else Unit.RATIO)
    colour = None
    if under:
        light = library.find(under)
        colour = swatches.light_colour(spectrum) if shines else swatches.surface_colour(spectrum, light)
    ink = bpy.context.preferences.themes[0].user_interface.wcol_regular.text
    scale = bpy.context.preferences.system.ui_scale or 1.0  # 0 where there is no window
    magnified = max(round(scale), 1)
    picture = curves.curve_picture(spectrum, side, colour, [255 * each for each in ink], magnified)
    picture[..., :3] *= picture[..., 3:]  # as Blender's previews are
    return picture


def _make_and_redraw() -> None:
    if make_wanted():
        redraw_panels()


@bpy.app.handlers.persistent
def _after_loading(*_) -> None:
    forget()


def register() -> None:
    """Make room for pictures."""
    global _pictures, _thumbnails
    _pictures, _thumbnails = bpy.utils.previews.new(), bpy.utils.previews.new()
    bpy.app.handlers.load_post.append(_after_loading)


def unregister() -> None:
    """Give all pictures back."""
    global _pictures, _thumbnails
    if bpy.app.timers.is_registered(_make_and_redraw):
        bpy.app.timers.unregister(_make_and_redraw)
    bpy.app.handlers.load_post.remove(_after_loading)
    _shown.clear()
    _wanted.clear()
    for each in (_pictures, _thumbnails):
        bpy.utils.previews.remove(each)
    _pictures = _thumbnails = None
