"""A long read tells how far it is, and can be stopped."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import pytest

from reparam.errors import FileFormatError
from reparam.files.bv import read_bv
from reparam.subject import open_subject
from reparam.viewer.loading import GivenUp, Loading

PATCH = "4\n1\n0 0 0\n0 1 0\n1 0 0\n1 1 0\n"
COUNT = 12_000


@pytest.fixture(scope="module")
def large(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("large") / "large.bv"
    path.write_text("Group 1 first\n" + PATCH * (COUNT // 2) + "Group 2 second\n" + PATCH * COUNT)
    return path


def test_shares_grow_from_nothing_to_all(large: Path) -> None:
    shares: list[float] = []
    read_bv(large, shares.append)
    assert shares == sorted(shares)
    assert shares[0] < 0.01
    assert shares[-1] > 0.97
    steps = [b - a for a, b in pairwise(shares)]
    assert max(steps) < 0.6  # a chunk of words


def test_a_read_can_be_given_up(large: Path) -> None:
    loading = Loading("large.bv", lambda tell: open_subject(str(large), tell))
    loading.give_up()
    with pytest.raises(GivenUp, match=r"large\.bv: not opened"):
        loading.result()
    assert loading.done()


def test_what_was_opened_or_went_wrong() -> None:
    opened = open_subject("fig5")
    assert Loading("fig5", lambda _: opened).result() is opened
    with pytest.raises(FileFormatError, match="found no file"):
        Loading("none", lambda tell: open_subject("none.bv", tell)).result()
