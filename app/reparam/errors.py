"""What can go wrong, each with the exit code of the command line (0 is good)."""


class ReparamError(Exception):
    """One line for the user: what was expected and what was found."""

    exit_code = 1


class GraphicsError(ReparamError):
    """OpenGL could not do it: no context, out of memory, a shader that does not compile."""


class UsageError(ReparamError):
    """Wrong words on the command line: an unknown scene, a value out of range."""

    exit_code = 2


class FileFormatError(ReparamError):
    """A file that does not hold what its format promises: `file:line: expected ..., found ...`."""

    exit_code = 3
