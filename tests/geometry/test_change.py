"""Changes of variables: derivatives, inverses, the chain rule, and what is refused."""

from __future__ import annotations

import numpy as np
import pytest

from reparam.geometry.arclength import ArcLength
from reparam.geometry.change import NAMED, NAMES, formula_change, named_change
from reparam.geometry.curve import curve_net, speed

U = np.linspace(0.0, 1.0, 41)
INNER = U[1:-1]
PARABOLA = curve_net([[0, 0], [0.5, 0], [1, 1]])


def of_parabola(u: np.ndarray) -> np.ndarray:
    return speed(PARABOLA, u)


@pytest.mark.parametrize("name", [*NAMES, "u**3", "sin(pi u/2)^2", "(exp(u)-1)/(e-1)"])
def test_a_change_and_its_inverse(name: str) -> None:
    change = named_change(name, of_parabola)
    assert np.abs(change.forward(U)[[0, -1]] - [0.0, 1.0]).max() < 1e-15
    assert (
        np.abs(change.inverse(change.forward(U)) - U).max() < 1e-7
    )  # of a square: half the digits
    assert np.abs(change.forward(change.inverse(U)) - U).max() < 1e-14
    h = 1e-6
    numeric = (change.forward(INNER + h) - change.forward(INNER - h)) / (2 * h)
    assert np.abs(change.derivative(INNER) - numeric).max() < 1e-7
    assert (change.derivative(U) >= 0.0).all()


def test_arc_length_makes_the_speed_constant() -> None:
    change = named_change("arclength", of_parabola)
    found = of_parabola(change.forward(U)) * change.derivative(U)
    assert np.abs(found - ArcLength(of_parabola).length).max() < 1e-13
    with pytest.raises(ValueError, match="expected a curve"):
        named_change("arclength")


def test_each_change_with_a_formula_can_be_written_as_glsl() -> None:
    for name in NAMED:
        formula = named_change(name).formula
        assert formula is not None
        assert "(u)" in formula.glsl()


def test_a_derivative_that_is_undefined_at_an_end_is_the_limit() -> None:
    assert abs(formula_change("u sqrt(u)").derivative(np.array([0.0]))[0]) < 1e-4


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("1/u", "to be finite on [0,1], found inf at u = 0"),
        ("sqrt(u-.5)/sqrt(.5)", "found nan at u = 0"),
        ("2u", "to be 1 at u = 1, found 2"),
        ("1-u", "to be 0 at u = 0, found 1"),
        ("sin(5 pi u/2)", "to increase on [0,1], found that it does not at u ="),
        ("u + sin(2 pi u)", "to increase"),
        ("abs(u-.5) + u - .5", "to increase on [0,1]"),
        ("u + v", "expected a formula of u, numbers"),
        ("squar", "or one of identity, square"),
    ],
)  # fmt: skip
def test_what_is_no_change(text: str, found: str) -> None:
    with pytest.raises(ValueError, match=r"^change: expected") as refused:
        named_change(text)
    assert found in str(refused.value)
