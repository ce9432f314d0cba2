"""Formulas that a user types, parsed.

    parse("u^3 (3 - 2 sin(pi u))", ("u",))

is a tree of numbers, variables, the five operations and the functions in FUNCTIONS; nothing else
is understood, and no name is ever looked up in Python.
"""

from __future__ import annotations

import ast
import math
import re

from .formula import FUNCTIONS, ZERO, Formula, Function, Number, Operation, Variable

LONGEST = 200  # characters
CONSTANTS = {"pi": math.pi, "e": math.e}

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
