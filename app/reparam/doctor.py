"""`reparam doctor`: what is here, which path is chosen, does it compute, and what mends it."""

from __future__ import annotations

import platform
from importlib.metadata import version
from typing import Any

import numpy as np

from . import __version__
from .errors import ReparamError
from .viewer.screen import screen_missing

PACKAGES = ("moderngl", "glcontext", "glfw", "numpy", "pillow")
ACCURACY = 4e-7  # of the largest coefficient: float32 against float64, biquadratic


def examine() -> dict[str, Any]:
    """The report, in the order to be read. `draws` says whether pictures can be made."""
    report: dict[str, Any] = {"reparam": __version__, "python": platform.python_version()}
    report["system"] = f"{platform.system()} {platform.machine()}"
    report |= {name: version(name) for name in PACKAGES}
    try:
        report |= _opengl()
    except ReparamError as error:
        report |= {"draws": False, "mend": str(error)}
    report["window"] = screen_missing() or _window()
    return report


def _opengl() -> dict[str, Any]:
    from .gpu.readback import read_points
    from .snapshot import Studio

    studio = Studio()
    found = studio.painter.capabilities
    paths = ("vertex", "tessellation") if found.tessellation else ("vertex",)
    errors = {path: _error(read_points(studio.painter, path, _net(), 8)) for path in paths}
    return {
        "OpenGL": f"{found.version / 100:.1f}, {found.driver}",
        "renderer": f"{found.renderer} ({found.vendor})",
        "samples a pixel": found.samples,
        "largest picture": found.largest,
        "evaluators": ", ".join(paths),
        "chosen evaluator": found.evaluator(None),
        **{f"error, {path}": f"{error:.1e} of float64" for path, error in errors.items()},
        "draws": max(errors.values()) <= ACCURACY,
    }


def _net() -> Any:
    from .geometry.net import control_net

    points = np.random.default_rng(1).uniform(-1.0, 1.0, (3, 3, 3))
    return control_net(points)


def _error(read: Any) -> float:
    """Largest deviation from float64 at the GPU's own parameters, of the largest coefficient."""
    from .geometry.evaluate import evaluate

    net, parameters = _net(), read.parameters[0].astype(np.float64)
    truth = evaluate(net.astype(np.float32).astype(np.float64), parameters[:, 0], parameters[:, 2])
    return float(np.abs(read.points[0] - truth).max() / np.abs(net).max())


def _window() -> str:
    import glfw

    from .errors import GraphicsError
    from .viewer.window import open_window

    try:
        open_window((64, 64), "reparam doctor", visible=False)
    except GraphicsError as error:
        return str(error)
    glfw.terminate()
    return "can be opened"
