"""A real window on a virtual screen of its own, driven by xdotool as a hand would."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
from PIL import Image

SIZE = (320, 240)
SECONDS = 30.0


@contextmanager
def virtual_screen() -> Iterator[str]:
    """An X server for this process alone: its DISPLAY."""
    read, write = os.pipe()
    command = ["Xvfb", "-displayfd", str(write), "-screen", "0", "800x600x24", "-nolisten", "tcp"]
    server = subprocess.Popen(command, pass_fds=[write], stderr=subprocess.DEVNULL)
    os.close(write)
    with os.fdopen(read) as pipe:
        number = pipe.readline().strip()
    try:
        yield f":{number}"
    finally:
        server.terminate()
        server.wait()


class Window:
    """`reparam view` in a folder of its own, driven by xdotool."""

    def __init__(self, display: str, folder: Path, *words: str) -> None:
        self.folder = folder
        self.environment = {**os.environ, "DISPLAY": display, "PYTHONUNBUFFERED": "1"}
        command = [sys.executable, "-m", "reparam", "view", "--size", "320x240", *words]
        app = Path(__file__).parents[2] / "app"
        self.environment["PYTHONPATH"] = str(app)
        self.log = folder / "log"
        with self.log.open("w") as log:
            self.process = subprocess.Popen(
                command, cwd=folder, env=self.environment, stdout=log, stderr=log
            )
        self.wait_for("H: all keys")
        self._id = self.xdotool("search", "--sync", "--name", "reparam").split()[-1]

    def xdotool(self, *words: str) -> str:
        result = subprocess.run(
            ["xdotool", *words], env=self.environment, capture_output=True, text=True, check=True
        )
        return result.stdout

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
        self.xdotool("key", "--window", self._id, key)

    def type_line(self, key: str, text: str, notice: str) -> None:
        """A key that asks for a line of text, the text, Enter; wait for a notice."""
        times = self.log.read_text().count(notice) + 1
        self.xdotool_key(key)
        if text:
            self.xdotool("type", "--window", self._id, text)
        self.xdotool_key("Return")
        self.wait_for(notice, times)

    def drag(self, start: tuple[float, float], way: tuple[float, float], notice: str) -> None:
        """Press at `start` (pixels, y down), move by `way` in steps, let go; wait for a notice."""
        times = self.log.read_text().count(notice) + 1
        self.point(start)
        self.xdotool("mousedown", "1")
        for part in (0.25, 0.5, 0.75, 1.0):
            self.point((start[0] + part * way[0], start[1] + part * way[1]))
        self.xdotool("mouseup", "1")
        self.wait_for(notice, times)

    def point(self, to: tuple[float, float]) -> None:
        """The mouse to a place in the window, in pixels, y down."""
        x, y = (str(round(c)) for c in to)
        self.xdotool("mousemove", "--window", self._id, "--sync", x, y)

    def screenshot(self) -> np.ndarray:
        self.press("s", "saved ")
        return self.last_picture()

    def last_picture(self) -> np.ndarray:
        """The picture saved last."""
        path = self.log.read_text().rsplit("saved ", 1)[1].splitlines()[0]
        return np.asarray(Image.open(path))

    def close(self) -> int:
        """Escape. The window is gone before the key is released, of which xdotool complains."""
        command = ["xdotool", "key", "--window", self._id, "Escape"]
        subprocess.run(command, env=self.environment, capture_output=True, check=False)
        return self.process.wait(SECONDS)
