"""One table of keys: the help in the terminal and the README's list are made from it."""

from __future__ import annotations

from pathlib import Path

import pytest

from reparam.cli import main
from reparam.viewer.keys import GROUPS, KEYS, Key, keys_groups, keys_markdown

ROOT = Path(__file__).parents[2]


def test_no_name_twice() -> None:
    names = [name.upper() for _, rows in GROUPS for row in rows for name in row.names]
    assert len(names) == len(set(names))


def test_arguments_are_for_each_name_or_for_none() -> None:
    assert all(len(row.arguments) in (0, len(row.names)) for row in KEYS)


def test_the_help_in_the_terminal(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as stopped:
        main(["view", "--help"])
    assert stopped.value.code == 0
    lines = [line.split() for line in capsys.readouterr().out.splitlines()]
    for title, rows in keys_groups():
        assert title.split() in lines
        for names, does in rows:
            assert [*names.split(), *does.split()] in lines


def test_the_readme() -> None:
    assert keys_markdown() in (ROOT / "README.md").read_text(encoding="utf-8")


def test_every_key_is_in_a_row() -> None:
    shown = [names for _, rows in keys_groups() for names, _ in rows]
    rows = [row for _, rows in GROUPS for row in rows]
    assert len(shown) == len(rows)
    assert tuple(row for row in rows if isinstance(row, Key)) == KEYS
    for row, names in zip(rows, shown, strict=True):
        assert names.startswith(row.names[0])
        assert names.endswith(row.names[-1])
