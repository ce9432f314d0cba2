"""`reparam list`: the scenes and their parameters."""

from __future__ import annotations

import argparse
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

from .options import Commands, print_json

if TYPE_CHECKING:
    from ..scenes.parameters import Parameter
    from ..scenes.registry import Scene


def add(commands: Commands) -> None:
    """The words of the command."""
    command = commands.add_parser("list", help="scenes and their parameters")
    command.add_argument("--json", action="store_true")
    command.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Scenes with their parameters, then the display's, which all scenes share."""
    from ..scenes.registry import file_scene, load_scene, scene_names
    from ..subject import DISPLAY

    scenes = [*(load_scene(name) for name in scene_names()), file_scene()]
    if options.json:
        print_json([_row(scene, DISPLAY) for scene in scenes])
        return 0
    for scene in scenes:
        print(f"{'FILE' if scene.opens_files else scene.name}: {scene.title}")
        _print_parameters(scene.parameters.values())
    print("any scene:")
    _print_parameters(DISPLAY.values())
    return 0


def _row(scene: Scene, display: Mapping[str, Parameter]) -> dict[str, Any]:
    parameters = [p.row() for p in (*scene.parameters.values(), *display.values())]
    return {
        "scene": scene.name,
        "title": scene.title,
        "figure": scene.figure,
        "parameters": parameters,
    }


def _print_parameters(parameters: Iterable[Parameter]) -> None:
    for p in parameters:
        default = p.text(p.default) if p.points else repr(p.default)
        print(f"  {p.name:10} {p.expected()}; default {default}   {p.help}")
