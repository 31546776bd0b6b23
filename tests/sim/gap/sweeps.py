"""Records of axes that go there and back."""

import numpy as np

from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("rotemina")


def sweep(effects, axes=("x",), seconds=8.0, rate_hz=1000.0, share=0.05, seed=0):
    """Each axis there and back at its own pace, from rest to rest."""
    time_s = np.arange(round(seconds * rate_hz)) / rate_hz
    signals, units = {}, {}
    for number, name in enumerate(axes):
        axis = ROBOT.axes[name]
        turn = 0.5 - 0.5 * np.cos(2 * np.pi * (number + 1) * time_s / seconds)
        signals[name, Tap.CMD] = sum(axis.range) / 2 + share * axis.span * turn
        units[name] = axis.unit
    commands = Record.from_signals(time_s, signals, units)
    return simulate(ROBOT, effects, commands, np.random.default_rng(seed))
