"""A real window under Xvfb: keys change the picture as they should, Escape closes it."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from reparam.snapshot import Studio
from reparam.subject import open_subject

SIZE = (320, 240)
SECONDS = 30.0


@pytest.fixture(scope="module")
def display() -> Iterator[str]:
    """A virtual screen of its own."""
    read, write = os.pipe()
    command = ["Xvfb", "-displayfd", str(write), "-screen", "0", "800x600x24", "-nolisten", "tcp"]
    server = subprocess.Popen(command, pass_fds=[write], stderr=subprocess.DEVNULL)
    os.close(write)
    with os.fdopen(read) as pipe:
        number = pipe.readline().strip()
    yield f":{number}"
    server.terminate()
    server.wait()


class Window:
    """`reparam view` in a folder of its own, driven by xdotool."""

    def __init__(self, display: str, folder: Path) -> None:
        self.folder = folder
        self._environment = {**os.environ, "DISPLAY": display, "PYTHONUNBUFFERED": "1"}
        command = [sys.executable, "-m", "reparam", "view", "--size", "320x240"]
        app = Path(__file__).parents[2] / "app"
        self._environment["PYTHONPATH"] = str(app)
        self.log = folder / "log"
        with self.log.open("w") as log:
            self.process = subprocess.Popen(
                command, cwd=folder, env=self._environment, stdout=log, stderr=log
            )
        self.wait_for("H: all keys")
        self._id = self._xdotool("search", "--sync", "--name", "reparam").split()[-1]

    def _xdotool(self, *words: str) -> str:
        result = subprocess.run(
            ["xdotool", *words], env=self._environment, capture_output=True, text=True, check=True
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
        self._xdotool("key", "--window", self._id, key)
        self.wait_for(notice, times)

    def screenshot(self) -> np.ndarray:
        self.press("s", "saved ")
        path = self.log.read_text().rsplit("saved ", 1)[1].splitlines()[0]
        return np.asarray(Image.open(path))

    def close(self) -> int:
        """Escape. The window is gone before the key is released, of which xdotool complains."""
        command = ["xdotool", "key", "--window", self._id, "Escape"]
        subprocess.run(command, env=self._environment, capture_output=True, check=False)
        return self.process.wait(SECONDS)


def test_keys_change_the_picture_as_the_command_line_does(
    display: str, tmp_path: Path, studio: Studio
) -> None:
    window = Window(display, tmp_path)
    subject = open_subject("fig5")
    try:
        assert np.array_equal(window.screenshot(), studio.draw(subject, SIZE))
        for key, name, value in (
            ("t", "texture", "r"),
            ("c", "checks", 16),
            ("n", "net", True),
            ("w", "wireframe", True),
            ("minus", "level", 24),
        ):
            shown = "on" if value is True else value
            window.press(key, f"{name} = {shown}")
            subject = subject.changed(name, value)
            assert np.array_equal(window.screenshot(), studio.draw(subject, SIZE)), name
        window.press("F5", "shaders reloaded")
        window.press("4", "fig4: ")
        assert window.close() == 0
    finally:
        window.process.kill()
