"""Entries of a robot file computed from the plate: stiffness, mass and coupling of its axes."""

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import PlateError
from rotemina.sim.messages import format_fixed, message
from rotemina.sim.plate.pin import pin_length
from rotemina.sim.plate.statics import AXES, UnitSolutions, hub_inertia
from rotemina.sim.plate.stress import describe_place, find_min_safety, motion_ranges
from rotemina.sim.robot import AxisCoupling, Robot
from rotemina.sim.robot_files import find_problem, load_robot

SHIPPED_ROBOT_NAME = "rotemina"
# The axis that carries the nano stage, so that its acceleration acts on the nano stage.
CARRYING_AXIS = "z"
# Smallest coupling, relative to the diagonal entries of its axes. Smaller ones are rounding errors
# of the mesh.
_MIN_COUPLING_RATIO = 1e-6


@dataclass(frozen=True, slots=True)
class RobotEntryChange:
    """Change of one entry of a robot file (SI): its value before, and computed from the plate."""

    key: str
    unit: str
    before: float
    after: float

    @property
    def difference(self) -> float:
        """Relative change; infinite for a new entry."""
        if self.before == self.after:
            return 0.0
        return self.after / self.before - 1.0 if self.before else float("inf")


def compare_with_shipped_robot(solutions: UnitSolutions) -> tuple[RobotEntryChange, ...]:
    """Return the stiffness of the plate compared with that of the shipped robot's axes."""
    shipped_robot = load_robot(SHIPPED_ROBOT_NAME)
    return tuple(
        RobotEntryChange(
            message("engine", "{name} stiffness").fill(name=name),
            "N/m" if name == "zn" else "N m/rad",
            shipped_robot.axes[name].stiffness or 0.0,
            float(solutions.stiffness[index, index]),
        )
        for index, name in enumerate(AXES)
    )


def hub_mass(robot: Robot, solutions: UnitSolutions) -> FloatArray:
    """Return the inertia (3, 3) of plate, hub and pin for the motion of the hub."""
    return np.asarray(solutions.mass + hub_inertia(robot.plate, pin_length(robot)))


def apply_plate(
    robot: Robot, solutions: UnitSolutions
) -> tuple[Robot, tuple[RobotEntryChange, ...]]:
    """Return a robot with stiffness, mass and couplings of the plate, and the changed entries.

    Damping and all other entries remain unchanged.

    Raises
    ------
    PlateError
        If the robot lacks an axis that the plate carries, an axis has no mass and stiffness, the
        plate yields within the ranges, or the resulting robot is invalid.
    """
    ranges = motion_ranges(robot)
    safety = find_min_safety(solutions, ranges)
    if safety.factor < 1.0:
        zn, thx, thy = safety.pose
        raise PlateError(
            "the plate yields within the range of motion: {stress} MPa {place_text} at zn {zn} "
            "µm, thx {thx} µrad, thy {thy} µrad; its yield strength is {yield_stress} MPa: "
            "make it thinner or wider",
            stress=format_fixed(1e-06 * safety.point.stress, 0),
            place_text=describe_place(safety.point, robot.plate),
            zn=format_fixed(1000000.0 * zn, 1),
            thx=format_fixed(1000000.0 * thx, 0),
            thy=format_fixed(1000000.0 * thy, 0),
            yield_stress=format_fixed(1e-06 * robot.plate.yield_stress, 0),
        )
    mass = hub_mass(robot, solutions)
    entries = []
    axes = dict(robot.axes)
    for index, name in enumerate(AXES):
        axis = axes[name]
        if axis.mass is None or axis.stiffness is None:
            raise PlateError(
                "robot {robot}: axis.{axis} has no mass and stiffness that the plate could "
                "replace; give it mass, damping and stiffness",
                robot=robot.name,
                axis=name,
            )
        stiffness, axis_mass = float(solutions.stiffness[index, index]), float(mass[index, index])
        units = ("N/m", "kg") if name == "zn" else ("N m/rad", "kg m²")
        entries.append(
            RobotEntryChange(f"axis.{name}.stiffness", units[0], axis.stiffness, stiffness)
        )
        entries.append(RobotEntryChange(f"axis.{name}.mass", units[1], axis.mass, axis_mass))
        axes[name] = replace(axis, stiffness=stiffness, mass=axis_mass)
    couplings, coupling_changes = _replace_couplings(robot, solutions.stiffness, mass)
    changed_robot = replace(robot, axes=axes, couplings=couplings)
    problem = find_problem(changed_robot)
    if problem is not None:
        raise PlateError("the plate would make the robot invalid: {problem}", problem=str(problem))
    return changed_robot, (*entries, *coupling_changes)


def _replace_couplings(
    robot: Robot, stiffness: FloatArray, mass: FloatArray
) -> tuple[tuple[AxisCoupling, ...], list[RobotEntryChange]]:
    plate_couplings: dict[tuple[Literal["M", "D", "C"], str, str], float] = {}
    if CARRYING_AXIS in robot.axes and not robot.axes[CARRYING_AXIS].static:
        plate_couplings["M", CARRYING_AXIS, "zn"] = float(mass[0, 0])
    letters: tuple[Literal["M", "C"], ...] = ("M", "C")
    for letter, matrix in zip(letters, (mass, stiffness), strict=True):
        scales = np.sqrt(np.diag(matrix))
        for i, j in ((0, 1), (0, 2), (1, 2)):
            if abs(matrix[i, j]) > _MIN_COUPLING_RATIO * scales[i] * scales[j]:
                plate_couplings[letter, AXES[i], AXES[j]] = float(matrix[i, j])
    entries, couplings = [], []
    for coupling in robot.couplings:
        pair = _find_matching_pair(coupling, plate_couplings)
        if pair is not None:
            value = plate_couplings.pop(pair)
            entries.append(_make_coupling_change(pair, coupling.value, value))
            couplings.append(replace(coupling, value=value))
        elif coupling.matrix != "D" and set(coupling.axes) <= set(AXES):
            entries.append(
                _make_coupling_change((coupling.matrix, *coupling.axes), coupling.value, 0.0)
            )
        else:
            couplings.append(coupling)
    for pair, value in plate_couplings.items():
        entries.append(_make_coupling_change(pair, 0.0, value))
        couplings.append(AxisCoupling(matrix=pair[0], axes=(pair[1], pair[2]), value=value))
    return tuple(couplings), entries


def _find_matching_pair(
    coupling: AxisCoupling, plate_couplings: dict[tuple[Literal["M", "D", "C"], str, str], float]
) -> tuple[Literal["M", "D", "C"], str, str] | None:
    for matrix, first, second in plate_couplings:
        if coupling.matrix == matrix and set(coupling.axes) == {first, second}:
            return matrix, first, second
    return None


def _make_coupling_change(
    pair: tuple[str, str, str], before: float, after: float
) -> RobotEntryChange:
    rotation_count = sum(name != "zn" and name != CARRYING_AXIS for name in pair[1:])
    unit = {"M": ("kg", "kg m", "kg m²"), "C": ("N/m", "N/rad", "N m/rad")}[pair[0]][rotation_count]
    return RobotEntryChange(f"coupling.{pair[0]}[{pair[1]}, {pair[2]}]", unit, before, after)
