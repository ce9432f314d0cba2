"""Trim regions as textures. Twin: shaders/lib/trim.glsl reads them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import moderngl
import numpy as np
from numpy.typing import NDArray

from ..errors import GraphicsError
from ..scenes.layers import Patches
from .evaluation import patch_count
from .kept import Kept
from .meshes import triangle_indices
from .nets import NET_WIDTH, net_texture
from .plans import Plan
from .programs import Program
from .tiles import Tiles, tile_rows, tiles

if TYPE_CHECKING:
    from ..geometry.trimming import TrimRegion
    from ..geometry.trimming.packing import PackedTrim

Array = NDArray[np.float64]

TRIM_DEFINES = ("TRIMMED", "ANTIALIASED", "BY_SAMPLE", "TRIM_DIVIDED", "TRIM_GRIDS")

Edges = Literal["pixels", "samples", "shares"]  # what decides: centres, samples, or how much stays
TRIMMED_TILE = 8  # steps: of a trimmed surface only tiles near its curves look them up
UNIT_SQUARE = np.array([[0.0, 1.0, 0.0, 1.0]])


@dataclass(frozen=True)
class TrimTextures:
    """A packed region on the GPU."""

    nodes: moderngl.Texture
    below: moderngl.Texture
    pieces: moderngl.Texture

    def release(self) -> None:
        """Give the memory back."""
        for texture in (self.nodes, self.below, self.pieces):
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
        self._patches: Kept[NDArray[np.int8]] = Kept(lambda _: None)
        self._tiles: Kept[list[tuple[bool, Tiles]]] = Kept(lambda _: None)
        self._domains: Kept[moderngl.Texture] = Kept(lambda texture: texture.release())

    def bind(self, program: Program, layer: Patches, unit: int) -> None:
        """The layer's region and the domains of its patches, in four units from `unit` on.

        Raises GraphicsError where the region is too large.
        """
        region, domains = layer.trim, layer.domains
        assert region is not None
        packed = region.pack()
        where = self._domains.get(
            packed.shares[0] if domains is None else domains,
            region.domain,
            lambda: net_texture(self._ctx, domains_in_square(region, domains)),
        )
        where.use(unit + 3)
        program.set(patch_domains=unit + 3, domain_stride=0 if domains is None else 1)
        self.bind_region(program, region, unit)

    def bind_region(self, program: Program, region: TrimRegion, unit: int) -> None:
        """A region, in three units from `unit` on. Raises GraphicsError where it is too large."""
        packed = region.pack()
        textures = self._regions.get(packed.shares[0], None, lambda: self._upload(packed))
        bound = (textures.nodes, textures.below, textures.pieces)
        for number, texture in enumerate(bound, start=unit):
            texture.use(number)
        program.set(trim_nodes=unit, trim_node_step=_step(textures.nodes))
        program.set(trim_pieces=unit + 2, trim_piece_step=_step(textures.pieces))
        program.set(trim_side=packed.sides[0])
        if program.defines & {"ANTIALIASED", "BY_SAMPLE"}:
            program.set(trim_shares=len(packed.pieces), trim_coarsest=len(packed.shares) - 1)
        if "BY_SAMPLE" in program.defines:
            program.set(samples=self._ctx.fbo.samples)
        if "TRIM_DIVIDED" in program.defines:
            program.set(trim_below=unit + 1)

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

    def patches(self, layer: Patches) -> NDArray[np.int8]:
        """What stays of each patch: (patches,), or (1,) without domains."""
        region = layer.trim
        assert region is not None
        domains = layer.domains if layer.domains is not None else region.pack().shares[0]
        whole = np.array([0.0, 1.0])
        return self._patches.get(domains, region, lambda: self.cells(layer, whole).reshape(-1))

    def tiles(self, layer: Patches, level: int) -> list[tuple[bool, Tiles]]:
        """Tiles for the tessellator: first those that no curve comes near, then those whose
        fragments are to be decided. Kept while they are drawn."""
        region = layer.trim
        assert region is not None
        from ..geometry.trimming.lookup import CUT, WITHIN

        def make() -> list[tuple[bool, Tiles]]:
            count, small = patch_count(layer.net), tiles(level, TRIMMED_TILE)
            lines = np.append(np.arange(0, level, TRIMMED_TILE), level) / level
            kept = self.cells(layer, lines).reshape(-1, len(small))
            kept = np.broadcast_to(kept, (count, len(small)))
            parts = [(which == CUT, tile_rows(count, small, kept == which)) for which in WITHIN]
            return [(cut, rows) for cut, rows in parts if len(rows)]

        key = (region.domain, _bytes(layer.domains), level, patch_count(layer.net))
        return self._tiles.get(region.pack().shares[0], key, make)

    def planned(self, layer: Patches, plan: Plan) -> Iterator[tuple[bool, Plan]]:
        """The patches to draw; of a trimmed surface first those that no curve comes near, then
        those whose fragments are to be decided."""
        if layer.trim is None:
            yield False, plan
            return
        from ..geometry.trimming.lookup import CUT, WITHIN

        kept = np.broadcast_to(self.patches(layer), patch_count(layer.net))[plan.patches]
        for which in WITHIN:
            here = np.flatnonzero(kept == which)
            yield which == CUT, plan.take(here)

    def parts(self, layer: Patches, level: int, patches: range) -> list[Part]:
        """The triangles of a batch of patches that no curve comes near, and the others; those
        outside are left out. Kept while they are drawn."""
        region = layer.trim
        assert region is not None
        key = (region.domain, _bytes(layer.domains), level, patches.start, patches.stop)
        return self._parts.get(
            region.pack().shares[0], key, lambda: list(self._split(layer, level, patches))
        )

    def _split(self, layer: Patches, level: int, patches: range) -> Iterator[Part]:
        kept = self.cells(layer, np.arange(level + 1) / level)
        own = kept if layer.domains is None else kept[patches.start : patches.stop]
        own = np.broadcast_to(own, (len(patches), level, level))
        indices = triangle_indices(level, len(patches))
        from ..geometry.trimming.lookup import CUT, WITHIN

        for which in WITHIN:
            chosen = indices[own == which]
            if len(chosen):
                yield Part(which == CUT, self._ctx.buffer(chosen.tobytes()), chosen.size)

    def _upload(self, packed: PackedTrim) -> TrimTextures:
        from ..geometry.trimming.shares import corner_shares

        widest, below = packed.sides[0], packed.cells
        nodes = np.zeros((len(packed.nodes), 4 if packed.divided else 2), np.int32)
        nodes[:, :2] = packed.nodes
        if packed.divided:
            nodes[:, 2] = packed.divisions - below
        grids, before = np.zeros((sum(packed.sides), widest, nodes.shape[1]), np.int32), 0
        for side in packed.sides:
            own = nodes[before : before + side**2].reshape(side, side, -1)
            grids[2 * (widest - side) : 2 * widest - side, :side] = own
            before += side**2
        shares = [corner_shares(level).reshape(-1) for level in packed.shares]
        fours = np.concatenate([*shares, np.zeros(16, np.uint8)])
        fours = fours[: len(fours) // 16 * 16].view(np.int32).reshape(-1, 4)
        return TrimTextures(
            self._table(grids.reshape(-1, nodes.shape[1]), "i4", widest),
            self._table(nodes[below:], "i4"),
            self._table(np.concatenate([packed.pieces, fours]), "i4"),
        )

    def _table(
        self,
        rows: NDArray[np.int32] | NDArray[np.float32],
        dtype: str,
        width: int = NET_WIDTH,
    ) -> moderngl.Texture:
        """A texel a row, wrapped at a width."""
        height = max(-(-len(rows) // width), 1)
        if height > self._ctx.info["GL_MAX_TEXTURE_SIZE"]:
            raise GraphicsError(
                f"expected a trim region of up to {self._ctx.info['GL_MAX_TEXTURE_SIZE']} rows "
                f"of cells and of pieces, found {height}"
            )
        texels = np.zeros((height * width, rows.shape[1]), rows.dtype)
        texels[: len(rows)] = rows
        texture = self._ctx.texture((width, height), rows.shape[1], texels.tobytes(), dtype=dtype)
        texture.filter = (moderngl.NEAREST, moderngl.NEAREST)
        return texture

    def sweep(self) -> None:
        """End of a frame."""
        self._regions.sweep()
        self._domains.sweep()
        self._parts.sweep()
        self._tiles.sweep()
        self._patches.sweep()


def trim_defines(region: TrimRegion, edges: Edges) -> dict[str, int]:
    """The defines of what is trimmed by a region."""
    wanted = {
        "TRIMMED": True,
        "ANTIALIASED": edges == "shares",
        "BY_SAMPLE": edges == "samples",
        "TRIM_DIVIDED": region.pack().divided,
    }
    grids = {"TRIM_GRIDS": len(region.pack().sides)}
    return grids | {name: 1 for name, on in wanted.items() if on}


def decided(defines: dict[str, int | str], trimmed: bool) -> dict[str, int | str]:
    """The defines for what is trimmed, or for a part that no curve comes near."""
    return {k: v for k, v in defines.items() if trimmed or k not in TRIM_DEFINES}


def _step(texture: moderngl.Texture) -> tuple[float, float]:
    return 1.0 / texture.width, 1.0 / texture.height


def _bytes(domains: Array | None) -> bytes:
    return b"" if domains is None else domains.tobytes()


def domains_in_square(region: TrimRegion, domains: Array | None) -> Array:
    """The patches' (u0, u1, v0, v1) in the region's unit square: (patches, 1, 4)."""
    given = UNIT_SQUARE if domains is None else domains
    low, high = (region.to_square(given[:, i], given[:, i + 2]) for i in (0, 1))
    return np.stack([low[:, 0], high[:, 0], low[:, 1], high[:, 1]], -1)[:, None, :]
