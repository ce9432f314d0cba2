"""`reparam check`: the claims of the scenes, computed."""

from __future__ import annotations

import argparse
from dataclasses import asdict

from .options import Commands, print_json


def add(commands: Commands) -> None:
    """The words of the command."""
    command = commands.add_parser("check", help="compute the claims of the scenes")
    command.add_argument("scenes", nargs="*", metavar="SCENE")
    command.add_argument("--json", action="store_true")
    command.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """The claims as a table; 1 if one fails."""
    from ..scenes.claims import judge
    from ..scenes.registry import load_scene, scene_names
    from ..snapshot import Studio

    scenes = [load_scene(name) for name in options.scenes or scene_names()]
    studio, verdicts = Studio(), []
    for scene in scenes:
        for claim in scene.claimed():
            verdict = judge(scene.name, claim, studio)
            verdicts.append(verdict)
            if not options.json:
                mark = "ok  " if verdict.ok else "FAIL"
                print(f"{mark} {scene.name:6} {verdict.equation:8} {verdict.statement}")
                print(f"       expected {verdict.expected}  measured {verdict.measured}"
                      f"  tolerance {verdict.tolerance:g}")  # fmt: skip
    if options.json:
        print_json([asdict(verdict) for verdict in verdicts])
    return 0 if all(verdict.ok for verdict in verdicts) else 1
