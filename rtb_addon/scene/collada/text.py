"""The bytes of a Collada file made into UTF-8 that a parser takes, and what had to be changed for it."""

from __future__ import annotations

import codecs
import re
from pathlib import Path

from ...errors import RecipeError

_DECLARED = re.compile(rb"""^\s*<\?xml[^>]*?encoding\s*=\s*["']([\w.-]+)["'][^>]*\?>""")
# Those in which "<!" is what it is in ASCII.
_ENCODINGS = {"utf-8", "ascii", "iso8859-1", "iso8859-15", "cp1252"}
# Characters that XML forbids and some exporters write.
_ILLEGAL = bytes(code for code in range(32) if code not in b"\t\n\r")


def utf8(data: bytes, file: str | Path) -> tuple[bytes, list[str]]:
    """Return a document in UTF-8, and a sentence for each thing that was changed; refuse a document type."""
    text, changes = _decoded(data, file)
    # Entities in attributes are expanded even where a parser resolves none, so none get that far.
    if b"<!DOCTYPE" in text or b"<!ENTITY" in text:
        raise RecipeError("a parent scene may declare no document type and no entities", file)
    legal = text.translate(None, _ILLEGAL)
    if len(legal) < len(text):
        changes.append(f"{len(text) - len(legal)} characters that XML forbids were left out")
    return legal, changes


def _decoded(data: bytes, file: str | Path) -> tuple[bytes, list[str]]:
    declared = _DECLARED.match(data.removeprefix(codecs.BOM_UTF8))
    name = declared[1].decode() if declared else "utf-8"
    wide = data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE))
    try:
        codec = "utf-16" if wide else codecs.lookup(name).name
        if not wide and codec not in _ENCODINGS:
            raise LookupError
        text = data.decode(codec)
        return data if codec == "utf-8" else text.encode(), []
    except LookupError:
        raise RecipeError(f"its encoding is {name}, save it as UTF-8", file) from None
    except UnicodeError as error:
        if wide or codec != "utf-8":
            raise RecipeError(f"its text is not {name}: {error}", file) from error
    return data.decode("latin-1").encode(), ["its text is not the UTF-8 that it says, it was read as Latin-1"]
