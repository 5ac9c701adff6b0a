"""
Drives a real Blender window, from inside: moves, clicks, keys and photographs.

A run is a generator that yields how long to wait [s], so that Blender draws meanwhile; what it finds out goes
to a report that the tests read.
"""

import json
import os
import subprocess
import sys
import time
import traceback
from pathlib import Path

import bpy
import numpy as np
from hands import Hands

PICTURING = ("RENDER_PREVIEW", "SHADER_COMPILATION")


class Driver(Hands):
    """
    One run of one window.

    Parameters
    ----------
    report_file : where what was found out is written as JSON
    pictures : folder of the photographs
    """

    def __init__(self, report_file: Path, pictures: Path) -> None:
        self.report: dict = {}
        self.report_file, self.pictures = report_file, pictures
        pictures.mkdir(parents=True, exist_ok=True)

    def until(self, happened, seconds: float = 60):
        """Wait until something has happened, but no longer than that."""
        deadline = time.monotonic() + seconds
        while not happened():
            if time.monotonic() > deadline:
                raise TimeoutError(f"it did not happen within {seconds} s")
            yield 0.05

    def settled(self):
        """Draw what a script has changed, and wait until Blender has made its small pictures of it."""
        for _ in range(2):
            for area in self.window.screen.areas:
                area.tag_redraw()
            yield 0.5
            yield from self.until(lambda: not any(map(bpy.app.is_job_running, PICTURING)))

    def open_sidebar(self, tab: str):
        """Show a tab of the 3D Viewport's sidebar."""
        self.area("VIEW_3D").spaces.active.show_region_ui = True
        yield 1.0
        self.region("VIEW_3D", "UI").active_panel_category = tab
        self.area("VIEW_3D").tag_redraw()
        yield 1.0

    def choose_last_entry(self, x: float, y: float, picture: str):
        """Right-click there, photograph the menu, and choose its last entry."""
        x, y = int(x), int(y)
        moved = (("MOUSEMOVE", "NOTHING"),) * 2
        for kind, value in (*moved, ("RIGHTMOUSE", "PRESS"), ("RIGHTMOUSE", "RELEASE")):
            self.window.event_simulate(type=kind, value=value, x=x, y=y)
            yield 0.2
        self.photograph(picture)
        for key in ("END", "RET"):
            for value in ("PRESS", "RELEASE"):
                self.window.event_simulate(type=key, value=value, x=x, y=y)
                yield 0.2

    def photograph(self, name: str) -> np.ndarray:
        """Photograph the screen and return its pixels, (height, width, 3) from the bottom up."""
        file = self.pictures / f"{name}.png"
        subprocess.run(["xshot", str(file)], check=True)
        image = bpy.data.images.load(str(file))
        width, height = image.size
        pixels = np.empty(width * height * 4, np.float32)
        image.pixels.foreach_get(pixels)
        bpy.data.images.remove(image)
        rgb = (pixels.reshape(height, width, 4)[..., :3] * 255).round().astype(np.uint8)
        packed = rgb.astype(np.uint32) @ np.array([1 << 16, 1 << 8, 1], np.uint32)
        self.report.setdefault("colours", {})[name] = len(np.unique(packed))
        return rgb

    def button_rows(self, picture: np.ndarray, region, from_left: float = 0.15) -> list[tuple[int, int]]:
        """Return (bottom, top) of the operator buttons in a region, from the top down, by colour."""
        theme = bpy.context.preferences.themes[0].user_interface.wcol_tool.inner
        colour = np.round(np.array(theme[:3]) * 255)
        x = int(region.x + from_left * region.width)
        column = picture[region.y : region.y + region.height, x].astype(float)
        same = np.concatenate([[False], np.abs(column - colour).max(axis=1) <= 2, [False]])
        edges = np.flatnonzero(same[1:] != same[:-1])
        runs = [
            (int(region.y + a), int(region.y + b))
            for a, b in zip(edges[::2], edges[1::2], strict=True)
            if b - a > 8
        ]
        return runs[::-1]

    def run(self, steps) -> None:
        """Let Blender's timer go through the steps, then leave Blender with 0 if all went well."""
        steps = iter(steps)

        def tick():
            try:
                return next(steps)
            except StopIteration:
                code = 0
            except BaseException:
                self.report["traceback"] = traceback.format_exc()
                code = 1
            self.leave(code)

        bpy.app.timers.register(tick, first_interval=1.0, persistent=True)

    def leave(self, code: int) -> None:
        """Write the report and end Blender."""
        self.write()
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(code)

    def write(self) -> None:
        """Write the report as it is now."""
        self.report_file.write_text(json.dumps(self.report, indent=1))


class Pulse:
    """How regularly Blender's main loop comes round while something else goes on."""

    def __init__(self, interval: float = 0.005) -> None:
        self.interval, self.gaps = interval, []
        self._last = time.perf_counter()
        self._beating = True
        bpy.app.timers.register(self._beat, persistent=True)

    def _beat(self):
        now = time.perf_counter()
        self.gaps.append(now - self._last)
        self._last = now
        return self.interval if self._beating else None

    def stop(self) -> dict[str, float]:
        """Return the number of beats, the longest gap and the median one [s]."""
        self._beating = False
        gaps = np.array(self.gaps[1:])
        return {"beats": len(gaps), "longest": float(gaps.max()), "median": float(np.median(gaps))}
