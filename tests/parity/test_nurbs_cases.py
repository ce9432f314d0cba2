"""The comparison with GLU's cases can fail: at a number, a primitive, an error, a trim."""

from __future__ import annotations

from copy import deepcopy
from typing import Any

import pytest

import parity
from reparam.snapshot import Studio

CASES = {
    name: case for name, case in parity.read_cases(parity.CASES).items() if name.startswith("glu_")
}


def altered(name: str, change: Any) -> parity.Case:
    case = deepcopy(CASES[name])
    change(case["outputs"]["prims"])
    return case


def add(field: str, primitive: int, vertex: int, column: int) -> Any:
    def change(primitives: Any) -> None:
        primitives[primitive][field][vertex][column] += 1e-4

    return change


def swap(primitives: Any) -> None:
    primitives[0], primitives[1] = primitives[1], primitives[0]


CHANGES = [
    ("glu_curve_multiplicities", add("pos", 1, 4, 2)),
    ("glu_curve_multiplicities", lambda p: p.pop(1)),
    ("glu_curve_multiplicities", lambda p: p.pop()),
    ("glu_curve_multiplicities", swap),
    ("glu_curve_rational_circle", add("pos", 3, 9, 3)),
    ("glu_surface_domain_distance", add("uv", 7, 2, 0)),
    ("glu_surface_domain_distance", add("normal", 7, 2, 1)),
    ("glu_surface_domain_distance", add("tex", 15, 0, 1)),
    ("glu_surface_domain_distance", lambda p: p.pop(3)),
    ("glu_surface_domain_distance", lambda p: p[3].update(color=[[0] * 4] * 8)),
    ("glu_trim_redbook", add("pos", 20, 1, 0)),
    ("glu_trim_redbook", lambda p: p.__delitem__(slice(40, 60))),
    ("glu_trim_rational_circle_hole", lambda p: p.clear()),
]


@pytest.mark.parametrize(("name", "change"), CHANGES)
def test_an_altered_output_fails(studio: Studio, name: str, change: Any) -> None:
    row = parity.run_case(studio, name, altered(name, change), "vertex")
    assert not row.ok, row.line()


def test_other_errors_fail(studio: Studio) -> None:
    case = deepcopy(CASES["glu_curve_rational_circle"])
    case["outputs"]["errors"] = [100251]
    assert "expected errors [100251]" in parity.run_case(studio, "odd", case, "vertex").complaint


def test_where_libglu_is_silent_ours_reports(studio: Studio) -> None:
    case = deepcopy(CASES["glu_trim_rational_circle_hole"])
    del case["inputs"]["trims"][0]  # the hole alone: libGLU draws nothing
    case["outputs"] = {"prims": [], "errors": []}
    assert parity.run_case(studio, "hole", case, "vertex").ok
    case["inputs"]["trims"] = []
    assert "nothing" in parity.run_case(studio, "whole", case, "vertex").complaint


def test_known_wrong_cases_are_held_to_float64(studio: Studio) -> None:
    case = altered("glu_surface_paper_r_tex_r", lambda p: p.pop())
    case["known_wrong"] = "pos: the last strip is missing"
    assert parity.run_case(studio, "wrong", case, "vertex").ok


DRAWN = [
    ("glu_drawn_trim", "verts", "pos", 40, 2),
    ("glu_drawn_trim", "verts", "normal", 41, 0),
    ("glu_drawn_curve", "lines", "pos", 5, 1),
    ("glu_drawn_curve", "lines", "color", 6, 0),
    ("glu_drawn_curve", "lines", "tex", 7, 3),
]


@pytest.mark.parametrize(("name", "what", "field", "vertex", "column"), DRAWN)
def test_an_altered_vertex_of_what_libglu_drew_fails(
    studio: Studio, name: str, what: str, field: str, vertex: int, column: int
) -> None:
    case = deepcopy(CASES[name])
    case["outputs"][what][field][vertex][column] += 1e-4
    assert not parity.run_case(studio, name, case, "vertex").ok


def test_a_missing_triangle_and_segment_of_what_libglu_drew_fail(studio: Studio) -> None:
    for name, what, corners in (("glu_drawn_trim", "verts", 30), ("glu_drawn_curve", "lines", 2)):
        case = deepcopy(CASES[name])
        for values in case["outputs"][what].values():
            del values[:corners]
        assert not parity.run_case(studio, name, case, "vertex").ok


def test_properties_that_libglu_takes_unchecked_may_be_refused(studio: Studio) -> None:
    case = deepcopy(CASES["glu_surface_domain_distance"])
    case["inputs"]["props"]["SAMPLING_TOLERANCE"] = 0.0
    assert parity.run_case(studio, "zero", case, "vertex").ok
    case["inputs"]["props"]["SAMPLING_METHOD"] = 7
    assert "[100901]" in parity.run_case(studio, "seven", case, "vertex").complaint
