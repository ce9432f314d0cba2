"""Every stored case on both paths, and that the comparison can fail."""

from __future__ import annotations

import json
import shutil
from copy import deepcopy
from pathlib import Path

import pytest

import parity
from reparam.snapshot import Studio

CASES = parity.read_cases(parity.CASES)


@pytest.mark.parametrize("name", CASES)
def test_case(studio: Studio, name: str) -> None:
    for evaluator in studio.painter.capabilities.evaluators:
        row = parity.run_case(studio, name, CASES[name], evaluator)
        assert row.ok, row.line()


ALTERED = [
    ("map1_redbook_bezcurve", "pos", 17, 1),
    ("map1_odd_stride_colour_tex", "color", 3, 2),
    ("map1_odd_stride_colour_tex", "tex", 0, 0),
    ("map2_redbook_bezmesh_autonormal", "normal", 20, 2),
    ("map2_rational_sphere_octant", "pos", 8, 3),
    ("map2_rational_sphere_octant", "normal", 48, 0),  # the zero vector at the pole
    ("map2_normal_map", "normal", 5, 1),
    ("map2_domain_reversed_autonormal", "pos", 0, 0),
    ("map2_mesh_fill", "pos", 77, 2),
    ("map2_mesh_fill", "tex", 119, 1),
    ("map2_mesh_fill", "normal", 50, 0),
    ("map2_mesh_grid_drift", "pos", 100, 0),
]


@pytest.mark.parametrize(("name", "field", "row", "column"), ALTERED)
def test_an_altered_number_fails(
    studio: Studio, name: str, field: str, row: int, column: int
) -> None:
    case = deepcopy(CASES[name])
    case["outputs"][field][row][column] += 1e-4
    for evaluator in studio.painter.capabilities.evaluators:
        assert not parity.run_case(studio, name, case, evaluator).ok


def test_missing_vertices_and_unknown_kinds_fail(studio: Studio) -> None:
    case = deepcopy(CASES["map2_mesh_fill"])
    case["outputs"]["pos"] = case["outputs"]["pos"][:-3]
    assert "of one length" in parity.run_case(studio, "uneven", case, "vertex").complaint
    case["outputs"] = {field: values[:117] for field, values in case["outputs"].items()}
    assert "primitives" in parity.run_case(studio, "short", case, "vertex").complaint
    case = deepcopy(CASES["map1_order5"])
    case["outputs"]["pos"] = []
    assert not parity.run_case(studio, "empty", case, "vertex").ok
    assert "kind" in parity.run_case(studio, "odd", {"kind": "odd"}, "vertex").complaint
    del case["inputs"]["maps"]["VERTEX_3"]["stride"]
    assert "stride" in parity.run_case(studio, "broken", case, "vertex").complaint


def test_where_one_makes_nothing_so_does_the_other(studio: Studio) -> None:
    case = deepcopy(CASES["map2_mesh_reversed_range"])
    case["inputs"]["rng"] = [0, 1, 0, 1]
    assert "found some" in parity.run_case(studio, "some", case, "vertex").complaint
    case = deepcopy(CASES["map2_mesh_fill"])
    del case["inputs"]["maps"]["VERTEX_3"]
    assert "found none" in parity.run_case(studio, "none", case, "vertex").complaint


def test_the_command_counts_and_exits(
    studio: Studio, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    paths = len(studio.painter.capabilities.evaluators)
    assert parity.main([str(tmp_path)], studio) == 1
    assert "found none" in capsys.readouterr().err
    shutil.copy(parity.CASES / "map1_order5.json", tmp_path / "other.json")
    assert parity.main([str(tmp_path)], studio) == 0
    assert f"{paths} of {paths} rows ok, 1 cases" in capsys.readouterr().out
    case = deepcopy(CASES["map1_order5"])
    case["outputs"]["pos"][3][0] -= 1e-4
    (tmp_path / "altered.json").write_text(json.dumps(case))
    assert parity.main([str(tmp_path)], studio) == 1
    assert f"{paths} of {2 * paths} rows ok, 2 cases" in capsys.readouterr().out
    (tmp_path / "altered.json").write_text("{")
    assert parity.main([str(tmp_path)], studio) == 1
