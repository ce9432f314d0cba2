"""One module a command: `add` says its words, `run` does it and returns the exit code.

A module imports what its command needs inside `run`: `reparam --help` reads all the words, and
nobody waits for OpenGL there.
"""
