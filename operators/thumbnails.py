"""
Small pictures of conditions, for the rows that are seen: asked of the viewer, kept as icons of Blender's.

A row asks with its name and gets what is there; drawing costs it a look into a dictionary. It lives here and
not in Blender's data, so that undo and saving do not touch it.
"""

from __future__ import annotations

import base64
from collections.abc import Mapping
from typing import Any, NamedTuple

import bpy
import bpy.utils.previews

from ..rtb_addon.blender.folders import recipe_folder
from ..rtb_addon.blender.icons import SIDE, new_icon
from ..rtb_addon.blender.redrawing import redraw_panels
from ..rtb_addon.errors import RecipeError
from . import viewing

MOST = 256  # icons that are kept
AT_ONCE = 4  # that the viewer is asked for, so that nobody else waits long for it
SEEN = 32  # rows that may be seen together; wishes of others, who were scrolled by, are dropped


class Wish(NamedTuple):
    """
    Whose picture is wanted.

    Parameters
    ----------
    scene : number of the scene in this session
    version : another one once the condition has been rendered anew
    """

    scene: int
    name: str
    version: int


DIM = 0.5  # how much is left of the picture of a condition that may look otherwise now

_icons: dict[Wish, tuple[int, int]] = {}
_wanted: dict[Wish, None] = {}
_asked: list[Wish] = []
_pictures = None


def icon(scene, name: str, version: int, dim: bool = False) -> int:
    """Return the icon of a condition, 0 while there is none; what is not there yet comes by itself."""
    wish = Wish(scene.session_uid, name, version)
    if wish not in _icons and wish not in _asked:
        _wanted[wish] = _wanted.pop(wish, None)  # the last one that was seen comes last
        if not bpy.app.background and not bpy.app.timers.is_registered(fetch):
            bpy.app.timers.register(fetch)
    return _icons.get(wish, (0, 0))[dim]


def fetch() -> None:
    """Ask the viewer for some of what is wanted, unless it is at it."""
    if _asked or not _wanted:
        return
    scene = next(reversed(_wanted)).scene
    newest = [each for each in list(_wanted)[-SEEN:] if each.scene == scene]
    _asked[:] = newest[-AT_ONCE:]
    _wanted.clear()
    _wanted.update(dict.fromkeys(newest[:-AT_ONCE]))
    if not (folder := _folder_of(scene)):
        _arrived({})
        return
    names = [each.name for each in _asked]
    request = {"verb": "thumbnails", "folder": folder, "names": names, "side": SIDE}
    viewing.ask("thumbnails", request, _arrived)


def _folder_of(number: int) -> str:
    """Return the folder of a scene's recipe, empty where either has gone."""
    scene = next((each for each in bpy.data.scenes if each.session_uid == number), None)
    try:
        return "" if scene is None else str(recipe_folder(scene))
    except RecipeError:
        return ""


def forget() -> None:
    """Forget all pictures and wishes."""
    for known in (_icons, _wanted, _asked):
        known.clear()
    if _pictures is not None:
        _pictures.clear()


def _arrived(answer: Mapping[str, Any]) -> None:
    """Keep the pictures that have come, in the place of older ones; who has none is not asked for again."""
    pictures = answer.get("pictures", {})
    for wish in _asked:
        for old in [each for each in _icons if each[:2] == wish[:2]]:
            _drop(old)
        _icons[wish] = _made(wish, pictures[wish.name]) if wish.name in pictures else (0, 0)
    _asked.clear()
    for old in list(_icons)[: max(len(_icons) - MOST, 0)]:
        _drop(old)
    redraw_panels()
    fetch()


def _made(wish: Wish, words: str) -> tuple[int, int]:
    """Return two icons of a picture, the second one dim."""
    import numpy as np  # which enabling need not wait for

    assert _pictures is not None
    pixels = np.frombuffer(base64.b64decode(words), np.uint8).astype(np.float32) / 255
    shown, dim = _names(wish)
    return new_icon(_pictures, shown, pixels), new_icon(_pictures, dim, pixels * DIM)


def _names(wish: Wish) -> tuple[str, str]:
    return repr(tuple(wish)), f"{tuple(wish)!r} dim"


def _drop(wish: Wish) -> None:
    del _icons[wish]
    assert _pictures is not None
    for name in _names(wish):
        if name in _pictures:
            del _pictures[name]


@bpy.app.handlers.persistent
def _before_loading(*_) -> None:
    forget()


def register() -> None:
    """Make room for pictures."""
    global _pictures
    _pictures = bpy.utils.previews.new()
    bpy.app.handlers.load_pre.append(_before_loading)


def unregister() -> None:
    """Give all pictures back."""
    global _pictures
    bpy.app.handlers.load_pre.remove(_before_loading)
    if bpy.app.timers.is_registered(fetch):
        bpy.app.timers.unregister(fetch)
    forget()
    bpy.utils.previews.remove(_pictures)
    _pictures = None
