"""
Several processes that paint tiles of one picture: a ray kernel keeps Python to itself while it works.

Each has the whole scene to itself and waits for questions: a native scene, then tiles of it, as lines of
JSON. They stay for the next scene, whose triangles may be the same. A tile is the same whoever paints it.
"""

from __future__ import annotations

import atexit
import base64
import json
import queue
import subprocess
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np

from ...background import send, start_child, stop_all
from ...errors import RecipeError, RenderingError
from ...lifeline import stop_for_good, watch_parent
from ...spectra import FloatArray
from . import native
from .passes import Alone, Tile

_GRACE = 0.5  # [s] from the end of a parent to that of its children
_children: list[subprocess.Popen] = []


class Together:
    """Paints a native scene in so many processes."""

    def __init__(self, scene: Path, processes: int) -> None:
        self.processes = _started(processes)
        with ThreadPoolExecutor(processes) as pool:
            ready = list(pool.map(lambda one: _asked(one, {"scene": str(scene)}), self.processes))
        self.kernel: str = ready[0]["kernel"]

    def paint(self, tiles: Sequence[Tile], report: Callable[[float], None]) -> Iterator[FloatArray]:
        """Yield the (pixels, bands) mean radiance of each tile, in their order."""
        idle: queue.SimpleQueue[subprocess.Popen] = queue.SimpleQueue()
        for one in self.processes:
            idle.put(one)

        def painted(tile: Tile) -> FloatArray:
            one = idle.get()
            try:
                light = base64.b64decode(_asked(one, {"tile": tile})["light"])
            finally:
                idle.put(one)
            return np.frombuffer(light, np.float32).reshape(tile.last - tile.first, -1)

        pool = ThreadPoolExecutor(len(self.processes))
        try:
            for number, radiance in enumerate(pool.map(painted, tiles)):
                yield radiance
                report((number + 1) / len(tiles))
        finally:
            # Who cancels waits for no more than the tiles that are being painted.
            pool.shutdown(cancel_futures=True)


def main() -> None:
    """Answer the questions of a parent until there are no more."""
    questions: queue.SimpleQueue[str] = queue.SimpleQueue()
    watch_parent(questions.put, lambda: stop_for_good(0))
    alone: Alone | None = None
    while True:
        question = json.loads(questions.get())
        try:
            if "scene" in question:
                alone = Alone(native.read(Path(question["scene"])))
                answer = {"kernel": alone.kernel}
            else:
                assert alone is not None
                light = alone.tile(Tile(*question["tile"]))
                answer = {"light": base64.b64encode(light.tobytes()).decode()}
        except (RecipeError, RenderingError) as error:
            answer = {"error": str(error)}
        print(json.dumps(answer), flush=True)


def _started(count: int) -> list[subprocess.Popen]:
    """Return so many children, those of the last picture where they still listen."""
    for one in [one for one in _children if one.poll() is not None]:
        _children.remove(one)
        _close(one)
    while len(_children) < count:
        _children.append(start_child([], __name__, threads=1))
    return _children[:count]


def _close(child: subprocess.Popen) -> None:
    """Close what an ended child spoke through."""
    with child:
        pass


def _asked(child: subprocess.Popen, question: dict[str, Any]) -> dict[str, Any]:
    """Return a child's answer; RenderingError where it has an error, or none at all."""
    assert child.stdout is not None
    answer = child.stdout.readline() if send(child, json.dumps(question)) else ""
    if not answer:
        words = child.communicate()[1].strip().splitlines()
        raise RenderingError(f"a process of the tracer ended: {words[-1] if words else 'it said nothing'}")
    told = json.loads(answer)
    if "error" in told:
        raise RenderingError(told["error"])
    return told


@atexit.register
def stop_processes() -> None:
    """End the processes that wait for another scene."""
    stop_all(_children, _GRACE)
    while _children:
        _close(_children.pop())


if __name__ == "__main__":
    main()
