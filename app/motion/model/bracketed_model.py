"""A model with memory that runs along with a session, once for each extreme of its past."""

from collections.abc import Mapping
from types import MappingProxyType

import numpy as np

from rotemina.app.motion.model.live_model import LiveModel
from rotemina.sim.arrays import BoolArray, FloatArray
from rotemina.sim.robot import Robot

# The runs of an axis agree if they differ by less than this fraction of its noise floor.
_MAX_UNCERTAINTY_TO_NOISE_RATIO = 0.5
# The runs must agree for this long before the fall run ends.
_MIN_AGREEMENT_S = 1.0


class BracketedModel:
    """Two runs of a model, which bracket the response of a machine whose past is unknown.

    One run starts as if the axes had risen to their positions long ago, the other as if they had
    fallen to them. The rise run is the prediction, because a diagnosis also assumes a rise before
    each record. The difference of the two runs is the uncertainty of the prediction. The runs agree
    once a large swing has overwritten the past, or the past has faded with time; then the fall run
    ends. A model without memory has no fall run.

    Parameters
    ----------
    robot : Robot
        The robot, including its effects.
    offsets : mapping axis -> float
        Constant offsets of the readings, m or rad.
    """

    def __init__(self, robot: Robot, offsets: Mapping[str, float] = MappingProxyType({})) -> None:
        self._robot, self._offsets = robot, offsets
        self._rise_run = LiveModel(robot, offsets)
        self._noise_floor = np.array(
            [
                (axis.sensor.noise_floor if axis.sensor else 0.0) or 1e-6 * axis.span
                for axis in robot.axes.values()
            ]
        )
        self.restart()

    @property
    def time_s(self) -> float:
        """Device time of the latest command that the model has processed; −∞ before the first."""
        return self._rise_run.time_s

    @property
    def unsettled_axes(self) -> tuple[str, ...]:
        """The axes whose past is not known well enough for a reliable prediction."""
        return tuple(np.array(tuple(self._robot.axes))[self._are_axes_uncertain].tolist())

    def restart(self) -> None:
        """Start again from rest at the next command, with an unknown past."""
        self._rise_run.restart()
        self._fall_run: LiveModel | None = None
        if self._rise_run.has_memory:
            self._fall_run = LiveModel(self._robot, self._offsets, starts_after_fall=True)
        # Device time since which the two runs have agreed.
        self._agreed_since_s: float | None = None
        self._are_axes_uncertain: BoolArray = np.zeros(len(self._noise_floor), dtype=np.bool_)

    def predict(self, time_s: FloatArray, command: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return readings (n, axes), m or rad, for the next commands, and their uncertainty."""
        rise_readings = self._rise_run.predict(time_s, command)
        if self._fall_run is None or not len(time_s):
            return rise_readings, np.zeros(rise_readings.shape)
        fall_readings = self._fall_run.predict(time_s, command)
        uncertainty = np.abs(rise_readings - fall_readings)
        self._update_uncertain_axes(time_s, uncertainty)
        return rise_readings, uncertainty

    def _update_uncertain_axes(self, time_s: FloatArray, uncertainty: FloatArray) -> None:
        """Update the uncertain axes; end the fall run once the runs have agreed for long enough."""
        is_uncertain = uncertainty > _MAX_UNCERTAINTY_TO_NOISE_RATIO * self._noise_floor
        self._are_axes_uncertain = np.asarray(is_uncertain[-1])
        if is_uncertain.any():
            next_row = int(np.flatnonzero(is_uncertain.any(axis=1))[-1]) + 1
            self._agreed_since_s = float(time_s[next_row]) if next_row < len(time_s) else None
        elif self._agreed_since_s is None:
            self._agreed_since_s = float(time_s[0])
        if (
            self._agreed_since_s is not None
            and time_s[-1] - self._agreed_since_s >= _MIN_AGREEMENT_S
        ):
            self._fall_run = None
