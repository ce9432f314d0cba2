"""A cold `reparam render fig5 --plain` against the least program that draws the same picture.

The bare program (the text below) is a process of its own too: it opens the context, draws the
same patch with hand-written shaders, the same picture as texture, with mip maps and
multisampling, and writes the PNG. It is run with numpy imported, as such programs do, and
without, which nothing that computes with numpy can match. The first runs, which fill the driver's
shader cache, do not count.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from pathlib import Path

from frames import python

from reparam.assets import texture_path
from reparam.bench import Rows, Skipped, interleave

BARE = '''
import array
import sys
import moderngl
from PIL import Image

if sys.argv[3] == "numpy":
    import numpy

VERTEX = """#version 330 core
in vec2 uv; out vec2 st;
uniform vec2 net[9];
vec2 row(int i, vec3 b) { return b.x * net[3 * i] + b.y * net[3 * i + 1] + b.z * net[3 * i + 2]; }
vec3 basis(float t) { return vec3((1 - t) * (1 - t), 2 * t * (1 - t), t * t); }
void main() {
    vec3 a = basis(uv.x), b = basis(uv.y);
    gl_Position = vec4((a.x * row(0, b) + a.y * row(1, b) + a.z * row(2, b)) / 1.62, 0, 1);
    st = vec2(2 * uv.y - 1, 1 - 2 * uv.x) * 2 + 2;
}"""
FRAGMENT = """#version 330 core
in vec2 st; out vec4 color;
uniform sampler2D image;
void main() { color = texture(image, st); }"""

ctx = moderngl.create_context(standalone=True, backend="egl")
net = [-1, 1, 0, 2, 1, 1, -2, 0, 0, 0, 2, 0, -1, -1, 0, -2, 1, -1]
program = ctx.program(vertex_shader=VERTEX, fragment_shader=FRAGMENT)
program["net"] = [tuple(net[i : i + 2]) for i in range(0, 18, 2)]
n = 32
grid = array.array("f", [k / n for i in range(n + 1) for j in range(n + 1) for k in (i, j)])
corner = lambda i, j: i * (n + 1) + j
triangles = array.array("i", [
    corner(i + a, j + b) for i in range(n) for j in range(n)
    for a, b in ((0, 0), (1, 0), (1, 1), (0, 0), (1, 1), (0, 1))
])
mesh = ctx.vertex_array(
    program, [(ctx.buffer(grid.tobytes()), "2f", "uv")], ctx.buffer(triangles.tobytes())
)
picture = Image.open(sys.argv[1]).convert("RGB").transpose(Image.Transpose.FLIP_TOP_BOTTOM)
texture = ctx.texture(picture.size, 3, picture.tobytes(), alignment=1)
texture.build_mipmaps()
texture.use(0)
size = (512, 512)
depth = ctx.depth_renderbuffer(size, samples=4)
fine = ctx.framebuffer([ctx.renderbuffer(size, 4, samples=4)], depth)
plain = ctx.framebuffer([ctx.renderbuffer(size, 4)])
fine.use()
fine.clear(1, 0, 1, 1)
mesh.render()
ctx.copy_framebuffer(plain, fine)
result = Image.frombytes("RGB", size, plain.read(components=3, alignment=1))
result.transpose(Image.Transpose.FLIP_TOP_BOTTOM).save(sys.argv[2])
'''


ACCOUNT = """
What a start does beyond the bare program is in `start_up`: our own modules, which are Python to be
loaded, then command line, scene and figure. On a busy machine loading many small files waits more
often than drawing does.
"""

RENDER = "import sys; from reparam.cli import main; sys.exit(main())"


def rows(pairs: int) -> Rows:
    """Both kinds of the bare program."""
    if not sys.platform.startswith("linux"):
        yield Skipped("cold_start", "the bare program opens its context through EGL")
        return
    with tempfile.TemporaryDirectory() as folder:
        script = Path(folder) / "bare.py"
        script.write_text(BARE, encoding="utf-8")
        bare = [sys.executable, str(script), str(texture_path("checkerboard"))]
        draw = ["render", "fig5", "--plain", "-o", f"{folder}/ours.png"]
        for kind, goal in (("numpy", 1.3), ("without-numpy", None)):
            other = [*bare, f"{folder}/bare.png", kind]
            times = interleave(
                lambda: python("-c", RENDER, *draw),
                lambda other=other: subprocess.run(other, check=True),
                pairs,
            )
            yield times.row(f"cold_start/{kind}", goal=goal, size="512x512")
