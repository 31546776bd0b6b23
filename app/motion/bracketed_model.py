"""A model with continued memory; an unknown past is bracketed by its two extremes."""

from collections.abc import Mapping
from types import MappingProxyType

import numpy as np

from rotemina.app.motion.live_model import LiveModel
from rotemina.sim.arrays import BoolArray, FloatArray
from rotemina.sim.robot.model import Robot

_SETTLED = 0.5  # of a noise floor: a doubt below that is none
_SETTLED_S = 1.0  # for which it must have been


class BracketedModel:
    """Two runs of a model, one from a rise and one from a fall long ago; the truth lies between.

    The first is the answer, as it is where a diagnosis begins a record, and their difference the
    doubt. A swing that wipes the past out, or time that lets it fade, makes them one; the second
    run ends then. A model without memory never has it.

    Parameters
    ----------
    robot : Robot
        With its effects.
    offsets : mapping axis -> float
    """

    def __init__(self, robot: Robot, offsets: Mapping[str, float] = MappingProxyType({})) -> None:
        self._robot, self._offsets = robot, offsets
        self._risen = LiveModel(robot, offsets)
        self._floor = np.array(
            [
                (axis.sensor.noise_floor if axis.sensor else 0.0) or 1e-6 * axis.span
                for axis in robot.axes.values()
            ]
        )
        self.restart()

    @property
    def time_s(self) -> float:
        """Device time up to which it has followed; −∞ before the first sample."""
        return self._risen.time_s

    @property
    def unsettled(self) -> tuple[str, ...]:
        """The axes whose history is insufficiently known."""
        return tuple(np.array(tuple(self._robot.axes))[self._doubtful].tolist())

    def restart(self) -> None:
        """Rest at the next command, with a past that is unknown."""
        self._risen.restart()
        self._fallen: LiveModel | None = None
        if self._risen.remembers:
            self._fallen = LiveModel(self._robot, self._offsets, fallen=True)
        self._sure_s: float | None = None  # since when there is no doubt
        self._doubtful: BoolArray = np.zeros(len(self._floor), dtype=np.bool_)

    def answer(self, time_s: FloatArray, command: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return readings and their doubt, each (n, axes), m or rad, for the next commands."""
        risen = self._risen.answer(time_s, command)
        if self._fallen is None or not len(time_s):
            return risen, np.zeros(risen.shape)
        fallen = self._fallen.answer(time_s, command)
        doubt = np.abs(risen - fallen)
        self._note(time_s, doubt)
        return risen, doubt

    def _note(self, time_s: FloatArray, doubt: FloatArray) -> None:
        """Notice when both runs have become one."""
        beyond = doubt > _SETTLED * self._floor
        self._doubtful = np.asarray(beyond[-1])
        if beyond.any():
            last = int(np.flatnonzero(beyond.any(axis=1))[-1])
            self._sure_s = float(time_s[last + 1]) if last + 1 < len(time_s) else None
        elif self._sure_s is None:
            self._sure_s = float(time_s[0])
        if self._sure_s is not None and time_s[-1] - self._sure_s >= _SETTLED_S:
            self._fallen = None
