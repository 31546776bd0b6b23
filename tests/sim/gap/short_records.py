"""Short records of one axis, for tests of parts of a diagnosis."""

import numpy as np

from rotemina.sim.gap.fit import Evidence
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("rotemina")
GAIN = AxisEffect(axis="zn", id="gain_error", parameters={"error": 0.02})
HYSTERESIS = AxisEffect(axis="zn", id="hysteresis", parameters={"width": 4e-6})
DELAY = AxisEffect(axis="zn", id="delay", parameters={"delay": 2e-3})


def make_evidence(*effects, records=2):
    """Return evidence of zn, which oscillates under effects."""
    axis = ROBOT.axes["zn"]
    time_s = np.arange(1000) / 1000.0
    simulated_records = []
    for number in range(records):
        wave = np.sin(2 * np.pi * (3.0 + number) * time_s) * np.linspace(0.1, 0.3, len(time_s))
        command = sum(axis.range) / 2 + axis.span * wave
        commands = Record.from_signals(time_s, {("zn", Tap.CMD): command}, {"zn": axis.unit})
        simulated_records.append(simulate(ROBOT, effects, commands, np.random.default_rng(number)))
    return Evidence.of(ROBOT, "zn", simulated_records)
