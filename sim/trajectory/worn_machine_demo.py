"""Demonstration motions that reveal the effects of a worn RoTeMiNa: fading swings of its piezo."""

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect, Robot
from rotemina.sim.robot_files import load_robot

WORN_ROBOT = "rotemina_worn"
RATE_HZ = 1000.0
DURATION_S = 6.0
# The swing is the distance between its two ends.
_DEMO_AXIS, _SWING_M, _SWING_HZ = "zn", 5.4e-5, 0.61
# The swing decreases by this fraction until the end.
_FADE_RATIO = 0.6
# Duration of the smooth start and of the smooth end.
_RAMP_TIME_S = 1.0


def load_worn_effects(robot: Robot) -> tuple[AxisEffect, ...]:
    """Return the effects of a worn RoTeMiNa; none if ``robot`` is another machine."""
    worn = load_robot(WORN_ROBOT)
    return worn.effects if worn.axes == robot.axes else ()


def make_demonstration(robot: Robot, pace: float = 1.0) -> Record:
    """Return a motion of 6 s; another ``pace``, a factor on its frequency, gives another motion."""
    time_s = np.arange(round(DURATION_S * RATE_HZ)) / RATE_HZ
    envelope = (
        _make_ramp(time_s)
        * _make_ramp(time_s[-1] - time_s)
        * (1.0 - _FADE_RATIO * time_s / DURATION_S)
    )
    swing = 0.5 * _SWING_M * envelope * np.sin(2.0 * np.pi * _SWING_HZ * pace * time_s)
    command = sum(robot.axes[_DEMO_AXIS].range) / 2.0 + swing
    metadata = {"name": f"demonstration × {pace:g}"}
    return Record.from_signals(
        time_s, {(_DEMO_AXIS, Tap.CMD): command}, {_DEMO_AXIS: "m"}, metadata
    )


def _make_ramp(time_s: FloatArray) -> FloatArray:
    """Return a rise from 0 to 1 without a jump in speed."""
    phase = np.clip(time_s / _RAMP_TIME_S, 0.0, 1.0)
    return np.asarray(phase**2 * (3.0 - 2.0 * phase))
