"""Array parameters: shapes, JSON text that comes back bit for bit, and what is refused."""

from __future__ import annotations

import json
from typing import Annotated

import numpy as np
import pytest

from reparam.errors import UsageError
from reparam.scenes.layers import Array
from reparam.scenes.parameters import Parameter, Points, parameters_of
from reparam.scenes.registry import Scene, load_scene

SQUARE = np.array([[0.0, 1.0], [2.0, 3.0]])


def example(
    four: Annotated[Array, Points((2, 2), "four numbers")] = SQUARE,
    free: Annotated[Array, Points((None, 3), "points in space")] = np.zeros((0, 3)),  # noqa: B008
) -> None: ...


def parameter(name: str) -> Parameter:
    return parameters_of(example)[name]


def test_the_default_is_checked_and_cannot_be_changed() -> None:
    default = parameter("four").default
    assert np.array_equal(default, SQUARE)
    assert not default.flags.writeable
    assert SQUARE.flags.writeable
    assert parameter("four").help == "four numbers"
    assert parameter("free").expected() == "n x 3 numbers as nested JSON lists"


def test_the_text_comes_back_bit_for_bit() -> None:
    random = np.random.default_rng(5)
    values = random.standard_normal((2, 2)) * 10.0 ** random.integers(-300, 17, (2, 2))
    for value in (values, np.array([[0.1, -0.0], [1e18, 5e-324]]), SQUARE):
        again = parameter("four").parse(parameter("four").text(value))
        assert again.tobytes() == np.asarray(value, float).tobytes()
    assert parameter("four").text(SQUARE) == "[[0,1],[2,3]]"
    assert json.loads(json.dumps(parameter("four").row()))["default"] == [[0, 1], [2, 3]]


@pytest.mark.parametrize("text", ["[]", "[[1,2,3]]", "[[1,2,3],[4,5,6.5]]"])
def test_a_free_length(text: str) -> None:
    found = parameter("free").parse(text)
    assert found.shape == (text.count("[") - 1, 3)
    assert parameter("free").text(found) == text


def test_a_value_that_is_in_order_is_not_copied() -> None:
    value = parameter("four").parse("[[1,2],[3,4]]")
    assert parameter("four").check(value) is value


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("[[1,2],[3]]", "lists of unequal length"),
        ("[[1,2],[3,null]]", "nan at [1][1]"),
        ('[[1,2],[3,"x"]]', "something that is no number"),
        ("[[1,2],[3,NaN]]", "nan at [1][1]"),
        ("[[1,2],[-1e19,3]]", "-1e+19 at [1][0]"),
        ("[1,2,3,4]", "4"),
        ("7", "a single number"),
        ("[]", "0"),
        ("[" * 100_000, "'[[["),
        ("texture", "'texture'"),
    ],
)
def test_what_is_refused(text: str, found: str) -> None:
    with pytest.raises(UsageError) as refused:
        parameter("four").parse(text)
    message = str(refused.value)
    assert message.startswith("four: expected 2 x 2 numbers as nested JSON lists, found ")
    assert found in message
    assert len(message) < 140


def test_no_parameter_has_the_name_of_one_of_the_display() -> None:
    def net(net: bool = False) -> None: ...

    assert load_scene("fig5").parameters["points"].points is not None
    with pytest.raises(AssertionError, match=r"\['net'\] are names of the display's"):
        _ = Scene("net", "", net).parameters  # type: ignore[arg-type]
