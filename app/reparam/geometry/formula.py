"""Formulas that a user types: parsed, evaluated, differentiated exactly, and written as GLSL.

    parse("u^3 (3 - 2 sin(pi u))", ("u",))

is a tree of numbers, variables, the five operations and the functions in FUNCTIONS; nothing else
is understood, and no name is ever looked up in Python.
"""

from __future__ import annotations

import ast
import math
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]

LONGEST = 200  # characters
MOST_FACTORS = 16  # of a whole power written as products: GLSL's pow takes no negative base
CONSTANTS = {"pi": math.pi, "e": math.e}


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

_SIGNS: dict[type[ast.operator], str] = {
    ast.Add: "+",
    ast.Sub: "-",
    ast.Mult: "*",
    ast.Div: "/",
    ast.Pow: "**",
}
_TYPED = str.maketrans({"^": "**", "²": "**2", "³": "**3", "−": "-", "·": "*", "×": "*", "π": "pi"})


def parse(text: str, names: tuple[str, ...] = ("u",)) -> Formula:
    """The formula that a user typed, in variables of these names.

    `^` and `²` are powers, as on paper; `2u` and `2 (u+1)` are products. Raises ValueError with
    one line that says what was expected and what was found.
    """
    if len(text) > LONGEST:
        raise ValueError(f"expected a formula of at most {LONGEST} characters, found {len(text)}")
    typed = _with_products(text.translate(_TYPED), (*names, *CONSTANTS))
    try:
        tree = ast.parse(typed.strip(), mode="eval")
    except (SyntaxError, ValueError, MemoryError, RecursionError):
        short = text if len(text) <= 40 else text[:37] + "..."
        raise ValueError(f"expected a formula in {_list(names)}, found {short!r}") from None
    return _formula(tree.body, names, text)


def _with_products(text: str, names: tuple[str, ...]) -> str:
    """The stars that paper leaves out: 2u, 2 (u+1), pi u, (u+1)(u-1)."""
    number = r"(?<![\w.])(?:\d+\.?\d*|\.\d+)(?!\.|e[+-]?\d|\d)(?=\s*[a-z(])"
    name = rf"(?<![A-Za-z_])(?:{'|'.join(names)})(?=\s*\(|\s+[a-z\d])"
    return re.sub(rf"{number}|{name}|\)(?=\s*[\w(])", r"\g<0>*", text)


def _formula(node: ast.expr, names: tuple[str, ...], text: str) -> Formula:
    match node:
        case ast.Constant(value=int() | float() as value) if not isinstance(value, bool):
            return Number(_finite(value, text))
        case ast.Name(id=name) if name in names:
            return Variable(name)
        case ast.Name(id=name) if name in CONSTANTS:
            return Number(CONSTANTS[name])
        case ast.UnaryOp(op=ast.UAdd(), operand=inner):
            return _formula(inner, names, text)
        case ast.UnaryOp(op=ast.USub(), operand=inner):
            return _negative(_formula(inner, names, text))
        case ast.BinOp(left=left, op=op, right=right) if type(op) in _SIGNS:
            sides = _formula(left, names, text), _formula(right, names, text)
            return Operation(_SIGNS[type(op)], *sides)
        case ast.Call(func=ast.Name(id=name), args=[inner], keywords=[]) if name in FUNCTIONS:
            return Function(name, _formula(inner, names, text))
    found = ast.unparse(node)
    raise ValueError(
        f"expected a formula of {_list(names)}, numbers, pi, e, + - * / ^ and "
        f"{_list(tuple(FUNCTIONS))}, found {found!r}"
    )


def _negative(formula: Formula) -> Formula:
    if isinstance(formula, Number):
        return Number(-formula.value)
    return Operation("-", ZERO, formula)


def _finite(value: float, text: str) -> float:
    try:
        number = float(value)
    except OverflowError:
        number = math.inf
    if not math.isfinite(number):
        raise ValueError(f"expected numbers up to 1e308, found a larger one in {text!r}")
    return number


def _list(names: tuple[str, ...]) -> str:
    return ", ".join(names)
