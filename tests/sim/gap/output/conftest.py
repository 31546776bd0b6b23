"""An invented diagnosis of records with a known cause."""

import numpy as np
import pytest

from rotemina.sim.gap.fit import Evidence
from rotemina.sim.gap.location import locate_gap
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("rotemina")
HYSTERESIS = AxisEffect(axis="thx", id="hysteresis", parameters={"width": 1.2e-4})
RATE_HZ = 500.0


def make_commands(seed, seconds=4.0):
    """Return commands: θx oscillates at several amplitudes and rates, y moves slowly."""
    time_s = np.arange(round(seconds * RATE_HZ)) / RATE_HZ
    rng = np.random.default_rng(seed)
    thx, y = ROBOT.axes["thx"], ROBOT.axes["y"]
    waves = sum(
        amplitude * np.sin(2 * np.pi * rate * time_s + rng.uniform(0, 6))
        for amplitude, rate in ((0.15, 0.7), (0.1, 2.1), (0.03, 11.0))
    )
    return Record.from_signals(
        time_s,
        {
            ("thx", Tap.CMD): sum(thx.range) / 2 + thx.span * waves,
            ("y", Tap.CMD): sum(y.range) / 2 + 1e-4 * np.sin(2 * np.pi * 0.5 * time_s),
        },
        {"thx": thx.unit, "y": y.unit},
        {"operator": "A & B <b>"},
    )


@pytest.fixture(scope="session")
def records():
    """Two records of a robot with hysteresis on θx."""
    return tuple(
        simulate(ROBOT, [HYSTERESIS], make_commands(seed), np.random.default_rng(seed))
        for seed in (1, 2)
    )


@pytest.fixture(scope="session")
def diagnosis(make_diagnosis, records):
    """A diagnosis of the records, with every kind of content."""

    def places(axis):
        return locate_gap(Evidence.of(ROBOT, axis, records), np.random.default_rng(0))

    return make_diagnosis(places, "y")
