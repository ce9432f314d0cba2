"""The wheel and the source archive away from the checkout, and `python app` in a bare clone."""

from __future__ import annotations

import os
import subprocess
import sys
import sysconfig
import zipfile
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

ROOT = Path(__file__).parents[1]
DATA = [
    path.relative_to(ROOT).as_posix()
    for folder in ("shaders", "textures")
    for path in (ROOT / folder).rglob("*")
    if path.is_file() and not path.name.endswith((".py", ".pyc"))
]


def run(*command: str | Path, cwd: Path) -> str:
    """What a command prints, run where no PYTHONPATH helps it."""
    environment = {k: v for k, v in os.environ.items() if k not in ("PYTHONPATH", "PYTHONHOME")}
    done = subprocess.run(
        [str(word) for word in command], cwd=cwd, env=environment, capture_output=True, text=True
    )
    assert done.returncode == 0, f"{command}:\n{done.stdout}{done.stderr}"
    return done.stdout


def build(target: str, folder: Path) -> Path:
    run(sys.executable, "-m", "hatchling", "build", "-t", target, "-d", folder, cwd=ROOT)
    (archive,) = folder.iterdir()
    return archive


class Environment:
    """A fresh virtual environment, with the dependencies of this one at the end of its path."""

    def __init__(self, folder: Path) -> None:
        run(sys.executable, "-m", "venv", "--without-pip", folder, cwd=folder.parent)
        self.folder = folder
        self.programs = folder / ("Scripts" if os.name == "nt" else "bin")
        self.python = self.programs / "python"
        # Only the folder: an editable install of reparam in it is not followed.
        ours = Path(self.evaluate("sysconfig.get_path('purelib')", "import sysconfig"))
        (ours / "borrowed.pth").write_text(sysconfig.get_path("purelib"), encoding="utf-8")

    def evaluate(self, expression: str, before: str) -> str:
        return run(self.python, "-c", f"{before}; print({expression})", cwd=self.folder).strip()


def assert_same_picture(left: Path, right: Path) -> None:
    a, b = (np.asarray(Image.open(path)) for path in (left, right))
    assert a.shape == b.shape == (512, 512, 3)
    assert np.count_nonzero((a != b).any(axis=-1)) == 0
    assert len(np.unique(a.reshape(-1, 3), axis=0)) > 2


@pytest.fixture(scope="module")
def picture(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """What the checkout draws."""
    folder = tmp_path_factory.mktemp("checkout")
    run(sys.executable, ROOT / "app", "render", "fig5", "-o", "fig5.png", cwd=folder)
    return folder / "fig5.png"


def test_wheel_away_from_the_checkout(tmp_path: Path, picture: Path) -> None:
    wheel = build("wheel", tmp_path / "wheel")
    names = zipfile.ZipFile(wheel).namelist()
    assert {name for name in names if not name.startswith("reparam/")} == {
        name for name in names if name.startswith("reparam-")
    }
    assert {f"reparam/{name}" for name in DATA} == {
        name for name in names if name.startswith(("reparam/shaders/", "reparam/textures/"))
    }
    assert not [name for name in names if "test" in name.split("/")[-1]]

    there = Environment(tmp_path / "environment")
    pip = (sys.executable, "-m", "pip", "--python", there.python, "install", "--quiet")
    run(*pip, "--no-deps", "--no-index", wheel, cwd=tmp_path)
    package = Path(there.evaluate("reparam.__file__", "import reparam"))
    assert package.is_relative_to(there.folder)

    reparam = there.programs / "reparam"
    assert "fig5: " in run(reparam, "list", cwd=tmp_path)
    assert run(there.python, "-m", "reparam", "--version", cwd=tmp_path).startswith("reparam ")
    run(reparam, "render", "fig5", "-o", "fig5.png", cwd=tmp_path)
    assert_same_picture(tmp_path / "fig5.png", picture)


def test_source_archive_is_whole_and_runs_uninstalled(tmp_path: Path, picture: Path) -> None:
    archive = build("sdist", tmp_path / "sdist")
    run(sys.executable, "-m", "tarfile", "-e", archive, cwd=tmp_path)
    (clone,) = tmp_path.glob("reparam-*")
    there = {path.relative_to(clone).as_posix() for path in clone.rglob("*")}
    needed = {"Makefile", ".ci/system-packages", "LICENSE", "README.md", "tests/test_packaging.py"}
    assert {*DATA, *needed} <= there

    without = Environment(tmp_path / "environment")
    search = "importlib.util.find_spec('reparam')"
    assert without.evaluate(search, "import importlib.util") == "None"
    run(without.python, clone / "app", "render", "fig5", "-o", "fig5.png", cwd=tmp_path)
    assert_same_picture(tmp_path / "fig5.png", picture)


@pytest.mark.slow
def test_pip_install_brings_everything(tmp_path: Path, picture: Path) -> None:
    folder = tmp_path / "environment"
    run(sys.executable, "-m", "venv", folder, cwd=tmp_path)
    programs = folder / ("Scripts" if os.name == "nt" else "bin")
    run(programs / "python", "-m", "pip", "install", "--quiet", ROOT, cwd=tmp_path)
    run(programs / "reparam", "render", "fig5", "-o", "fig5.png", cwd=tmp_path)
    assert_same_picture(tmp_path / "fig5.png", picture)
