"""Quantities of the plate that can be shown by colours."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from rotemina.plugins.plate import mark
from rotemina.sim.arrays import FloatArray
from rotemina.sim.plate import (
    UnitSolutions,
    deflection,
    principal_stresses,
    surface_stress,
    von_mises,
)


@dataclass(frozen=True, slots=True)
class ColouredQuantity:
    """Quantity at the points of the plate, for a pose of the hub.

    ``compute`` returns its values (n,), SI. A signed quantity has a colour scale from minus to
    plus.
    """

    title: str
    unit: str
    per_si: float
    is_signed: bool
    compute: Callable[[UnitSolutions, FloatArray], FloatArray]


def _compute_von_mises(solutions: UnitSolutions, pose: FloatArray) -> FloatArray:
    return von_mises(surface_stress(solutions, pose))


def _compute_larger_principal(solutions: UnitSolutions, pose: FloatArray) -> FloatArray:
    return principal_stresses(surface_stress(solutions, pose))[0]


def _compute_smaller_principal(solutions: UnitSolutions, pose: FloatArray) -> FloatArray:
    return principal_stresses(surface_stress(solutions, pose))[1]


def _compute_deflection(solutions: UnitSolutions, pose: FloatArray) -> FloatArray:
    return deflection(solutions, pose)


QUANTITIES = (
    ColouredQuantity(mark("Von Mises stress"), "MPa", 1e-6, False, _compute_von_mises),
    ColouredQuantity(
        mark("Larger principal stress, top"), "MPa", 1e-6, True, _compute_larger_principal
    ),
    ColouredQuantity(
        mark("Smaller principal stress, top"), "MPa", 1e-6, True, _compute_smaller_principal
    ),
    ColouredQuantity(mark("Deflection"), "µm", 1e6, True, _compute_deflection),
)


def find_largest_values(solutions: UnitSolutions, corners: FloatArray) -> tuple[float, ...]:
    """Return the largest absolute value of each quantity over poses (n, 3)."""
    return tuple(
        max(float(np.abs(quantity.compute(solutions, pose)).max()) for pose in corners)
        for quantity in QUANTITIES
    )
