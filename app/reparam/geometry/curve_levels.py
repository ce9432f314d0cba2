"""Into how many segments a curve is cut so that none is off by more than so many pixels.

As in levels.py, for curves and any camera, from numbers that do not depend on the view. Let X be
the curve's homogeneous points less w times its middle, E and E_w what bounds |X''| and |w''|:
second differences times d (d-1). An eye at distance D sees the curve enlarged up to e times, in a
direction up to tau = tan(angle) away from the axis, with s = sqrt(1 + tau^2), and spread up to
rho = r e s around its middle, r being the curve's radius. A chord over h is then off, at the same
parameter, by at most

    h^2/8 * e/w * (E s + rho (E_w + E/D))

in the view plane: the numerator bounds the second derivative of  x - q w'  for every image point q
of the curve, with  w' = w - z/D  linear in the homogeneous point.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from .bernstein import bernstein
from .camera import Camera
from .curve import restrict
from .edge_levels import STEPS
from .net import Array

Ints = NDArray[np.int64]

FINEST = 1024  # segments of a curve
HALVINGS = 4  # until a curve's weights are positive


@dataclass(frozen=True)
class Bends:
    """Of each of k curves: E / w and E_w / w, the curve's middle (k, 3), and its radius."""

    off: Array
    off_w: Array
    middle: Array
    radius: Array

    def steps(self, camera: Camera, pixels: float, tolerance: float) -> Ints:
        """Segments that are enough, (k,), of `STEPS` up to FINEST; a unit of the view plane is
        `pixels` pixels."""
        seen = (self.middle - camera.pivot) @ camera.rotation.T
        inverse = 1.0 / camera.distance
        with np.errstate(divide="ignore", invalid="ignore"):
            clear = 1.0 - (seen[:, 2] + self.radius) * inverse
            enlarged = np.where(clear > 0.0, 1.0 / clear, np.inf)
            reach = (np.hypot(seen[:, 0], seen[:, 1]) + self.radius) * enlarged
            slant = np.hypot(1.0, reach * inverse)
            rho = self.radius * enlarged * slant
            off = self.off * slant + rho * (self.off_w + self.off * inverse)
            need = off * enlarged * pixels / (8.0 * tolerance)
        need = np.where(np.isnan(need), np.inf, need)
        exact = np.sqrt(np.clip(need, 1.0, FINEST**2))
        return STEPS[np.searchsorted(STEPS, exact - 1e-9)]


def curve_bends(nets: Array, span: tuple[float, float] = (0.0, 1.0)) -> Bends:
    """Of curves (k, n, 4) over a span of their parameter; infinite where a weight stays <= 0."""
    return _bends(restrict(nets, *span), HALVINGS)


def iso_bends(
    net: Array, u: Sequence[float], v: Sequence[float], span: tuple[float, float]
) -> Bends:
    """Of the curves u = const and v = const of patches (m, n, 4) or (patches, m, n, 4)."""
    nets = net if net.ndim == 4 else net[None]
    found = [
        curve_bends(curves.reshape(-1, *curves.shape[-2:]), span)
        for curves in (
            np.einsum("ki,pijc->kpjc", bernstein(nets.shape[1] - 1, u), nets),
            np.einsum("kj,pijc->kpic", bernstein(nets.shape[2] - 1, v), nets),
        )
    ]
    return Bends(*(np.concatenate([getattr(b, f.name) for b in found]) for f in fields(Bends)))


def _bends(nets: Array, halvings: int) -> Bends:
    weight = nets[..., 3:]
    positive = np.asarray((weight > 0.0).all((-2, -1)))
    places = nets[..., :3] / np.where(weight > 0.0, weight, 1.0)
    low, high = places.min(-2), places.max(-2)
    middle, radius = (low + high) / 2.0, _length(high - low) / 2.0
    degree = nets.shape[-2] - 1
    second = degree * (degree - 1) * np.diff(nets, 2, axis=-2)
    moved = second[..., :3] - second[..., 3:] * middle[:, None]
    least = np.where(positive, weight.min((-2, -1)), 1.0)
    off = _length(moved).max(-1, initial=0.0) / least
    off_w = np.abs(second[..., 3]).max(-1, initial=0.0) / least
    found = Bends(np.where(positive, off, np.inf), off_w, middle, radius)
    if not positive.all() and halvings:
        _mend(found, ~positive, nets[~positive], halvings - 1)
    return found


def _mend(found: Bends, which: NDArray[np.bool_], nets: Array, halvings: int) -> None:
    """Of both halves of curves: in half as many segments each is as bent as 4 times that."""
    halves = [_bends(restrict(nets, *ends), halvings) for ends in ((0.0, 0.5), (0.5, 1.0))]
    corners = [h.middle + side * h.radius[:, None] for h in halves for side in (-1.0, 1.0)]
    low, high = np.min(corners, axis=0), np.max(corners, axis=0)
    found.off[which] = 4.0 * np.maximum(halves[0].off, halves[1].off)
    found.off_w[which] = 4.0 * np.maximum(halves[0].off_w, halves[1].off_w)
    found.middle[which] = (low + high) / 2.0
    found.radius[which] = _length(high - low) / 2.0


def _length(vectors: Array) -> Array:
    return np.asarray(np.sqrt(np.einsum("...c,...c->...", vectors, vectors)))
