"""
What the Image Editor shows of the renderings: asked of a child, shown when it is there.

It lives here and not in Blender's data, so that undo and saving do not touch it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import bpy

from ..rtb_addon.blender.folders import recipe_folder
from ..rtb_addon.blender.properties import RTB_PG_scene
from ..rtb_addon.blender.redrawing import redraw_panels
from ..rtb_addon.errors import RecipeError
from . import montages
from .stills import still_home
from .tell import tell

if TYPE_CHECKING:
    from ..rtb_addon.tiles import Tiles
    from .viewer_child import ViewerChild

INTERVAL = 0.02  # [s] between two looks at what the child has answered
FILE = "images/view.tif"

seen: Mapping[str, Any] = {}  # what the picture shows, as the viewer answered; empty while there is none
sentence = ""  # why the last wish could not be met
_tiles: Tiles | None = None
_child: ViewerChild | None = None
_opening = False


def show(folder: Path, open_editor: bool = False) -> None:
    """
    Show the renderings of a recipe as the view says, as soon as the picture is there.

    Parameters
    ----------
    open_editor : put the picture into an Image Editor, opening one if need be; else only its pixels change
    """
    global _opening
    _opening = _opening or open_editor
    view = bpy.context.window_manager.rtb_view
    request = {"verb": "look", "folder": str(folder), "output": str(folder / FILE), "grid": _grid(folder)}
    ask("look", {**request, **view.request()}, _arrived)


def wake() -> None:
    """Start the viewer ahead of the first wish, unless it is there."""
    if _child is None:
        ask("wake", {"verb": "wake"}, lambda answer: None)


def redraw() -> None:
    """Let the Image Editors that show renderings be drawn anew, for what is written over them is another."""
    if seen and (image := montages.find(seen["name"])) is not None:
        montages.redraw(image)


def refresh(scene) -> None:
    """Show a scene's renderings anew where they are shown already."""
    if seen or sentence:
        try:
            show(Path(seen["folder"]) if shows(scene) else recipe_folder(scene))
        except RecipeError as error:
            _complain(str(error))


def _grid(folder: Path) -> dict[str, Any]:
    """Return how the scene in hand arranges its montage, nothing where the folder is another recipe's."""
    settings = bpy.context.scene.rtb
    if not _is_folder_of(bpy.context.scene, folder):
        return {}
    return {"columns": settings.montage_columns or None, "fill": settings.montage_fill}


def _is_folder_of(scene, folder: Path) -> bool:
    try:
        return folder == recipe_folder(scene)
    except RecipeError:
        return False


def ask(kind: str, request: dict[str, Any], then: Callable[[Mapping[str, Any]], None]) -> None:
    """Ask the viewer, starting it if need be; without a window wait for its answer."""
    from .viewer_child import ViewerChild  # brings subprocess and more, which enabling need not wait for

    global _child
    if _child is None or _child.ended:
        _child = ViewerChild()
    _child.ask(kind, request, then)
    if bpy.app.background:
        _child.wait()
    elif not bpy.app.timers.is_registered(_take):
        bpy.app.timers.register(_take, first_interval=INTERVAL, persistent=True)


def wait() -> None:
    """Wait for what was asked, for a script that goes on with the answer."""
    if _child is not None:
        _child.wait()


def tiles() -> Tiles:
    """Return what lies where in the picture; there must be one."""
    assert _tiles is not None
    return _tiles


def shows_recipe(scene) -> bool:
    """Whether the picture is of a scene's recipe."""
    return bool(seen) and _is_folder_of(scene, Path(seen["folder"]))


def shows(scene) -> bool:
    """Whether the picture is of a scene's recipe, or of what Render Image has rendered of it."""
    return shows_recipe(scene) or (bool(seen) and Path(seen["folder"]).is_relative_to(still_home(scene)))


def forget() -> None:
    """End the viewer and forget what it showed."""
    global seen, sentence, _tiles, _child, _opening
    seen, sentence, _tiles, _opening = {}, "", None, False
    if _child is not None:
        _child.stop()
        _child = None
    if bpy.app.timers.is_registered(_take):
        bpy.app.timers.unregister(_take)


def _take() -> float | None:
    """Take in what the child has answered; Blender calls this and goes on."""
    if _child is None:
        return None
    _child.take()
    return INTERVAL if _child.busy else None


def _arrived(answer: Mapping[str, Any]) -> None:
    """Show a picture that has come, or keep in mind why there is none."""
    from ..rtb_addon.tiles import Tiles

    global seen, sentence, _tiles, _opening
    opening, _opening = _opening, False
    if "sentence" in answer:
        _complain(answer["sentence"], aloud=opening)
        return
    seen, sentence, _tiles = answer, "", Tiles.from_words(answer["tiles"])
    image = montages.load(Path(answer["file"]), answer["name"])
    if opening and not bpy.app.background:
        area = montages.editor(bpy.context) or montages.split_viewport(bpy.context)
        if area is not None:
            montages.show(image, area)
    redraw_panels()
    montages.redraw(image)


def _complain(words: str, aloud: bool = False) -> None:
    """Keep in mind what is wrong; aloud where no panel may be there to say it."""
    global sentence
    sentence = words
    if aloud:
        tell("ERROR", words)
    redraw_panels()


@bpy.app.handlers.persistent
def _before_loading(*_) -> None:
    forget()


def _arranged_anew() -> None:
    refresh(bpy.context.scene)


def register() -> None:
    """Watch for another file being opened, and for a montage that is arranged anew."""
    bpy.app.handlers.load_pre.append(_before_loading)
    for name in ("montage_columns", "montage_fill"):
        key = RTB_PG_scene, name
        bpy.msgbus.subscribe_rna(
            key=key, owner=_arranged_anew, args=(), notify=_arranged_anew, options={"PERSISTENT"}
        )


def unregister() -> None:
    """Leave no child and no timer behind."""
    forget()
    bpy.msgbus.clear_by_owner(_arranged_anew)
    bpy.app.handlers.load_pre.remove(_before_loading)
