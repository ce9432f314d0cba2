"""The only room that talks to OpenGL."""
