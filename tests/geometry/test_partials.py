"""Partial derivatives: against finite differences of the exact kind, and of rational surfaces."""

from __future__ import annotations

import numpy as np

from reparam.geometry.evaluate import evaluate, project
from reparam.geometry.net import Array, control_net
from reparam.geometry.partials import partials

random = np.random.default_rng(1)


def differences(net: Array, u: float, v: float, i: int, j: int, h: float = 1e-2) -> Array:
    """Central differences of order i, j, extrapolated twice (Richardson)."""

    def raw(step: float) -> Array:
        total = np.zeros(3)
        for a in range(i + 1):
            for b in range(j + 1):
                sign = (-1.0) ** (a + b)
                binomial = _choose(i, a) * _choose(j, b)
                place = u + (i / 2 - a) * step, v + (j / 2 - b) * step
                total += sign * binomial * project(evaluate(net, *place))
        return total / step ** (i + j)

    one, two, three = raw(h), raw(h / 2), raw(h / 4)
    first, second = (4 * two - one) / 3, (4 * three - two) / 3
    return np.asarray((16 * second - first) / 15)


def _choose(n: int, k: int) -> int:
    return [[1], [1, 1], [1, 2, 1], [1, 3, 3, 1]][n][k]


def test_against_differences() -> None:
    for weights in (None, random.uniform(0.5, 2.0, (4, 3))):
        net = control_net(random.normal(size=(4, 3, 3)), weights)
        found = partials(net, 0.3, 0.6, 3)
        for i in range(4):
            for j in range(4 - i):
                expected = differences(net, 0.3, 0.6, i, j)
                assert np.abs(found[i, j] - expected).max() <= 1e-5, (i, j)
        assert np.isnan(found[2, 2]).all()


def test_degree_zero_and_many_nets() -> None:
    nets = control_net(random.normal(size=(5, 1, 3, 3)))
    found = partials(nets, np.zeros(4), np.linspace(0, 1, 4), 2)
    assert found.shape == (3, 3, 5, 4, 3)
    assert (found[1, 0] == 0.0).all()
    assert (found[2, 0] == 0.0).all()
    assert found[0, 1].any()
