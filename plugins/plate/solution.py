"""A solved plate, with data for drawing."""

from collections.abc import Callable
from dataclasses import dataclass
from itertools import product

import numpy as np

from rotemina.plugins.plate import mark
from rotemina.plugins.plate.coloured_quantities import largest_values
from rotemina.sim.arrays import FloatArray
from rotemina.sim.plate.mesh import PlateMesh
from rotemina.sim.plate.modes import Modes, eigenmodes
from rotemina.sim.plate.pin import pin_length
from rotemina.sim.plate.statics import UnitSolutions, hold, solve
from rotemina.sim.plate.stress import Safety, least_safety, motion_ranges
from rotemina.sim.robot.model import Robot

MODES = 10


@dataclass(frozen=True, slots=True, eq=False)
class Solved:
    """A solved plate: unit solutions, modes, and the range of motion of its hub.

    ``hub_lid`` are triangles that close the hub, with the point after the mesh's last one in its
    middle. ``largest`` is the largest size of each quantity that can be shown, SI.
    """

    solutions: UnitSolutions
    modes: Modes
    ranges: FloatArray
    least: Safety
    pin_length_m: float
    hub_lid: np.ndarray
    largest: tuple[float, ...]

    @property
    def mesh(self) -> PlateMesh:
        """The plate's mesh."""
        return self.solutions.held.mesh

    @property
    def radius(self) -> float:
        """Radius of the rim, m."""
        return self.solutions.held.plate.rim_radius

    @property
    def largest_deflection(self) -> float:
        """Largest deflection over the range of motion, m."""
        return self.largest[-1]


def solved(robot: Robot, divisions: int, stage: Callable[[str], None]) -> Solved:
    """Solve a robot's plate; ``stage`` is told what comes next (a marked text), and may raise.

    Raises
    ------
    PlateError
        If the plate cannot be computed, or the robot does not have the axes that it carries.
    """
    ranges, length = motion_ranges(robot), pin_length(robot)
    stage(mark("meshing"))
    held = hold(robot.plate, divisions)
    stage(mark("solving"))
    solutions = solve(held)
    stage(mark("modes"))
    modes = eigenmodes(held, length, MODES)
    stage(mark("range of motion"))
    return Solved(
        solutions=solutions,
        modes=modes,
        ranges=ranges,
        least=least_safety(solutions, ranges),
        pin_length_m=length,
        hub_lid=_lid(held.mesh),
        largest=largest_values(solutions, np.array(list(product(*ranges)))),
    )


def _lid(mesh: PlateMesh) -> np.ndarray:
    """Return triangles from the hub's circle to a point after the last one, its middle."""
    around = np.flatnonzero(mesh.hub)
    around = around[np.argsort(np.arctan2(*mesh.points[::-1, around]))]
    middle = np.full(around.size, mesh.points.shape[1])
    return np.stack([middle, around, np.roll(around, -1)])
