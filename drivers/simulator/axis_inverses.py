"""Hysteresis inverses between the set-points and the actuators of the simulated machine."""

from typing import NamedTuple

from rotemina.sim.arrays import FloatArray
from rotemina.sim.compensate import Inverse, InverseExceedance, InverseModel, find_rest
from rotemina.sim.errors import CompensationError
from rotemina.sim.trajectory import SetpointLimits
from rotemina.sim.units import format_exact

# An axis may be outside the range of its inverse by this fraction of the span.
_RANGE_SLACK_RATIO = 1e-3


class InverseAtRest(NamedTuple):
    """The inverse of an axis at rest, or None, and the command of the axis, m or rad."""

    inverse: Inverse | None
    command: float


class SetpointInverses:
    """The inverses in use, by axis number. Each computes one actuator command per tick.

    If an axis is in a closed loop, its inverse is part of the loop's feed-forward. Then this class
    uses only its model, for the bounds of the axis.

    Parameters
    ----------
    limits : SetpointLimits
        Limits of the machine.
    tick_s : float
    """

    def __init__(self, limits: SetpointLimits, tick_s: float) -> None:
        self._limits = limits
        self._tick_s = tick_s
        self._models: dict[int, InverseModel] = {}
        self._inverses: dict[int, Inverse] = {}
        #: How far each axis has exceeded the range of its inverse, by axis number. Replaced as a
        #: whole, so that any thread may read it.
        self.exceedances: dict[int, InverseExceedance] = {}

    def get_model(self, index: int) -> InverseModel | None:
        """Return the model of an axis' inverse in use, or None."""
        return self._models.get(index)

    def find_rest(self, model: InverseModel | None, actuator_command: float) -> InverseAtRest:
        """Return an inverse at rest at an actuator command, and the command of the axis.

        The call changes nothing. The first call may take tens of milliseconds.

        Parameters
        ----------
        model : InverseModel or None
            Model of the inverse. If it is None, the command is the actuator command.
        actuator_command : float
            Actuator command, m or rad.

        Raises
        ------
        CompensationError
            If the inverse cannot produce this actuator command.
        """
        return (
            InverseAtRest(None, actuator_command)
            if model is None
            else InverseAtRest(*find_rest(model, self._tick_s, actuator_command))
        )

    def replace_inverse(self, index: int, model: InverseModel | None, rest: InverseAtRest) -> float:
        """Replace or remove the inverse of an axis at rest, and return the command of the axis."""
        self._set_model(index, model)
        if rest.inverse is not None:
            self._inverses[index] = rest.inverse
        return rest.command

    def lend_to_loop(self, index: int, model: InverseModel | None, position: float) -> float:
        """Hand the inverse of an axis over to its loop, and return the command of the axis.

        Raises
        ------
        CompensationError
            If the axis is outside the range of the inverse.
        """
        low, high = float(self._limits.low[index]), float(self._limits.high[index])
        if model is not None:
            low, high = max(low, model.desired_range[0]), min(high, model.desired_range[1])
            slack = _RANGE_SLACK_RATIO * model.span
            if not low - slack <= position <= high + slack:
                raise CompensationError(
                    "inverse of axis {axis}: the axis is at {at}, but the inverse covers {low} "
                    "to {high}: move the axis there first",
                    axis=model.axis,
                    at=format_exact(position, model.unit, size=high),
                    low=format_exact(low, model.unit, size=high),
                    high=format_exact(high, model.unit),
                )
        self._set_model(index, model)
        return min(max(position, low), high)

    def set_tick(self, tick_s: float) -> None:
        """Change the interval of the ticks. The axes must be at rest."""
        self._tick_s = tick_s
        for index, old_inverse in self._inverses.items():
            new_inverse = Inverse(old_inverse.model, tick_s)
            new_inverse.state = old_inverse.state
            self._inverses[index] = new_inverse

    def find_bounds(self, index: int) -> tuple[float, float]:
        """Return the smallest and largest command of an axis, within the range of its inverse."""
        low, high = float(self._limits.low[index]), float(self._limits.high[index])
        if index in self._models:
            inverse_range = self._models[index].desired_range
            return max(low, inverse_range[0]), min(high, inverse_range[1])
        return low, high

    def compute_actuator_commands(self, command: FloatArray) -> FloatArray:
        """Return the actuator commands (n, axes) for the commands of the next n ticks."""
        if not self._inverses or not len(command):
            return command
        actuator_command = command.copy()
        for index, inverse in self._inverses.items():
            actuator_command[:, index] = inverse.run(command[:, index])
        self.note_exceedances(
            {index: inverse.exceedance for index, inverse in self._inverses.items()}
        )
        return actuator_command

    def note_exceedances(self, exceedances: dict[int, InverseExceedance]) -> None:
        """Add how far axes have exceeded the ranges of their inverses."""
        combined = {
            index: self.exceedances[index] | exceedance for index, exceedance in exceedances.items()
        }
        if any(combined[index] != self.exceedances[index] for index in combined):
            self.exceedances = {**self.exceedances, **combined}

    def _set_model(self, index: int, model: InverseModel | None) -> None:
        self._models.pop(index, None)
        self._inverses.pop(index, None)
        exceedances = {other: self.exceedances[other] for other in self._models}
        if model is not None:
            self._models[index] = model
            exceedances[index] = InverseExceedance(0)
        self.exceedances = exceedances
