"""Formulas: read as paper has them, differentiated exactly, and nothing else understood."""

from __future__ import annotations

import numpy as np
import pytest

from reparam.geometry.formula import FUNCTIONS, Number, Variable
from reparam.geometry.parsing import LONGEST, parse

U = np.linspace(0.07, 0.93, 23)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("u**3", U**3),
        ("u^3", U**3),
        ("u²(3-2u)", U * U * (3 - 2 * U)),
        ("tan(pi u/4)", np.tan(np.pi * U / 4)),
        ("2 (u+1)(u−1)", 2 * (U + 1) * (U - 1)),
        ("1e-3u + 2.5e1", 1e-3 * U + 25),
        ("-u^2", -(U**2)),
        ("e^u − +1", np.exp(U) - 1),
        ("abs(u - .5)/2", abs(U - 0.5) / 2),
        ("7", 7.0 + 0 * U),
    ],
)
def test_values(text: str, value: np.ndarray) -> None:
    assert np.abs(parse(text)(u=U) - value).max() < 1e-15 * max(1.0, np.abs(value).max())


COMPOSED = [
    "u**u", "(1+u)/(2-u**3)", "(u+1)^-2", "2^u", "sqrt(1-sin(u)^2)", "(1-u)^0", "u/(u^2+1)^1.5",
    "exp(-u)*cos(3u)", "u - u*(u - 1)",
]  # fmt: skip


@pytest.mark.parametrize("text", [*(f"{name}(u/2 + .1)" for name in FUNCTIONS), *COMPOSED])
def test_derivatives(text: str) -> None:
    formula, h = parse(text), 1e-6
    numeric = (formula(u=U + h) - formula(u=U - h)) / (2 * h)
    found = formula.derivative("u")(u=U)
    assert (np.abs(found - numeric) < 1e-8 * (1.0 + np.abs(found))).all()
    assert "u" in formula.glsl() or text == "(1-u)^0"


def test_variables_and_their_change() -> None:
    formula = parse("w cos(u) + (1-w) u", ("u", "w"))
    assert np.abs(formula(u=U, w=0.25) - (0.25 * np.cos(U) + 0.75 * U)).max() < 1e-15
    assert (formula.derivative("w")(u=U, w=0.25) == np.cos(U) - U).all()
    changed = formula.substitute(u=parse("u^2"), w=Number(1.0))
    assert np.abs(changed(u=U) - np.cos(U**2)).max() < 1e-15
    assert Variable("u").substitute(u=Number(2.0)) == Number(2.0)


def test_glsl() -> None:
    assert parse("u^3 - 2").glsl() == "(whole_power((u), 3) - 2.0)"
    assert parse("u^.5 * -3").glsl() == "(pow((u), 0.5) * (-3.0))"


@pytest.mark.parametrize(
    "text",
    [
        "", "u,u", "f(u)", "v", "sin(u,u)", "sin()", "u.real", "__import__('os')", "lambda: 1",
        "u if u else 1", "[u]", "True", "'a'", "1j", "u(", "sin", "u<1", "1e999", "((" * 60,
        "sin(u=1)", "u\n+1 1", "u;u", "0x", "u:=1", "*u",
    ],
)  # fmt: skip
def test_what_is_not_understood(text: str) -> None:
    with pytest.raises(ValueError, match=r"^expected .*, found .*$"):
        parse(text)


def test_too_long() -> None:
    with pytest.raises(ValueError, match="at most 200 characters, found 201"):
        parse("u" * (LONGEST + 1))
    long = "u" + "**u" * 66
    assert np.isfinite(parse(long).derivative("u")(u=U)).all()
    assert np.isfinite(parse("-" * 199 + "u").derivative("u")(u=U)).all()
