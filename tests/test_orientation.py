"""Which way is up, and which way u and v run: what r cannot show, since transposing its net
changes no pixel."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

from reparam.geometry.evaluate import evaluate, grid_parameters
from reparam.geometry.net import control_net
from reparam.geometry.planar_maps import R
from reparam.gpu.readback import read_points
from reparam.snapshot import Studio
from reparam.subject import open_subject

Array = NDArray[np.float64]

# Of textures/corners.png, as [up][right].
RED, GREEN, BLUE, YELLOW = (213, 40, 40), (0, 158, 80), (30, 80, 200), (240, 228, 66)
CORNERS = np.array([[BLUE, YELLOW], [RED, GREEN]])
POINTS = [  # degree 2 in u, downwards; degree 3 in v, to the right; no symmetry
    [(-1.6, 1.1), (-0.5, 1.9), (0.6, 1.3), (1.5, 0.9)],
    [(-1.3, 0.2), (-0.4, 0.3), (0.7, 0.1), (1.9, -0.2)],
    [(-1.4, -0.8), (-0.6, -1.4), (0.4, -1.2), (1.2, -1.6)],
]
NET = control_net(POINTS)
EXACT = ["filter=nearest", "samples=1"]

pytestmark = pytest.mark.usefixtures("evaluator")


def planar_file(folder: Path, points: Array) -> str:
    """The net as a .bv file of kind 5 in the plane z = 0."""
    rows, columns, _ = points.shape
    lines = [f"{x} {y} 0" for x, y in points.reshape(-1, 2)]
    path = folder / "planar.bv"
    path.write_text("\n".join([f"5 {rows - 1} {columns - 1}", *lines]))
    return str(path)


def draw(studio: Studio, name: str, *settings: str) -> NDArray[np.uint8]:
    return studio.draw(open_subject(name).assigned(settings), (300, 240), plain=True)


def look_up(picture: NDArray[np.uint8], net: Array, x: Array, y: Array) -> NDArray[np.uint8]:
    """The pixels at points of the plane: x to the right, y up, the net's box in the middle."""
    t = np.linspace(0.0, 1.0, 201)
    surface = evaluate(net, *np.meshgrid(t, t, indexing="ij"))[..., :2].reshape(-1, 2)
    height, width = picture.shape[:2]
    low, high = surface.min(0), surface.max(0)
    pixel = 1.08 * max((high[0] - low[0]) / width, (high[1] - low[1]) / height)
    middle = (low + high) / 2.0
    column = np.floor((x - middle[0]) / pixel + width / 2.0).astype(int)
    row = np.floor(height / 2.0 - (y - middle[1]) / pixel).astype(int)
    return np.asarray(picture[row, column])


def corner(s: Array, t: Array) -> NDArray[np.int64]:
    """The colour of corners.png over [-1,1]^2."""
    return np.asarray(CORNERS[(t > 0.0).astype(int), (s > 0.0).astype(int)])


def parameters() -> tuple[Array, Array]:
    """Clear of the patch's edges and of its middle lines."""
    t = np.array([0.04, 0.15, 0.3, 0.46, 0.54, 0.68, 0.81, 0.96])
    u, v = np.meshgrid(t, t, indexing="ij")
    return u, v


def test_u_runs_along_the_first_index(studio: Studio, evaluator: str) -> None:
    read = read_points(studio.painter, evaluator, NET, 1)
    expected = {(u, v): NET[-u, -v] for u in (0, 1) for v in (0, 1)}
    for (u, _, v, _), point in zip(read.parameters[0], read.points[0], strict=True):
        assert point == pytest.approx(expected[int(u), int(v)], abs=1e-6)
    alone = studio.painter.evaluation.read(NET, grid_parameters(1))[0]  # without normals
    for (u, _, v, _), point in zip(grid_parameters(1), alone, strict=True):
        assert point == pytest.approx(expected[int(u), int(v)], abs=1e-6)


def test_a_picture_goes_with_each_patch(studio: Studio, tmp_path: Path) -> None:
    picture = draw(studio, planar_file(tmp_path, np.array(POINTS)), "image=corners", *EXACT)
    u, v = parameters()
    x, y = np.moveaxis(evaluate(NET, u, v)[..., :2], -1, 0)
    assert (look_up(picture, NET, x, y) == corner(2.0 * v - 1.0, 1.0 - 2.0 * u)).all()


def test_a_picture_lies_in_the_plane(studio: Studio, tmp_path: Path) -> None:
    file = planar_file(tmp_path, np.array(POINTS))
    picture = draw(studio, file, "image=corners", "texture=r", *EXACT)
    x, y = np.meshgrid([-0.9, -0.4, -0.05, 0.05, 0.5, 0.9], [-0.9, -0.3, -0.05, 0.05, 0.4, 0.9])
    assert (look_up(picture, NET, x, y) == corner(x, y)).all()


@pytest.mark.parametrize("texture", ["identity", "r"])
@pytest.mark.parametrize("filter", ["nearest", "smooth"])
def test_the_texture_map_never_turns_a_picture(studio: Studio, texture: str, filter: str) -> None:
    picture = draw(studio, "fig5", "image=corners", f"texture={texture}", f"filter={filter}")
    u, v = parameters()
    x, y = np.moveaxis(evaluate(R, u, v)[..., :2], -1, 0)
    assert (look_up(picture, R, x, y) == corner(x, y)).all()
    assert tuple(look_up(picture, R, np.array(-0.6), np.array(0.6))) == RED


@pytest.mark.parametrize("filter", ["nearest", "smooth"])
@pytest.mark.parametrize("wrap", ["mirror", "repeat"])
def test_a_picture_goes_on(studio: Studio, tmp_path: Path, wrap: str, filter: str) -> None:
    points = np.array([[(-3.9, 4.9), (4.9, 4.9)], [(-3.9, -2.9), (4.9, -2.9)]])
    settings = ["image=corners", "texture=r", f"wrap={wrap}", f"filter={filter}"]
    picture = draw(studio, planar_file(tmp_path, points), *settings)
    x, y = np.meshgrid(np.arange(-3.5, 5.0), np.arange(-2.5, 5.0))
    period = 2.0 if wrap == "repeat" else 4.0
    s, t = ((c + 1.0) % period - 1.0 for c in (x, y))
    s, t = (np.where(c > 1.0, 2.0 - c, c) for c in (s, t))
    assert (look_up(picture, control_net(points), x, y) == corner(s, t)).all()


@pytest.mark.parametrize(
    ("orientation", "turn"),
    [
        (1, None),
        (2, Image.Transpose.FLIP_LEFT_RIGHT),
        (3, Image.Transpose.ROTATE_180),
        (6, Image.Transpose.ROTATE_90),
        (8, Image.Transpose.ROTATE_270),
    ],
)
def test_a_camera_held_sideways(
    studio: Studio, tmp_path: Path, orientation: int, turn: Image.Transpose | None
) -> None:
    """6: the viewer has to turn the stored picture clockwise, so it is stored turned the other
    way. Wider than high, so that the sides must be swapped too."""
    upright = Image.fromarray(CORNERS[::-1].astype(np.uint8)).resize((96, 64), Image.Resampling.BOX)
    stored = upright if turn is None else upright.transpose(turn)
    exif = Image.Exif()
    exif[0x0112] = orientation
    path = tmp_path / "photo.jpg"
    stored.save(path, quality=95, subsampling=0, exif=exif)
    picture = draw(studio, "fig5", f"image={path}")
    x, y = np.meshgrid([-0.8, 0.8], [-0.8, 0.8])
    difference = look_up(picture, R, x, y).astype(int) - corner(x, y)
    assert np.abs(difference).max() <= 12
