"""Slow motion of the pin's bottom end with plate, pin and seat in equilibrium at every step."""

from dataclasses import dataclass

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import PlateError
from rotemina.sim.plate.pin import pin_compliance, pin_stress
from rotemina.sim.plate.seat_friction import friction_utilization, solve_seat_force
from rotemina.sim.plate.statics import UnitSolutions

DEFAULT_DURATION_S = 30.0
DEFAULT_STEPS = 300


@dataclass(frozen=True, slots=True, eq=False)
class RampResponse:
    """Response to a motion of the pin's bottom end, one row for each instant.

    The first row is the unloaded plate.

    Attributes
    ----------
    time_s : (n,) array
    bottom : (n, 3) array
        Prescribed motion: zn m, thx and thy rad (sideways motion divided by the pin's length).
    hub : (n, 3) array
        Motion of the hub: zn m, thx rad, thy rad.
    force : (n, 3) array
        Reaction force along the pin, N, and moments about the pivot, N m.
    slip : (n, 3) array
        Slip of the pin in its seat since the start, m and rad.
    utilization : (n,) array
        Share of the friction in the seat that is used; 1 where the pin slips.
    pin_stress : (n,) array
        Largest stress in the pin, Pa.
    """

    time_s: FloatArray
    bottom: FloatArray
    hub: FloatArray
    force: FloatArray
    slip: FloatArray
    utilization: FloatArray
    pin_stress: FloatArray

    @property
    def has_slipped(self) -> bool:
        """Whether the pin has slipped in its seat."""
        return bool(np.any(self.slip))


def make_ramp_path(
    target: FloatArray, *, steps: int = DEFAULT_STEPS, back: bool = False
) -> FloatArray:
    """Return a path (n, 3) in equal steps from rest to a target (3,), and back if ``back``."""
    fractions = np.linspace(0.0, 1.0, steps + 1)
    if back:
        fractions = np.concatenate([fractions, fractions[-2::-1]])
    return np.outer(fractions, target)


def move_bottom(
    solutions: UnitSolutions,
    length_m: float,
    path: FloatArray,
    duration_s: float = DEFAULT_DURATION_S,
) -> RampResponse:
    """Return the response to a path of (zn, thx, thy) of the pin's bottom end.

    The rows of the path are equally spaced in time.

    Raises
    ------
    PlateError
        If the path is not a table of three columns with finite numbers, or the duration is not
        positive.
    """
    if path.ndim != 2 or path.shape[1] != 3 or len(path) < 2 or not np.isfinite(path).all():
        raise PlateError("the path of the pin's bottom must be rows of three finite numbers")
    if not (np.isfinite(duration_s) and duration_s > 0.0):
        raise PlateError(
            "duration of the ramp = {duration_s} s: must be positive", duration_s=duration_s
        )
    plate = solutions.clamped.plate
    hub_compliance = np.linalg.inv(solutions.stiffness)
    stiffness = np.asarray(
        np.linalg.inv(hub_compliance + pin_compliance(plate.pin, length_m)), dtype=np.float64
    )
    slip = np.zeros(3)
    forces, slips = [], []
    for bottom in path:
        seat_force = solve_seat_force(plate.joint, stiffness, stiffness @ (bottom - slip))
        slip = slip + seat_force.slip
        forces.append(seat_force.force)
        slips.append(slip)
    force = np.array(forces)
    return RampResponse(
        time_s=np.linspace(0.0, duration_s, len(path)),
        bottom=path,
        hub=force @ hub_compliance.T,
        force=force,
        slip=np.array(slips),
        utilization=np.array([friction_utilization(plate.joint, row) for row in force]),
        pin_stress=np.array([pin_stress(plate.pin, row) for row in force]),
    )
