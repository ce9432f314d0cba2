"""The figures as files: `python -m reparam.gallery FOLDER WxH [NAME ...]`."""

from __future__ import annotations

import re
import sys
from collections.abc import Collection, Iterator
from pathlib import Path

from .files.output import save_picture
from .scenes.registry import load_scene, scene_names
from .snapshot import Studio
from .subject import Subject, open_subject


def plates() -> Iterator[tuple[str, Subject]]:
    """All pictures worth showing: a file name, without its ending, and the subject."""
    for name in scene_names():
        for plate in load_scene(name).plates:
            subject = open_subject(name).assigned(plate)
            words = [re.sub(r"[^\w.]+", "-", word) for word in plate]  # a name for every system
            yield "-".join([name, *words]), subject


def write_figures(folder: Path, size: tuple[int, int], names: Collection[str] = ()) -> list[Path]:
    """Draw all plates, or those named, as PNG into the folder, made if missing.

    Returns the files.
    """
    folder.mkdir(parents=True, exist_ok=True)
    studio, written = Studio(), []
    for name, subject in plates():
        if names and name not in names:
            continue
        path = folder / f"{name}.png"
        save_picture(studio.draw(subject, size), path)
        written.append(path)
    return written


if __name__ == "__main__":
    from .commands.options import parse_size

    write_figures(Path(sys.argv[1]), parse_size(sys.argv[2]), sys.argv[3:])
