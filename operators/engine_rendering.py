"""How Render Image is rendered: a folder for the condition, a child process, the picture of its cube."""

from __future__ import annotations

import tempfile
import time
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import bpy
import numpy as np

from ..rtb_addon.blender import preview
from ..rtb_addon.blender.colours import xyz_to_working_space
from ..rtb_addon.blender.folders import is_unsaved, safe_name
from ..rtb_addon.blender.properties import rendered_size
from ..rtb_addon.blender.reading import read_rendered
from ..rtb_addon.developing import daylight_efficacy
from ..rtb_addon.errors import RenderingError
from ..rtb_addon.recipe import Recipe
from .child_batch import ChildBatch
from .stills import still_home
from .viewer_child import ViewerChild

if TYPE_CHECKING:
    from .render_engine import RTB_RE_engine

INTERVAL = 0.05  # [s] between two looks at what the child has said


class EngineRendering:
    """
    One rendering of the engine.

    Parameters
    ----------
    engine : that Blender has called
    depsgraph : the scene as it is to be rendered
    """

    def __init__(self, engine: RTB_RE_engine, depsgraph) -> None:
        self.engine = engine
        self.scene = depsgraph.scene.original
        self.depsgraph = depsgraph

    def run(self) -> None:
        """Render, unless somebody breaks it off; say what is wrong by raising it."""
        if problems := preview.problems():
            raise RenderingError(problems[0])
        self.engine.update_stats("", "RenderToolbox: writing the scene")
        recipe = read_rendered(self.scene, self.depsgraph)
        for remark in recipe.report:
            self.engine.report({"INFO"}, remark)
        home, options = still_home(self.scene), replace(recipe.options, crop=_framed(self.scene.render))
        if is_unsaved(self.scene):
            remark = f"the .blend is not saved, its cube is in {home} until Blender ends"
            self.engine.report({"WARNING"}, remark)
        still = replace(recipe, name=f"{recipe.name} still", options=options)
        folder = still.save(home / self._part())
        if self._rendered(folder):
            self._show(folder)

    def _part(self) -> Path:
        """Return what tells pictures of a scene apart: the view layer where there are several, the frame."""
        layers = [layer for layer in self.scene.view_layers if layer.use]
        layer = [safe_name(self.depsgraph.view_layer.name)] if len(layers) > 1 else []
        frame = [f"{self.scene.frame_current:04}"] if self.engine.is_animation else []
        return Path(*layer, *frame)

    def _rendered(self, folder: Path) -> bool:
        """Render a folder in a child process and return whether it went to its end."""
        batch = ChildBatch(folder)
        try:
            while not batch.ended:
                if self.engine.test_break():
                    batch.cancel()
                if batch.take():
                    self.engine.update_progress(batch.progress)
                    self.engine.update_stats("", f"RenderToolbox: {100 * batch.progress:.0f} %")
                time.sleep(INTERVAL)
        finally:
            batch.stop()
        for warning in batch.warnings:
            self.engine.report({"WARNING"}, warning)
        if batch.failures and not batch.cancelled:
            raise RenderingError(batch.failures[0])
        return not batch.cancelled

    def _show(self, folder: Path) -> None:
        """Give Blender the picture of the cube, in its working space."""
        recipe = Recipe.load(folder)
        pixels = developed(recipe.rendering_file(next(iter(recipe.conditions))))
        layer = self.depsgraph.view_layer.name
        result = self.engine.begin_result(0, 0, pixels.shape[1], pixels.shape[0], layer=layer)
        result.layers[0].passes["Combined"].rect.foreach_set(pixels.ravel())
        self.engine.end_result(result)


def developed(cube: Path) -> np.ndarray:
    """
    Return a cube's colours as render engines give theirs, (height, width, 4), from the lowest row up.

    Notes
    -----
    Scaled so that a lamp of daylight gives the picture that a white lamp of as many watts gives in Cycles:
    D65 of 1 W sr-1 m-2 from 360 to 830 nm is red, green and blue of 1.
    """
    viewer = ViewerChild()
    answers: list = []
    with tempfile.TemporaryDirectory(dir=bpy.app.tempdir or None) as scratch:
        output = Path(scratch) / "pixels"
        matrix = (xyz_to_working_space() / daylight_efficacy()).tolist()
        request = {"verb": "develop", "cube": str(cube), "matrix": matrix, "output": str(output)}
        try:
            viewer.ask("develop", request, answers.append)
            viewer.wait()
        finally:
            viewer.stop()
        if not answers or "sentence" in answers[0]:
            raise RenderingError(answers[0]["sentence"] if answers else "nobody looks at the rendering")
        size = answers[0]["height"], answers[0]["width"], 4
        return np.fromfile(output, np.float32).reshape(size)


def _framed(render) -> tuple[int, ...]:
    """Return left, top, width and height of the render region [pixels], as Blender counts; or nothing."""
    if not render.use_border:
        return ()
    width, height = map(np.float32, rendered_size(render.id_data))
    left, right = int(width * np.float32(render.border_min_x)), int(width * np.float32(render.border_max_x))
    low, high = int(height * np.float32(render.border_min_y)), int(height * np.float32(render.border_max_y))
    return left, int(height) - high, right - left, high - low
