"""How the panel looks: Source Sans Pro, ink on paper, and one blue for what can be moved."""

from __future__ import annotations

import importlib.util
from pathlib import Path

from imgui_bundle import imgui

from ..scenes import palette

FONT_SIZE = 17.0  # at content scale 1, as all sizes here
HEADING = 21.0
WIDTH = 348.0

PAPER = (0.966, 0.963, 0.955)
FIELD = (1.0, 1.0, 1.0)
SHADE = (0.925, 0.920, 0.908)
EDGE = (0.78, 0.77, 0.75)
FAINT = (0.40, 0.40, 0.40)
GOOD = (0.0, 0.45, 0.32)
BAD = (0.72, 0.22, 0.0)

PAIRS = {
    "window_padding": (14.0, 10.0),
    "frame_padding": (7.0, 3.0),
    "item_spacing": (8.0, 6.0),
    "item_inner_spacing": (6.0, 4.0),
    "cell_padding": (4.0, 3.0),
}
SIZES = {
    "frame_rounding": 4.0,
    "grab_rounding": 4.0,
    "tab_rounding": 4.0,
    "popup_rounding": 4.0,
    "child_rounding": 4.0,
    "scrollbar_rounding": 6.0,
    "frame_border_size": 1.0,
    "popup_border_size": 1.0,
    "window_border_size": 0.0,
    "scrollbar_size": 11.0,
    "grab_min_size": 13.0,
    "indent_spacing": 14.0,
}
BLUE = palette.ALONG_U
COLORS = {
    "text": (*palette.INK, 1.0),
    "text_disabled": (*FAINT, 1.0),
    "window_bg": (*PAPER, 1.0),
    "popup_bg": (*FIELD, 1.0),
    "child_bg": (*PAPER, 0.0),
    "border": (*EDGE, 1.0),
    "separator": (*EDGE, 1.0),
    "frame_bg": (*FIELD, 1.0),
    "frame_bg_hovered": (*BLUE, 0.10),
    "frame_bg_active": (*BLUE, 0.18),
    "checkbox_selected_bg": (*FIELD, 1.0),
    "check_mark": (*BLUE, 1.0),
    "slider_grab": (*BLUE, 0.38),  # the value stands over it
    "slider_grab_active": (*BLUE, 0.60),
    "button": (*SHADE, 1.0),
    "button_hovered": (*BLUE, 0.18),
    "button_active": (*BLUE, 0.32),
    "header": (*BLUE, 0.14),
    "header_hovered": (*BLUE, 0.20),
    "header_active": (*BLUE, 0.30),
    "tab": (*SHADE, 1.0),
    "tab_hovered": (*BLUE, 0.20),
    "tab_selected": (*BLUE, 0.24),
    "tab_selected_overline": (*BLUE, 1.0),
    "scrollbar_bg": (*PAPER, 1.0),
    "scrollbar_grab": (*EDGE, 1.0),
    "text_selected_bg": (*BLUE, 0.30),
    "input_text_cursor": (*palette.INK, 1.0),
    "nav_cursor": (*BLUE, 1.0),
    "table_row_bg_alt": (*SHADE, 0.5),
    "table_border_light": (*EDGE, 1.0),
    "table_border_strong": (*EDGE, 1.0),
}


def load_fonts() -> imgui.ImFont:
    """Load the text's face, which is used by itself, and the headings', which is returned."""
    spec = importlib.util.find_spec("font_source_sans_pro")
    assert spec is not None
    assert spec.origin is not None
    folder, fonts = Path(spec.origin).parent / "files", imgui.get_io().fonts
    fonts.add_font_from_file_ttf(str(folder / "SourceSansPro-Regular.ttf"), FONT_SIZE)
    return fonts.add_font_from_file_ttf(str(folder / "SourceSansPro-Semibold.ttf"), FONT_SIZE)


def set_style(scale: float) -> None:
    """Colours, and sizes in the window's units: `scale` of them make one at content scale 1."""
    style = imgui.get_style()
    for name, (x, y) in PAIRS.items():
        setattr(style, name, imgui.ImVec2(x * scale, y * scale))
    for name, size in SIZES.items():
        setattr(style, name, size * scale)
    style.font_size_base = FONT_SIZE
    style.font_scale_dpi = scale
    for name, color in COLORS.items():
        style.set_color_(imgui.Col_[name].value, imgui.ImVec4(*color))
