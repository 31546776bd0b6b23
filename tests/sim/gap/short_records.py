"""Evidence of a second of one axis, for parts that are tried without a diagnosis."""

import numpy as np

from rotemina.sim.gap.fit.evidence import Evidence
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("rotemina")
GAIN = AxisEffect(axis="zn", id="gain_error", parameters={"error": 0.02})
LOOP = AxisEffect(axis="zn", id="hysteresis", parameters={"width": 4e-6})
LATE = AxisEffect(axis="zn", id="delay", parameters={"delay": 2e-3})


def evidence(*effects, records=2):
    """Return evidence of swings of zn under effects."""
    own = ROBOT.axes["zn"]
    time_s = np.arange(1000) / 1000.0
    found = []
    for number in range(records):
        wave = np.sin(2 * np.pi * (3.0 + number) * time_s) * np.linspace(0.1, 0.3, len(time_s))
        command = sum(own.range) / 2 + own.span * wave
        commands = Record.from_signals(time_s, {("zn", Tap.CMD): command}, {"zn": own.unit})
        found.append(simulate(ROBOT, effects, commands, np.random.default_rng(number)))
    return Evidence.of(ROBOT, "zn", found)
