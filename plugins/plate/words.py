"""What the panel says of a solved plate."""

import numpy as np

from rotemina.plugins.plate.solved import Solved
from rotemina.sim.arrays import FloatArray
from rotemina.sim.plate.application import agreement
from rotemina.sim.plate.report import TOLERANCE, mode_name, pose_text, safety_text
from rotemina.sim.plate.stress import safety

MESHES = (("Coarse mesh", 60), ("Default mesh", 120), ("Fine mesh", 240))
AXES = (("zn", "µm", 1e6), ("thx", "µrad", 1e6), ("thy", "µrad", 1e6))
EMPTY = "Solve the plate of this robot to see its stress, its deformation and its modes."


def pose_lines(solved: Solved, pose: FloatArray) -> str:
    """Say what the plate bears and answers at a pose of the hub."""
    solutions = solved.solutions
    found = safety(solutions, pose)
    force, about_x, about_y = solutions.stiffness @ pose
    lines = [
        f"Reaction {force:.1f} N; {1e3 * about_x:.1f} and {1e3 * about_y:.1f} N mm about x and y",
    ]
    if np.any(pose):
        lines.insert(0, _capital(safety_text(found, solutions.held.plate)))
    return "\n".join(lines)


def plate_text(solved: Solved) -> str:
    """Say how stiff and how safe the plate is over the whole range of motion."""
    solutions = solved.solutions
    axial, tilt_x, tilt_y = np.diag(solutions.stiffness)
    far = max(abs(entry.difference) for entry in agreement(solutions))
    word = "agree" if far <= TOLERANCE else "do not agree"
    return "\n".join(
        [
            f"{1e-6 * axial:.3f} N/µm along the pin; {tilt_x:.4g} and {tilt_y:.4g} N m/rad in "
            f"tilt: they {word} with the shipped robot within {TOLERANCE:.0%}",
            f"Whole range: {safety_text(solved.least, solutions.held.plate)}, at "
            f"{pose_text(solved.least.pose)}",
        ]
    )


def mode_titles(solved: Solved) -> list[str]:
    """Return a title for each mode."""
    modes = solved.modes
    return [
        f"{number}  {frequency:.0f} Hz  {mode_name(hub)}"
        for number, (frequency, hub) in enumerate(
            zip(modes.frequencies_hz, modes.hub, strict=True), start=1
        )
    ]


def yields(solved: Solved, pose: FloatArray) -> bool:
    """Whether the plate yields at a pose."""
    return safety(solved.solutions, pose).factor < 1.0


def _capital(text: str) -> str:
    return text[0].upper() + text[1:]
