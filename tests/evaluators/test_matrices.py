"""glOrtho, gluPerspective, glRotatef and their kin, from what OpenGL says they do."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import ArrayLike, NDArray

from reparam.evaluators import InvalidValue, Light
from reparam.evaluators.matrices import (
    frustum,
    look_at,
    ortho,
    perspective,
    rotate,
    scale,
    translate,
)


def moved(matrix: NDArray[np.float64], point: ArrayLike) -> NDArray[np.float64]:
    found = matrix @ np.append(point, 1.0)
    return np.asarray(found[:3] / found[3])


@pytest.mark.parametrize("make", [ortho, frustum])
def test_the_view_volume_becomes_the_cube(make: object) -> None:
    """Its nearest and farthest corners on the diagonal; the far ones of a frustum are wider."""
    matrix = make(-1.0, 3.0, -2.0, 1.0, 2.0, 6.0)  # type: ignore[operator]
    wider = 3.0 if make is frustum else 1.0
    np.testing.assert_allclose(moved(matrix, (-1, -2, -2)), (-1, -1, -1), atol=1e-15)
    far = (3 * wider, 1 * wider, -6)
    np.testing.assert_allclose(moved(matrix, far), (1, 1, 1), atol=1e-15)


def test_perspective_opens_by_its_angle() -> None:
    matrix = perspective(90.0, 2.0, 1.0, 10.0)
    np.testing.assert_allclose(moved(matrix, (2, 1, -1)), (1, 1, -1), atol=1e-15)


def test_look_at_puts_the_center_ahead_and_up_upwards() -> None:
    matrix = look_at((1, 2, 3), (1, 2, -7), (1, 1, 0))
    np.testing.assert_allclose(moved(matrix, (1, 2, -7)), (0, 0, -10), atol=1e-14)
    x, y, _ = moved(matrix, (2, 3, 3))
    assert abs(x) < 1e-14
    assert y == pytest.approx(np.sqrt(2))


def test_calls_multiply_from_the_right() -> None:
    matrix = translate(0, 0, -5) @ rotate(90, 0, 0, 2) @ scale(2, 3, 4)
    np.testing.assert_allclose(moved(matrix, (1, 1, 1)), (-3, 2, -1), atol=1e-15)


def test_a_light_takes_the_arrays_of_c() -> None:
    """Four numbers a colour, whole numbers, numpy arrays; others are refused by name."""
    light = Light(position=(1, 2, 2, 0), ambient=np.array([1, 0, 0, 1]), diffuse=[1, 1, 1, 1])
    assert light.position == (1.0, 2.0, 2.0, 0.0)
    assert light.ambient == (1.0, 0.0, 0.0)
    with pytest.raises(InvalidValue, match="Light: position: expected 4 numbers, found 3"):
        Light(position=(0, 0, 1))
    with pytest.raises(InvalidValue, match="Light: specular: expected a finite number"):
        Light(specular=(0, 0, float("nan")))
