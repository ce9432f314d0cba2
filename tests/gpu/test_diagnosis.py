from __future__ import annotations

import pytest

from reparam.gpu.diagnosis import explain

SAID = {
    "libGL.so not loaded": "libgl1",
    "libEGL.so not loaded": "libegl1",
    "requested device index 0, but found 0 devices": "libegl-mesa0",
    "eglInitialize failed (0x3001)": "libgl1-mesa-dri",
    "eglCreateContext failed (0x3009)": "driver",
    "(standalone) XOpenDisplay: cannot open display": "EGL",
    "X11: The DISPLAY environment variable is missing": "reparam render fig5",
    "Wayland: Failed to connect: WAYLAND_DISPLAY": "reparam render fig5",
}


@pytest.mark.parametrize("message", SAID)
def test_each_known_failure_has_the_line_that_mends_it(message: str) -> None:
    line = explain(message)
    assert SAID[message] in line.split("[")[0]
    assert message in line
    assert "\n" not in line


def test_an_unknown_failure_is_one_line_that_names_the_doctor() -> None:
    line = explain("something\n  quite new")
    assert "reparam doctor" in line
    assert "something quite new" in line
