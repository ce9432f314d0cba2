"""Formulas: evaluated, differentiated exactly, and written as GLSL.

A formula is a tree of numbers, variables, the five operations and the functions in FUNCTIONS;
parsing.py makes one of what a user typed.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]

MOST_FACTORS = 16  # of a whole power written as products: GLSL's pow takes no negative base


@dataclass(frozen=True)
class Formula:
    """An expression. `names` that it may hold are given when it is evaluated."""

    def __call__(self, **values: ArrayLike) -> Array:
        """Its value for arrays or numbers by name. NaN and infinities come back as they are."""
        arrays = {name: np.asarray(value, float) for name, value in values.items()}
        shape = np.broadcast_shapes(*(array.shape for array in arrays.values()))
        with np.errstate(all="ignore"):
            return np.broadcast_to(np.asarray(self.evaluate(arrays), float), shape)

    def evaluate(self, values: Mapping[str, Array]) -> Array | float:
        """As `__call__`, without broadcasting."""
        raise NotImplementedError

    def derivative(self, name: str) -> Formula:
        """d/d(name), by the rules, exactly."""
        raise NotImplementedError

    def glsl(self) -> str:
        """The same as an expression in GLSL, float throughout (shaders/lib/formula.glsl)."""
        raise NotImplementedError

    def substitute(self, **formulas: Formula) -> Formula:
        """The same with formulas in the place of variables: a change of variables."""
        raise NotImplementedError


@dataclass(frozen=True)
class Number(Formula):
    """A constant."""

    value: float

    def evaluate(self, values: Mapping[str, Array]) -> float:  # noqa: ARG002, D102
        return self.value

    def derivative(self, name: str) -> Formula:  # noqa: ARG002, D102
        return ZERO

    def glsl(self) -> str:  # noqa: D102
        return f"({self.value!r})" if self.value < 0.0 else repr(self.value)

    def substitute(self, **formulas: Formula) -> Formula:  # noqa: ARG002, D102
        return self


ZERO, ONE = Number(0.0), Number(1.0)


@dataclass(frozen=True)
class Variable(Formula):
    """A name whose value comes later."""

    name: str

    def evaluate(self, values: Mapping[str, Array]) -> Array:  # noqa: D102
        return values[self.name]

    def derivative(self, name: str) -> Formula:  # noqa: D102
        return ONE if name == self.name else ZERO

    def glsl(self) -> str:  # noqa: D102
        return f"({self.name})"

    def substitute(self, **formulas: Formula) -> Formula:  # noqa: D102
        return formulas.get(self.name, self)


@dataclass(frozen=True)
class Operation(Formula):
    """Two formulas joined by + - * / or **."""

    sign: str
    left: Formula
    right: Formula

    def evaluate(self, values: Mapping[str, Array]) -> Array | float:  # noqa: D102
        left, right = self.left.evaluate(values), self.right.evaluate(values)
        return OPERATIONS[self.sign](np.asarray(left), np.asarray(right))

    def derivative(self, name: str) -> Formula:  # noqa: D102
        f, g = self.left, self.right
        df, dg = f.derivative(name), g.derivative(name)
        match self.sign:
            case "+":
                return plus(df, dg)
            case "-":
                return minus(df, dg)
            case "*":
                return plus(times(df, g), times(f, dg))
            case "/":
                return over(minus(df, times(f, over(dg, g))), g)
        if isinstance(g, Number):
            return times(times(g, power(f, Number(g.value - 1.0))), df)
        growth = plus(times(dg, Function("log", f)), times(g, over(df, f)))
        return times(self, growth)

    def glsl(self) -> str:  # noqa: D102
        left, right = self.left.glsl(), self.right.glsl()
        if self.sign != "**":
            return f"({left} {self.sign} {right})"
        whole = isinstance(self.right, Number) and self.right.value == int(self.right.value)
        if whole and isinstance(self.right, Number) and abs(self.right.value) <= MOST_FACTORS:
            return f"whole_power({left}, {int(self.right.value)})"
        return f"pow({left}, {right})"

    def substitute(self, **formulas: Formula) -> Formula:  # noqa: D102
        left, right = self.left.substitute(**formulas), self.right.substitute(**formulas)
        return Operation(self.sign, left, right)


@dataclass(frozen=True)
class Function(Formula):
    """A function of FUNCTIONS applied to a formula."""

    name: str
    argument: Formula

    def evaluate(self, values: Mapping[str, Array]) -> Array | float:  # noqa: D102
        return FUNCTIONS[self.name].value(np.asarray(self.argument.evaluate(values)))

    def derivative(self, name: str) -> Formula:  # noqa: D102
        inner = self.argument.derivative(name)
        return times(FUNCTIONS[self.name].derivative(self.argument), inner)

    def glsl(self) -> str:  # noqa: D102
        return f"{FUNCTIONS[self.name].glsl}({self.argument.glsl()})"

    def substitute(self, **formulas: Formula) -> Formula:  # noqa: D102
        return Function(self.name, self.argument.substitute(**formulas))


def plus(f: Formula, g: Formula) -> Formula:
    """f + g."""
    return g if f == ZERO else f if g == ZERO else Operation("+", f, g)


def minus(f: Formula, g: Formula) -> Formula:
    """f - g."""
    return f if g == ZERO else Operation("-", f, g)


def times(f: Formula, g: Formula) -> Formula:
    """f g."""
    if ZERO in (f, g):
        return ZERO
    return g if f == ONE else f if g == ONE else Operation("*", f, g)


def over(f: Formula, g: Formula) -> Formula:
    """f / g."""
    return ZERO if f == ZERO else f if g == ONE else Operation("/", f, g)


def power(f: Formula, g: Formula) -> Formula:
    """f ** g."""
    return ONE if g == ZERO else f if g == ONE else Operation("**", f, g)


@dataclass(frozen=True)
class Rule:
    """What is known of a function: its values, its derivative, and its name in GLSL."""

    value: Callable[[Array], Array]
    derivative: Callable[[Formula], Formula]
    glsl: str


def _square(f: Formula) -> Formula:
    return power(f, Number(2.0))


def _of(name: str) -> Callable[[Formula], Formula]:
    return lambda f: Function(name, f)


OPERATIONS: dict[str, Callable[[Array, Array], Array]] = {
    "+": np.add,
    "-": np.subtract,
    "*": np.multiply,
    "/": np.divide,
    "**": np.power,
}
FUNCTIONS = {
    "sqrt": Rule(np.sqrt, lambda f: over(Number(0.5), Function("sqrt", f)), "sqrt"),
    "exp": Rule(np.exp, _of("exp"), "exp"),
    "log": Rule(np.log, lambda f: over(ONE, f), "log"),
    "sin": Rule(np.sin, _of("cos"), "sine"),
    "cos": Rule(np.cos, lambda f: minus(ZERO, Function("sin", f)), "cosine"),
    "tan": Rule(np.tan, lambda f: plus(ONE, _square(Function("tan", f))), "tangent"),
    "asin": Rule(
        np.arcsin, lambda f: over(ONE, Function("sqrt", minus(ONE, _square(f)))), "arcsine"
    ),
    "acos": Rule(
        np.arccos,
        lambda f: over(Number(-1.0), Function("sqrt", minus(ONE, _square(f)))),
        "arccosine",
    ),
    "atan": Rule(np.arctan, lambda f: over(ONE, plus(ONE, _square(f))), "arctangent"),
    "sinh": Rule(np.sinh, _of("cosh"), "sinh"),
    "cosh": Rule(np.cosh, _of("sinh"), "cosh"),
    "tanh": Rule(np.tanh, lambda f: minus(ONE, _square(Function("tanh", f))), "tanh"),
    "abs": Rule(np.abs, _of("sign"), "abs"),
    "sign": Rule(np.sign, lambda _: ZERO, "sign"),
}
