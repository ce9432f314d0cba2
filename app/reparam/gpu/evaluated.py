"""What the evaluators recorded, evaluated and handed back as arrays."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from ..evaluators.grids import Indices, grid_points, pairs, primitive_indices
from ..evaluators.maps import FILL, Array, Attribute
from ..evaluators.recording import (
    HAVE_CURRENT,
    Batch,
    Collection,
    Evaluated,
    Recording,
    Single,
)
from .context import bound
from .readback import read_at

if TYPE_CHECKING:
    from .painter import Painter

SIZES: dict[Attribute, int] = {"vertex": 4, "normal": 3, "color": 4, "texcoord": 4, "index": 1}


def read_recording(
    painter: Painter, recording: Recording, evaluator: str | None = None
) -> list[Evaluated]:
    """What each glEvalMesh and each glBegin ... glEnd made, in their order.

    `evaluator` is "vertex", the default, or "tessellation". Raises GraphicsError if the
    context has not that one.
    """
    found: list[Evaluated] = []
    with bound(painter.ctx, painter.nowhere):
        for item in recording.batches:
            if isinstance(item, Batch):
                found.extend(read_batch(painter, item, evaluator or "vertex"))
            else:
                found.append(read_collection(painter, item, evaluator or "vertex"))
    painter.evaluation.sweep()
    return found


def read_batch(painter: Painter, batch: Batch, evaluator: str) -> Iterator[Evaluated]:
    """All meshes of a batch, evaluated together."""
    parameters = grid_points(batch.first.grid)
    arrays: dict[Attribute, Single] = {
        attribute: np.broadcast_to(
            np.array(batch.first.current.value(attribute)[: SIZES[attribute]], np.float32),
            (len(batch.meshes), len(parameters), SIZES[attribute]),
        )
        for attribute in HAVE_CURRENT
    }
    for attribute, feed in batch.feeds.items():
        normals = attribute == "vertex" and batch.first.maps.auto_normal
        read = read_at(painter, evaluator, feed.net, feed.pairs, normals)
        shape = (len(batch.meshes), *read.points.shape[1:])
        arrays[attribute] = np.broadcast_to(exact(read.points, feed.components, attribute), shape)[
            ..., : SIZES[attribute]
        ]
        if normals:
            arrays["normal"] = np.broadcast_to(read.normals, (*shape[:-1], 3))
    for i in range(len(batch.meshes)):
        yield evaluated({a: array[i] for a, array in arrays.items()}, parameters, batch.indices)


def read_collection(painter: Painter, collection: Collection, evaluator: str) -> Evaluated:
    """Evaluated and plain vertices in their order."""
    arrays: dict[Attribute, Single] = {
        attribute: value[:, : SIZES[attribute]].astype(np.float32)
        for attribute, value in collection.given.items()
    }
    for dimension, maps in collection.maps.items():
        which = collection.dimensions == dimension
        for attribute, feed in maps.by_attribute.items():
            where = pairs(collection.parameters[which], feed.rising)
            normals = attribute == "vertex" and maps.auto_normal
            read = read_at(painter, evaluator, feed.net, where, normals)
            points = exact(read.points[0], feed.target.components, attribute)
            arrays[attribute][which] = points[:, : SIZES[attribute]]
            if normals:
                arrays["normal"][which] = read.normals[0]
    _, indices = primitive_indices(collection.mode, len(collection.dimensions))
    return evaluated(arrays, collection.parameters, indices)


def exact(points: Single, components: int, attribute: Attribute) -> Single:
    """Points (..., 4) with the components that the map lacks exactly as OpenGL has them."""
    filled = points.copy()
    filled[..., components:] = FILL[attribute][components:]
    return filled


def evaluated(arrays: dict[Attribute, Single], parameters: Array, indices: Indices) -> Evaluated:
    """All arrays of one mesh together."""
    return Evaluated(
        arrays["vertex"],
        arrays["normal"],
        arrays["color"],
        arrays["texcoord"],
        arrays["index"][:, 0],
        parameters,
        indices,
    )
