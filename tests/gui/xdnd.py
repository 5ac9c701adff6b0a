"""
Drop files on Blender's window as a file manager does, by X's protocol: python xdnd.py X Y FILE...

X and Y are places in the window, from its upper left corner [pixels]. Blender stands still while something is
dragged over it, so this is a process of its own. It prints "taken" once Blender has what was dropped.
"""

from __future__ import annotations

import ctypes
import sys
import time
from ctypes import POINTER, Structure, Union, byref, c_char_p, c_int, c_long, c_uint, c_ulong, c_void_p
from pathlib import Path

PATIENCE = 10.0  # [s]
VERSION = 5  # of the protocol
CLIENT_MESSAGE, SELECTION_REQUEST, SELECTION_NOTIFY = 33, 30, 31

x11 = ctypes.CDLL("libX11.so.6")
x11.XOpenDisplay.restype = c_void_p
for name in ("XInternAtom", "XDefaultRootWindow", "XCreateSimpleWindow"):
    getattr(x11, name).restype = c_ulong


class Message(Structure):
    """XClientMessageEvent."""

    _fields_ = [
        *(("type", c_int), ("serial", c_ulong), ("send_event", c_int), ("display", c_void_p)),
        *(("window", c_ulong), ("message_type", c_ulong), ("format", c_int), ("words", c_long * 5)),
    ]


class Request(Structure):
    """XSelectionRequestEvent."""

    _fields_ = [
        *(("type", c_int), ("serial", c_ulong), ("send_event", c_int), ("display", c_void_p)),
        *(("owner", c_ulong), ("requestor", c_ulong), ("selection", c_ulong), ("target", c_ulong)),
        *(("property", c_ulong), ("time", c_ulong)),
    ]


class Answer(Structure):
    """XSelectionEvent."""

    _fields_ = [each for each in Request._fields_ if each[0] != "owner"]


class Event(Union):
    """XEvent."""

    _fields_ = [
        *(("type", c_int), ("message", Message), ("request", Request), ("answer", Answer)),
        ("room", c_long * 24),
    ]


class Source:
    """Something that is dragged from: a window that nobody sees, with a list of files."""

    def __init__(self, files: list[Path]) -> None:
        self.display = c_void_p(x11.XOpenDisplay(None))
        self.root = x11.XDefaultRootWindow(self.display)
        self.window = self.made_window()
        self.target = next(filter(self.is_aware, self.below(self.root)))
        self.text = "".join(f"{file.resolve().as_uri()}\r\n" for file in files).encode()

    def atom(self, name: str) -> int:
        return x11.XInternAtom(self.display, name.encode(), 0)

    def made_window(self) -> int:
        sides = (c_int(0), c_int(0), c_uint(1), c_uint(1), c_uint(0), c_ulong(0), c_ulong(0))
        return x11.XCreateSimpleWindow(self.display, c_ulong(self.root), *sides)

    def below(self, window: int):
        """Yield a window and all windows within it."""
        yield window
        root, parent, count = c_ulong(), c_ulong(), c_uint()
        children = POINTER(c_ulong)()
        x11.XQueryTree(
            *(self.display, c_ulong(window), byref(root), byref(parent)), byref(children), byref(count)
        )
        for number in range(count.value):
            yield from self.below(children[number])

    def is_aware(self, window: int) -> bool:
        """Whether things may be dropped on a window."""
        kind, width, count, left, found = c_ulong(), c_int(), c_ulong(), c_ulong(), c_void_p()
        asked = (c_ulong(self.atom("XdndAware")), c_long(0), c_long(1), c_int(0), c_ulong(0))
        answers = (byref(each) for each in (kind, width, count, left, found))
        x11.XGetWindowProperty(self.display, c_ulong(window), *asked, *answers)
        return count.value > 0

    def tell(self, kind: str, *words: int) -> None:
        """Send the target a message."""
        event = Event()
        message = event.message
        message.type, message.window, message.format = CLIENT_MESSAGE, self.target, 32
        message.message_type = self.atom(kind)
        message.words[:] = [self.window, *words, *[0] * (4 - len(words))]
        self.send(self.target, event)

    def send(self, window: int, event: Event) -> None:
        x11.XSendEvent(self.display, c_ulong(window), c_int(0), c_long(0), byref(event))
        x11.XFlush(self.display)

    def drag_to(self, x: int, y: int) -> None:
        """Come in over the target, with the pointer where Blender looks for it."""
        selection = c_ulong(self.atom("XdndSelection"))
        x11.XSetSelectionOwner(self.display, selection, c_ulong(self.window), c_ulong(0))
        place = (c_ulong(0), c_ulong(self.root), c_int(0), c_int(0), c_uint(0), c_uint(0), c_int(x), c_int(y))
        x11.XWarpPointer(self.display, *place)
        self.tell("XdndEnter", VERSION << 24, self.atom("text/uri-list"))
        self.tell("XdndPosition", 0, x << 16 | y, 0, self.atom("XdndActionCopy"))

    def hand_over(self, request: Request) -> None:
        """Give the target what it asks for."""
        put = (c_ulong(request.requestor), c_ulong(request.property), c_ulong(request.target))
        replaced = (c_int(8), c_int(0), c_char_p(self.text), c_int(len(self.text)))
        x11.XChangeProperty(self.display, *put, *replaced)
        event = Event()
        answer = event.answer
        answer.type = SELECTION_NOTIFY
        for name in ("requestor", "selection", "target", "property", "time"):
            setattr(answer, name, getattr(request, name))
        self.send(request.requestor, event)

    def drop(self) -> bool:
        """Let go once the target agrees; return whether it took the files."""
        until = time.monotonic() + PATIENCE
        while time.monotonic() < until:
            if not x11.XPending(self.display):
                time.sleep(0.01)
                continue
            event = Event()
            x11.XNextEvent(self.display, byref(event))
            if event.type == SELECTION_REQUEST:
                self.hand_over(event.request)
            elif event.type == CLIENT_MESSAGE and event.message.message_type == self.atom("XdndStatus"):
                self.tell("XdndDrop")
            elif event.type == CLIENT_MESSAGE and event.message.message_type == self.atom("XdndFinished"):
                return True
        return False


if __name__ == "__main__":
    across, down, *names = sys.argv[1:]
    source = Source([Path(each) for each in names])
    source.drag_to(int(across), int(down))
    print("taken" if source.drop() else "left", flush=True)
