"""A cold `reparam render fig5 --plain` against the least program that draws the same picture.

    python tests/benchmarks/cold_start.py [--pairs 21]

The bare program (the text below) is a process of its own too: it opens the context, draws the
same patch with hand-written shaders, the same picture as texture, with mip maps and
multisampling, and writes the PNG. It is run twice: with numpy imported, as such programs do, and
without, which nothing that computes with numpy can match. The median of ratios of neighbouring
runs is printed; the first runs, which fill the driver's shader cache, do not count.
"""

from __future__ import annotations

import argparse
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from reparam.assets import texture_path

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


def seconds(command: list[str]) -> float:
    """Wall-clock time of a process."""
    began = time.perf_counter()
    subprocess.run(command, check=True)
    return time.perf_counter() - began


def main() -> None:
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--pairs", type=int, default=21)
    pairs = options.parse_args().pairs
    with tempfile.TemporaryDirectory() as folder:
        script = Path(folder) / "bare.py"
        script.write_text(BARE)
        picture = str(texture_path("checkerboard"))
        bare = [sys.executable, str(script), picture, f"{folder}/bare.png"]
        others = {"numpy": [*bare, "numpy"], "no numpy": [*bare, "none"]}
        render = "import sys; from reparam.cli import main; sys.exit(main())"
        ours = [
            sys.executable,
            "-c",
            render,
            "render",
            "fig5",
            "--plain",
            "-o",
            f"{folder}/ours.png",
        ]
        for name, other in others.items():
            for _ in range(2):
                seconds(other), seconds(ours)
            ratios = [seconds(ours) / seconds(other) for _ in range(pairs)]
            print(f"cold_start / bare with {name:10} {statistics.median(ratios):.3f}", flush=True)


if __name__ == "__main__":
    main()
