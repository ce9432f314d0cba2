"""OpenGL's evaluators on today's GPU, and what a change of variables does to what they draw."""

__version__ = "0.1.0"
