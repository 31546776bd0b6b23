"""The pin's bottom moved slowly: plate, pin and seat in equilibrium at every step."""

from dataclasses import dataclass

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.messages import message
from rotemina.sim.plate.errors import PlateError
from rotemina.sim.plate.pin import compliance, pin_stress
from rotemina.sim.plate.seat_friction import seat_force, utilization
from rotemina.sim.plate.statics import UnitSolutions

DURATION_S = 30.0
STEPS = 300


@dataclass(frozen=True, slots=True, eq=False)
class Ramp:
    """What happens while the pin's bottom moves; rows are instants, from the unloaded plate on.

    Attributes
    ----------
    time_s : (n,) array
    bottom : (n, 3) array
        What was prescribed: zn m, thx and thy rad (sideways motion over the pin's length).
    hub : (n, 3) array
        The hub's motion: zn m, thx rad, thy rad.
    force : (n, 3) array
        Reaction along the pin N and about the pivot N m.
    slip : (n, 3) array
        Of the pin in its seat since the start, m and rad.
    utilization : (n,) array
        Of friction in the seat; 1 where it slips.
    pin_stress : (n,) array
        Pa.
    """

    time_s: FloatArray
    bottom: FloatArray
    hub: FloatArray
    force: FloatArray
    slip: FloatArray
    utilization: FloatArray
    pin_stress: FloatArray

    @property
    def slipped(self) -> bool:
        """Whether the pin moved in its seat."""
        return bool(np.any(self.slip))


def ramp_path(target: FloatArray, *, steps: int = STEPS, back: bool = False) -> FloatArray:
    """Return an even path from rest to a target (3,), and back to rest if wanted, (n, 3)."""
    share = np.linspace(0.0, 1.0, steps + 1)
    if back:
        share = np.concatenate([share, share[-2::-1]])
    return np.outer(share, target)


def move_bottom(
    solutions: UnitSolutions, length_m: float, path: FloatArray, duration_s: float = DURATION_S
) -> Ramp:
    """Move the pin's bottom along a path of (zn, thx, thy) in even steps of time.

    Raises
    ------
    PlateError
        If the path is no such table of finite numbers, or the time is not positive.
    """
    if path.ndim != 2 or path.shape[1] != 3 or len(path) < 2 or not np.isfinite(path).all():
        raise PlateError(
            message("engine", "the path of the pin's bottom must be rows of three finite numbers")
        )
    if not (np.isfinite(duration_s) and duration_s > 0.0):
        raise PlateError(
            message("engine", "duration of the ramp = {duration_s} s: must be positive").fill(
                duration_s=duration_s
            )
        )
    plate = solutions.held.plate
    hub_compliance = np.linalg.inv(solutions.stiffness)
    stiffness = np.asarray(
        np.linalg.inv(hub_compliance + compliance(plate.pin, length_m)), dtype=np.float64
    )
    slip = np.zeros(3)
    forces, slips = [], []
    for bottom in path:
        carried = seat_force(plate.joint, stiffness, stiffness @ (bottom - slip))
        slip = slip + carried.slip
        forces.append(carried.force)
        slips.append(slip)
    force = np.array(forces)
    return Ramp(
        time_s=np.linspace(0.0, duration_s, len(path)),
        bottom=path,
        hub=force @ hub_compliance.T,
        force=force,
        slip=np.array(slips),
        utilization=np.array([utilization(plate.joint, one) for one in force]),
        pin_stress=np.array([pin_stress(plate.pin, one) for one in force]),
    )
