"""What the window shows and how it changes: parameters with undo, time, lines of text."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from math import inf
from typing import Any

from ..errors import ReparamError
from ..files.picture import find_picture, read_picture
from ..geometry.camera import View
from ..scenes.cursor import Cursor
from ..scenes.parameters import Range
from ..subject import Subject, open_subject
from .history import History, Moment, difference
from .motion import Motion, phase, value_at
from .prompt import Prompt
from .views import Views

NOTICE_SECONDS = 2.5
ANIMATION_SECONDS = 3.0  # from one end to the other


class Stage(Views):
    """A subject with its views.

    `changed` is set whenever the picture must be drawn again, `refresh` when only what the window
    shows over it is another.
    """

    def __init__(self, subject: Subject) -> None:
        super().__init__(subject.views)
        self.subject = subject
        self.cursor: Cursor | None = None  # where the mouse put it; not a step that is undone
        self.refresh = False
        self.notice = ""
        self.prompt: Prompt | None = None
        self._notice_until = self._notice_seconds = 0.0
        self._now = 0.0
        self._motion: tuple[str, Motion] | None = None  # of the parameter of that name
        self._visited: dict[str, tuple[Subject, dict[str, View]]] = {}
        self._opened = subject if subject.data else None
        self._history = History()
        self._gesture: object = None

    def snapshot(self) -> Subject:
        """All that the picture is made from: the subject, seen as it is now."""
        looked_at = {name: view for name, view in self.views.items() if view != View()}
        subject = replace(self.subject, views=looked_at)
        return subject if self.cursor is None else subject.pointed(self.cursor)

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

    def ask(self, title: str, accept: Callable[[str], None], text: str = "") -> None:
        """Ask for a line of text, proposing one; keys go there until Enter or Escape."""
        self.prompt = Prompt(title, text, accept, offered=bool(text))
        self.refresh = True

    def type_text(self, text: str) -> None:
        """More of the line that is asked for."""
        if self.prompt is not None:
            self.prompt.type(text)
            self.refresh = True

    def type_key(self, name: str) -> None:
        """BACKSPACE, ENTER and ESC, while a line is asked for; others change nothing."""
        prompt = self.prompt
        if prompt is None:
            return
        self.refresh = True
        if name == "BACKSPACE":
            prompt.take_back()
        elif name == "ESC":
            self.prompt = None
        elif name == "ENTER":
            try:
                self.prompt = None
                prompt.accept(prompt.text.strip())
            except (ReparamError, ValueError) as fault:
                self.prompt, prompt.offered = prompt, False  # the text stays, to be mended
                self.say(str(fault), 8.0)

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

    def set_by_text(self, text: str) -> None:
        """Set a parameter by `name = value`. Raises UsageError, FileFormatError."""
        name, equals, value = text.partition("=")
        name = name.strip()
        subject = self.subject.assigned([f"{name}={value.strip()}"] if equals else [text])
        if subject.parameters()[name].picture and subject.value(name):
            read_picture(find_picture(subject.value(name)))  # or it raises
        subject.figure()  # or it raises: the scene may refuse a text
        self._replace(subject)
        self.say(f"{name} = {subject.shown(name)}")

    def begin_gesture(self) -> None:
        """What changes from now on, until `end_gesture`, is one step: a drag of the mouse."""
        self._gesture = object()

    def end_gesture(self) -> None:
        """The gesture is over."""
        self._gesture = None

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

    def keep_view(self, space: str, view: View) -> None:
        """The view by which the picture stays where it is while a gesture changes the scene."""
        if view != self.view(space):
            self.views[space] = view
            self._history.look(Moment(self.subject, dict(self.views)), self._gesture)

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

    def _animate(self, name: str) -> None:
        """Move a parameter to and fro, or round and round, until something stops it."""
        interval = self._range(name)
        start, begun = phase(interval, self.subject.value(name)), self._now

        def motion(now: float) -> float:
            return value_at(interval, start + (now - begun) / ANIMATION_SECONDS)

        self._motion = (name, motion)
        self.say(f"animating {name}")

    def _glide(self, name: str, seconds: float) -> None:
        """Move a parameter to its farther end: one step, whatever is seen on the way."""
        interval = self._range(name)
        start, begun = phase(interval, self.subject.value(name)), self._now
        end = interval.low if start >= 0.5 else interval.high

        def motion(now: float) -> float | None:
            way = (now - begun) / seconds
            if self.subject.value(name) == end:
                return None
            goal = min(1.0, start + way) if end == interval.high else max(0.0, start - way)
            return value_at(interval, goal)

        before = Moment(self.subject, dict(self.views))
        self._history.note(before, Moment(self.subject.changed(name, end), before.views))
        self._motion = (name, motion)
        self.say(f"{name} to {end:g}")

    def _range(self, name: str) -> Range:
        interval = self.subject.parameters()[name].range
        assert interval is not None, f"{name} has no range to move in"
        return interval

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
