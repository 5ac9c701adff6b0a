"""What a zip may hold, a recipe's or a scene's: plain files in one folder, of a size that somebody meant."""

from __future__ import annotations

import re
import stat
import unicodedata
import zipfile
from collections.abc import Iterator, Sequence
from itertools import pairwise
from zipfile import ZipInfo

MOST_FILES = 20_000
MOST_RATIO = 100  # of the files' bytes to the archive's
MOST_BYTES = 64 << 30
_SMALL = 1 << 20  # [bytes] that may come out of an archive of any size
_MOST_LETTERS, _MOST_FOLDERS = 180, 16
_FORBIDDEN = re.compile(r'[\x00-\x1f\x7f\\:*?"<>|]')
_RESERVED = re.compile(r"(con|prn|aux|nul|conin\$|conout\$|(com|lpt)[0-9¹²³])(\.|$)", re.IGNORECASE)
_ENCRYPTED = 0x1


def wrongs(size: int, members: Sequence[ZipInfo], most_bytes: int | None = None) -> Iterator[str]:
    """
    Yield a sentence for everything about an archive that is not as it should be.

    Parameters
    ----------
    size : of the archive [bytes]
    most_bytes : that may come out of it; None: of a recipe
    """
    if len(members) > MOST_FILES:
        yield f"it holds {len(members)} files, {MOST_FILES} at most can be unpacked"
    for member in members:
        if wrong := _wrong_name(member) or _wrong_kind(member):
            yield f"{member.orig_filename[:80]!r} {wrong}"
    yield from _clashes(members)
    yield from _overlaps(members)
    total, most_bytes = sum(member.file_size for member in members), most_bytes or MOST_BYTES
    if total > min(most_bytes, max(_SMALL, MOST_RATIO * size)):
        most = f"{MOST_RATIO} times its size and {most_bytes >> 30} GiB are the most"
        yield f"{size} bytes would unpack to {total}, {most}"


def _wrong_name(member: ZipInfo) -> str:
    name = member.orig_filename
    parts = name.removesuffix("/").split("/")
    if name.startswith("/") or _FORBIDDEN.search(name):
        return "is no relative name with / between folders that every system can write"
    if ".." in parts:
        return "leads out of the folder that it is unpacked into"
    if len(parts) > _MOST_FOLDERS or any(len(part.encode()) > _MOST_LETTERS for part in parts):
        return f"is too long, {_MOST_FOLDERS} folders and {_MOST_LETTERS} letters are the most"
    if any(not part.strip(".") or part[-1] in " ." or _RESERVED.match(part) for part in parts):
        return "is a name that some systems keep for themselves"
    return ""


def _wrong_kind(member: ZipInfo) -> str:
    kind = stat.S_IFMT(member.external_attr >> 16)
    if kind not in (0, stat.S_IFDIR if member.is_dir() else stat.S_IFREG):
        return "is a link or a device, only plain files can be unpacked"
    if member.flag_bits & _ENCRYPTED:
        return "is encrypted, pack it without a password"
    if member.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
        return "is compressed in a way that not every zip program knows, pack it with deflate"
    return ""


def _clashes(members: Sequence[ZipInfo]) -> Iterator[str]:
    """Yield where two names are one file on some system, or one is a file and a folder at once."""
    files: dict[str, str] = {}
    for member in members:
        if not member.is_dir() and (other := files.get(name := _folded(member.filename))) is not None:
            yield f"{other!r} and {member.filename!r} are one file on some systems"
        elif not member.is_dir():
            files[name] = member.filename
    for member in members:
        folders = _folded(member.filename).split("/")[:-1]
        above = ("/".join(folders[: count + 1]) for count in range(len(folders)))
        if (both := next((folder for folder in above if folder in files), None)) is not None:
            yield f"{files[both]!r} is a file and a folder at once"


def _folded(name: str) -> str:
    return unicodedata.normalize("NFC", unicodedata.normalize("NFC", name).casefold())


def _overlaps(members: Sequence[ZipInfo]) -> Iterator[str]:
    """Yield where bytes of the archive belong to two files, which is how small bombs are made."""
    header = 30
    ordered = sorted(members, key=lambda member: member.header_offset)
    for first, second in pairwise(ordered):
        if first.header_offset + header + first.compress_size > second.header_offset:
            yield f"{first.filename!r} and {second.filename!r} share bytes of the archive"
