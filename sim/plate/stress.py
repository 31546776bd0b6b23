"""Stress of the plate by superposition of unit solutions, and its safety against yield."""

from dataclasses import dataclass
from itertools import product
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import PlateError
from rotemina.sim.messages import Message, format_fixed, message
from rotemina.sim.plate.statics import AXES, UnitSolutions
from rotemina.sim.robot import Plate, Robot


class StressPoint(NamedTuple):
    """A von Mises stress, Pa, and its position on the plate: radius m, direction rad."""

    stress: float
    radius: float
    direction: float


@dataclass(frozen=True, slots=True)
class YieldSafety:
    """Safety against yield, with the most stressed point and the pose of the hub.

    Attributes
    ----------
    factor : float
        Ratio of yield stress to von Mises stress; below 1 the plate yields.
    point : StressPoint
        The point with the largest stress.
    pose : (zn m, thx rad, thy rad)
    """

    factor: float
    point: StressPoint
    pose: tuple[float, float, float]


def deflection(solutions: UnitSolutions, pose: FloatArray) -> FloatArray:
    """Return the deflection (points,), m, for a motion (zn, thx, thy) of the hub."""
    return np.asarray(pose @ solutions.deflection)


def surface_stress(solutions: UnitSolutions, pose: FloatArray) -> FloatArray:
    """Return σx, σy, τxy at the upper surface, (3, points), Pa.

    The stress at the lower surface has the opposite sign.
    """
    return np.asarray(np.tensordot(pose, solutions.stress, axes=1))


def von_mises(stress: FloatArray) -> FloatArray:
    """Return the von Mises stress ``√(σx² − σx σy + σy² + 3 τxy²)`` for plane stress.

    It is the same at both surfaces.
    """
    x, y, xy = stress
    return np.asarray(np.sqrt(x**2 - x * y + y**2 + 3.0 * xy**2))


def principal_stresses(stress: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the larger and the smaller principal stress of the upper surface, Pa.

    Those of the lower surface have the opposite sign, so the larger one becomes the smaller one.
    """
    x, y, xy = stress
    middle, radius = 0.5 * (x + y), np.hypot(0.5 * (x - y), xy)
    return middle + radius, middle - radius


def find_peak_stress(solutions: UnitSolutions, pose: FloatArray) -> StressPoint:
    """Return the largest von Mises stress and its position."""
    mises = von_mises(surface_stress(solutions, pose))
    point = int(np.argmax(mises))
    x, y = solutions.clamped.mesh.points[:, point]
    return StressPoint(float(mises[point]), float(np.hypot(x, y)), float(np.arctan2(y, x)))


def safety_at(solutions: UnitSolutions, pose: FloatArray) -> YieldSafety:
    """Return the safety against yield at a pose (zn m, thx rad, thy rad)."""
    point = find_peak_stress(solutions, pose)
    yield_stress = solutions.clamped.plate.yield_stress
    factor = yield_stress / point.stress if point.stress > 0.0 else float("inf")
    zn, thx, thy = (float(value) for value in pose)
    return YieldSafety(factor, point, (zn, thx, thy))


def find_min_safety(solutions: UnitSolutions, ranges: FloatArray) -> YieldSafety:
    """Return the minimum safety over all poses within ``ranges`` (3, 2).

    Von Mises stress is a norm of a linear function of the pose. It is therefore convex, and its
    largest value over a box is at one of the eight corners.
    """
    corners = (safety_at(solutions, np.array(corner)) for corner in product(*ranges))
    return min(corners, key=lambda safety: safety.factor)


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
            "robot {name} has no axis {missing}; the plate carries {axes}: name a robot "
            "that has them",
            name=robot.name,
            missing=", ".join(missing),
            axes=", ".join(AXES),
        )
    return np.array([robot.axes[name].range for name in AXES], dtype=np.float64)


def describe_place(point: StressPoint, plate: Plate) -> Message:
    """Return the position of a stress on the plate as text."""
    fraction = (point.radius - plate.hub_radius) / (plate.rim_radius - plate.hub_radius)
    where = (
        message("engine", "at the hub")
        if fraction < 0.02
        else message("engine", "at the rim")
        if fraction > 0.98
        else message("engine", "between hub and rim")
    )
    degrees = np.degrees(point.direction) % 360.0
    return message("engine", "{where}, r {radius} mm, {degrees}°").fill(
        where=where, radius=format_fixed(1000.0 * point.radius, 2), degrees=format_fixed(degrees, 0)
    )
