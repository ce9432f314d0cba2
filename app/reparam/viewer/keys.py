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


GROUPS: tuple[tuple[str, tuple[Key | Gesture, ...]], ...] = (
    (
        "the scene",
        (
            Key(("T",), "texture map: the identity, or r itself", "next_texture"),
            Key(("P",), "change of variables", "next_change"),
            Key(("M",), "morph between the square and its image", "glide"),
            Key(("Space",), "animate, or stop", "play"),
            Key(("C",), "checker size", "next_checks"),
            Key(tuple("123456789"), "the note's figures", "show_figure", tuple(range(1, 10))),
            Key(("PageDown", "PageUp"), "next and previous scene", "turn_page", (1, -1)),
        ),
    ),
    (
        "how it is drawn",
        (
            Key(("D",), "the domain and the texture beside the picture", "toggle_linked"),
            Key(("L",), "light, zebra, curvature, kinds, textures, steps, errors", "next_shading"),
            Key(("N",), "control net", "toggle_net"),
            Key(("W",), "wireframe", "toggle_wireframe"),
            Key(("A",), "as fine as half a pixel asks for, or one level", "toggle_tolerance"),
            Key(("+", "-"), "tessellation level, finer and coarser", "change_level", (1, -1)),
            Key(("E",), "evaluator: vertex shader, or tessellation", "next_evaluator"),
        ),
    ),
    (
        "looking",
        (
            Gesture(("point",), "mark the point in all linked spaces"),
            Gesture(("drag",), "move the picture; turn a spatial surface"),
            Gesture(("right drag",), "move a spatial surface"),
            Gesture(("wheel",), "zoom at the mouse"),
            Key(("O",), "in perspective, or orthographic", "toggle_perspective"),
            Key(("R",), "reset the view; again: the parameters", "reset"),
        ),
    ),
    (
        "comparing",
        (
            Key(("X",), "two values in one picture: the identity, and r", "toggle_comparison"),
            Key(("Shift+X",), "before and after the last change", "compare_last_change"),
            Key(("B",), "blend one slowly into the other", "blend"),
            Gesture(("drag the divider",), "see more of one or of the other"),
        ),
    ),
    (
        "changing",
        (
            Gesture(("drag a point",), "change the scene; with Shift in steps"),
            Gesture(("click a point",), "keep an arc or let it go, insert a knot"),
            Key(("Enter",), "type the point's coordinates, or a parameter", "type_value"),
            Key(("Ctrl+Z",), "undo", "undo"),
            Key(("Ctrl+Shift+Z", "Ctrl+Y"), "redo", "redo"),
        ),
    ),
    (
        "keeping",
        (
            Key(("S",), "screenshot into the current folder", "screenshot"),
            Key(("Shift+S",), "screenshot, larger", "ask_screenshot"),
            Key(("Ctrl+S",), "save the scene into the current folder", "save_scene"),
            Key(("Ctrl+C",), "copy the command that draws this picture", "copy_command"),
        ),
    ),
    (
        "the window",
        (
            Key(("Tab",), "the panel: parameters, claims, scenes", "toggle_panel"),
            Key(("H", "F1"), "this help", "toggle_help"),
            Key(("F11",), "full screen", "toggle_full_screen"),
            Key(("F5",), "reload the shaders", "reload_shaders"),
            Key(("Esc",), "quit", "quit"),
        ),
    ),
)

KEYS = tuple(row for _, rows in GROUPS for row in rows if isinstance(row, Key))


def keys_groups() -> list[tuple[str, list[tuple[str, str]]]]:
    """What they are for, with (keys, what they do): for the help in all its places."""
    return [(title, [(_names(row.names), row.does) for row in rows]) for title, rows in GROUPS]


def keys_text() -> str:
    """The table as plain text."""
    lines = []
    for title, rows in keys_groups():
        lines += [f" {title}", *(f"  {names:22} {does}" for names, does in rows)]
    return "\n".join(lines)


def keys_markdown() -> str:
    """The table as the README has it."""
    lines = ["| key | what it does |", "|---|---|"]
    for title, rows in keys_groups():
        lines += [f"| **{title}** | |", *(f"| {names} | {does} |" for names, does in rows)]
    return "\n".join(lines)


def _names(names: tuple[str, ...]) -> str:
    return f"{names[0]} .. {names[-1]}" if len(names) > 2 else ", ".join(names)
