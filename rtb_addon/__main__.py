"""The command line: ``python -m rtb_addon VERB``; --help says the rest."""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Sequence
from pathlib import Path

from .background import start_early, stop_early
from .errors import RecipeError, RenderingError

WRONG, CANCELLED = 2, 130


def main(arguments: Sequence[str] | None = None) -> int:
    """Do what the arguments say and return the exit status: 0 done, 1 partly, 2 wrong, 130 cancelled."""
    said = command_parser().parse_args(arguments)
    if said.verb == "render" and _has_work(said):
        expected = [] if said.renderer else [str(said.folder.absolute())]
        start_early(expected, "rtb_addon.worker", said.threads)
    try:
        # Only now: what a verb needs takes a while to import, and a first worker imports it meanwhile.
        from . import command_line

        return getattr(command_line, said.verb)(said)
    except RecipeError as error:
        return _end(str(error), WRONG)
    except RenderingError as error:
        return _end(str(error), 1)
    except OSError as error:  # a full disk, a folder that went away
        return _end(f"{error.filename or 'system'}: {error.strerror or error}", 1)
    except KeyboardInterrupt:
        return CANCELLED
    finally:
        stop_early()


def _has_work(said: argparse.Namespace) -> bool:
    """Return whether a batch is sure to need a worker of ours, as far as one look can tell."""
    new = said.fresh or not (said.folder / "renderings").is_dir()
    return new and said.scheduler is None and (said.folder / "recipe.json").is_file()


def _end(sentence: str, status: int) -> int:
    print(sentence, file=sys.stderr)
    return status


def command_parser(program: str = "python -m rtb_addon") -> argparse.ArgumentParser:
    """Return what understands the command line, and what its help calls the program."""
    parser = argparse.ArgumentParser(
        prog=program, description="Families of physically based, multispectral renderings."
    )
    verb = parser.add_subparsers(required=True, metavar="VERB", title="verbs")
    _add_render(verb.add_parser("render", help="render every condition of a recipe that is not done yet"))
    _add_check(verb.add_parser("check", help="say everything that is wrong with a recipe"))
    _add_import(verb.add_parser("import", help="make a recipe folder of RenderToolbox3's files"))
    _add_montage(verb.add_parser("montage", help="make one picture of all renderings"))
    _add_compare(verb.add_parser("compare", help="say how far two renderers' pictures lie apart"))
    _add_pack(verb.add_parser("pack", help="put a recipe and all files that it names into one zip"))
    _add_unpack(verb.add_parser("unpack", help="make a recipe's folder of such a zip"))
    renderers = verb.add_parser("renderers", help="say which renderers are installed, and why not")
    renderers.add_argument("--json", action="store_true", help="print a line of JSON for each")
    renderers.set_defaults(verb="renderers_installed")
    return parser


def _add_render(render: argparse.ArgumentParser) -> None:
    _add_folder(render)
    _add_conditions(render, "render")
    render.add_argument("--samples", type=_positive, metavar="N", help="paths per pixel")
    render.add_argument("--size", type=_size, metavar="WxH", help="size of the images in pixels")
    render.add_argument("--jobs", type=_positive, metavar="N", help="workers at once, else one a core")
    render.add_argument("--threads", type=_positive, metavar="N", default=1, help="threads of each worker")
    render.add_argument("--gpu", action="store_true", help="render on a graphics card")
    render.add_argument(
        "--scheduler", metavar="ADDRESS", help="a Dask cluster that renders, like tcp://host:8786"
    )
    render.add_argument("--fresh", action="store_true", help="render even what is done")
    _add_trust(render)
    render.add_argument("--json", action="store_true", help="print a line of JSON for each event")
    render.set_defaults(verb="render")


def _add_check(check: argparse.ArgumentParser) -> None:
    _add_folder(check)
    _add_trust(check)
    check.add_argument("--json", action="store_true", help="print a line of JSON for each finding")
    check.set_defaults(verb="check")


def _add_import(add: argparse.ArgumentParser) -> None:
    add.add_argument("parent", type=Path, metavar="PARENT.dae", help="the parent scene")
    add.add_argument("conditions", type=Path, nargs="?", metavar="CONDITIONS", help="the table")
    add.add_argument("mappings", type=Path, nargs="?", metavar="MAPPINGS", help="the mappings")
    add.add_argument("--output", type=Path, required=True, metavar="FOLDER", help="the recipe's new folder")
    add.add_argument(
        "--convention",
        choices=("si", "rtb3"),
        default="si",
        help="si: a point light's number is W sr-1 nm-1; rtb3: its total power, as it was",
    )
    add.add_argument(
        "--data",
        type=Path,
        nargs="+",
        action="extend",
        default=[],
        metavar="FOLDER",
        help="where to look for files that are not beside the others",
    )
    add.set_defaults(verb="import_files")


def _add_montage(montage: argparse.ArgumentParser) -> None:
    _add_folder(montage)
    montage.add_argument("--output", type=Path, metavar="FILE.png", help="else images/RENDERER/NAME.png")
    montage.set_defaults(verb="montage")


def _add_compare(compare: argparse.ArgumentParser) -> None:
    compare.add_argument("folder", type=Path, metavar="FOLDER", help="of the recipe")
    compare.add_argument(
        "--renderers", type=_two_names, required=True, metavar="A,B", help="A minus B is what is shown"
    )
    _add_conditions(compare, "compare")
    compare.add_argument("--json", action="store_true", help="print a line of JSON for each condition")
    compare.set_defaults(verb="compare")


def _add_pack(pack: argparse.ArgumentParser) -> None:
    pack.add_argument("folder", type=Path, metavar="FOLDER", help="of the recipe")
    pack.add_argument("file", type=Path, metavar="FILE.zip", help="the zip to write")
    pack.add_argument("--renderings", action="store_true", help="with what was rendered, else without")
    pack.set_defaults(verb="pack")


def _add_unpack(unpack: argparse.ArgumentParser) -> None:
    unpack.add_argument("file", type=Path, metavar="FILE.zip", help="which pack wrote")
    unpack.add_argument("folder", type=Path, metavar="FOLDER", help="the recipe's new folder")
    unpack.set_defaults(verb="unpack")


def _add_folder(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("folder", type=Path, metavar="FOLDER", help="of the recipe")
    parser.add_argument("--renderer", metavar="NAME", help="instead of the recipe's own")


def _add_conditions(parser: argparse.ArgumentParser, verb: str) -> None:
    what = f"names of those to {verb}, else all; one with a comma in it stands in quotes: '\"a, b\",c'"
    parser.add_argument("--conditions", type=_names, metavar="A,B", help=what)


def _add_trust(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--trust", action="store_true", help="run the recipe's own remodeler.py, which is code"
    )


def _names(text: str) -> list[str]:
    import csv  # not before there are any: help and errors do not wait for it

    return [name for row in csv.reader([text]) for name in row if name]


def _two_names(text: str) -> list[str]:
    names = [name.lower() for name in _names(text)]
    if len(names) != 2:
        raise argparse.ArgumentTypeError(f"{text} are no two renderers, want A,B")
    return names


def _positive(text: str) -> int:
    if not re.fullmatch(r"[0-9]+", text) or int(text) < 1:
        raise argparse.ArgumentTypeError(f"{text} is no whole number from 1")
    return int(text)


def _size(text: str) -> tuple[int, int]:
    width, _, height = text.partition("x")
    try:
        return _positive(width), _positive(height)
    except argparse.ArgumentTypeError as error:
        raise argparse.ArgumentTypeError(f"{text} is no size like 320x240") from error


if __name__ == "__main__":
    sys.exit(main())
