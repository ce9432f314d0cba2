"""What plain pictures must show, known from float64: no stored image is needed."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

from reparam.assets import texture_path
from reparam.geometry import planar_maps
from reparam.geometry.body import Patch, body
from reparam.geometry.evaluate import evaluate
from reparam.geometry.net import control_net
from reparam.geometry.regions import count_regions, label_regions
from reparam.scenes.registry import file_scene
from reparam.snapshot import Studio
from reparam.subject import scene_subject

Array = NDArray[np.float64]
Picture = NDArray[np.uint8]
Mask = NDArray[np.bool_]

MARGIN = 1.08  # of the frame about the patch's box
WHOLE = 3.0 * MARGIN  # side of a square plain picture of r
EXACT = {"filter": "nearest", "samples": 1}
GROUND = np.array([0.0, 0.0, 255.0])
_TILE = np.asarray(Image.open(texture_path("checkerboard")).convert("RGB"), float)
LIGHT, DARK = _TILE[0, 0], _TILE[-1, 0]

pytestmark = pytest.mark.usefixtures("evaluator")


def axes(size: int, whole: float = WHOLE) -> tuple[Array, Array]:
    """(x, y) of the pixels' centres, top row first."""
    t = ((np.arange(size) + 0.5) / size - 0.5) * whole
    x, y = np.meshgrid(t, -t)
    return x, y


def pixels(x: Array, y: Array, size: int) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Row and column of the pixels that hold the points."""
    row, column = (np.floor((c / WHOLE + 0.5) * size).astype(np.int64) for c in (-y, x))
    return row, column


def r(u: Array, v: Array) -> tuple[Array, Array]:
    """Formula (13) in powers, not in the code's coefficients."""
    a, b = 2.0 * u - 1.0, 2.0 * v - 1.0
    return b * (3.0 - a * a) / 2.0, -a * (3.0 - b * b) / 2.0


def bright(s: Array, t: Array, checks: int) -> Mask:
    """The checkerboard over [-1,1]^2, dark at (-1,-1)."""
    return (np.floor((s + 1.0) * checks / 2.0) + np.floor((t + 1.0) * checks / 2.0)) % 2 == 1


def covered(picture: Picture) -> Mask:
    return ~(picture == GROUND).all(-1)


def spread(values: Array, ufunc: np.ufunc) -> Array:
    """Least or largest among each pixel and its eight neighbours."""
    height, width = values.shape
    around = np.pad(values, 1, mode="edge")
    windows = [around[i : i + height, j : j + width] for i in range(3) for j in range(3)]
    return np.asarray(ufunc.reduce(windows))


@cache
def found_around(texture: str, size: int) -> tuple[Array, Array]:
    """The least and the largest of `bright` in each pixel and its neighbours, by float64."""
    u, v = np.meshgrid(*2 * [(np.arange(1200) + 0.5) / 1200], indexing="ij")
    x, y = r(u, v)
    truth = bright(x, y, 8) if texture == "r" else bright(2 * v - 1, 1 - 2 * u, 8)
    least, largest = np.full((size, size), np.inf), np.full((size, size), -np.inf)
    np.minimum.at(least, pixels(x, y, size), truth)
    np.maximum.at(largest, pixels(x, y, size), truth)
    return spread(least, np.minimum), spread(largest, np.maximum)


@pytest.mark.parametrize("level", [1, 2, 3, 7, 32])
@pytest.mark.parametrize("checks", [4, 8, 9])
@pytest.mark.parametrize("size", [97, 240])
def test_under_r_every_fragment_is_the_checker_at_x_y(
    studio: Studio, level: int, checks: int, size: int
) -> None:
    picture = studio.picture("fig5", (size, size), texture="r", level=level, checks=checks, **EXACT)
    x, y = axes(size)
    seen = covered(picture)
    for c in (x, y):
        cells = (c + 1.0) * checks / 2.0
        seen &= np.abs(cells - np.round(cells)) * 2.0 / checks > 1e-3
    assert seen.sum() > 0.3 * size**2
    expected = np.where(bright(x, y, checks)[..., None], LIGHT, DARK)
    assert (picture[seen] == expected[seen]).all()


@pytest.mark.parametrize("checks", [2, 4, 8, 10])
def test_the_identity_makes_n_by_n_regions_in_their_places(studio: Studio, checks: int) -> None:
    size = 400
    picture = studio.picture("fig5", (size, size), texture="identity", checks=checks, **EXACT)
    inside, light = covered(picture), (picture == LIGHT).all(-1)
    assert (inside & ~light == (picture == DARK).all(-1)).all()
    smallest = 0.05 * inside.sum() / checks**2
    assert count_regions(inside & light, smallest) == checks**2 // 2
    assert count_regions(inside & ~light, smallest) == checks**2 // 2
    centers = (np.arange(checks) + 0.5) / checks
    u, v = np.meshgrid(centers, centers, indexing="ij")
    x, y = r(u, v)
    row, column = pixels(x, y, size)
    assert (light[row, column] == bright(2 * v - 1, 1 - 2 * u, checks)).all()


@pytest.mark.parametrize(
    ("settings", "n"), [({}, 32), *(({"level": n}, n) for n in (2, 4, 16, 64))]
)
def test_area_covered(studio: Studio, settings: dict[str, int], n: int) -> None:
    """The triangles miss 8/3 n^-2 of 20/3; without a level there are 32 steps."""
    picture = studio.picture("fig5", (1000, 1000), samples=1, **settings)
    area = covered(picture).sum() * (WHOLE / 1000) ** 2
    assert area == pytest.approx(20 / 3 - 8 / 3 / n**2, abs=2e-3)


def test_the_rim_is_four_parabolas(studio: Studio) -> None:
    """x = (3 - y^2) / 2 for |y| <= 1, and the same turned; to a thirtieth of a pixel."""
    found = covered(studio.picture("fig5", (1000, 1000), samples=1, level=128))
    x, y = np.abs(axes(1000))
    across = np.where(y <= 1.0, (3.0 - y * y) / 2.0 - x, -np.inf)
    along = np.where(x <= 1.0, (3.0 - x * x) / 2.0 - y, -np.inf)
    inside = np.maximum(across, along)
    assert (found == (inside > 0.0))[np.abs(inside) > 1e-4].all()


@pytest.mark.parametrize("size", [(160, 160), (300, 120), (90, 250), (161, 100)])
@pytest.mark.parametrize("subject", ["r", "elsewhere"])
def test_the_box_is_centred(studio: Studio, size: tuple[int, int], subject: str) -> None:
    nets = {"r": planar_maps.R, "elsewhere": control_net([[(7, -2), (9, 3)], [(8, -4), (12, -3)]])}
    scene = scene_subject(file_scene(), {"body": body([Patch(nets[subject])])})
    inside = covered(studio.draw(scene.changed("samples", 1), size, plain=True))
    rows, columns = np.flatnonzero(inside.any(1)), np.flatnonzero(inside.any(0))
    margins = [columns[0], size[0] - 1 - columns[-1], rows[0], size[1] - 1 - rows[-1]]
    assert abs(margins[0] - margins[1]) <= 1
    assert abs(margins[2] - margins[3]) <= 1
    filled = max(len(columns) / size[0], len(rows) / size[1])
    assert filled == pytest.approx(1.0 / MARGIN, abs=2.0 / min(size))


def test_the_ground_is_far_from_every_mixture(studio: Studio) -> None:
    ground = studio.picture("fig5", (64, 64))[0, 0].astype(float)
    assert (ground == GROUND).all()  # which is saturated
    mixture = DARK + np.linspace(0.0, 1.0, 1001)[:, None] * (LIGHT - DARK)
    lit = np.linspace(0.45, 1.0, 56)[:, None, None] * mixture
    assert np.abs(lit - ground).max(-1).min() >= 64.0


@pytest.mark.parametrize("texture", ["identity", "r"])
@pytest.mark.parametrize("size", [200, 512])
def test_no_specks_on_the_rim(studio: Studio, texture: str, size: int) -> None:
    """Free of the ground's share, the brightness of each pixel, those on the rim too, is among
    those that float64 finds in the pixel and its neighbours."""
    picture = studio.picture("fig5", (size, size), texture=texture).astype(float)
    unmix = np.linalg.pinv(np.stack([LIGHT - DARK, DARK - GROUND]))
    light, patch = np.moveaxis((picture - GROUND) @ unmix, -1, 0)
    seen = patch > 0.2
    least, largest = (bound[seen] for bound in found_around(texture, size))
    assert (least == largest).mean() > 0.5  # so most pixels have but one right answer
    brightness = light[seen] / patch[seen]
    assert np.maximum(least - brightness, brightness - largest).max() < 0.15


@pytest.mark.parametrize("texture", ["identity", "r"])
def test_without_morph_it_is_the_square(studio: Studio, texture: str) -> None:
    picture = studio.picture("fig5", (201, 201), morph=0.0, texture=texture, samples=1)
    x, y = axes(201, 2.0 * MARGIN)
    assert (covered(picture) == (np.maximum(np.abs(x), np.abs(y)) < 1.0)).all()


@pytest.mark.parametrize("weight", [0.25, 0.5, 0.9, 1.0])
@pytest.mark.parametrize("scene", ["fig4", "fig5"])
def test_nothing_folds(studio: Studio, scene: str, weight: float) -> None:
    picture = studio.picture(scene, (256, 256), morph=weight)
    labels = label_regions((picture == GROUND).all(-1))
    assert len(np.unique(labels[labels >= 0])) == 1  # no ground but outside
    steps = np.linspace(0.0, 1.0, 33)
    u, v = np.meshgrid(steps, steps, indexing="ij")
    p = evaluate(planar_maps.morph(planar_maps.R, weight), u, v)[..., :2]
    down, right = np.diff(p, axis=0), np.diff(p, axis=1)
    for du, dv in ((down[:, :-1], right[:-1]), (down[:, 1:], right[1:])):
        assert (du[..., 0] * dv[..., 1] > du[..., 1] * dv[..., 0]).all()
