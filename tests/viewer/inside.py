"""Run with a DISPLAY: what only the inside of a window can be asked. Prints one JSON object."""

from __future__ import annotations

import json
import time
from pathlib import Path
from statistics import median
from typing import Any

import glfw

from reparam.gpu.context import create_for_window
from reparam.gpu.painter import Painter
from reparam.scenes.layers import Handles
from reparam.subject import open_subject
from reparam.viewer.hand import Grip
from reparam.viewer.window import Viewer, open_window

EVENTS_A_SECOND = 1000  # of a good mouse
FRAMES_A_SECOND = 60
WIDTH, HEIGHT = 640, 480


class Inside:
    """A viewer whose events are made here."""

    def __init__(self, name: str) -> None:
        self.window = open_window((WIDTH, HEIGHT), "inside")
        painter = Painter(create_for_window())
        self.viewer: Any = Viewer(self.window, painter, open_subject(name), None)
        self.state = self.viewer.state
        self.turn()

    def turn(self) -> None:
        """One turn of the main loop."""
        glfw.poll_events()
        self.viewer._tick()
        self.viewer._guard(self.viewer.keeping.follow_loading)
        self.viewer._guard(self.viewer._mouse.settle)
        self.viewer._draw_changes()

    def drop(self, path: Path) -> str:
        """Drop a file as GLFW tells it; the notice when it is opened."""
        self.state.notice = ""
        self.viewer._on_drop(self.window, [str(path)])
        until = time.monotonic() + 20.0
        while not self.state.notice and time.monotonic() < until:
            self.turn()
            time.sleep(0.005)
        self.turn()
        return str(self.state.notice)

    def drop_all(self) -> dict[str, Any]:
        """Good files and bad ones, and the scene after each."""
        folder = Path.cwd()
        (folder / "bad.bv").write_text("4 1\n0 0 zero\n")
        (folder / "bad.json").write_text('{"reparam": 1,\n "scene": "fgi5"}')
        (folder / "bad.png").write_text("no picture")
        (folder / "notes.txt").write_text("hello\n")
        (folder / "good.bv").write_text("4 1\n0 0 0\n0 1 0\n1 0 0\n1 1 0\n")
        (folder / "good.json").write_text('{"reparam": 1, "scene": "fig4"}')
        good = Path(__file__).parents[2] / "textures" / "checkerboard.png"
        found = {}
        for path in (folder / "bad.bv", folder / "bad.json", folder / "bad.png",
                     folder / "notes.txt", folder / "none.bv", good, folder / "good.bv",
                     folder / "good.json", good):  # fmt: skip
            notice = self.drop(path)
            name = self.state.subject.scene.name
            found[f"{len(found)} {path.name}"] = [notice, name, self.viewer._ctx.error]
        return found

    def shrink_to_nothing(self) -> list[bool]:
        """A framebuffer of 0 x 0, as while iconified, and back: whether a frame was drawn."""
        real = glfw.get_framebuffer_size
        drawn = []
        for size in ((0, 0), (320, 0), None):
            glfw.get_framebuffer_size = real if size is None else lambda _, size=size: size
            self.state.changed = True
            drawn.append(self.viewer._draw_changes())
        return drawn

    def cost_of_a_drag(self) -> dict[str, float]:
        """CPU seconds of a second of dragging, drawing apart, and of one frame drawn."""
        hand, mouse = self.viewer._mouse.hand, self.viewer._mouse
        layers = hand.panels[0].space.layers
        number = next(i for i, layer in enumerate(layers) if isinstance(layer, Handles))
        x, y = (float(c) for c in hand.place(Grip("physical", number, 4)))
        mouse._on_move(self.window, x, HEIGHT - y)
        mouse._on_button(self.window, glfw.MOUSE_BUTTON_LEFT, glfw.PRESS, 0)
        assert hand.held
        before, frames, start = 0.0, [], self.state.subject
        for frame in range(FRAMES_A_SECOND):
            begun = time.process_time()
            for event in range(EVENTS_A_SECOND // FRAMES_A_SECOND + 1):
                way = 40.0 * (frame + event / 20.0) / FRAMES_A_SECOND
                mouse._on_move(self.window, x + way, HEIGHT - y + way)
            mouse.settle()
            hand.steady()
            drawing = time.process_time()
            self.viewer._draw_changes()
            self.viewer._ctx.finish()
            before += drawing - begun
            frames.append(time.process_time() - drawing)
        mouse._on_button(self.window, glfw.MOUSE_BUTTON_LEFT, glfw.RELEASE, 0)
        assert self.state.subject is not start
        return {"above": before, "frame": median(frames)}


if __name__ == "__main__":
    inside = Inside("fig5")
    report: dict[str, Any] = {"shrunk": inside.shrink_to_nothing()}
    report["drag"] = inside.cost_of_a_drag()
    report["dropped"] = inside.drop_all()
    glfw.terminate()
    print("REPORT " + json.dumps(report))
