"""A real window on a virtual screen of its own, driven by xdotool as a hand would."""

from __future__ import annotations

import ctypes
import os
import struct
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from PIL import Image

SIZE = (320, 240)
SECONDS = 30.0
COMPLAINTS = ("Traceback", "OpenGL:", "Error", "expected no error")
SOFTPIPE_ERROR = 1  # of 255: its first picture of a texture differs so much from the second


def same_picture(one: np.ndarray, other: np.ndarray) -> bool:
    """Whether no pixel differs; on softpipe, none by more than it differs from itself."""
    if one.shape != other.shape:
        return False
    off = int(np.abs(one.astype(int) - other).max())
    return off <= SOFTPIPE_ERROR * (os.environ.get("GALLIUM_DRIVER") == "softpipe")


@dataclass(frozen=True)
class Screen:
    """An X server for this process alone: its DISPLAY, and the file that holds its pixels."""

    name: str
    pixels: Path

    def seen(self) -> np.ndarray:
        """What is on it now, (height, width, 3); the file is X's own dump (XWD)."""
        data = self.pixels.read_bytes()
        header = struct.unpack(">25I", data[:100])
        start, width, height = header[0] + 12 * header[19], header[4], header[5]
        rows = np.frombuffer(data, np.uint8, count=header[12] * height, offset=start)
        return rows.reshape(height, -1, 4)[:, :width, 2::-1].copy()


@contextmanager
def virtual_screen(dots_an_inch: int | None = None) -> Iterator[Screen]:
    """An X server of its own, 800 x 600; 192 dots an inch are a content scale of 2."""
    read, write = os.pipe()
    folder = tempfile.TemporaryDirectory()
    command = ["Xvfb", "-displayfd", str(write), "-screen", "0", "800x600x24", "-nolisten", "tcp"]
    command += ["-fbdir", folder.name, "-noreset"]  # it keeps what a program left on it
    server = subprocess.Popen(command, pass_fds=[write], stderr=subprocess.DEVNULL)
    os.close(write)
    with os.fdopen(read) as pipe:
        number = pipe.readline().strip()
    try:
        if dots_an_inch is not None:
            set_dots_an_inch(f":{number}", dots_an_inch)
        yield Screen(f":{number}", Path(folder.name) / "Xvfb_screen0")
    finally:
        server.terminate()
        server.wait()
        folder.cleanup()


def set_dots_an_inch(display: str, dots: int) -> None:
    """Leave the resource on the root window that a desktop of that density leaves there."""
    x11 = ctypes.CDLL("libX11.so.6")
    x11.XOpenDisplay.restype = ctypes.c_void_p
    x11.XDefaultRootWindow.restype = ctypes.c_ulong
    there = ctypes.c_void_p(x11.XOpenDisplay(display.encode()))
    root = ctypes.c_ulong(x11.XDefaultRootWindow(there))
    text, replace, resource_manager, string = f"Xft.dpi:\t{dots}\n".encode(), 0, 23, 31
    x11.XChangeProperty(there, root, resource_manager, string, 8, replace, text, len(text))
    x11.XCloseDisplay(there)


class Window:
    """`reparam view` in a folder of its own, driven by xdotool."""

    def __init__(self, screen: Screen, folder: Path, *words: str) -> None:
        self.folder = folder
        self._at = ("", "")  # of the mouse
        self.environment = {**os.environ, "DISPLAY": screen.name, "PYTHONUNBUFFERED": "1"}
        command = [sys.executable, "-m", "reparam", "view", "--size", "320x240", *words]
        app = Path(__file__).parents[2] / "app"
        self.environment["PYTHONPATH"] = str(app)
        self.log = folder / "log"
        with self.log.open("w") as log:
            self.process = subprocess.Popen(
                command, cwd=folder, env=self.environment, stdout=log, stderr=log
            )
        self.wait_for("H: all keys")
        self.id = self._window()

    def xdotool(self, *words: str) -> str:
        result = subprocess.run(
            ["xdotool", *words], env=self.environment, capture_output=True, text=True, check=False
        )
        ended = f"the viewer's exit code: {self.process.poll()}\n"
        assert result.returncode == 0, ended + result.stderr + self.log.read_text()[-5000:]
        return result.stdout

    def _window(self) -> str:
        """The id of this process's window; those of viewers before may still be on the screen."""
        own = ["--all", "--pid", str(self.process.pid), "--name", "^reparam"]
        found = subprocess.run(
            ["xdotool", "search", "--sync", *own],
            env=self.environment, capture_output=True, text=True, check=False, timeout=SECONDS,
        )  # fmt: skip
        return found.stdout.split()[0]

    def wait_for(self, text: str, times: int = 1) -> None:
        until = time.monotonic() + SECONDS
        while self.log.read_text().count(text) < times:
            assert time.monotonic() < until, f"no {text!r} in {self.log.read_text()!r}"
            assert self.process.poll() is None, self.log.read_text()
            time.sleep(0.02)

    def press(self, key: str, notice: str) -> None:
        times = self.log.read_text().count(notice) + 1
        self.xdotool_key(key)
        self.wait_for(notice, times)

    def xdotool_key(self, key: str) -> None:
        """Press and release a key, or several at once."""
        self.xdotool("key", "--window", self.id, key)

    def type_line(self, key: str, text: str, notice: str) -> None:
        """A key that asks for a line of text, the text, Enter; wait for a notice."""
        times = self.log.read_text().count(notice) + 1
        self.xdotool_key(key)
        if text:
            self.xdotool("type", "--window", self.id, text)
        self.xdotool_key("Return")
        self.wait_for(notice, times)

    def drag(self, start: tuple[float, float], way: tuple[float, float], notice: str = "") -> None:
        """Press at `start` (pixels, y down), move by `way` in steps, let go; wait for a notice."""
        times = self.log.read_text().count(notice) + 1 if notice else 0
        self.point(start)
        self.xdotool("mousedown", "1")
        for part in (0.25, 0.5, 0.75, 1.0):
            self.point((start[0] + part * way[0], start[1] + part * way[1]))
        self.xdotool("mouseup", "1")
        self.wait_for(notice, times)

    def point(self, to: tuple[float, float]) -> None:
        """The mouse to a place in the window, in pixels, y down."""
        x, y = (str(round(c)) for c in to)
        if (x, y) != self._at:  # xdotool would wait long for what does not move
            self.xdotool("mousemove", "--window", self.id, "--sync", x, y)
            self._at = (x, y)

    def click(self, at: tuple[float, float], notice: str) -> None:
        """The left button on a place; wait for a notice, if one is to come."""
        times = self.log.read_text().count(notice) + 1
        self.point(at)
        self.xdotool("click", "1")
        if notice:
            self.wait_for(notice, times)

    def screenshot(self) -> np.ndarray:
        self.press("s", "saved ")
        return self.last_picture()

    def last_picture(self) -> np.ndarray:
        """The picture saved last."""
        path = self.log.read_text().rsplit("saved ", 1)[1].splitlines()[0]
        return np.asarray(Image.open(path))

    def close(self) -> int:
        """Escape. The window is gone before the key is released, of which xdotool complains."""
        command = ["xdotool", "key", "--window", self.id, "Escape"]
        subprocess.run(command, env=self.environment, capture_output=True, check=False)
        return self.process.wait(SECONDS)


def assert_no_complaint(window: Window) -> None:
    text = window.log.read_text()
    assert not [word for word in COMPLAINTS if word in text], text[-3000:]
