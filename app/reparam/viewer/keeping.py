"""What the window writes and opens: screenshots, saved scenes, commands, files dropped on it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import glfw

from ..errors import UsageError
from ..files.output import check_output, save_picture
from ..files.picture import is_picture, read_picture
from ..gpu.painter import Painter
from ..gpu.targets import Target
from ..saving import command, save
from ..subject import open_subject
from .loading import Loading
from .state import State

ATTACHED = "image"  # the parameter that a dropped picture goes to


class Keeping:
    """Actions with files, all in the current folder. `draw` draws what changed, into a target."""

    def __init__(
        self,
        window: Any,
        painter: Painter,
        state: State,
        draw: Callable[[], Target | None],
        paint: Callable[[Target], object],
    ) -> None:
        self._window = window
        self._painter = painter
        self._state = state
        self._draw = draw
        self._paint = paint
        self.loading: Loading | None = None

    def screenshot(self, times: int = 1) -> None:
        """The frame, without what the window adds, into the next free file of the folder.

        With more pixels if asked: `times` as many to each side. Raises ReparamError.
        """
        drawn = self._draw()  # what a key or the mouse did just now belongs to it
        if drawn is None:
            return
        path = check_output(self._free_path(".png"))
        target = drawn
        if times > 1:
            size = (times * drawn.size[0], times * drawn.size[1])
            samples = self._state.subject.display.samples
            target = Target(self._painter.ctx, size, samples, self._painter.capabilities)
        try:
            if target is not drawn:
                self._paint(target)
            save_picture(target.pixels(), path)
        finally:
            if target is not drawn:
                target.release()
        self._state.say(f"saved {path}")

    def ask_screenshot(self) -> None:
        """Ask how many times the window's size a screenshot shall have, and make it."""

        def accept(text: str) -> None:
            if not text.isdecimal() or int(text) < 1:
                raise UsageError(f"expected a whole number from 1, found {text!r}")
            self.screenshot(int(text))

        width, height = self._size()
        self._state.ask(f"screenshot, how many times {width} x {height}?", accept, "2")

    def save_scene(self) -> None:
        """Everything that the picture is made from, as a file that `reparam view` opens again."""
        path = self._free_path(".json")
        save(self._state.snapshot(), path)
        self._state.say(f"saved {path}")

    def copy_command(self) -> None:
        """The command line that draws this picture without a window, into the clipboard."""
        size = self._size()
        usual = self._painter.capabilities.evaluator(None)
        evaluator = self._state.evaluator if self._state.evaluator != usual else None
        text = command(self._state.snapshot(), size, evaluator, f"{self._stem()}.png")
        glfw.set_clipboard_string(self._window, text)
        self._state.say(f"copied: {text}", 6.0)

    def drop(self, paths: list[str]) -> None:
        """Files were dropped onto the window: pictures are attached, others opened.

        Raises ReparamError for a picture that cannot be read, and where none can be attached.
        """
        path = paths[-1]
        if not is_picture(Path(path)):
            self.loading = Loading(Path(path).name, lambda tell: open_subject(path, tell))
            return
        if ATTACHED not in self._state.subject.values:
            raise UsageError(f"{self._state.subject.title}: has no place for a picture")
        read_picture(Path(path))
        self._state.change({ATTACHED: path})
        self._state.say(f"{ATTACHED} = {path}")

    def follow_loading(self) -> None:
        """Show how far a file is, or what it holds. Raises what is wrong with it."""
        loading = self.loading
        if loading is None:
            return
        self._state.refresh = True
        if loading.done():
            self.loading = None
            self._state.open(loading.result())

    def give_up_loading(self) -> bool:
        """Stop opening a file; whether one was being opened."""
        if self.loading is None:
            return False
        self.loading.give_up()
        return True

    def _size(self) -> tuple[int, int]:
        """Of the picture, in pixels."""
        drawn = self._draw()
        return drawn.size if drawn else glfw.get_framebuffer_size(self._window)

    def _stem(self) -> str:
        subject = self._state.subject
        return f"reparam-{Path(subject.source).stem if subject.source else subject.scene.name}"

    def _free_path(self, ending: str) -> Path:
        number = 1
        while (path := Path.cwd() / f"{self._stem()}-{number:03}{ending}").exists():
            number += 1
        return path
