"""What a host shows: a scene or the user's file, with the values of its parameters."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .errors import FileFormatError, UsageError
from .files.progress import Progress, silent
from .files.saved import is_saved
from .geometry.camera import View
from .scenes.cursor import Cursor, is_linked, marked, parse, within
from .scenes.display import Display
from .scenes.layers import Figure
from .scenes.linked import linked
from .scenes.parameters import Parameter, find, parameters_of
from .scenes.registry import Scene, file_scene, load_scene, scene_names
from .scenes.remember import remember

if TYPE_CHECKING:
    from .geometry.body import Body

DISPLAY = parameters_of(Display)


@dataclass(frozen=True)
class Subject:
    """State is the parameters: a scene, the values of its parameters, and how it is displayed."""

    scene: Scene
    values: Mapping[str, Any]
    display: Display = field(default_factory=Display)
    data: Mapping[str, Any] = field(default_factory=dict)  # what has no text form: a file's body
    title: str = ""
    source: str = ""  # the path of the file, if it is one
    views: Mapping[str, View] = field(default_factory=dict)  # of its spaces, by name

    def figure(self) -> Figure:
        """The picture for these values, linked and with the cursor as its display says.

        Raises UsageError if the scene refuses the values.
        """
        try:
            return marked(self._unmarked(), parse(self.display.cursor))
        except ValueError as fault:
            raise UsageError(str(fault)) from fault

    def pointed(self, cursor: Cursor) -> Subject:
        """The same with the cursor moved there, if it is to be seen. Raises as `figure` does."""
        try:
            figure = self._unmarked()
        except ValueError as fault:
            raise UsageError(str(fault)) from fault
        if not (self.display.cursor or is_linked(figure)):
            return self
        return self.changed("cursor", within(figure, cursor).text)

    def _unmarked(self) -> Figure:
        data = _with_meshes(self.scene, self.values, self.data)
        return _figure(self.scene, self.values, data, self.display.linked, self.display.joins)

    def parameters(self) -> dict[str, Parameter]:
        """The scene's parameters, then the display's."""
        return {**self.scene.parameters, **DISPLAY}

    def value(self, name: str) -> Any:
        """The present value of a parameter."""
        return self.values[name] if name in self.values else getattr(self.display, name)

    def shown(self, name: str) -> str:
        """The present value of a parameter, as a line on the screen has room for it."""
        value = self.value(name)
        if isinstance(value, bool):
            return "on" if value else "off"
        text = f"{value:.4g}" if isinstance(value, float) else self.parameters()[name].text(value)
        text = text or "none"
        return text if len(text) <= 60 else f"{text[:57]}..."

    def changed(self, name: str, value: Any) -> Subject:
        """The same with one parameter changed. Raises ValueError if the value is not allowed."""
        value = find(self.parameters(), name).check(value)
        if name in self.values:
            return replace(self, values={**self.values, name: value})
        return replace(self, display=replace(self.display, **{name: value}))

    def assigned(self, assignments: Sequence[str]) -> Subject:
        """The same after the command line's `name=value`s. Raises UsageError."""
        subject = self
        for assignment in assignments:
            name, equals, text = assignment.partition("=")
            if not equals:
                raise UsageError(f"--set: expected NAME=VALUE, found {assignment!r}")
            parameter = find(self.parameters(), name)
            subject = subject.changed(name, parameter.parse(text))
        return subject


@remember
def _figure(
    scene: Scene, values: Mapping[str, Any], data: Mapping[str, Any], beside: bool, joins: bool
) -> Figure:
    figure = scene({**values, **data})
    if joins:
        from .scenes.join_lines import joined  # few ask for them

        figure = joined(figure)
    return linked(figure) if beside else figure


@remember
def _with_meshes(
    scene: Scene, values: Mapping[str, Any], data: Mapping[str, Any]
) -> Mapping[str, Any]:
    """The data, and of a file that a parameter names what is in it."""
    for name, parameter in scene.parameters.items():
        if parameter.mesh and values[name] not in parameter.presets:
            path = Path(values[name])
            if path.suffix.lower() not in (".obj", ".bv") and not os.path.exists(path):
                raise UsageError(f"{name}: expected {parameter.expected()}, found {values[name]!r}")
            data = {**data, "file": _mesh_file(path, _changed_at(path))}
    return data


def _changed_at(path: Path) -> int:
    try:
        return path.stat().st_mtime_ns
    except OSError:  # reading it says what is wrong
        return 0


@lru_cache(maxsize=4)
def _mesh_file(path: Path, changed_at: int) -> Body:  # noqa: ARG001
    """What is in the file; read again when it has changed."""
    if path.suffix.lower() == ".obj":
        from .files.obj import read_obj

        return read_obj(path)
    from .files.bv import read_bv

    return read_bv(path)


def without_bad_pictures(subject: Subject) -> tuple[Subject, list[str]]:
    """The subject with each picture that cannot be read put back, and a warning for each."""
    warnings = []
    for name, parameter in subject.scene.parameters.items():
        if parameter.picture and subject.values[name]:
            from .files.picture import find_picture, read_picture

            try:
                read_picture(find_picture(subject.values[name]))
            except FileFormatError as error:
                subject = subject.changed(name, parameter.default)
                warnings.append(f"{error}; the checkerboard stands in")
    return subject, warnings


def scene_subject(
    scene: Scene, data: Mapping[str, Any] | None = None, title: str = "", source: str = ""
) -> Subject:
    """A scene with its defaults."""
    values = {name: parameter.default for name, parameter in scene.parameters.items()}
    return Subject(scene, values, data=data or {}, title=title or scene.title, source=source)


def open_subject(name: str, progress: Progress = silent) -> Subject:
    """A scene by its name, or a file by its path: a surface, or a scene that was saved.

    `progress` is told which share of a file, from 0 to 1, has been read.

    Raises UsageError for a name that is neither, FileFormatError for a file that is not readable.
    """
    if name in scene_names():
        return scene_subject(load_scene(name))
    path = Path(name)
    if is_saved(path):
        from .saving import open_saved

        return open_saved(path, lambda found: open_subject(found, progress))
    if path.suffix.lower() == ".obj":
        from .files.obj import read_obj

        opened = scene_subject(file_scene(), {"body": read_obj(path)}, path.name, name)
        return opened.changed("smooth", "layout")
    if path.suffix.lower() == ".bv" or os.path.exists(path):  # Path.exists raises on long names
        from .files.bv import read_bv

        return scene_subject(file_scene(), {"body": read_bv(path, progress)}, path.name, name)
    return scene_subject(load_scene(name))  # raises, naming what there is
