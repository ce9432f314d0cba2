"""`reparam accuracy`: how many pixels drawn points are off, measured at every fragment, what a
picture shows on the surface, and the outline."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np

from .geometry.net import Array
from .gpu.accuracy import Drawn, deviations, picture_deviations, silhouette
from .gpu.arrangement import arrange
from .gpu.plans import Tolerance, uniform_plan
from .gpu.recorded_meshes import RecordedMeshes, recorded_meshes
from .scenes.layers import Patches, Recorded
from .snapshot import Studio
from .subject import Subject

FORGIVEN = 1e-4  # share of the fragments: triangles thinner than the rasteriser's grid


@dataclass(frozen=True)
class Accuracy:
    """A layer drawn alone, without its trims, or of a recorded one what is filled meshes of one
    shape: pixels between a fragment's centre and the exact surface point of its own patch and
    (u, v); the same for what its picture shows there, if it has a map of its own; and between the
    drawn outline and the exact one (gpu/accuracy.py)."""

    layer: int
    evaluator: str
    patches: int  # in view
    triangles: int
    fragments: int
    mean: float
    most: float  # of all fragments but the FORGIVEN share
    worst: float
    silhouette: float
    picture: float | None = None  # as `most`
    tolerance: float = 0.0  # 0: nothing is promised
    recorded: bool = False  # by glEvalMesh2, in its own grid; else in one level if not by tolerance

    @property
    def ok(self) -> bool:
        """Whether the tolerance is kept."""
        most = max(self.most, self.picture or 0.0, self.silhouette)
        return not self.tolerance or most <= self.tolerance

    def row(self) -> dict[str, Any]:
        """As JSON has it."""
        return {**asdict(self), "ok": self.ok}

    def line(self) -> str:
        """As the table has it."""
        asked = f"<= {self.tolerance:g}" if self.tolerance else "one level"
        asked = "as recorded" if self.recorded else asked
        verdict = "ok  " if self.ok else "FAIL"
        picture = "" if self.picture is None else f"  picture {self.picture:.4f}"
        return (
            f"{verdict} layer {self.layer} {self.evaluator:12} {self.patches:6} patches "
            f"{self.triangles:9} triangles {self.fragments:8} fragments   "
            f"pixels off: mean {self.mean:.4f}  most {self.most:.4f}  worst {self.worst:.4f}"
            f"{picture}  outline {self.silhouette:.4f}   {asked}"
        )


def measure(studio: Studio, subject: Subject, size: tuple[int, int]) -> Iterator[Accuracy]:
    """Each Patches layer of the subject, framed as `--plain` does, by the studio's evaluator, or
    by each that there is; and what Recorded layers have of filled meshes."""
    painter, display = studio.painter, subject.display
    panel = arrange(
        subject.figure().plain(), size, subject.views, True, False, display.perspective
    )[0]
    if studio.evaluator:
        evaluators: tuple[str, ...] = (painter.capabilities.evaluator(studio.evaluator),)
    else:
        evaluators = painter.capabilities.evaluators
    surfaces = [each for each in panel.space.layers if isinstance(each, Patches | Recorded)]
    # Alone they have another outline.
    layers = [
        replace(each, solid=False) if isinstance(each, Patches) else each for each in surfaces
    ]
    beside = tuple(layer for layer in layers if isinstance(layer, Patches))
    for number, layer in enumerate(layers, start=1):
        if isinstance(layer, Recorded):
            for meshes in recorded_meshes(painter, layer.recording, panel.camera, size):
                yield measured_meshes(number, meshes)
            continue
        for evaluator in evaluators:
            tolerance = Tolerance(display.tolerance, size, beside)
            plan = (
                painter.surfaces.adaptive.plan(layer, panel.camera, evaluator, tolerance)
                if display.tolerance
                else uniform_plan(layer, display.level)
            )
            yield measured(
                number,
                Drawn(painter, layer, panel.camera, evaluator, plan, size),
                display.tolerance,
            )


def measured_meshes(number: int, meshes: RecordedMeshes) -> Accuracy:
    """Recorded ones of one shape, in the grid that glMapGrid2 gave them."""
    found = _measured(meshes, number, "vertex", len(meshes.nets), meshes.triangles)
    return replace(found, recorded=True)


def measured(number: int, drawn: Drawn, tolerance: float) -> Accuracy:
    """One layer by one evaluator."""
    plan, texture, picture = drawn.plan, drawn.layer.texture, None
    if texture is not None and not texture.exact and texture.net is not drawn.layer.net:
        picture = _most(picture_deviations(drawn))
    found = _measured(drawn, number, drawn.evaluator, len(plan.patches), plan.triangles())
    return replace(found, picture=picture, tolerance=tolerance)


def _measured(
    drawn: Drawn | RecordedMeshes, number: int, evaluator: str, patches: int, triangles: int
) -> Accuracy:
    off = _found(deviations(drawn))
    return Accuracy(
        layer=number,
        evaluator=evaluator,
        patches=patches,
        triangles=triangles,
        fragments=len(off),
        mean=float(off.mean()),
        most=_most(off),
        worst=float(off.max()),
        silhouette=silhouette(drawn),
    )


def _found(off: Array) -> Array:
    return off if len(off) else np.zeros(1)


def _most(off: Array) -> float:
    return float(np.quantile(off, 1.0 - FORGIVEN)) if len(off) else 0.0
