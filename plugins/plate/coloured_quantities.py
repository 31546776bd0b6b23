"""Quantities of the plate that colours can show."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from rotemina.plugins.plate import mark
from rotemina.sim.arrays import FloatArray
from rotemina.sim.plate.statics import UnitSolutions
from rotemina.sim.plate.stress import deflection, principal, surface_stress, von_mises


@dataclass(frozen=True, slots=True)
class Quantity:
    """A quantity at the plate's points for a motion of the hub."""

    title: str
    unit: str
    per_si: float
    signed: bool  # its scale goes from minus to plus
    at: Callable[[UnitSolutions, FloatArray], FloatArray]


def _von_mises(solutions: UnitSolutions, pose: FloatArray) -> FloatArray:
    return von_mises(surface_stress(solutions, pose))


def _larger(solutions: UnitSolutions, pose: FloatArray) -> FloatArray:
    return principal(surface_stress(solutions, pose))[0]


def _smaller(solutions: UnitSolutions, pose: FloatArray) -> FloatArray:
    return principal(surface_stress(solutions, pose))[1]


def _deflection(solutions: UnitSolutions, pose: FloatArray) -> FloatArray:
    return deflection(solutions, pose)


QUANTITIES = (
    Quantity(mark("Von Mises stress"), "MPa", 1e-6, False, _von_mises),
    Quantity(mark("Larger principal stress, top"), "MPa", 1e-6, True, _larger),
    Quantity(mark("Smaller principal stress, top"), "MPa", 1e-6, True, _smaller),
    Quantity(mark("Deflection"), "µm", 1e6, True, _deflection),
)


def largest_values(solutions: UnitSolutions, corners: FloatArray) -> tuple[float, ...]:
    """Return the largest size of each quantity over poses (n, 3)."""
    return tuple(
        max(float(np.abs(quantity.at(solutions, pose)).max()) for pose in corners)
        for quantity in QUANTITIES
    )
