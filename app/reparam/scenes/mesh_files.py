"""Control meshes out of files: a body's polyhedron, and where in its file it is at fault."""

from __future__ import annotations

from ..errors import FileFormatError
from ..geometry.body import Body, Polyhedron
from ..geometry.mesh import Mesh, MeshError, mesh
from .remember import remember


@remember
def mesh_of(body: Body, parameter: str) -> Mesh:
    """The polyhedron of a body as a mesh; `parameter` is the one that asked for it.

    Raises ValueError where there is none, FileFormatError for one that is no oriented 2-manifold:
    the line in its file that made it so, and the face, edge or vertex.
    """
    found = body.polyhedron
    if found is None:
        raise ValueError(
            f"{parameter}: expected a file with a polyhedron, found Bezier patches alone"
        )
    try:
        return mesh(found.vertices, found.faces)
    except MeshError as fault:
        if not found.source:
            raise ValueError(f"{parameter}: {fault}") from None
        raise FileFormatError(_in_file(found, fault)) from None


def _in_file(polyhedron: Polyhedron, fault: MeshError) -> str:
    lines = sorted({polyhedron.line(face) for face in fault.faces})
    last = f":{lines[-1]}" if lines else ""
    found = ""
    if fault.place == "edge":
        found = f"the faces of line{'s' * (len(lines) > 1)} {', '.join(map(str, lines))}"
    elif fault.place == "vertex" and lines:
        found = "that face apart from the others"
    return f"{polyhedron.source}{last}: {fault.told(polyhedron.first, found)}"
