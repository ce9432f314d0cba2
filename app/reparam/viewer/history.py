"""Undo and redo: what was shown before and after each change of parameters."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ..geometry.camera import View
from ..subject import Subject

STEPS = 1000


@dataclass(frozen=True)
class Moment:
    """A subject and how its spaces were seen. Subjects are frozen: a moment costs a few words."""

    subject: Subject
    views: Mapping[str, View]


@dataclass
class Step:
    """One change; changes of the same gesture (one drag of the mouse) are one step."""

    before: Moment
    after: Moment
    gesture: object


class History:
    """The steps that can be undone, and the undone ones that can be made again."""

    def __init__(self) -> None:
        self._done: list[Step] = []
        self._undone: list[Step] = []

    def note(self, before: Moment, after: Moment, gesture: object = None) -> None:
        """A change was made: a step of its own, or more of the same gesture."""
        self._undone.clear()
        if gesture is not None and self._done and self._done[-1].gesture is gesture:
            self._done[-1].after = after
        else:
            self._done.append(Step(before, after, gesture))
            del self._done[:-STEPS]

    def look(self, after: Moment, gesture: object) -> None:
        """The gesture changed how the spaces are seen, too."""
        if gesture is not None and self._done and self._done[-1].gesture is gesture:
            self._done[-1].after = after

    @property
    def last(self) -> Step | None:
        """The step that `undo` would undo."""
        return self._done[-1] if self._done else None

    def undo(self) -> Step | None:
        """The last step, now undone; None if there is none."""
        return self._move(self._done, self._undone)

    def redo(self) -> Step | None:
        """The step undone last, now made again; None if there is none."""
        return self._move(self._undone, self._done)

    def _move(self, start: list[Step], goal: list[Step]) -> Step | None:
        if not start:
            return None
        step = start.pop()
        step.gesture = None  # what follows does not go on with it
        goal.append(step)
        return step


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
