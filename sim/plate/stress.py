"""Stress of the plate as a superposition of unit solutions, and its safety against yield."""

from dataclasses import dataclass
from itertools import product
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.messages import marked, message
from rotemina.sim.plate.errors import PlateError
from rotemina.sim.plate.statics import AXES, UnitSolutions
from rotemina.sim.quantities import fixed
from rotemina.sim.robot.model import Robot
from rotemina.sim.robot.plate import Plate


class StressPoint(NamedTuple):
    """A stress (von Mises, Pa) and where on the plate it is: radius m, direction rad."""

    stress: float
    radius: float
    direction: float


@dataclass(frozen=True, slots=True)
class Safety:
    """The least safety against yield, and where and when that is.

    Attributes
    ----------
    factor : float
        Yield stress over von Mises stress; below 1 the plate yields.
    point : StressPoint
    pose : (zn m, thx rad, thy rad)
    """

    factor: float
    point: StressPoint
    pose: tuple[float, float, float]


def deflection(solutions: UnitSolutions, pose: FloatArray) -> FloatArray:
    """Return the deflection of the points for a motion (zn, thx, thy) of the hub, m."""
    return np.asarray(pose @ solutions.deflection)


def surface_stress(solutions: UnitSolutions, pose: FloatArray) -> FloatArray:
    """Return σx, σy, τxy at the upper surface, (3, points), Pa; opposite at the lower one."""
    return np.asarray(np.tensordot(pose, solutions.stress, axes=1))


def von_mises(stress: FloatArray) -> FloatArray:
    """Return ``√(σx² − σx σy + σy² + 3 τxy²)``, plane stress; the same at both surfaces."""
    x, y, xy = stress
    return np.asarray(np.sqrt(x**2 - x * y + y**2 + 3.0 * xy**2))


def principal(stress: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the larger and the smaller principal stress of the upper surface, Pa.

    At the lower surface the larger one is minus the smaller one here, and the other way round.
    """
    x, y, xy = stress
    middle, radius = 0.5 * (x + y), np.hypot(0.5 * (x - y), xy)
    return middle + radius, middle - radius


def greatest(solutions: UnitSolutions, pose: FloatArray) -> StressPoint:
    """Return the largest von Mises stress and its place."""
    mises = von_mises(surface_stress(solutions, pose))
    point = int(np.argmax(mises))
    x, y = solutions.held.mesh.points[:, point]
    return StressPoint(float(mises[point]), float(np.hypot(x, y)), float(np.arctan2(y, x)))


def safety(solutions: UnitSolutions, pose: FloatArray) -> Safety:
    """Return the safety against yield at one pose (zn m, thx rad, thy rad)."""
    point = greatest(solutions, pose)
    yields = solutions.held.plate.yield_stress
    factor = yields / point.stress if point.stress > 0.0 else float("inf")
    zn, thx, thy = (float(value) for value in pose)
    return Safety(factor, point, (zn, thx, thy))


def least_safety(solutions: UnitSolutions, ranges: FloatArray) -> Safety:
    """Return the least safety over all poses between ``ranges`` (3, 2).

    Von Mises stress is a norm of a linear function of the pose, so it is convex: its largest value
    over a box is at one of the eight corners.
    """
    corners = (safety(solutions, np.array(corner)) for corner in product(*ranges))
    return min(corners, key=lambda one: one.factor)


def motion_ranges(robot: Robot) -> FloatArray:
    """Return the ranges of zn, thx and thy, (3, 2), m and rad.

    Raises
    ------
    PlateError
        If the robot lacks one of these axes.
    """
    missing = [name for name in AXES if name not in robot.axes]
    if missing:
        raise PlateError(
            message(
                "engine",
                "robot {name} has no axis {missing}; the plate carries {axes}: name a robot "
                "that has them",
            ).fill(name=robot.name, missing=", ".join(missing), axes=", ".join(AXES))
        )
    return np.array([robot.axes[name].range for name in AXES], dtype=np.float64)


def place_text(point: StressPoint, plate: Plate) -> str:
    """Say where on the plate a place is."""
    share = (point.radius - plate.hub_radius) / (plate.rim_radius - plate.hub_radius)
    where = (
        marked("engine", "at the hub")
        if share < 0.02
        else marked("engine", "at the rim")
        if share > 0.98
        else "between"
    )
    degrees = np.degrees(point.direction) % 360.0
    return message("engine", "{where}, r {radius} mm, {degrees}°").fill(
        where=where, radius=fixed(1000.0 * point.radius, 2), degrees=fixed(degrees, 0)
    )
