"""Inverses between set-points and actuators of the simulated machine, tick by tick."""

from typing import NamedTuple

from rotemina.sim.arrays import FloatArray
from rotemina.sim.compensate.errors import CompensationError
from rotemina.sim.compensate.inverse import Exceedance, Inverse, resting_at
from rotemina.sim.compensate.inverse_parameters import InverseModel
from rotemina.sim.messages import message
from rotemina.sim.quantities import exact
from rotemina.sim.trajectory.setpoint_limits import SetpointLimits

_SLACK = 1e-3  # share of the span by which an axis may stand beyond what its inverse saw


class Rest(NamedTuple):
    """The inverse of an axis at rest, if it has one, and its command there, m or rad."""

    inverse: Inverse | None
    command: float


class Compensating:
    """The inverses in use, by the number of their axis; each is asked once a tick.

    That of an axis under a loop is part of the loop's feed-forward: here it only bounds the axis.

    Parameters
    ----------
    limits : SetpointLimits
        Of the machine.
    tick_s : float
    """

    def __init__(self, limits: SetpointLimits, tick_s: float) -> None:
        self._limits = limits
        self._tick_s = tick_s
        self._models: dict[int, InverseModel] = {}
        self._inverses: dict[int, Inverse] = {}
        #: In what each axis that has an inverse has gone beyond it; replaced as a whole.
        self.beyond: dict[int, Exceedance] = {}

    def model(self, index: int) -> InverseModel | None:
        """Return the inverse in use of an axis; None where there is none."""
        return self._models.get(index)

    def rest(self, model: InverseModel | None, sent: float) -> Rest:
        """Return how an axis that was sent to ``sent`` rests under a model, or under none.

        The first one may take tens of milliseconds; nothing changes.

        Raises
        ------
        CompensationError
            If the inverse asks for ``sent`` nowhere.
        """
        return Rest(None, sent) if model is None else Rest(*resting_at(model, self._tick_s, sent))

    def change(self, index: int, model: InverseModel | None, rest: Rest) -> float:
        """Use another inverse, or none, of an axis that rests so; return its command."""
        self._use(index, model)
        if rest.inverse is not None:
            self._inverses[index] = rest.inverse
        return rest.command

    def lend(self, index: int, model: InverseModel | None, at: float) -> float:
        """Lend the inverse of an axis at ``at`` to a loop; return its command there.

        Raises
        ------
        CompensationError
            If the axis stands beyond what the inverse saw.
        """
        low, high = float(self._limits.low[index]), float(self._limits.high[index])
        if model is not None:
            low, high = max(low, model.desired_range[0]), min(high, model.desired_range[1])
            slack = _SLACK * model.span
            if not low - slack <= at <= high + slack:
                raise CompensationError(
                    message(
                        "engine",
                        "inverse of axis {axis}: the axis is at {at}, but the inverse covers {low} "
                        "to {high}: move the axis there first",
                    ).fill(
                        axis=model.axis,
                        at=exact(at, model.unit, size=high),
                        low=exact(low, model.unit, size=high),
                        high=exact(high, model.unit),
                    )
                )
        self._use(index, model)
        return min(max(at, low), high)

    def retime(self, tick_s: float) -> None:
        """Continue at other ticks; the axes are at rest."""
        self._tick_s = tick_s
        for index, before in self._inverses.items():
            after = Inverse(before.model, tick_s)
            after.state = before.state
            self._inverses[index] = after

    def bounds(self, index: int) -> tuple[float, float]:
        """Return between which commands an axis may be: no farther than its inverse saw."""
        low, high = float(self._limits.low[index]), float(self._limits.high[index])
        if index in self._models:
            seen = self._models[index].desired_range
            return max(low, seen[0]), min(high, seen[1])
        return low, high

    def sent(self, command: FloatArray) -> FloatArray:
        """Return the commands (n, axes) to the actuators at the next n ticks."""
        if not self._inverses or not len(command):
            return command
        sent = command.copy()
        for index, inverse in self._inverses.items():
            sent[:, index] = inverse.run(command[:, index])
        self.note({index: inverse.beyond for index, inverse in self._inverses.items()})
        return sent

    def note(self, beyond: dict[int, Exceedance]) -> None:
        """Remember in what axes went beyond their inverses."""
        if any(self.beyond[index] | said != self.beyond[index] for index, said in beyond.items()):
            said = {index: self.beyond[index] | one for index, one in beyond.items()}
            self.beyond = {**self.beyond, **said}

    def _use(self, index: int, model: InverseModel | None) -> None:
        for one in (self._models, self._inverses):
            one.pop(index, None)
        left = {key: self.beyond[key] for key in self._models}
        if model is not None:
            self._models[index] = model
            left[index] = Exceedance(0)
        self.beyond = left
