"""What the keys do to the stage. No window and no OpenGL in here."""

from __future__ import annotations

from ..compare import comparison_text, default_comparison
from ..geometry.camera import View
from ..scenes.cursor import Cursor, is_linked
from ..scenes.linked import can_link
from ..scenes.registry import scene_names
from ..scenes.shading import HALF_A_PIXEL
from ..subject import Subject, scene_subject
from .history import changed_names
from .stage import Stage

LEVELS = (1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128, 192, 256)
TOLERANCES = (0.125, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0)
FIELD_OF_VIEW = 40.0  # degrees, with key O
CHECKS = (2, 4, 8, 16, 32)
GLIDE_SECONDS = 0.7
BLEND_SECONDS = 3.0


class State(Stage):
    """A stage with the actions of the table of keys."""

    def __init__(self, subject: Subject, evaluators: tuple[str, ...], evaluator: str) -> None:
        super().__init__(subject)
        self.evaluators = evaluators
        self.evaluator = evaluator
        self.help = False

    def next_texture(self) -> None:
        """The next texture map."""
        if self._has("texture"):
            self._cycle("texture")

    def next_change(self) -> None:
        """The next change of variables."""
        if self._has("change"):
            self._cycle("change")

    def next_checks(self) -> None:
        """Checker squares twice as small, coming round."""
        if self._has("checks"):
            now = self.subject.value("checks")
            self._tell("checks", next((n for n in CHECKS if n > now), CHECKS[0]))

    def toggle_net(self) -> None:
        """The control net, on or off."""
        self._cycle("net")

    def next_shading(self) -> None:
        """Light, zebra lines, curvatures, kinds of patches, in turn."""
        self._cycle("shading")

    def toggle_wireframe(self) -> None:
        """The triangles' edges, on or off."""
        self._cycle("wireframe")

    def toggle_tolerance(self) -> None:
        """As finely as each patch needs in this view, or one level for all."""
        self._tell("tolerance", 0.0 if self.subject.value("tolerance") else HALF_A_PIXEL)

    def toggle_perspective(self) -> None:
        """What is spatial in perspective, or orthographic."""
        self._tell("perspective", 0.0 if self.subject.value("perspective") else FIELD_OF_VIEW)

    def change_level(self, direction: int) -> None:
        """The next finer or coarser tessellation level, or tolerance if that decides."""
        name = "tolerance" if self.subject.value("tolerance") else "level"
        now = self.subject.value(name)
        steps = LEVELS if name == "level" else TOLERANCES
        larger = next((n for n in steps if n > now), now)
        smaller = next((n for n in reversed(steps) if n < now), now)
        self._tell(name, larger if (direction > 0) == (name == "level") else smaller)

    def next_evaluator(self) -> None:
        """The other evaluator, if this OpenGL has it."""
        index = self.evaluators.index(self.evaluator)
        self.evaluator = self.evaluators[(index + 1) % len(self.evaluators)]
        alone = " (the only one here: tessellation needs OpenGL 4.0)"
        self.changed = True
        self.say(f"evaluator = {self.evaluator}{alone if len(self.evaluators) == 1 else ''}")

    def toggle_linked(self) -> None:
        """Domain and texture beside the picture, or not."""
        figure = self.subject.figure()
        if not can_link(figure):
            self.say(f"{self.subject.title}: has no patch whose domain could be shown")
        elif is_linked(figure) and not self.subject.display.linked:
            self.say(f"{self.subject.title}: its domain is there already")
        else:
            self._cycle("linked")

    def point(self, cursor: Cursor) -> None:
        """The cursor is here now, in all linked spaces."""
        if cursor != self.cursor:
            self.cursor = cursor
            self.changed = True

    def toggle_help(self) -> None:
        """The list of keys, on or off."""
        self.help = not self.help
        self.refresh = True

    def show_figure(self, number: int) -> None:
        """The note's figure of that number."""
        for name in scene_names():
            if name == f"fig{number}":
                self.visit(name)
                return
        self.say(f"there is no figure {number} here")

    def turn_page(self, direction: int) -> None:
        """The next or previous scene; a file that was opened is one of them."""
        names = self.pages()
        index = names.index(self.subject.scene.name)
        self.visit(names[(index + direction) % len(names)])

    def pages(self) -> list[str]:
        """The names of all scenes, and of the one that shows the opened file."""
        return [*scene_names(), *([self._opened.scene.name] if self._opened else [])]

    def reset(self) -> None:
        """The view as it was at first; if it is so already, the parameters."""
        self._motion = None
        if any(view != View() for view in self.views.values()):
            self.views = {}
            self.changed = True
            self.say("view reset")
            return
        here = self.subject
        self._replace(scene_subject(here.scene, here.data, here.title, here.source))
        self.say("parameters reset")

    def play(self) -> None:
        """Move the scene's parameter to and fro, or stop."""
        name = self.subject.scene.animates
        if self._motion is not None:
            moved, self._motion = self._motion[0], None
            self.say(f"{moved} = {self.subject.value(moved):.2f}")
        elif name is None or not self._has(name):
            self.say(f"{self.subject.title}: nothing here is animated")
        else:
            self._animate(name)

    def glide(self) -> None:
        """Morph to the other end."""
        if self._has("morph"):
            self._glide("morph", GLIDE_SECONDS)

    def toggle_comparison(self) -> None:
        """Two values of the scene's first parameter side by side, or one picture again."""
        if self.subject.display.compare:
            self.change({"compare": "", "divider": 0.5, "blend": 0.0})
            self.say("compare = none")
        else:
            self._compare(default_comparison(self.subject), 0.5)

    def compare_last_change(self) -> None:
        """The picture before the last change of the scene, and after it."""
        step = self._history.last
        text = ""
        if step is not None and step.after.subject.scene is self.subject.scene:
            before, after = step.before.subject, step.after.subject
            for name in changed_names(before, after):
                if name in self.subject.values and not text:
                    text = comparison_text(after, name, before.value(name), after.value(name))
        self._compare(text, 0.5)

    def blend(self) -> None:
        """Blend the left picture into the right one, or back; without a comparison all of it."""
        if not self.subject.display.compare:
            self._compare(default_comparison(self.subject), 1.0)
        if self.subject.display.compare:
            self._glide("blend", BLEND_SECONDS)

    def _compare(self, text: str, divider: float) -> None:
        if not text:
            self.say(f"{self.subject.title}: there is nothing to compare")
            return
        self.change({"compare": text, "divider": divider, "blend": 0.0})
        self.say(f"compare = {self.subject.shown('compare')}")

    def ask_for_parameter(self) -> None:
        """Ask for `name=value`, as the command line has it."""
        self.ask("set a parameter:  name = value", self.set_by_text)
