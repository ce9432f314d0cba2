"""Trim regions as textures. Twin: shaders/lib/trim.glsl reads them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import moderngl
import numpy as np
from numpy.typing import NDArray

from ..errors import GraphicsError
from ..scenes.layers import Patches
from .kept import Kept
from .meshes import triangle_indices
from .nets import NET_WIDTH, net_texture
from .programs import Program

if TYPE_CHECKING:
    from ..geometry.trimming import TrimRegion
    from ..geometry.trimming.packing import PackedTrim

Array = NDArray[np.float64]

UNIT_SQUARE = np.array([[0.0, 1.0, 0.0, 1.0]])


@dataclass(frozen=True)
class TrimTextures:
    """A packed region on the GPU."""

    nodes: moderngl.Texture
    pieces: moderngl.Texture
    shares: moderngl.Texture

    def release(self) -> None:
        """Give the memory back."""
        for texture in (self.nodes, self.pieces, self.shares):
            texture.release()


@dataclass(frozen=True)
class Part:
    """Triangles of a batch: whether fragments are to be decided, and the vertices' numbers."""

    trimmed: bool
    indices: moderngl.Buffer
    count: int


def _release(parts: list[Part]) -> None:
    for part in parts:
        part.indices.release()


class Trims:
    """What programs with TRIMMED read."""

    def __init__(self, ctx: moderngl.Context) -> None:
        self._ctx = ctx
        self._regions: Kept[TrimTextures] = Kept(TrimTextures.release)
        self._parts: Kept[list[Part]] = Kept(_release)
        self._domains: Kept[moderngl.Texture] = Kept(lambda texture: texture.release())

    def bind(self, program: Program, layer: Patches, unit: int) -> None:
        """The layer's region and the domains of its patches, in four units from `unit` on.

        Raises GraphicsError where the region is too large.
        """
        region, domains = layer.trim, layer.domains
        assert region is not None
        packed = region.pack()
        textures = self._regions.get(packed.shares, None, lambda: self._upload(packed))
        where = self._domains.get(
            packed.shares if domains is None else domains,
            region.domain,
            lambda: net_texture(self._ctx, domains_in_square(region, domains)),
        )
        bound = (textures.nodes, textures.pieces, textures.shares, where)
        for number, texture in enumerate(bound, start=unit):
            texture.use(number)
        program.set(
            trim_nodes=unit,
            trim_pieces=unit + 1,
            trim_shares=unit + 2,
            patch_domains=unit + 3,
            trim_side=packed.side,
            domain_stride=0 if domains is None else 1,
        )

    def cells(self, layer: Patches, lines: Array) -> NDArray[np.int8]:
        """What stays of the cells between lines 0 .. 1 of each patch: (patches, k, k), or (1, k,
        k) without domains."""
        region = layer.trim
        assert region is not None
        u0, u1, v0, v1 = domains_in_square(region, layer.domains)[:, 0].T[..., None]
        u, v = u0 + (u1 - u0) * lines, v0 + (v1 - v0) * lines
        ua, va = np.broadcast_arrays(u[:, :-1, None], v[:, None, :-1])
        ub, vb = np.broadcast_arrays(u[:, 1:, None], v[:, None, 1:])
        low = np.stack([np.minimum(ua, ub), np.minimum(va, vb)], -1)
        high = np.stack([np.maximum(ua, ub), np.maximum(va, vb)], -1)
        from ..geometry.trimming.lookup import boxes_kept

        kept = boxes_kept(region.pack(), low.reshape(-1, 2), high.reshape(-1, 2))
        return kept.reshape(low.shape[:-1])

    def parts(self, layer: Patches, level: int, patches: range) -> list[Part]:
        """The triangles of a batch of patches that no curve comes near, and the others; those
        outside are left out. Kept while they are drawn."""
        region = layer.trim
        assert region is not None
        domains = b"" if layer.domains is None else layer.domains.tobytes()
        key = (region.domain, domains, level, patches.start, patches.stop)
        return self._parts.get(
            region.pack().shares, key, lambda: list(self._split(layer, level, patches))
        )

    def _split(self, layer: Patches, level: int, patches: range) -> Iterator[Part]:
        kept = self.cells(layer, np.arange(level + 1) / level)
        own = kept if layer.domains is None else kept[patches.start : patches.stop]
        own = np.broadcast_to(own, (len(patches), level, level))
        indices = triangle_indices(level, len(patches))
        from ..geometry.trimming.lookup import CUT, INSIDE

        for which in (INSIDE, CUT):
            chosen = indices[own == which]
            if len(chosen):
                yield Part(which == CUT, self._ctx.buffer(chosen.tobytes()), chosen.size)

    def _upload(self, packed: PackedTrim) -> TrimTextures:
        rows = -(-len(packed.nodes) // NET_WIDTH)
        if rows > self._ctx.info["GL_MAX_TEXTURE_SIZE"]:
            raise GraphicsError(
                f"expected a trim region of up to {self._ctx.info['GL_MAX_TEXTURE_SIZE']} rows "
                f"of cells, found {rows}"
            )
        nodes = np.zeros((rows * NET_WIDTH, 4), np.int32)
        nodes[: len(packed.nodes)] = packed.nodes
        cells = self._ctx.texture((NET_WIDTH, rows), 4, nodes.tobytes(), dtype="i4")
        cells.filter = (moderngl.NEAREST, moderngl.NEAREST)
        texels = np.round(255.0 * packed.shares).astype(np.uint8)
        shares = self._ctx.texture(texels.shape[::-1], 1, texels.tobytes(), alignment=1)
        shares.repeat_x = shares.repeat_y = False
        shares.filter = (moderngl.LINEAR_MIPMAP_LINEAR, moderngl.LINEAR)
        shares.build_mipmaps()
        pieces = packed.pieces if len(packed.pieces) else np.zeros((1, 3, 4))
        return TrimTextures(cells, net_texture(self._ctx, pieces.astype(np.float64)), shares)

    def sweep(self) -> None:
        """End of a frame."""
        self._regions.sweep()
        self._domains.sweep()
        self._parts.sweep()


def domains_in_square(region: TrimRegion, domains: Array | None) -> Array:
    """The patches' (u0, u1, v0, v1) in the region's unit square: (patches, 1, 4)."""
    given = UNIT_SQUARE if domains is None else domains
    low, high = (region.to_square(given[:, i], given[:, i + 2]) for i in (0, 1))
    return np.stack([low[:, 0], high[:, 0], low[:, 1], high[:, 1]], -1)[:, None, :]
