"""An inverse for a device that holds set-points and moves between them at its own ramps.

Nobody asks it at every tick, so lag and resonance are left out, and creep is that of a set-point
which stands for :data:`SETTLED_S`: relaxations up to that time have settled, slower ones have not
begun. What is left depends on turning points alone, not on time. From the latest of them, each
wanted position has one set-point on the way up and one on the way down.
"""

from dataclasses import replace
from typing import Self

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.compensate.inverse import Exceedance, Inverse, resting_at
from rotemina.sim.compensate.inverse_parameters import InverseModel

SETTLED_S = 1.0
_PLACES = 65  # of the map on each side of the turning point
_MOST_TURNS = 20_000  # of a path: earlier ones are wiped out by later ones, or nearly


class HeldInverse:
    """The memory of an axis under an inverse, and the map between what is wanted and sent.

    Parameters
    ----------
    model : InverseModel
    sent : the set-point at which the axis rests, m or rad.

    Attributes
    ----------
    wanted : where the inverse takes the axis to be now, m or rad.
    beyond : Exceedance
        In what a target has gone beyond the inverse so far.

    Raises
    ------
    CompensationError
        If the inverse asks for ``sent`` nowhere in what it saw.
    """

    def __init__(self, model: InverseModel, sent: float) -> None:
        self.model = model
        self.beyond = Exceedance(0)
        slow = model.creep_times_s > SETTLED_S
        settled = replace(
            model,
            lag_s=0.0,
            mode_s2=0.0,
            creep_times_s=np.where(slow, np.inf, np.finfo(float).tiny),
        )
        self._inverse = Inverse(settled, SETTLED_S, preview=True)
        self._offset, self._sent = 0.0, sent
        self._up: bool | None = None  # which way it goes since it turned
        rested, self.wanted = resting_at(settled, SETTLED_S, sent)
        self._turned = rested.state
        self._places, self._setpoints = self._map()

    @property
    def range(self) -> tuple[float, float]:
        """Between which positions it may be asked."""
        return self.model.desired_range

    def aim(self, target: float) -> float:
        """Return the set-point of a target, which the map has exactly from now on."""
        self._face(target)
        sent = self._sent_at(target)
        # FAST is of samples that follow one another in time; these do not.
        self.beyond |= self._inverse.beyond & ~Exceedance.FAST
        place = int(np.searchsorted(self._places, target))
        self._places = np.insert(self._places, place, target)
        self._setpoints = np.maximum.accumulate(np.insert(self._setpoints, place, sent))
        return sent

    def follow(self, sent: FloatArray) -> FloatArray:
        """Return where set-points (n,) that acted one after the other take the axis to be."""
        out = np.empty_like(sent)
        for row, setpoint in enumerate(sent.tolist()):
            if setpoint != self._sent:
                self._go(setpoint)
            out[row] = self.wanted
        return out

    def rate(self, target: float) -> float:
        """Return the factor for a speed on the way to a target.

        It is the least slope of the map there: the axis goes nowhere faster than is wanted.
        """
        self._face(target)
        low, high = sorted((self.wanted, min(max(target, self.range[0]), self.range[1])))
        first = max(int(np.searchsorted(self._places, low, side="right")) - 1, 0)
        last = min(int(np.searchsorted(self._places, high)), len(self._places) - 1)
        rise = np.diff(self._setpoints[first : last + 1])
        run = np.diff(self._places[first : last + 1])
        slopes = rise[run > 0.0] / run[run > 0.0]
        return float(slopes.min()) if len(slopes) else 1.0

    def walked(self, path: FloatArray, sent: float) -> Self:
        """Continue from the end of a path (n,) of wanted positions that brought ``sent`` about.

        What ``sent`` differs by from a held set-point there, mostly slow creep, stays as an offset.
        """
        turns = np.flatnonzero(np.diff(np.sign(np.diff(path)))) + 1
        way = np.concatenate([path[:1], path[turns[-_MOST_TURNS:]], path[-1:]])
        self._offset, self.wanted = 0.0, float(path[-1])
        self._inverse.reset().run(way)
        self._turned = self._inverse.state
        self._offset = sent - self._sent_at(self.wanted)
        self._turn(self._turned, sent)
        return self

    def _face(self, target: float) -> None:
        """Turn here, if the way to a target leads back."""
        if self._up is not None and target != self.wanted and (target > self.wanted) != self._up:
            self._inverse.state = self._turned
            self._inverse.step(self.wanted)
            self._turn(self._inverse.state, self._sent)

    def _go(self, setpoint: float) -> None:
        up = setpoint > self._sent
        self._face(np.inf if up else -np.inf)
        self._up, self._sent = up, setpoint
        self.wanted = float(np.interp(setpoint, self._setpoints, self._places))

    def _turn(self, state: FloatArray, sent: float) -> None:
        """Begin a new map at a turning point, where the axis is now."""
        self._turned, self._sent, self._up = state, sent, None
        self._places, self._setpoints = self._map()

    def _map(self) -> tuple[FloatArray, FloatArray]:
        """Return positions and their set-points, both ascending, on ways from where it turned."""
        low, high = self.range
        here = min(max(self.wanted, low), high)
        down, up = np.linspace(low, here, _PLACES), np.linspace(here, high, _PLACES)
        places = np.concatenate([down, up[1:]])
        setpoints = np.array([self._sent_at(place) for place in places.tolist()])
        return places, np.maximum.accumulate(setpoints)

    def _sent_at(self, place: float) -> float:
        self._inverse.state = self._turned
        return self._inverse.step(place) + self._offset
