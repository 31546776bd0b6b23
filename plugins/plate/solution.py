"""Solution of a plate, with the quantities that the drawing needs."""

from collections.abc import Callable
from dataclasses import dataclass
from itertools import product

import numpy as np

from rotemina.plugins.plate import mark
from rotemina.plugins.plate.coloured_quantities import find_largest_values
from rotemina.sim.arrays import FloatArray
from rotemina.sim.plate import (
    PlateMesh,
    PlateModes,
    UnitSolutions,
    YieldSafety,
    clamp_plate,
    compute_eigenmodes,
    find_min_safety,
    motion_ranges,
    pin_length,
    solve_unit_motions,
)
from rotemina.sim.robot import Robot

MODE_COUNT = 10


@dataclass(frozen=True, slots=True, eq=False)
class SolvedPlate:
    """Solved plate: unit solutions, modes, and the range of motion (3, 2) of its hub.

    ``lowest_safety`` is the lowest safety against yield over the range of motion. ``hub_lid``
    contains the triangles (3, t) that close the hub. Their common corner is the centre of the hub,
    whose index follows the last point of the mesh.
    ``largest`` has the largest absolute value of each quantity, SI.
    """

    solutions: UnitSolutions
    modes: PlateModes
    ranges: FloatArray
    lowest_safety: YieldSafety
    pin_length_m: float
    hub_lid: np.ndarray
    largest: tuple[float, ...]

    @property
    def mesh(self) -> PlateMesh:
        """Mesh of the plate."""
        return self.solutions.clamped.mesh

    @property
    def radius(self) -> float:
        """Radius of the rim, m."""
        return self.solutions.clamped.plate.rim_radius

    @property
    def largest_deflection(self) -> float:
        """Largest deflection over the range of motion, m."""
        return self.largest[-1]


def solve_plate(robot: Robot, divisions: int, report_stage: Callable[[str], None]) -> SolvedPlate:
    """Solve the plate of a robot.

    ``report_stage`` is called with the name of the next stage, a marked text. An exception that it
    raises stops the solution.

    Raises
    ------
    PlateError
        If the plate cannot be computed, or the robot lacks the axes that the plate carries.
    """
    ranges, length = motion_ranges(robot), pin_length(robot)
    report_stage(mark("meshing"))
    clamped_plate = clamp_plate(robot.plate, divisions)
    report_stage(mark("solving"))
    solutions = solve_unit_motions(clamped_plate)
    report_stage(mark("modes"))
    modes = compute_eigenmodes(clamped_plate, length, MODE_COUNT)
    report_stage(mark("range of motion"))
    return SolvedPlate(
        solutions=solutions,
        modes=modes,
        ranges=ranges,
        lowest_safety=find_min_safety(solutions, ranges),
        pin_length_m=length,
        hub_lid=_make_hub_lid(clamped_plate.mesh),
        largest=find_largest_values(solutions, np.array(list(product(*ranges)))),
    )


def _make_hub_lid(mesh: PlateMesh) -> np.ndarray:
    """Return triangles from the circle of the hub to its centre, a point after the mesh points."""
    circle = np.flatnonzero(mesh.hub)
    circle = circle[np.argsort(np.arctan2(*mesh.points[::-1, circle]))]
    centre = np.full(circle.size, mesh.points.shape[1])
    return np.stack([centre, circle, np.roll(circle, -1)])
