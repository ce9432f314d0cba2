"""Typed parameters, read off a function's signature, and their text form on the command line.

def fig5(texture: Literal["identity", "r"] = "identity",
         checks: Annotated[int, Range(1, 64), "squares along each side"] = 8): ...
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from inspect import signature
from typing import Any, Literal, get_args, get_origin, get_type_hints

from ..errors import UsageError

Value = Any


@dataclass(frozen=True)
class Range:
    """Smallest and largest allowed value, both included; `step` is one key press."""

    low: float
    high: float
    step: float = 1.0


@dataclass(frozen=True)
class PictureFile:
    """Marks a text that names a picture; without one the scene shows what it shows for ""."""


@dataclass(frozen=True)
class Parameter:
    """One parameter: its name, type, default, choices or range, and what it does."""

    name: str
    type: type
    default: Value
    choices: tuple[str, ...] = ()
    range: Range | None = None
    help: str = ""
    picture: bool = False  # the name of a picture file

    def expected(self) -> str:
        """The values it takes, in words."""
        if self.choices:
            return " or ".join(self.choices)
        if self.type is bool:
            return "0 or 1"
        kind = {int: "a whole number", float: "a number", str: "a text"}[self.type]
        return f"{kind} from {self.range.low:g} to {self.range.high:g}" if self.range else kind

    def row(self) -> dict[str, Any]:
        """The parameter as JSON has it."""
        interval = [self.range.low, self.range.high] if self.range else None
        return {
            "name": self.name,
            "type": "choice" if self.choices else self.type.__name__,
            "choices": list(self.choices) or None,
            "range": interval,
            "default": self.default,
            "help": self.help,
        }

    def parse(self, text: str) -> Value:
        """The value that `text` stands for. Raises UsageError with what was expected and found."""
        try:
            if self.type is bool:
                return {"0": False, "1": True, "false": False, "true": True}[text.lower()]
            return self.check(self.type(text))
        except (ValueError, KeyError):
            raise UsageError(f"{self.name}: expected {self.expected()}, found {text!r}") from None

    def check(self, value: Value) -> Value:
        """The value itself if it is allowed, else ValueError."""
        allowed = (
            value in self.choices
            if self.choices
            else self.range is None
            or (math.isfinite(value) and self.range.low <= value <= self.range.high)
        )
        if not allowed:
            raise ValueError(f"{self.name}: expected {self.expected()}, found {value!r}")
        return value

    def following(self, value: Value) -> Value:
        """The next choice, the other truth, or one step up, coming round at the end."""
        if self.choices:
            return self.choices[(self.choices.index(value) + 1) % len(self.choices)]
        if self.type is bool:
            return not value
        assert self.range is not None, f"{self.name} has no step"
        up = self.type(value + self.range.step)
        return up if up <= self.range.high else self.type(self.range.low)


def parameters_of(function: Callable[..., object]) -> dict[str, Parameter]:
    """The parameters of a function, or the fields of a dataclass, that have a text form.

    Others (a Body, an array) are data: their caller gives them.
    """
    hints = get_type_hints(function, include_extras=True)
    found = {}
    for name, argument in signature(function).parameters.items():
        parameter = _parameter(name, hints[name], argument.default)
        if parameter is not None:
            found[name] = parameter
    return found


def _parameter(name: str, hint: Any, default: Value) -> Parameter | None:
    hint, *extras = get_args(hint) if hasattr(hint, "__metadata__") else (hint,)
    choices = get_args(hint) if get_origin(hint) is Literal else ()
    kind = str if choices else hint
    if kind not in (bool, int, float, str):
        return None
    interval = next((extra for extra in extras if isinstance(extra, Range)), None)
    text = next((extra for extra in extras if isinstance(extra, str)), "")
    picture = any(isinstance(extra, PictureFile) for extra in extras)
    return Parameter(name, kind, default, choices, interval, text, picture)


def find(parameters: Mapping[str, Parameter], name: str) -> Parameter:
    """The parameter of that name. Raises UsageError that suggests the nearest one."""
    if name in parameters:
        return parameters[name]
    from difflib import get_close_matches

    near = get_close_matches(name, parameters, 1)
    meant = f"; did you mean {near[0]}?" if near else ""
    raise UsageError(f"--set: expected one of {', '.join(parameters)}, found {name!r}{meant}")
