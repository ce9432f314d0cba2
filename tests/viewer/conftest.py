from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from driver import Screen, Window, virtual_screen


@pytest.fixture(scope="module")
def screen() -> Iterator[Screen]:
    with virtual_screen() as found:
        yield found


@pytest.fixture
def window(screen: Screen, tmp_path: Path) -> Iterator[Window]:
    opened = Window(screen, tmp_path)
    yield opened
    opened.process.kill()
    opened.process.wait()
