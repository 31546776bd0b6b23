"""A diagnosis made by hand, of records whose cause is known."""

import numpy as np
import pytest

from rotemina.sim.gap.fit.evidence import Evidence
from rotemina.sim.gap.location.located_gap import locate
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("rotemina")
LOOP = AxisEffect(axis="thx", id="hysteresis", parameters={"width": 1.2e-4})
RATE_HZ = 500.0


def swings(seed, seconds=4.0):
    """θx swings through several amplitudes; y follows a slow path."""
    time_s = np.arange(round(seconds * RATE_HZ)) / RATE_HZ
    rng = np.random.default_rng(seed)
    own, other = ROBOT.axes["thx"], ROBOT.axes["y"]
    waves = sum(
        size * np.sin(2 * np.pi * rate * time_s + rng.uniform(0, 6))
        for size, rate in ((0.15, 0.7), (0.1, 2.1), (0.03, 11.0))
    )
    return Record.from_signals(
        time_s,
        {
            ("thx", Tap.CMD): sum(own.range) / 2 + own.span * waves,
            ("y", Tap.CMD): sum(other.range) / 2 + 1e-4 * np.sin(2 * np.pi * 0.5 * time_s),
        },
        {"thx": own.unit, "y": other.unit},
        {"operator": "A & B <b>"},
    )


@pytest.fixture(scope="session")
def records():
    """Two records of a robot with hysteresis on θx."""
    return tuple(
        simulate(ROBOT, [LOOP], swings(seed), np.random.default_rng(seed)) for seed in (1, 2)
    )


@pytest.fixture(scope="session")
def diagnosis(make_diagnosis, records):
    """Everything that can be said of them."""

    def places(axis):
        return locate(Evidence.of(ROBOT, axis, records), np.random.default_rng(0))

    return make_diagnosis(places, "y")
