"""The plate's mesh with its fields as a file of the Visualization Toolkit (``.vtu``)."""

import tempfile
from os import PathLike, fspath
from pathlib import Path

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.messages import message
from rotemina.sim.plate.errors import PlateError
from rotemina.sim.plate.modes import Modes
from rotemina.sim.plate.statics import UnitSolutions
from rotemina.sim.plate.stress import deflection, principal, surface_stress, von_mises
from rotemina.sim.whole_files import replaced


def write_vtu(
    path: str | PathLike[str],
    solutions: UnitSolutions,
    pose: FloatArray,
    modes: Modes | None = None,
) -> None:
    """Write mesh (m), displacement (m), stress of the upper surface (Pa) and modes.

    Raises
    ------
    PlateError
        If the name does not end with ``.vtu``.
    FileWriteError
        If the file cannot be written.
    """
    import meshio  # only this needs it, and it would make every start of the program slower

    name = fspath(path)
    if not name.endswith(".vtu"):
        raise PlateError(message("engine", "{name}: the name must end with .vtu").fill(name=name))
    mesh = solutions.held.mesh
    stress = surface_stress(solutions, pose)
    larger, smaller = principal(stress)
    fields = {
        "displacement": _along_pin(deflection(solutions, pose)),
        "von_mises": von_mises(stress),
        "principal_1_top": larger,
        "principal_2_top": smaller,
        "stress_top": stress.T.copy(),  # σx, σy, τxy
    }
    if modes is not None:
        shapes = zip(modes.frequencies_hz, modes.deflection, strict=True)
        for number, (frequency, shape) in enumerate(shapes, start=1):
            fields[f"mode_{number}_{frequency:.1f}_Hz"] = _along_pin(shape)
    points = np.concatenate([mesh.points, np.zeros((1, mesh.points.shape[1]))]).T
    made = meshio.Mesh(points, [("triangle", mesh.triangles.T)], point_data=fields)
    # meshio writes to a name only; ours take the place of another file when they are complete.
    with tempfile.TemporaryDirectory() as folder:
        draft = Path(folder) / "plate.vtu"
        meshio.write(draft, made)
        with replaced(name) as file:
            file.write(draft.read_bytes())


def _along_pin(values: FloatArray) -> FloatArray:
    return np.stack([np.zeros_like(values), np.zeros_like(values), values], axis=1)
