"""``blender --command rtb VERB ...``: our command line in Blender's own Python."""

from __future__ import annotations

import bpy

_commands: list = []


def run(arguments: list[str]) -> int:
    """Do what the arguments say and return the exit status."""
    from ..rtb_addon.__main__ import main  # brings much that enabling need not wait for

    try:
        return main(arguments)
    except SystemExit as ended:  # of --help, or of words that nobody knows
        return int(ended.code or 0)


def register() -> None:
    """Let Blender's command line know ours."""
    _commands.append(bpy.utils.register_cli_command("rtb", run))


def unregister() -> None:
    """Take it back."""
    for each in _commands:
        bpy.utils.unregister_cli_command(each)
    _commands.clear()
