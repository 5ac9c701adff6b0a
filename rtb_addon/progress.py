"""A batch as a person at a terminal sees it."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING

from .background import Event
from .recipe.resources import listed

if TYPE_CHECKING:
    from tqdm import tqdm


class ProgressBar:
    """A bar of conditions with the time that is left; at the end, where things are."""

    def __enter__(self) -> ProgressBar:
        self._bar: tqdm | None = None
        self._fractions: dict[str, float] = {}
        self._failed: dict[str, list[str]] = {}
        self._counts: dict[str, int] = dict.fromkeys(("done", "cached", "failed"), 0)
        self._warnings: dict[str, None] = {}
        self._folders: dict[str, None] = {}
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._bar is not None:
            self._bar.close()

    def shown(self, events: Iterable[Event]) -> Iterator[Event]:
        """Show events while they pass."""
        for event in events:
            self._show(event)
            yield event

    def _show(self, event: Event) -> None:
        if event.kind in self._counts:
            self._count(event)
        elif event.condition:
            self._fractions[event.condition] = event.fraction
        self._warnings |= dict.fromkeys(event.warnings)
        self._bar = self._bar or _bar(event.total)
        if event.kind == "progress" and event.message:
            self._bar.write(f"{event.condition}: {event.message}", file=sys.stderr)
        reached = event.finished + sum(self._fractions.values())
        left = "" if event.remaining is None else f"{_clock(event.remaining)} left"
        self._bar.set_postfix_str(left, refresh=False)
        self._bar.update(reached - self._bar.n)
        if not event.condition and event.kind in {"finished", "cancelled"}:
            self._bar.close()
            self._sum_up(event)

    def _count(self, event: Event) -> None:
        self._counts[event.kind] += 1
        self._fractions.pop(event.condition, None)
        if event.kind == "failed":
            self._failed.setdefault(event.message, []).append(event.condition)
        else:
            self._folders[str(Path(event.file).parent)] = None

    def _sum_up(self, event: Event) -> None:
        for sentence in self._warnings:
            print(f"warning: {sentence}", file=sys.stderr)
        for sentence, names in self._failed.items():
            print(f"{sentence} ({listed(names)})", file=sys.stderr)
        done, cached, failed = self._counts.values()
        print(f"{done} rendered, {cached} found done, {failed} failed", end="")
        print(f", {event.total - event.finished} not begun or stopped" * (event.kind == "cancelled"))
        for folder in self._folders:
            print(f"radiance cubes: {folder}")
        if event.file:
            print(f"montage: {event.file}")


def _bar(total: int) -> tqdm:
    from tqdm import tqdm

    return tqdm(
        total=total,
        bar_format="{l_bar}{bar}| {n:.1f} of {total} conditions{postfix}",
        mininterval=0.1 if sys.stderr.isatty() else 5.0,
        file=sys.stderr,
    )


def _clock(seconds: float) -> str:
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02}:{rest:02}" if hours else f"{minutes}:{rest:02}"
