"""The Okabe-Ito colours, safe for the colour-blind, each with one meaning throughout."""

from __future__ import annotations

from .layers import Color


def rgb(hexadecimal: str) -> Color:
    """(red, green, blue) in 0..1 from "RRGGBB"."""
    red, green, blue = bytes.fromhex(hexadecimal)
    return red / 255, green / 255, blue / 255


INK = rgb("222222")
GROUND = rgb("FFFFFF")
DOMAIN = rgb("E8F1F8")  # the parameter square
IMAGE = rgb("FBF3E2")  # its image
ALONG_U = rgb("0072B2")  # blue: where u runs
ALONG_V = rgb("D55E00")  # vermillion: where v runs
CURSOR = rgb("009E73")  # bluish green: the point looked at, in every space
CONTROL_NET = rgb("222222")
SURFACE = rgb("56B4E9")  # sky blue: a surface without a picture
PLAIN_GROUND = rgb("0000FF")  # far from the checkers and their mixtures, in colour and in grey
SAMPLES = rgb("D55E00")  # vermillion: points of the image that a parameterisation hands out
DERIVATIVE = rgb("009E73")  # bluish green: speed, curvature
MOVING = rgb("E69F00")  # orange: what walks in time
GUIDE = rgb("BBBBBB")  # what leads the eye
KEPT = rgb("D55E00")  # vermillion, on a curve: what stays as it was
MODIFIED = rgb("0072B2")  # blue, on a curve: what a designer changes
SMOOTH = rgb("009E73")  # bluish green: where things join as they should
SHARP = rgb("D55E00")  # vermillion: where they do not
STAYS = rgb("0072B2")  # blue, on a trim loop: its inside stays
GOES = rgb("D55E00")  # vermillion: its inside goes
FACETS = {  # the patches around a facet of that size; 4: all is regular
    3: rgb("009E73"),
    4: rgb("A9D6F0"),
    5: rgb("E69F00"),
    6: rgb("CC79A7"),
    7: rgb("D55E00"),
    8: rgb("F0E442"),
}
PIECES = (rgb("0072B2"), rgb("D55E00"), rgb("009E73"))  # of a curve, in their order
