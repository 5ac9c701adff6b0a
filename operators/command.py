"""``blender --command rtb VERB ...``: our command line, in a process of its own as all that renders."""

from __future__ import annotations

import bpy

PROGRAM = "blender --command rtb"

_commands: list = []


def run(arguments: list[str]) -> int:
    """Do what the arguments say and return the exit status."""
    # These bring much that enabling need not wait for.
    import signal

    from ..rtb_addon.__main__ import command_parser
    from ..rtb_addon.background import run_child

    try:
        command_parser(PROGRAM).parse_args(arguments)
    except SystemExit as ended:  # of --help, or of words that nobody knows
        return int(ended.code or 0)
    signal.signal(signal.SIGINT, signal.default_int_handler)  # Blender keeps Ctrl-C for its own renderings
    return run_child(arguments)


def register() -> None:
    """Let Blender's command line know ours."""
    _commands.append(bpy.utils.register_cli_command("rtb", run))


def unregister() -> None:
    """Take it back."""
    for each in _commands:
        bpy.utils.unregister_cli_command(each)
    _commands.clear()
