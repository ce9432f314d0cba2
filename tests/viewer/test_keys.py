from __future__ import annotations

from pathlib import Path

import pytest

from reparam.cli import main
from reparam.viewer.keys import KEYS, keys_markdown, keys_rows


def test_the_readme_has_the_table() -> None:
    readme = Path(__file__).parents[2] / "README.md"
    assert keys_markdown() in readme.read_text(encoding="utf-8")


def test_the_help_has_the_table(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        main(["view", "--help"])
    text = capsys.readouterr().out
    assert all(names in text and does in text for names, does in keys_rows())


def test_no_key_does_two_things() -> None:
    names = [name for key in KEYS for name in key.names]
    assert len(names) == len(set(names))
