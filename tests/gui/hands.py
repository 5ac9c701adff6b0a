"""Moves the pointer over a real Blender window, and its keys, as a person does."""

from __future__ import annotations

from typing import Any

import bpy


class Hands:
    """A mouse and a keyboard; moves are generators that yield how long to wait [s], so that Blender acts."""

    @property
    def window(self):
        return bpy.context.window_manager.windows[0]

    def area(self, kind: str) -> Any:
        """Return the largest area of a kind, or None."""
        areas = [area for area in self.window.screen.areas if area.type == kind]
        return max(areas, key=lambda area: area.width * area.height, default=None)

    def region(self, area_kind: str, kind: str):
        return next(region for region in self.area(area_kind).regions if region.type == kind)

    def move(self, x: float, y: float):
        """Move the pointer to a place in the window."""
        self.x, self.y = int(x), int(y)
        for _ in range(2):
            self.window.event_simulate(type="MOUSEMOVE", value="NOTHING", x=self.x, y=self.y)
        yield 0.02

    def drag(self, begin: tuple[float, float], end: tuple[float, float], shift: bool = False):
        """Press the left button at a place in the window and let it go at another one."""
        yield from self.move(*begin)
        where = {"x": int(begin[0]), "y": int(begin[1]), "shift": shift}
        self.window.event_simulate(type="LEFTMOUSE", value="PRESS", **where)
        yield 0.05
        for share in (0.3, 0.7, 1.0):
            x, y = (int(a + share * (b - a)) for a, b in zip(begin, end, strict=True))
            self.window.event_simulate(type="MOUSEMOVE", value="NOTHING", x=x, y=y, shift=shift)
            yield 0.05
        self.window.event_simulate(type="LEFTMOUSE", value="RELEASE", x=x, y=y, shift=shift)
        yield 0.05

    def click(self, x: float, y: float):
        """Move there and click, as a person does."""
        yield from self.move(x, y)
        for value in ("PRESS", "RELEASE"):
            self.window.event_simulate(type="LEFTMOUSE", value=value, x=int(x), y=int(y))
        yield 0.05

    def under_pointer(self, area_kind: str, region_kind: str) -> str:
        """Return what a script calls the button under the pointer: its operator, or its property's path."""
        manager, found = bpy.context.window_manager, ""
        ask = {"area": self.area(area_kind), "region": self.region(area_kind, region_kind)}
        with bpy.context.temp_override(window=self.window, **ask):
            for copy in (bpy.ops.ui.copy_python_command_button, bpy.ops.ui.copy_data_path_button):
                manager.clipboard = ""
                if copy.poll():
                    copy()
                    found = found or manager.clipboard
        return found

    def find(self, name: str, area_kind: str, region_kind: str, down: int, across: float = 0.7):
        """
        Move over a region to the middle of the button that a script calls so; the pointer rests there then.

        Parameters
        ----------
        down : where it is looked for first, from the upper edge of the region [pixels]
        across : share of the region's width
        """
        region = self.region(area_kind, region_kind)
        x, top = region.x + across * region.width, region.y + region.height

        def on_it(distance: float):
            yield from self.move(x, top - distance)
            return name in self.under_pointer(area_kind, region_kind)

        for distance in [down, *sorted(range(4, region.height, 9), key=lambda each: abs(each - down))]:
            if (yield from on_it(distance)):
                break
        else:
            raise LookupError(f"there is no button {name} in {area_kind} {region_kind}")
        edges = [distance, distance]
        for side, step in enumerate((-4, 4)):
            while (yield from on_it(edges[side] + step)):
                edges[side] += step
        yield from self.move(x, top - sum(edges) / 2)

    def click_on(self, name: str, area_kind: str, region_kind: str, down: int, across: float = 0.7):
        """Find a button, and click on it."""
        yield from self.find(name, area_kind, region_kind, down, across)
        yield from self.click(self.x, self.y)

    def key(self, kind: str, text: str = "", **held: bool):
        """Press a key where the pointer is, and let it go; it writes a letter where something is typed."""
        letter = {"unicode": text} if text else {}
        self.window.event_simulate(type=kind, value="PRESS", x=self.x, y=self.y, **letter, **held)
        self.window.event_simulate(type=kind, value="RELEASE", x=self.x, y=self.y, **held)
        yield 0.05

    def type(self, text: str):
        """Type a text, letter by letter."""
        for letter in text:
            yield from self.key(letter.upper() if letter.isalpha() else "SPACE", letter)

    def press(self, key: str, area_kind: str):
        """Press a key with the pointer over an area."""
        area = self.area(area_kind)
        x, y = area.x + area.width // 2, area.y + area.height // 2
        for kind, value in (("MOUSEMOVE", "NOTHING"), (key, "PRESS"), (key, "RELEASE")):
            self.window.event_simulate(type=kind, value=value, x=x, y=y)
            yield 0.05

    def scroll(self, area_kind: str, region_kind: str, clicks: int):
        """Turn the mouse wheel over the middle of a region, down or up if negative."""
        region = self.region(area_kind, region_kind)
        x, y = region.x + region.width // 2, region.y + region.height // 2
        self.window.event_simulate(type="MOUSEMOVE", value="NOTHING", x=x, y=y)
        yield 0.1
        for _ in range(abs(clicks)):
            kind = "WHEELDOWNMOUSE" if clicks > 0 else "WHEELUPMOUSE"
            self.window.event_simulate(type=kind, value="PRESS", x=x, y=y)
            yield 0.05
        yield 0.5
