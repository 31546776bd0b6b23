"""Export of the mesh and its fields to a file of the Visualization Toolkit (``.vtu``)."""

import tempfile
from os import PathLike, fspath
from pathlib import Path

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import PlateError
from rotemina.sim.files import replace_file
from rotemina.sim.plate.modes import PlateModes
from rotemina.sim.plate.statics import UnitSolutions
from rotemina.sim.plate.stress import deflection, principal_stresses, surface_stress, von_mises


def write_vtu(
    path: str | PathLike[str],
    solutions: UnitSolutions,
    pose: FloatArray,
    modes: PlateModes | None = None,
) -> None:
    """Write mesh (m), displacement (m), stress of the upper surface (Pa) and modes to a file.

    Raises
    ------
    PlateError
        If the name does not end with ``.vtu``.
    FileWriteError
        If the file cannot be written.
    """
    # Imported here, because it is needed only here and would slow down every start of the program.
    import meshio

    name = fspath(path)
    if not name.endswith(".vtu"):
        raise PlateError("{name}: the name must end with .vtu", name=name)
    mesh = solutions.clamped.mesh
    stress = surface_stress(solutions, pose)
    larger, smaller = principal_stresses(stress)
    fields = {
        "displacement": _make_pin_vectors(deflection(solutions, pose)),
        "von_mises": von_mises(stress),
        "principal_1_top": larger,
        "principal_2_top": smaller,
        # The columns are σx, σy, τxy.
        "stress_top": stress.T.copy(),
    }
    if modes is not None:
        shapes = zip(modes.frequencies_hz, modes.deflection, strict=True)
        for number, (frequency, shape) in enumerate(shapes, start=1):
            fields[f"mode_{number}_{frequency:.1f}_Hz"] = _make_pin_vectors(shape)
    points = np.concatenate([mesh.points, np.zeros((1, mesh.points.shape[1]))]).T
    vtk_mesh = meshio.Mesh(points, [("triangle", mesh.triangles.T)], point_data=fields)
    # meshio writes only to a file name. The target is replaced when the draft is complete.
    with tempfile.TemporaryDirectory() as folder:
        draft = Path(folder) / "plate.vtu"
        meshio.write(draft, vtk_mesh)
        with replace_file(name) as file:
            file.write(draft.read_bytes())


def _make_pin_vectors(values: FloatArray) -> FloatArray:
    return np.stack([np.zeros_like(values), np.zeros_like(values), values], axis=1)
