"""Records of axes that move back and forth."""

import numpy as np

from rotemina.sim.records import Record, Tap
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("rotemina")


def simulate_sweep(effects, axes=("x",), seconds=8.0, rate_hz=1000.0, share=0.05, seed=0):
    """Return a record of axes that move back and forth at their own rates, from rest to rest."""
    time_s = np.arange(round(seconds * rate_hz)) / rate_hz
    signals, units = {}, {}
    for number, name in enumerate(axes):
        axis = ROBOT.axes[name]
        turn = 0.5 - 0.5 * np.cos(2 * np.pi * (number + 1) * time_s / seconds)
        signals[name, Tap.CMD] = sum(axis.range) / 2 + share * axis.span * turn
        units[name] = axis.unit
    commands = Record.from_signals(time_s, signals, units)
    return simulate(ROBOT, effects, commands, np.random.default_rng(seed))
