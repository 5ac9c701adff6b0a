"""How far the batch is, drawn alike wherever it is shown."""

import bpy

from ..operators import child_verb, running
from ..operators.cancel_rendering import RTB_OT_cancel_rendering

VERBS = {"check": "Checking…", "compare": "Comparing…", "pack": "Packing…"}
MOST = 4  # conditions under way that have a bar of their own


def draw_progress(layout, batch) -> None:
    """Draw a bar with what is done and what is left, and a button that stops."""
    row = layout.row(align=True)
    row.progress(factor=batch.progress, type="BAR", text=progress_text(batch))
    row.operator(RTB_OT_cancel_rendering.bl_idname, text="", icon="CANCEL")


def draw_under_way(layout, batch) -> None:
    """Draw a thin bar for each condition that is being rendered, the first few of them."""
    column = layout.column(align=True)
    column.scale_y = 0.7
    for name, fraction in list(batch.under_way.items())[:MOST]:
        column.progress(factor=fraction, type="BAR", text=name)


def draw_verbs(layout) -> None:
    """Draw what else is being done, and has no bar."""
    for each in child_verb.under_way:
        if each.verb in VERBS:
            layout.label(text=VERBS[each.verb], icon="SORTTIME")


def progress_text(batch) -> str:
    """Return for instance ``3/24 · 0:14 left``."""
    if batch.cancelled:
        return "Stopping…"
    if not batch.total:
        return "Starting…"
    return f"{batch.finished}/{batch.total}{time_left(batch.remaining)}"


def time_left(seconds: float | None) -> str:
    """Return a time [s] in words, empty when nobody knows it yet."""
    if seconds is None:
        return ""
    minutes, seconds = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f" · {hours}:{minutes:02}:{seconds:02} left" if hours else f" · {minutes}:{seconds:02} left"


def draw_in_status_bar(header, context):
    """Draw the batch that runs, as Blender draws its own jobs."""
    if running.batch is not None:
        row = header.layout.row()
        row.label(text="Render Recipe")
        draw_progress(row, running.batch)


def register() -> None:
    """Show batches in the status bar."""
    bpy.types.STATUSBAR_HT_header.append(draw_in_status_bar)


def unregister() -> None:
    """Leave the status bar as it was."""
    bpy.types.STATUSBAR_HT_header.remove(draw_in_status_bar)
