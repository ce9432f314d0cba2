"""The typeface: Source Sans Pro, which has the mathematics that Pillow's own face lacks."""

from __future__ import annotations

import importlib.util
from pathlib import Path


def font_path(italic: bool) -> Path:
    """The TrueType file of the upright or the italic face."""
    spec = importlib.util.find_spec("font_source_sans_pro")
    assert spec is not None
    assert spec.origin is not None
    name = "SourceSansPro-It.ttf" if italic else "SourceSansPro-Regular.ttf"
    return Path(spec.origin).parent / "files" / name
