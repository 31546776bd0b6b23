"""Trials of a next experiment: all of them may be played."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.gap.experiment.safe_tests import trials
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import KeepOut
from rotemina.sim.trajectory.dry_run import dry_run

ROBOT = load_robot("rotemina")


def commands(robot=ROBOT, share=0.2, hertz=1.0, rate_hz=1000.0, seconds=4.0, axes=("zn",)):
    """Sines about the middle of the range, each axis a little slower than the one before."""
    time_s = np.arange(round(seconds * rate_hz)) / rate_hz
    signals = {}
    for number, axis in enumerate(axes):
        own = robot.axes[axis]
        wave = np.minimum(time_s, 1.0) * np.sin(2.0 * np.pi * hertz * 0.7**number * time_s)
        signals[axis, Tap.CMD] = sum(own.range) / 2.0 + share * own.span * wave
    units = {axis: robot.unit(axis) for axis in axes}
    return Record.from_signals(time_s, signals, units)


def test_an_axis_is_held_while_the_one_moves_that_may_leak_into_it():
    record = commands(axes=("thx", "thy"))
    able = trials(ROBOT, "thx", [record], ["thy"])
    of_thy = [one.record for one in able if str(one.name).endswith("of thy while thx is held")]
    assert len(of_thy) >= 3
    assert all(np.ptp(one.signal("thx", Tap.CMD)) == 0.0 for one in of_thy)
    assert all(np.ptp(one.signal("thy", Tap.CMD)) > 0.0 for one in of_thy)


def test_near_a_keep_out_no_test_leaves_where_the_records_were():
    record = commands(share=0.02)
    low, high = (float(end(record.signal("zn", Tap.CMD))) for end in (np.min, np.max))
    guarded = replace(ROBOT, keep_out=KeepOut(floor=0.0))
    for robot, inside in ((ROBOT, False), (guarded, True)):
        able = trials(robot, "zn", [record])
        assert len(able) >= 12
        ends = [(one.record.signal("zn", Tap.CMD)) for one in able]
        slack = 1e-9 * (high - low)
        kept = [one.min() >= low - slack and one.max() <= high + slack for one in ends]
        assert all(kept) is inside


@pytest.mark.parametrize("axis", ROBOT.axes)
def test_every_test_of_every_axis_may_be_played(axis):
    able = trials(ROBOT, axis, [commands(axes=(axis,), share=0.1 if "th" in axis else 0.02)])
    assert len(able) >= 12
    assert all(dry_run(ROBOT, one.record).allowed for one in able)
    assert max(one.record.duration_s for one in able) <= 30.0


def test_an_axis_that_nothing_makes_follow_has_no_test():
    robot = load_robot("emps")
    free = replace(robot, axes={"q": replace(robot.axes["q"], controller=None)})
    record = Record.from_signals(np.arange(100) / 1e3, {("q", Tap.CMD): np.ones(100)}, {"q": "m"})
    assert trials(free, "q", [record]) == []
