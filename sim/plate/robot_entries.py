"""The plate turned into entries of a robot file: stiffness, mass and coupling of its axes."""

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.messages import message
from rotemina.sim.plate.errors import PlateError
from rotemina.sim.plate.pin import pin_length
from rotemina.sim.plate.statics import AXES, UnitSolutions, hub_inertia
from rotemina.sim.plate.stress import least_safety, motion_ranges, place_text
from rotemina.sim.quantities import fixed
from rotemina.sim.robot.consistency import find_problem
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import Coupling, Robot

SHIPPED_ROBOT = "rotemina"
CARRIER = "z"  # the axis that carries the nano stage, which feels its acceleration
# Couplings smaller than this against the axes' own figures are rounding of the mesh.
_NOTHING = 1e-6


@dataclass(frozen=True, slots=True)
class Entry:
    """One figure of a robot file: what it was, and what the plate makes of it (SI)."""

    key: str
    unit: str
    before: float
    after: float

    @property
    def difference(self) -> float:
        """The relative change; infinite for a new entry."""
        if self.before == self.after:
            return 0.0
        return self.after / self.before - 1.0 if self.before else float("inf")


def agreement(solutions: UnitSolutions) -> tuple[Entry, ...]:
    """Return the plate's stiffness beside that of the shipped robot's axes."""
    shipped = load_robot(SHIPPED_ROBOT)
    return tuple(
        Entry(
            message("engine", "{name} stiffness").fill(name=name),
            "N/m" if name == "zn" else "N m/rad",
            shipped.axes[name].stiffness or 0.0,
            float(solutions.stiffness[index, index]),
        )
        for index, name in enumerate(AXES)
    )


def hub_mass(robot: Robot, solutions: UnitSolutions) -> FloatArray:
    """Return the (3, 3) inertia of plate, hub and pin for the hub's motion."""
    return np.asarray(solutions.mass + hub_inertia(robot.plate, pin_length(robot)))


def applied(robot: Robot, solutions: UnitSolutions) -> tuple[Robot, tuple[Entry, ...]]:
    """Return a robot with the plate's stiffness, mass and couplings, and what changed.

    Damping stays as it is, and so does everything else.

    Raises
    ------
    PlateError
        If the robot lacks the axes that the plate carries or gives them otherwise, the plate
        yields within their ranges, or no possible robot comes out.
    """
    ranges = motion_ranges(robot)
    least = least_safety(solutions, ranges)
    if least.factor < 1.0:
        zn, thx, thy = least.pose
        raise PlateError(
            message(
                "engine",
                "the plate yields within the range of motion: {stress} MPa {place_text} at zn {zn} "
                "µm, thx {thx} µrad, thy {thy} µrad; its yield strength is {yield_stress} MPa: "
                "make it thinner or wider",
            ).fill(
                stress=fixed(1e-06 * least.point.stress, 0),
                place_text=place_text(least.point, robot.plate),
                zn=fixed(1000000.0 * zn, 1),
                thx=fixed(1000000.0 * thx, 0),
                thy=fixed(1000000.0 * thy, 0),
                yield_stress=fixed(1e-06 * robot.plate.yield_stress, 0),
            )
        )
    mass = hub_mass(robot, solutions)
    entries = []
    axes = dict(robot.axes)
    for index, name in enumerate(AXES):
        axis = axes[name]
        if axis.mass is None or axis.stiffness is None:
            raise PlateError(
                message(
                    "engine",
                    "robot {robot}: axis.{axis} has no mass and stiffness of its own; give mass, "
                    "damping and stiffness to put the plate's there",
                ).fill(robot=robot.name, axis=name)
            )
        stiff, heavy = float(solutions.stiffness[index, index]), float(mass[index, index])
        units = ("N/m", "kg") if name == "zn" else ("N m/rad", "kg m²")
        entries.append(Entry(f"axis.{name}.stiffness", units[0], axis.stiffness, stiff))
        entries.append(Entry(f"axis.{name}.mass", units[1], axis.mass, heavy))
        axes[name] = replace(axis, stiffness=stiff, mass=heavy)
    couplings, changed = _couplings(robot, solutions.stiffness, mass)
    made = replace(robot, axes=axes, couplings=couplings)
    problem = find_problem(made)
    if problem is not None:
        raise PlateError(
            message("engine", "the plate gives an impossible robot: {problem}").fill(
                problem=str(problem)
            )
        )
    return made, (*entries, *changed)


def _couplings(
    robot: Robot, stiffness: FloatArray, mass: FloatArray
) -> tuple[tuple[Coupling, ...], list[Entry]]:
    """Return the couplings with the plate's in place of those between its axes."""
    wanted: dict[tuple[Literal["M", "D", "C"], str, str], float] = {}
    if CARRIER in robot.axes and not robot.axes[CARRIER].static:
        wanted["M", CARRIER, "zn"] = float(mass[0, 0])
    letters: tuple[Literal["M", "C"], ...] = ("M", "C")
    for letter, matrix in zip(letters, (mass, stiffness), strict=True):
        own = np.sqrt(np.diag(matrix))
        for i, j in ((0, 1), (0, 2), (1, 2)):
            if abs(matrix[i, j]) > _NOTHING * own[i] * own[j]:
                wanted[letter, AXES[i], AXES[j]] = float(matrix[i, j])
    entries, kept = [], []
    for coupling in robot.couplings:
        pair = _matching(coupling, wanted)
        if pair is not None:
            value = wanted.pop(pair)
            entries.append(_entry(pair, coupling.value, value))
            kept.append(replace(coupling, value=value))
        elif coupling.matrix != "D" and set(coupling.axes) <= set(AXES):
            entries.append(_entry((coupling.matrix, *coupling.axes), coupling.value, 0.0))
        else:
            kept.append(coupling)
    for pair, value in wanted.items():
        entries.append(_entry(pair, 0.0, value))
        kept.append(Coupling(matrix=pair[0], axes=(pair[1], pair[2]), value=value))
    return tuple(kept), entries


def _matching(
    coupling: Coupling, wanted: dict[tuple[Literal["M", "D", "C"], str, str], float]
) -> tuple[Literal["M", "D", "C"], str, str] | None:
    for matrix, one, other in wanted:
        if coupling.matrix == matrix and set(coupling.axes) == {one, other}:
            return matrix, one, other
    return None


def _entry(pair: tuple[str, str, str], before: float, after: float) -> Entry:
    turning = sum(name != "zn" and name != CARRIER for name in pair[1:])
    unit = {"M": ("kg", "kg m", "kg m²"), "C": ("N/m", "N/rad", "N m/rad")}[pair[0]][turning]
    return Entry(f"coupling.{pair[0]}[{pair[1]}, {pair[2]}]", unit, before, after)
