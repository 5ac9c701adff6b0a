"""The user's own spectra: the folders that they lie in, and what is typed, heard with them."""

from __future__ import annotations

from pathlib import Path

import bpy

from .folders import blend_folder

EXTENSION = (__package__ or "").partition(".rtb_addon")[0]  # the name under which Blender has enabled us


def own_folders() -> list[Path]:
    """Return the folders of the user's own spectra that are there, the one of imported spectra first."""
    addon = bpy.context.preferences.addons.get(EXTENSION)
    further = [] if addon is None else [each.path for each in addon.preferences.spectra_folders]
    chosen = [Path(bpy.path.abspath(each)) for each in (_preferred(), *further) if each]
    return [each for each in (*chosen, *_kept()) if each.is_dir()]


def folder_for_imports() -> Path:
    """Return the folder that imported spectra are kept in: the preferred one, else Blender's for us."""
    if chosen := _preferred():
        return Path(bpy.path.abspath(chosen))
    return Path(bpy.utils.extension_path_user(EXTENSION, path="spectra", create=True))


def _preferred() -> str:
    addon = bpy.context.preferences.addons.get(EXTENSION)
    return "" if addon is None else addon.preferences.spectra


def heard(text: str, unit=None):
    """Return the spectrum that somebody has typed into this file."""
    # numpy takes longer to come than all else that enabling the extension waits for.
    from ..spectra import Unit
    from ..spectra.spoken import spectrum_from

    return spectrum_from(text, unit or Unit.RATIO, blend_folder(), own_folders())


def _kept() -> list[Path]:
    try:
        return [Path(bpy.utils.extension_path_user(EXTENSION, path="spectra"))]
    except ValueError:  # imported by itself, and not enabled as an extension
        return []
