"""What the window shows, and how keys and mouse change it. No window and no OpenGL in here."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from math import asin, inf, sin
from typing import Any

import numpy as np

from ..compare import comparison_text, default_comparison
from ..errors import ReparamError
from ..files.picture import find_picture, read_picture
from ..geometry.camera import View
from ..scenes.cursor import Cursor, is_linked
from ..scenes.linked import can_link
from ..scenes.registry import scene_names
from ..subject import Subject, open_subject, scene_subject
from .history import History, Moment

LEVELS = (1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128, 192, 256)
TOLERANCES = (0.125, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0)
HALF_A_PIXEL = 0.5
CHECKS = (2, 4, 8, 16, 32)
NOTICE_SECONDS = 2.5
ANIMATION_SECONDS = 3.0  # from one end to the other
GLIDE_SECONDS = 0.7
BLEND_SECONDS = 3.0


@dataclass
class Prompt:
    """A line of text that is asked for, and what it is for. `accept` raises what is wrong."""

    title: str
    text: str
    accept: Callable[[str], None]
    offered: bool  # the text is only proposed: typing begins a new one


Motion = Callable[[float], float | None]  # a value by the clock, None when it is over


class State:
    """A subject with its views.

    `changed` is set whenever the picture must be drawn again, `refresh` when only what the window
    shows over it is another.
    """

    def __init__(self, subject: Subject, evaluators: tuple[str, ...], evaluator: str) -> None:
        self.subject = subject
        self.evaluators = evaluators
        self.evaluator = evaluator
        self.views: dict[str, View] = dict(subject.views)
        self.cursor: Cursor | None = None  # where the mouse put it; not a step that is undone
        self.help = False
        self.changed = True
        self.refresh = False
        self.notice = ""
        self._notice_until = self._notice_seconds = 0.0
        self._now = 0.0
        self._motion: tuple[str, Motion] | None = None  # of the parameter of that name
        self._visited: dict[str, tuple[Subject, dict[str, View]]] = {}
        self._opened = subject if subject.data else None
        self.prompt: Prompt | None = None
        self._history = History()
        self._gesture: object = None

    def snapshot(self) -> Subject:
        """All that the picture is made from: the subject, seen as it is now."""
        looked_at = {name: view for name, view in self.views.items() if view != View()}
        subject = replace(self.subject, views=looked_at)
        return subject if self.cursor is None else subject.pointed(self.cursor)

    # Time -----------------------------------------------------------------------------------

    @property
    def moving(self) -> bool:
        """Whether time alone changes the picture."""
        return self._motion is not None

    def seconds_of_notice(self) -> float:
        """How long the notice is still to be seen."""
        left = min(self._notice_until - self._now, self._notice_seconds)
        return max(0.0, left) if self.notice else 0.0

    def presented(self, now: float) -> None:
        """The notice is on the screen: its time begins, however long the drawing took."""
        if self._notice_until == inf:
            self._notice_until = now + self._notice_seconds

    def advance(self, now: float) -> None:
        """The clock stands at `now` seconds."""
        if self._motion is not None:
            name, motion = self._motion
            value = motion(now)
            if value is None:
                self._motion = None
            else:
                self._set(name, value)
        self._now = now
        if self.notice and now >= self._notice_until:
            self.notice = ""
            self.refresh = True

    def say(self, text: str, seconds: float = NOTICE_SECONDS) -> None:
        """Show one line for a moment; it is printed too."""
        self.notice = text
        self._notice_seconds, self._notice_until = seconds, inf  # `presented` says when it begins
        self.refresh = True
        print(text, flush=True)

    # Keys -----------------------------------------------------------------------------------

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

    def undo(self) -> None:
        """Back to before the last change of parameters."""
        step = self._history.undo()
        if step is None:
            self.say("nothing to undo")
        else:
            self._return_to(step.before, step.after)
            self.say(f"undone: {difference(step.after.subject, step.before.subject)}")

    def redo(self) -> None:
        """The change undone last, once more."""
        step = self._history.redo()
        if step is None:
            self.say("nothing to redo")
        else:
            self._return_to(step.after, step.before)
            self.say(f"redone: {difference(step.before.subject, step.after.subject)}")

    def play(self) -> None:
        """Move the scene's parameter to and fro, or stop."""
        name = self.subject.scene.animates
        if self._motion is not None:
            moved, self._motion = self._motion[0], None
            self.say(f"{moved} = {self.subject.value(moved):.2f}")
        elif name is None or not self._has(name):
            self.say(f"{self.subject.title}: nothing here is animated")
        else:
            start, phase = self._now, self._phase(name)
            self._motion = (
                name,
                lambda now: self._at(name, phase + (now - start) / ANIMATION_SECONDS),
            )
            self.say(f"animating {name}")

    def glide(self) -> None:
        """Morph to the other end."""
        if self._has("morph"):
            self._glide("morph", GLIDE_SECONDS)

    def _glide(self, name: str, seconds: float) -> None:
        """Move a parameter to its farther end: one step, whatever is seen on the way."""
        start, phase = self._now, _unsmooth(self._fraction(name))
        interval = self.subject.parameters()[name].range
        assert interval is not None
        end = interval.low if phase >= 0.5 else interval.high

        def motion(now: float) -> float | None:
            way = (now - start) / seconds
            if self.subject.value(name) == end:
                return None
            up = end == interval.high
            return self._at(name, min(1.0, phase + way) if up else max(0.0, phase - way))

        before = Moment(self.subject, dict(self.views))
        self._history.note(before, Moment(self.subject.changed(name, end), before.views))
        self._motion = (name, motion)
        self.say(f"{name} to {end:g}")

    # Comparing ------------------------------------------------------------------------------

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

    # Text -----------------------------------------------------------------------------------

    def ask(self, title: str, accept: Callable[[str], None], text: str = "") -> None:
        """Ask for a line of text, proposing one; keys go there until Enter or Escape."""
        self.prompt = Prompt(title, text, accept, offered=bool(text))
        self.refresh = True

    def ask_for_parameter(self) -> None:
        """Ask for `name=value`, as the command line has it."""
        self.ask("set a parameter:  name = value", self.set_by_text)

    def set_by_text(self, text: str) -> None:
        """Set a parameter by `name = value`. Raises UsageError, FileFormatError."""
        name, equals, value = text.partition("=")
        name = name.strip()
        subject = self.subject.assigned([f"{name}={value.strip()}"] if equals else [text])
        if subject.parameters()[name].picture and subject.value(name):
            read_picture(find_picture(subject.value(name)))  # or it raises
        self._replace(subject)
        self.say(f"{name} = {subject.shown(name)}")

    def type_text(self, text: str) -> None:
        """More of the line that is asked for."""
        if self.prompt is not None:
            self.prompt.text = text if self.prompt.offered else self.prompt.text + text
            self.prompt.offered = False
            self.refresh = True

    def type_key(self, name: str) -> None:
        """BACKSPACE, ENTER and ESC, while a line is asked for; others change nothing."""
        prompt = self.prompt
        if prompt is None:
            return
        self.refresh = True
        if name == "BACKSPACE":
            prompt.text = "" if prompt.offered else prompt.text[:-1]
            prompt.offered = False
        elif name == "ESC":
            self.prompt = None
        elif name == "ENTER":
            try:
                self.prompt = None
                prompt.accept(prompt.text.strip())
            except (ReparamError, ValueError) as fault:
                self.prompt, prompt.offered = prompt, False  # the text stays, to be mended
                self.say(str(fault), 8.0)

    # Parameters -----------------------------------------------------------------------------

    def change(self, changes: Mapping[str, Any]) -> None:
        """Set parameters: one step that can be undone, with the others of the same gesture.

        Raises ValueError for a value that is not allowed.
        """
        if not changes:
            return
        subject = self.subject
        for name, value in changes.items():
            subject = subject.changed(name, value)
            if subject.display.compare.startswith(f"{name}="):
                subject = subject.changed("compare", "")  # the hand wants to see this value
        self._replace(subject)

    def choose(self, name: str, value: Any) -> None:
        """A parameter by hand: changed and told, or told why not."""
        try:
            self._tell(name, value)
        except (ReparamError, ValueError) as fault:
            self.say(str(fault), 8.0)

    def assign(self, name: str, text: str) -> None:
        """A parameter by its text, as on the command line: changed and told, or told why not."""
        try:
            self.set_by_text(f"{name}={text}")
        except (ReparamError, ValueError) as fault:
            self.say(str(fault), 8.0)

    def begin_gesture(self) -> None:
        """What changes from now on, until `end_gesture`, is one step: a drag of the mouse."""
        self._gesture = object()

    def end_gesture(self) -> None:
        """The gesture is over."""
        self._gesture = None

    def _replace(self, subject: Subject) -> None:
        before = Moment(self.subject, dict(self.views))
        self.subject = subject
        self._history.note(before, Moment(subject, before.views), self._gesture)
        self.changed = True

    def _return_to(self, there: Moment, here: Moment) -> None:
        """To `there`, the other side of a step whose this side is `here`."""
        self._motion = None
        if self.subject.scene.name != there.subject.scene.name:
            self.visit(there.subject.scene.name)
        if self.views == here.views:  # else the user looks from elsewhere by now
            self.views = dict(there.views)
        self.subject = there.subject
        self.changed = True

    # Mouse ----------------------------------------------------------------------------------

    def view(self, space: str) -> View:
        """How a space is seen."""
        return self.views.get(space, View())

    def keep_view(self, space: str, view: View) -> None:
        """The view by which the picture stays where it is while a gesture changes the scene."""
        if view != self.view(space):
            self.views[space] = view
            self._history.look(Moment(self.subject, dict(self.views)), self._gesture)

    def pan(self, space: str, dx: float, dy: float) -> None:
        """Move a space's picture by (dx, dy) model units."""
        view = self.view(space)
        self.views[space] = replace(view, pan=(view.pan[0] - dx, view.pan[1] - dy))
        self.changed = True

    def zoom(self, space: str, factor: float, x: float, y: float) -> None:
        """Enlarge by `factor`, keeping the point (x, y) model units from the middle in place."""
        view = self.view(space)
        zoom = min(1e4, max(1e-2, view.zoom * factor))
        shift = 1.0 - view.zoom / zoom
        pan = (view.pan[0] + x * shift, view.pan[1] + y * shift)
        self.views[space] = replace(view, zoom=zoom, pan=pan)
        self.changed = True

    def orbit(self, space: str, azimuth: float, elevation: float) -> None:
        """Turn a spatial space by these degrees."""
        view = self.view(space)
        steep = min(90.0, max(-90.0, view.elevation + elevation))
        turned = (view.azimuth + azimuth) % 360.0
        self.views[space] = replace(view, azimuth=turned, elevation=steep)
        self.changed = True

    # ----------------------------------------------------------------------------------------

    def _has(self, name: str) -> bool:
        if name in self.subject.values:
            return True
        self.say(f"{self.subject.title}: has no {name}")
        return False

    def _set(self, name: str, value: Any) -> None:
        self.subject = self.subject.changed(name, value)
        self.changed = True

    def _tell(self, name: str, value: Any) -> None:
        self.change({name: value})
        self.say(f"{name} = {self.subject.shown(name)}")

    def _cycle(self, name: str) -> None:
        self._tell(name, self.subject.parameters()[name].following(self.subject.value(name)))

    def _fraction(self, name: str) -> float:
        interval = self.subject.parameters()[name].range
        assert interval is not None
        return float((self.subject.value(name) - interval.low) / (interval.high - interval.low))

    def _phase(self, name: str) -> float:
        """Where on its way the parameter stands: `_at` gives its value back."""
        interval = self.subject.parameters()[name].range
        fraction = self._fraction(name)
        return fraction if interval is not None and interval.clock else _unsmooth(fraction)

    def _at(self, name: str, phase: float) -> float:
        interval = self.subject.parameters()[name].range
        assert interval is not None
        if interval.clock:
            return interval.low + (interval.high - interval.low) * (phase % 1.0)
        way = phase % 2.0
        way = 2.0 - way if way > 1.0 else way
        return interval.low + (interval.high - interval.low) * way * way * (3.0 - 2.0 * way)

    def open(self, subject: Subject) -> None:
        """Show another scene or file; a file is a page from then on."""
        self._motion = None
        self._visited[self.subject.scene.name] = (self.subject, self.views)
        self._visited.pop(subject.scene.name, None)
        if subject.data:
            self._opened = subject
        self.subject, self.views = subject, dict(subject.views)
        self.changed = True
        self.say(f"{subject.scene.name}: {subject.title}")

    def visit(self, name: str) -> None:
        """One of the pages, as it was left."""
        here = self.subject.scene.name
        if name == here:
            return
        self._motion = None
        display = replace(self.subject.display, compare="")  # the next scene has other parameters
        self._visited[here] = (self.subject, self.views)
        if name in self._visited:
            subject, self.views = self._visited[name]
        else:
            subject, self.views = open_subject(name), {}  # a scene: it has no views of its own
        self.subject = replace(subject, display=display)
        self.changed = True
        self.say(f"{name}: {self.subject.title}")


def difference(before: Subject, after: Subject) -> str:
    """Names and new values of the parameters that differ."""
    if before.scene.name != after.scene.name:
        return after.scene.name
    names = changed_names(before, after)
    return ", ".join(f"{name} = {after.shown(name)}" for name in names)


def changed_names(before: Subject, after: Subject) -> list[str]:
    """The parameters of a scene that differ."""
    names = after.parameters()
    return [name for name in names if not np.array_equal(before.value(name), after.value(name))]


def _unsmooth(value: float) -> float:
    """The inverse of smoothstep: where on its way a value of 0..1 stands."""
    return 0.5 - sin(asin(max(-1.0, min(1.0, 1.0 - 2.0 * value))) / 3.0)
