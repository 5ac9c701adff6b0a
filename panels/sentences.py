"""Sentences in panels, broken into lines that fit: Blender's labels do not wrap."""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Sequence
from typing import Any

import bpy

LETTER = 6.6  # mean width of a letter [pixels at scale 1]
MARGIN = 62  # what icon and borders take [pixels at scale 1]
BUTTON = 26  # what a button beside a sentence takes [pixels at scale 1]
MOST = 6  # sentences shown; the rest is a number


def draw_sentences(
    layout,
    sentences: Sequence[str],
    width: int,
    alert: bool = False,
    beside: Callable[[Any, str], None] | None = None,
) -> None:
    """
    Draw sentences in a box, red if something stopped.

    Parameters
    ----------
    width : of the region [pixels]
    beside : draws a button at the right of a sentence
    """
    if not sentences:
        return
    box = layout.box()
    box.alert = alert
    for sentence in sentences[:MOST]:
        row = box.row()
        draw_sentence(row, sentence, width - (BUTTON if beside else 0), "ERROR" if alert else "INFO")
        if beside is not None:
            beside(row, sentence)
    if len(sentences) > MOST:
        box.label(text=f"and {len(sentences) - MOST} more, see the folder's log.jsonl", icon="BLANK1")


def draw_sentence(layout, sentence: str, width: int, icon: str) -> None:
    """Draw one sentence on as many lines as it takes, an icon at the first."""
    scale = bpy.context.preferences.system.ui_scale or 1.0  # 0 where there is no window
    letters = max(int((width / scale - MARGIN) / LETTER), 12)
    column = layout.column(align=True)
    column.scale_y = 0.8
    for number, line in enumerate(textwrap.wrap(begun(sentence), letters)):
        column.label(text=line, icon="BLANK1" if number else icon)


def begun(sentence: str) -> str:
    """Return a sentence with a capital where it begins with a word, and not with a file's name."""
    first = sentence.split(maxsplit=1)[0] if sentence.strip() else ""
    return sentence[:1].upper() + sentence[1:] if first.isalpha() else sentence
