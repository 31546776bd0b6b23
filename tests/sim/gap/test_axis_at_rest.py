"""An axis that rests in one record, because the axes were moved one at a time."""

import numpy as np
import pytest

from rotemina.sim.gap.pipeline import diagnose
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("rotemina")
RATE_HZ = 200.0
TIME_S = np.arange(round(8.0 * RATE_HZ)) / RATE_HZ


def record_one_moving_axis(moving, motion, effects, seed):
    """Return a record of x and thx, of which one rests at the low end of its range."""
    signals, units = {}, {}
    for name in ("x", "thx"):
        axis = ROBOT.axes[name]
        share = motion if name == moving else 0.0 * motion
        signals[name, Tap.CMD] = axis.range[0] + axis.span * share
        units[name] = axis.unit
    commands = Record.from_signals(TIME_S, signals, units)
    return simulate(ROBOT, effects, commands, np.random.default_rng(seed))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("effect", "size"),
    [
        (AxisEffect(axis="thx", id="hysteresis", parameters={"width": 1e-4}), 0.3),
        (AxisEffect(axis="x", id="backlash", parameters={"width": 2e-5}), 0.01),
    ],
)
@pytest.mark.parametrize("shape", ["sine", "chirp"])
def test_a_record_in_which_the_axis_rests_changes_nothing(effect, size, shape):
    turns = 0.4 * TIME_S if shape == "sine" else 0.2 * TIME_S + 0.05 * TIME_S**2
    motion = 0.5 * size * (1.0 - np.cos(2.0 * np.pi * turns))
    other = "x" if effect.axis == "thx" else "thx"
    records = [
        record_one_moving_axis(effect.axis, motion, [effect], 1),
        record_one_moving_axis(other, 0.01 * motion / size, [effect], 2),
    ]
    alone, together = (diagnose(ROBOT, part).axes[effect.axis] for part in (records[:1], records))
    assert together.verdict is alone.verdict
    assert [cause.effect for cause in together.causes] == [cause.effect for cause in alone.causes]
