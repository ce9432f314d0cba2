"""Why OpenGL does not start, and the line that mends it."""

from __future__ import annotations

APT = "apt-get install --no-install-recommends"

# (what the library says, what it means, what mends it), the first that fits.
CAUSES = (
    ("libGL.so not loaded", "libGL is missing", f"{APT} libgl1 libegl1"),
    ("libEGL.so not loaded", "libEGL is missing", f"{APT} libegl1"),
    ("found 0 devices", "EGL finds no driver", f"{APT} libegl-mesa0 libgl1-mesa-dri"),
    (
        "eglInitialize failed (0x3001)",
        "EGL finds its device but not the driver, or may not open /dev/dri",
        f"{APT} libgl1-mesa-dri   (or: add the user to the groups video and render)",
    ),
    (
        "eglCreateContext failed (0x3009)",
        "the driver has no OpenGL 3.3 core",
        "update the graphics driver, or unset MESA_GL_VERSION_OVERRIDE and GALLIUM_DRIVER",
    ),
    (
        "XOpenDisplay: cannot open display",
        "a window system was asked for where there is no screen",
        "on Linux reparam asks for EGL by itself; check that glcontext is up to date: "
        "pip install -U moderngl glcontext",
    ),
    (
        "DISPLAY environment variable is missing",
        "there is no screen for a window",
        "reparam render fig5 -o fig5.png   (draws without one)",
    ),
    (
        "WAYLAND_DISPLAY",
        "there is no screen for a window",
        "reparam render fig5 -o fig5.png   (draws without one)",
    ),
)


def explain(message: str) -> str:
    """One line: the cause in words, what mends it, and what the library said."""
    said = " ".join(message.split())
    for sign, meaning, remedy in CAUSES:
        if sign in message:
            return f"OpenGL: {meaning}; try: {remedy}   [{said}]"
    return f"OpenGL did not start; `reparam doctor` tells more   [{said}]"
