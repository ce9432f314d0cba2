"""OpenGL's names with OpenGL's numbers (gl.h), so that PyOpenGL's constants fit here as well."""

from __future__ import annotations

from typing import Final

GL_POINTS: Final = 0x0000
GL_LINES: Final = 0x0001
GL_LINE_LOOP: Final = 0x0002
GL_LINE_STRIP: Final = 0x0003
GL_TRIANGLES: Final = 0x0004
GL_TRIANGLE_STRIP: Final = 0x0005
GL_TRIANGLE_FAN: Final = 0x0006
GL_QUADS: Final = 0x0007
GL_QUAD_STRIP: Final = 0x0008
GL_POLYGON: Final = 0x0009

GL_POINT: Final = 0x1B00
GL_LINE: Final = 0x1B01
GL_FILL: Final = 0x1B02

GL_MAP1_COLOR_4: Final = 0x0D90
GL_MAP1_INDEX: Final = 0x0D91
GL_MAP1_NORMAL: Final = 0x0D92
GL_MAP1_TEXTURE_COORD_1: Final = 0x0D93
GL_MAP1_TEXTURE_COORD_2: Final = 0x0D94
GL_MAP1_TEXTURE_COORD_3: Final = 0x0D95
GL_MAP1_TEXTURE_COORD_4: Final = 0x0D96
GL_MAP1_VERTEX_3: Final = 0x0D97
GL_MAP1_VERTEX_4: Final = 0x0D98

GL_MAP2_COLOR_4: Final = 0x0DB0
GL_MAP2_INDEX: Final = 0x0DB1
GL_MAP2_NORMAL: Final = 0x0DB2
GL_MAP2_TEXTURE_COORD_1: Final = 0x0DB3
GL_MAP2_TEXTURE_COORD_2: Final = 0x0DB4
GL_MAP2_TEXTURE_COORD_3: Final = 0x0DB5
GL_MAP2_TEXTURE_COORD_4: Final = 0x0DB6
GL_MAP2_VERTEX_3: Final = 0x0DB7
GL_MAP2_VERTEX_4: Final = 0x0DB8

GL_AUTO_NORMAL: Final = 0x0D80
GL_MAX_EVAL_ORDER: Final = 0x0D30
GL_MAP1_GRID_DOMAIN: Final = 0x0DD0
GL_MAP1_GRID_SEGMENTS: Final = 0x0DD1
GL_MAP2_GRID_DOMAIN: Final = 0x0DD2
GL_MAP2_GRID_SEGMENTS: Final = 0x0DD3
GL_COEFF: Final = 0x0A00
GL_ORDER: Final = 0x0A01
GL_DOMAIN: Final = 0x0A02

GL_CURRENT_COLOR: Final = 0x0B00
GL_CURRENT_INDEX: Final = 0x0B01
GL_CURRENT_NORMAL: Final = 0x0B02
GL_CURRENT_TEXTURE_COORDS: Final = 0x0B03
GL_ACTIVE_TEXTURE: Final = 0x84E0
GL_TEXTURE0: Final = 0x84C0
GL_TEXTURE1: Final = 0x84C1
GL_ATTRIB_STACK_DEPTH: Final = 0x0BB0
GL_MAX_ATTRIB_STACK_DEPTH: Final = 0x0D35

GL_CURRENT_BIT: Final = 0x00000001
GL_ENABLE_BIT: Final = 0x00002000
GL_EVAL_BIT: Final = 0x00010000
GL_ALL_ATTRIB_BITS: Final = 0xFFFFFFFF

GL_INVALID_ENUM: Final = 0x0500
GL_INVALID_VALUE: Final = 0x0501
GL_INVALID_OPERATION: Final = 0x0502
GL_STACK_OVERFLOW: Final = 0x0503
GL_STACK_UNDERFLOW: Final = 0x0504

_ALL = {name: value for name, value in globals().items() if name.startswith("GL_")}
PRIMITIVES = {value: name for name, value in _ALL.items() if value <= GL_POLYGON}
_NAMES = {
    value: name
    for name, value in _ALL.items()
    if value > GL_POLYGON and not name.endswith(("_BIT", "_BITS"))
}


def name_of(value: object) -> str:
    """The constant's name, for messages; its hexadecimal number where it is none of these."""
    if not isinstance(value, int):
        return repr(value)
    return _NAMES.get(value, f"0x{value:04X}")
