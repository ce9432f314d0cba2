"""The one table of keys: it makes the help in the window, in the terminal and in the README."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Key:
    """`names` as on the keyboard (and as GLFW names them), what they do, the Viewer's method."""

    names: tuple[str, ...]
    does: str
    action: str
    arguments: tuple[int, ...] = ()  # for each of `names`, if they differ


@dataclass(frozen=True)
class Gesture:
    """A movement of the mouse, for the help."""

    names: tuple[str, ...]
    does: str


KEYS = (
    Key(("T",), "texture map: the identity, or r itself", "next_texture"),
    Key(("M",), "morph between the square and its image", "glide"),
    Key(("Space",), "animate, or stop", "play"),
    Key(("C",), "checker size", "next_checks"),
    Key(("N",), "control net", "toggle_net"),
    Key(("W",), "wireframe", "toggle_wireframe"),
    Key(("E",), "evaluator: vertex shader, or tessellation", "next_evaluator"),
    Key(("+", "-"), "tessellation level, finer and coarser", "change_level", (1, -1)),
    Key(tuple("123456789"), "the note's figures", "show_figure", tuple(range(1, 10))),
    Key(("PageDown", "PageUp"), "next and previous scene", "turn_page", (1, -1)),
    Key(("R",), "reset the view; again: the parameters", "reset"),
    Key(("Ctrl+Z",), "undo", "undo"),
    Key(("Ctrl+Shift+Z", "Ctrl+Y"), "redo", "redo"),
    Key(("S",), "screenshot into the current folder", "screenshot"),
    Key(("F5",), "reload the shaders", "reload_shaders"),
    Key(("F11",), "full screen", "toggle_full_screen"),
    Key(("H", "F1"), "this help", "toggle_help"),
    Key(("Esc",), "quit", "quit"),
)

GESTURES = (
    Gesture(("drag a point",), "change the scene; with Shift in steps"),
    Gesture(("drag",), "move the picture; turn a spatial surface"),
    Gesture(("right drag",), "move a spatial surface"),
    Gesture(("wheel",), "zoom at the mouse"),
)


def keys_rows() -> list[tuple[str, str]]:
    """(keys, what they do), for the help in all its places."""
    return [(_names(row.names), row.does) for row in (*KEYS, *GESTURES)]


def keys_text() -> str:
    """The table as plain text."""
    return "\n".join(f"  {names:16} {does}" for names, does in keys_rows())


def keys_markdown() -> str:
    """The table as the README has it."""
    rows = [f"| {names} | {does} |" for names, does in keys_rows()]
    return "\n".join(["| key | what it does |", "|---|---|", *rows])


def _names(names: tuple[str, ...]) -> str:
    return f"{names[0]} .. {names[-1]}" if len(names) > 2 else ", ".join(names)
