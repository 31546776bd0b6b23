"""An inverse for a device that holds set-points and moves between them with its own ramps.

Such a device does not use the inverse at every tick. So lag and resonance are left out, and the
creep is that after a hold of :data:`SETTLED_S`: relaxations with time constants up to that time
have settled, and slower ones have not begun. The remaining model depends on turning points, but not
on time. From the latest turning point, each desired position has one set-point on the way up and
one on the way down.
"""

from dataclasses import replace
from typing import Self

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.compensate.inverse import Inverse, InverseExceedance, find_rest
from rotemina.sim.compensate.inverse_parameters import InverseModel

SETTLED_S = 1.0
# Number of points of the map on each side of the turning point.
_PLACES_PER_SIDE = 65
# Earlier turning points of a path hardly matter, because later ones erase them.
_MAX_TURNS = 20_000


class SetpointInverse:
    """The history of an axis under an inverse, and the map from desired positions to set-points.

    Parameters
    ----------
    model : InverseModel
    sent : set-point at which the axis rests, m or rad.

    Attributes
    ----------
    desired : position at which the axis is now, according to the inverse, m or rad.
    exceedance : InverseExceedance
        Limits of the inverse that targets have exceeded so far.

    Raises
    ------
    CompensationError
        If no position in the training range of the inverse has the set-point ``sent``.
    """

    def __init__(self, model: InverseModel, sent: float) -> None:
        self.model = model
        self.exceedance = InverseExceedance(0)
        is_slow = model.creep_times_s > SETTLED_S
        settled = replace(
            model,
            lag_s=0.0,
            mode_s2=0.0,
            creep_times_s=np.where(is_slow, np.inf, np.finfo(float).tiny),
        )
        self._inverse = Inverse(settled, SETTLED_S, preview=True)
        self._offset, self._sent = 0.0, sent
        # Direction of motion since the latest turning point.
        self._is_rising: bool | None = None
        resting_inverse, self.desired = find_rest(settled, SETTLED_S, sent)
        self._turning_state = resting_inverse.state
        self._places, self._setpoints = self._make_map()

    @property
    def range(self) -> tuple[float, float]:
        """Lowest and highest position that may be requested."""
        return self.model.desired_range

    def add_setpoint(self, target: float) -> float:
        """Return the set-point of a target, and add the pair to the map."""
        self._turn_towards(target)
        sent = self._find_setpoint(target)
        # FAST applies to samples that follow one another in time, which these do not.
        self.exceedance |= self._inverse.exceedance & ~InverseExceedance.FAST
        index = int(np.searchsorted(self._places, target))
        self._places = np.insert(self._places, index, target)
        self._setpoints = np.maximum.accumulate(np.insert(self._setpoints, index, sent))
        return sent

    def advance(self, sent: FloatArray) -> FloatArray:
        """Return the positions (n,) of the axis after successive set-points (n,)."""
        positions = np.empty_like(sent)
        for row, setpoint in enumerate(sent.tolist()):
            if setpoint != self._sent:
                self._move_to(setpoint)
            positions[row] = self.desired
        return positions

    def compute_speed_factor(self, target: float) -> float:
        """Return the ratio of set-point speed to desired axis speed on the way to a target.

        It is the smallest slope of the map on the way, so the axis never exceeds the desired speed.
        """
        self._turn_towards(target)
        low, high = sorted((self.desired, min(max(target, self.range[0]), self.range[1])))
        first = max(int(np.searchsorted(self._places, low, side="right")) - 1, 0)
        last = min(int(np.searchsorted(self._places, high)), len(self._places) - 1)
        rise = np.diff(self._setpoints[first : last + 1])
        run = np.diff(self._places[first : last + 1])
        slopes = rise[run > 0.0] / run[run > 0.0]
        return float(slopes.min()) if len(slopes) else 1.0

    def resume_after(self, path: FloatArray, sent: float) -> Self:
        """Continue from the end of a path (n,) of desired positions, and return this inverse.

        ``sent`` is the last set-point of the path. Its difference from the set-point that this
        inverse has there, mostly slow creep, becomes an offset.
        """
        turn_rows = np.flatnonzero(np.diff(np.sign(np.diff(path)))) + 1
        turning_points = np.concatenate([path[:1], path[turn_rows[-_MAX_TURNS:]], path[-1:]])
        self._offset, self.desired = 0.0, float(path[-1])
        self._inverse.reset().run(turning_points)
        self._turning_state = self._inverse.state
        self._offset = sent - self._find_setpoint(self.desired)
        self._start_map(self._turning_state, sent)
        return self

    def _turn_towards(self, target: float) -> None:
        """Start a new map at the present position if the target is in the opposite direction."""
        if (
            self._is_rising is not None
            and target != self.desired
            and (target > self.desired) != self._is_rising
        ):
            self._inverse.state = self._turning_state
            self._inverse.step(self.desired)
            self._start_map(self._inverse.state, self._sent)

    def _move_to(self, setpoint: float) -> None:
        is_rising = setpoint > self._sent
        self._turn_towards(np.inf if is_rising else -np.inf)
        self._is_rising, self._sent = is_rising, setpoint
        self.desired = float(np.interp(setpoint, self._setpoints, self._places))

    def _start_map(self, state: FloatArray, sent: float) -> None:
        self._turning_state, self._sent, self._is_rising = state, sent, None
        self._places, self._setpoints = self._make_map()

    def _make_map(self) -> tuple[FloatArray, FloatArray]:
        """Return ascending positions, and the set-points that reach them from the turning point."""
        low, high = self.range
        turning_position = min(max(self.desired, low), high)
        down, up = (
            np.linspace(low, turning_position, _PLACES_PER_SIDE),
            np.linspace(turning_position, high, _PLACES_PER_SIDE),
        )
        places = np.concatenate([down, up[1:]])
        setpoints = np.array([self._find_setpoint(place) for place in places.tolist()])
        return places, np.maximum.accumulate(setpoints)

    def _find_setpoint(self, place: float) -> float:
        self._inverse.state = self._turning_state
        return self._inverse.step(place) + self._offset
