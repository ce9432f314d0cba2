"""Unit normals of the projected surface. Twin: shaders/lib/normal.glsl, same names."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .evaluate import evaluate, evaluate_derivatives

Array = NDArray[np.float64]

SINGULAR_SINE = 1e-5  # below this sine of the angle between p_u and p_v: look for the limit
SINGULAR_STEP = 1e-3  # how far towards the patch's centre, of the way there
SINGULAR_FACTOR = 30.0  # and how much further if it is singular there too


def safe_normalize(vectors: Array) -> Array:
    """Unit vectors (..., 3) without overflow; the zero vector stays zero."""
    largest = np.abs(vectors).max(-1, keepdims=True)
    scaled = vectors / np.where(largest > 0.0, largest, 1.0)
    length = np.linalg.norm(scaled, axis=-1, keepdims=True)
    return np.asarray(scaled / np.where(length > 0.0, length, 1.0))


def projected_derivative(points: Array, derivatives: Array) -> Array:
    """w times the derivative of X/w by the quotient rule, from (..., 4) points and derivatives.

    None, that is zero, at infinity (w = 0).
    """
    weights = points[..., 3:]
    affine = points[..., :3] / np.where(weights != 0.0, weights, 1.0)
    return np.where(weights != 0.0, derivatives[..., :3] - derivatives[..., 3:] * affine, 0.0)


def largest_component(vectors: Array) -> Array:
    """The largest absolute component of vectors (..., 3): shape (..., 1)."""
    return np.asarray(np.abs(vectors).max(-1, keepdims=True))


def cross_of_tangents(net: Array, u: ArrayLike, v: ArrayLike) -> Array:
    """Cross product of the tangents along u and v, each as long as its largest component is 1:
    so its length is the sine between them, but for a factor of at most 3.

    Zero too where one tangent is tiny beside the other: at a pole it is rounding alone.
    """
    points = evaluate(net, u, v)
    along_u, along_v = (projected_derivative(points, d) for d in evaluate_derivatives(net, u, v))
    size_u, size_v = largest_component(along_u), largest_component(along_v)
    tiny = np.minimum(size_u, size_v) <= SINGULAR_SINE * np.maximum(size_u, size_v)
    size_u, size_v = np.where(tiny, 1.0, size_u), np.where(tiny, 1.0, size_v)
    return np.where(tiny, 0.0, np.cross(along_u / size_u, along_v / size_v))


def surface_normal(net: Array, u: ArrayLike, v: ArrayLike) -> Array:
    """p_u x p_v normalised (GL_AUTO_NORMAL), shape (..., 3).

    Where it vanishes, at a pole or at a corner of r where p_u = -p_v, the normal a little
    further inside is taken: the limit instead of OpenGL's zero vector. Where there is none
    (all points collinear), any unit vector, never NaN.
    """
    u, v = np.asarray(u, dtype=np.float64), np.asarray(v, dtype=np.float64)
    normal = cross_of_tangents(net, u, v)
    inward = SINGULAR_STEP
    while (singular := is_singular(normal)).any() and inward < 1.0:
        inside = (t + inward * (0.5 - t) for t in (u, v))
        normal = np.where(singular[..., None], cross_of_tangents(net, *inside), normal)
        inward *= SINGULAR_FACTOR
    nowhere = ~normal.any(-1, keepdims=True)
    return safe_normalize(np.where(nowhere, np.array([0.0, 0.0, 1.0]), normal))


def is_singular(normals: Array) -> NDArray[np.bool_]:
    """Whether a cross product of tangents (..., 3) says nothing about the normal."""
    return np.asarray(np.linalg.norm(normals, axis=-1) <= SINGULAR_SINE)
