"""What libGLU drew by itself, in renderer mode: triangles or segments with no (u, v).

Its triangles are captured vertex by vertex, as homogeneous points with the values of all maps.
Where they lie is found, in float64: from the nearest of many points of each piece, by
Gauss-Newton in all that the maps feed. From then on they are as those of the tessellator mode.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from evaluator_truth import Array

from reparam.evaluators.maps import Attribute
from reparam.evaluators.splines import Nurbs
from reparam.geometry.evaluate import evaluate, evaluate_derivatives

MAPPED: dict[str, Attribute] = {"pos": "vertex", "color": "color", "tex": "texcoord"}
DENSE = 17  # points each way of a piece to begin at
STARTS = 4
NEWTON = 12


def drawn_curve(nurbs: Nurbs, outputs: dict[str, Any]) -> dict[str, Any]:
    """Each segment a primitive of its own."""
    return {"prims": _apart(_fields(nurbs, outputs["lines"]), "LINE_STRIP", 2)}


def drawn_surface(nurbs: Nurbs, outputs: dict[str, Any]) -> dict[str, Any]:
    """Each triangle a primitive of its own, with (u, v)."""
    fields = _fields(nurbs, outputs["verts"])
    flat = np.concatenate([fields[name] for name in MAPPED if name in fields], 1)
    uv = _located(
        nurbs, [name for name in MAPPED if name in fields], flat.reshape(-1, 3, flat.shape[1])
    )
    return {"prims": _apart({**fields, "uv": uv.reshape(-1, 2)}, "TRIANGLES", 3)}


def _apart(fields: dict[str, Array], mode: str, corners: int) -> list[dict[str, Any]]:
    count = len(fields["pos"]) // corners
    return [
        {"mode": mode, **{n: v[corners * i : corners * (i + 1)] for n, v in fields.items()}}
        for i in range(count)
    ]


def _fields(nurbs: Nurbs, captured: dict[str, Any]) -> dict[str, Array]:
    """What the maps feed, as many numbers as they have; normals where there are some."""
    found = {"pos": np.array(captured["pos"], float)}
    for name, attribute in MAPPED.items():
        spline = nurbs.by_attribute.get(attribute)
        if spline is not None and name in captured:
            width = 4 if name == "pos" else spline.target.components
            found[name] = np.array(captured[name], float)[:, :width]
    normals = np.array(captured.get("normal", ()), float)
    if len(normals) and not (normals == UNFED).all():
        found["normal"] = normals
    return found


UNFED = 9.0  # the current value that the capture sets: no map and no GL_AUTO_NORMAL


def _located(nurbs: Nurbs, names: list[str], wanted: Array) -> Array:
    """(u, v) of triangles (k, 3, fields), all three corners in one piece: (k, 3, 2)."""
    nets = [nurbs.pieces(MAPPED[name]) for name in names]
    widths = [4 if name == "pos" else nurbs.by_attribute[MAPPED[name]].target.components
              for name in names]  # fmt: skip
    best, found = np.full(len(wanted), np.inf), np.zeros((*wanted.shape[:2], 2))
    columns, rows = nets[0].shape[:2]
    for s in range(columns):
        for t in range(rows):
            local, off = _nearest(
                [net[s, t] for net in nets], widths, wanted.reshape(-1, wanted.shape[-1])
            )
            off = off.reshape(-1, 3).max(1)
            low = np.array([nurbs.ends(0)[s], nurbs.ends(1)[t]])
            high = np.array([nurbs.ends(0)[s + 1], nurbs.ends(1)[t + 1]])
            better = off < best
            found[better] = (low + (high - low) * local).reshape(-1, 3, 2)[better]
            best = np.minimum(best, off)
    return found


def _nearest(nets: list[Array], widths: list[int], wanted: Array) -> tuple[Array, Array]:
    """Parameters in [0,1]^2 of the points nearest to wanted (k, fields), and how far these are."""

    def values(u: Array, v: Array) -> Array:
        return np.concatenate(
            [evaluate(n, u, v)[:, :w] for n, w in zip(nets, widths, strict=True)], 1
        )

    def newton(at: Array) -> tuple[Array, Array]:
        for _ in range(NEWTON):
            off = wanted - values(*at.T)
            tangents = [evaluate_derivatives(net, *at.T) for net in nets]
            slopes = np.stack(
                [np.concatenate([d[axis][:, :w] for d, w in zip(tangents, widths, strict=True)], 1)
                 for axis in (0, 1)], -1)  # fmt: skip
            normal = np.einsum("kfi,kfj->kij", slopes, slopes)
            normal += 1e-12 * np.trace(normal, axis1=1, axis2=2)[:, None, None] * np.eye(2) + 1e-300
            steps = np.linalg.solve(normal, np.einsum("kfi,kf->ki", slopes, off)[..., None])[..., 0]
            at = np.clip(at + steps, 0.0, 1.0)
        return at, np.abs(wanted - values(*at.T)).max(-1)

    line = np.linspace(0.0, 1.0, DENSE)
    u, v = (x.ravel() for x in np.meshgrid(line, line))
    samples = values(u, v)
    away = (samples**2).sum(1) - 2.0 * wanted @ samples.T
    found = [newton(np.stack([u, v], -1)[start]) for start in np.argsort(away, 1)[:, :STARTS].T]
    at, off = (np.stack(arrays) for arrays in zip(*found, strict=True))
    best = off.argmin(0)
    return at[best, np.arange(len(wanted))], off.min(0)
