"""Trials of a next experiment: all of them may be played, and none asks for more than records."""

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
        able = trials(robot, "zn", [record], beyond_records=True)
        assert len(able) >= 12
        ends = [(one.record.signal("zn", Tap.CMD)) for one in able]
        slack = 1e-9 * (high - low)
        kept = [one.min() >= low - slack and one.max() <= high + slack for one in ends]
        assert all(kept) is inside


@pytest.mark.parametrize("axis", ROBOT.axes)
@pytest.mark.parametrize("beyond_records", [False, True])
def test_every_test_of_every_axis_may_be_played(axis, beyond_records):
    records = [commands(axes=(axis,), share=0.1 if "th" in axis else 0.02)]
    able = trials(ROBOT, axis, records, beyond_records=beyond_records)
    assert len(able) >= 12
    assert all(dry_run(ROBOT, one.record).allowed for one in able)
    assert max(one.record.duration_s for one in able) <= 30.0


def test_an_axis_that_nothing_makes_follow_has_no_test():
    robot = load_robot("emps")
    free = replace(robot, axes={"q": replace(robot.axes["q"], controller=None)})
    record = Record.from_signals(np.arange(100) / 1e3, {("q", Tap.CMD): np.ones(100)}, {"q": "m"})
    assert trials(free, "q", [record]) == []


def without_limits(robot):
    free = {
        name: replace(axis, max_speed=None, max_acceleration=None)
        for name, axis in robot.axes.items()
    }
    return replace(robot, axes=free)


def recorded(axis, robot, kind, rate_hz):
    """A record of 6 s of one axis that follows its command with a lag of 10 ms and some noise."""
    rng = np.random.default_rng(7)
    rows = round(6.0 * rate_hz)
    time_s = np.arange(rows) / rate_hz
    wave = {
        "sine": np.sin(2.0 * np.pi * 0.7 * time_s),
        "triangle": 2.0 * np.abs((time_s % 2.0) - 1.0) - 1.0,
        "staircase": np.array([-1.0, -0.5, 0.0, 0.5, 1.0, 0.0])[(time_s % 6.0).astype(int)],
        "random steps": np.repeat(rng.uniform(-1.0, 1.0, 24), -(-rows // 24))[:rows],
        "coarse sine": np.round(8.0 * np.sin(2.0 * np.pi * 0.5 * time_s)) / 8.0,
        "multisine": sum(np.sin(2.0 * np.pi * f * time_s + f) for f in (0.5, 3.5, 11.5)) / 3.0,
    }[kind]
    described = robot.axes[axis]
    command = sum(described.range) / 2.0 + 0.1 * described.span * wave
    forgetting = np.exp(-1.0 / (rate_hz * 0.01))
    measured = command.copy()
    for row in range(1, rows):
        measured[row] = forgetting * measured[row - 1] + (1.0 - forgetting) * command[row]
    measured += 1e-5 * described.span * rng.standard_normal(rows)
    signals = {(axis, Tap.CMD): command, (axis, Tap.MEAS): measured}
    return Record.from_signals(time_s, signals, {axis: robot.unit(axis)})


def rates(record, axis):
    """Greatest speed and acceleration from row to row; before and after, the axis rests."""
    step_s = np.diff(record.time_s)
    assert np.ptp(step_s) < 1e-9
    speed = np.diff(np.pad(record.signal(axis, Tap.CMD), 2, mode="edge")) / step_s.mean()
    return np.abs(speed).max(), np.abs(np.diff(speed)).max() / step_s.mean()


@pytest.mark.parametrize(
    ("name", "rate_hz"), [("rotemina", 1000.0), ("picma", 200.0), ("fsm", 1000.0), ("emps", 200.0)]
)
@pytest.mark.parametrize(
    "kind", ["sine", "triangle", "staircase", "random steps", "coarse sine", "multisine"]
)
def test_without_limits_no_test_exceeds_the_records_and_all_begin_and_end_at_rest(
    kind, name, rate_hz
):
    robot = without_limits(load_robot(name))
    axis = "thx" if name == "rotemina" else next(iter(robot.axes))
    record = recorded(axis, robot, kind, rate_hz)
    command, step_s = record.signal(axis, Tap.CMD), 1.0 / rate_hz
    most_speed = np.abs(np.diff(command)).max() / step_s
    most_acceleration = np.abs(np.diff(command, 2)).max() / step_s**2
    able = trials(robot, axis, [record])
    assert len(able) >= 12
    assert trials(robot, axis, [record], beyond_records=True) == []
    for one in able:
        asked = one.record.signal(axis, Tap.CMD)
        speed, acceleration = rates(one.record, axis)
        assert command.min() - 1e-12 <= asked.min() < asked.max() <= command.max() + 1e-12
        assert speed <= most_speed * (1.0 + 1e-6)
        assert acceleration <= most_acceleration * (1.0 + 1e-6)


def test_a_step_counts_with_the_speed_at_which_the_machine_made_it():
    robot = without_limits(ROBOT)
    record = recorded("thx", robot, "staircase", 1000.0)
    measured = np.abs(np.diff(record.signal("thx", Tap.MEAS))).max() * 1000.0
    asked = np.abs(np.diff(record.signal("thx", Tap.CMD))).max() * 1000.0
    fastest = max(rates(one.record, "thx")[0] for one in trials(robot, "thx", [record]))
    assert fastest <= measured < 0.2 * asked


def test_an_axis_that_never_moved_in_the_records_is_not_moved():
    still = commands(share=0.0)
    assert trials(without_limits(ROBOT), "zn", [still]) == []
