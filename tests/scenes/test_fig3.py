"""Figure 3: what is kept is drawn on the circle, what a hand does changes what it should."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from seen import Seen

from reparam.errors import ReparamError
from reparam.scenes import palette
from reparam.scenes.layers import Handles
from reparam.snapshot import Studio
from reparam.subject import Subject, open_subject


def subject(**values: Any) -> Subject:
    found = open_subject("fig3")
    for name, value in values.items():
        found = found.changed(name, value)
    return found


@pytest.mark.parametrize(("arcs", "smooth"), [("KMKM", "G2"), ("KMKK", "G1")])
def test_kept_arcs_are_drawn_on_the_circle(studio: Studio, arcs: str, smooth: str) -> None:
    seen = Seen(studio, subject(smooth=smooth, arcs=arcs), (360, 360))
    at, pixel = seen.places(palette.KEPT), seen.pixel
    radius = np.hypot(at[:, 0], at[:, 1])
    assert np.abs(radius - 1.0).max() < 1.2 * pixel
    assert radius.mean() == pytest.approx(1.0, abs=0.1 * pixel)
    degrees = (np.degrees(np.arctan2(at[:, 1], at[:, 0])) + 60.0) % 360.0
    pixels, _ = np.histogram(degrees, bins=72, range=(0.0, 360.0))
    kept = np.repeat([letter == "K" for letter in arcs], [26, 18, 8, 20])
    inner = kept & np.roll(kept, 1) & np.roll(kept, -1)
    assert (pixels[inner] > 0).all()
    assert not pixels[~kept].any()
    modified = seen.places(palette.MODIFIED)
    assert np.hypot(modified[:, 0], modified[:, 1]).max() > 1.15


def handles(shown: Subject) -> list[Handles]:
    return [layer for layer in shown.figure().spaces[0].layers if isinstance(layer, Handles)]


def test_handles() -> None:
    shown = subject(step=3.0, arcs="KMMM")
    sections, cuts, points = handles(shown)
    assert (len(sections.at), len(cuts.at), len(points.at)) == (4, 4, 3)
    assert sections.drag(shown.values, 0, np.zeros(3)) == {}
    assert sections.click is not None
    assert sections.click(shown.values, 0) == {"arcs": "MMMM"}
    assert sections.click(shown.values, 2) == {"arcs": "KMKM"}
    turned = cuts.drag(shown.values, 3, np.array([-2.0, -1.0, 0.0]))["cuts"]
    assert turned.tolist()[:3] == [-60.0, 70.0, 160.0]
    assert turned[3] == pytest.approx(206.565, abs=1e-3)  # 200 on, not back by a turn
    changes = points.drag(shown.values, 2, np.array([0.5, -2.0, 0.0]))
    assert changes["step"] == 4.0
    for name, value in changes.items():
        shown = shown.changed(name, value)
    assert handles(shown)[2].at[2].tolist() == pytest.approx([0.5, -2.0, 0.0], abs=1e-15)
    assert handles(shown)[2].at[:2] == pytest.approx(points.at[:2], abs=1e-15)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"arcs": "KXKM"}, r"arcs: expected letters K \(kept\) and M \(modified\), found 'KXKM'"),
        ({"arcs": ""}, "arcs: expected letters"),
        ({"arcs": "KM"}, "expected 4 sections for as many cuts, found 2"),
        ({"cuts": np.array([0.0, 90.0, 80.0, 200.0])}, "once around, 1 apart"),
        ({"edits": np.full((2, 2), 1e308)}, "edits"),
    ],
)
def test_refused(values: dict[str, Any], message: str) -> None:
    with pytest.raises((ValueError, ReparamError), match=message):
        subject(**values).figure()


def test_steps_are_told_and_what_is_shown_grows() -> None:
    counts = []
    for step in (1.0, 1.5, 2.0, 3.0, 4.0):
        figure = subject(step=step).figure()
        assert figure.caption[0].startswith(f"{int(np.ceil(step))}: ")
        counts.append(len(figure.spaces[0].layers))
    assert counts == sorted(counts)
    assert counts[0] < counts[1]
