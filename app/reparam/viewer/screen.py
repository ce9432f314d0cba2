"""Is there a screen?"""

from __future__ import annotations

import os
import sys


def screen_missing() -> str | None:
    """Why no window can be opened, or None if one may be."""
    if sys.platform in ("darwin", "win32"):
        return None
    if os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"):
        return None
    return "no screen (neither DISPLAY nor WAYLAND_DISPLAY is set)"
