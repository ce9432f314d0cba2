"""Scenes: decorated functions of typed parameters, one module a scene in scenes/figures.

A new file there, with a function of the module's name, is a new entry in the viewer, in
`reparam list`, in `--set`, in the golden-picture test and in the gallery.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..errors import UsageError
from .display import Display
from .layers import Figure
from .parameters import Parameter, parameters_of

if TYPE_CHECKING:
    from .claims import Claim

Claims = Callable[[], "Iterator[Claim]"]


@dataclass
class Scene:
    """A named, parameterised picture."""

    name: str
    title: str
    build: Callable[..., Figure]
    figure: int | None = None  # of the note: the key that shows it
    animates: str | None = None  # the parameter that Space moves to and fro
    opens_files: bool = False  # takes a Body; shown by naming a file
    plates: tuple[tuple[str, ...], ...] = ((),)  # assignments of the pictures worth keeping
    _claims: Claims = field(default=lambda: iter(()))

    @cached_property
    def parameters(self) -> dict[str, Parameter]:
        """Its parameters by name, in the order of its signature."""
        found = parameters_of(self.build)
        shadowed = sorted(found.keys() & parameters_of(Display).keys())
        assert not shadowed, f"{self.name}: {shadowed} are names of the display's parameters"
        return found

    def __call__(self, values: Mapping[str, Any] | None = None) -> Figure:
        """The picture for these values, defaults for the others."""
        return self.build(**(values or {}))

    def claims(self, function: Claims) -> Claims:
        """Decorator: the function that yields this scene's claims."""
        self._claims = function
        return function

    def claimed(self) -> Iterator[Claim]:
        """Its claims, computed when asked for."""
        return self._claims()


def scene(
    title: str,
    *,
    figure: int | None = None,
    animates: str | None = None,
    opens_files: bool = False,
    plates: tuple[tuple[str, ...], ...] = ((),),
) -> Callable[[Callable[..., Figure]], Scene]:
    """Decorator: the function becomes the scene of its name."""

    def register(build: Callable[..., Figure]) -> Scene:
        return Scene(shown(build.__name__), title, build, figure, animates, opens_files, plates)

    return register


FILE_SCENE = "surface"


def shown(module: str) -> str:
    """A scene's name from its module's: hyphens stand where Python wants underscores."""
    return module.replace("_", "-")


def scene_names() -> list[str]:
    """All scenes but the one that opens files, without importing any."""
    files = (Path(__file__).parent / "figures").glob("*.py")
    names = {file.stem for file in files} - {"__init__", FILE_SCENE}
    return sorted(map(shown, names))


def load_scene(name: str) -> Scene:
    """The scene of that name; imports its module alone. Raises UsageError for an unknown name."""
    if name not in scene_names():
        from difflib import get_close_matches

        near = get_close_matches(name, scene_names(), 1)
        meant = f"; did you mean {near[0]}?" if near else ""
        raise UsageError(
            f"expected a scene ({', '.join(scene_names())}) or a file (.bv, .obj), "
            f"found {name!r}{meant}"
        )
    return _import(name)


def file_scene() -> Scene:
    """The scene that shows a file; it takes a Body."""
    return _import(FILE_SCENE)


def _import(name: str) -> Scene:
    module = name.replace("-", "_")
    found = getattr(import_module(f"{__package__}.figures.{module}"), module)
    assert isinstance(found, Scene), f"scenes/figures/{module}.py defines no scene {module}"
    return found
