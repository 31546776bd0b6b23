"""Motions that show what is wrong with a worn RoTeMiNa: fading swings of its piezo."""

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect, Robot

WORN = "rotemina_worn"
RATE_HZ = 1000.0
DURATION_S = 6.0
_AXIS, _SWING, _HERTZ = "zn", 5.4e-5, 0.61  # from end to end, m
_FADES = 0.6  # share of the swing that is gone at the end
_SOFT_S = 1.0  # of the beginning and of the end


def worn_effects(robot: Robot) -> tuple[AxisEffect, ...]:
    """Return what years do to a RoTeMiNa; nothing where the robot is another one."""
    worn = load_robot(WORN)
    return worn.effects if worn.axes == robot.axes else ()


def demonstration(robot: Robot, pace: float = 1.0) -> Record:
    """Return a motion of 6 s; another ``pace`` makes one that no record of the first holds."""
    time_s = np.arange(round(DURATION_S * RATE_HZ)) / RATE_HZ
    fade = _softly(time_s) * _softly(time_s[-1] - time_s) * (1.0 - _FADES * time_s / DURATION_S)
    way = 0.5 * _SWING * fade * np.sin(2.0 * np.pi * _HERTZ * pace * time_s)
    command = sum(robot.axes[_AXIS].range) / 2.0 + way
    metadata = {"name": f"demonstration × {pace:g}"}
    return Record.from_signals(time_s, {(_AXIS, Tap.CMD): command}, {_AXIS: "m"}, metadata)


def _softly(since_s: FloatArray) -> FloatArray:
    """Return a rise from 0 to 1 without a jump in speed."""
    share = np.clip(since_s / _SOFT_S, 0.0, 1.0)
    return np.asarray(share**2 * (3.0 - 2.0 * share))
