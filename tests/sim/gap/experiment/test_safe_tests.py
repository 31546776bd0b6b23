"""Trials of the next experiment: all may be played, and none exceeds the records."""

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from rotemina.sim.gap.experiment.safe_tests import find_safe_tests
from rotemina.sim.gap.location import apply_lag
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import KeepOut
from rotemina.sim.robot_files import load_robot
from rotemina.sim.trajectory import dry_run

# The shared records are in a module of the parent folder.
sys.path.insert(0, str(Path(__file__).parents[1]))
from sweeps import ROBOT, make_sines


def test_an_axis_is_held_while_the_axis_that_may_couple_into_it_moves():
    record = make_sines(axes=("thx", "thy"))
    trials = find_safe_tests(ROBOT, "thx", [record], ["thy"])
    thy_records = [
        trial.record for trial in trials if str(trial.name).endswith("of thy while thx is held")
    ]
    assert len(thy_records) >= 3
    assert all(np.ptp(record.signal("thx", Tap.CMD)) == 0.0 for record in thy_records)
    assert all(np.ptp(record.signal("thy", Tap.CMD)) > 0.0 for record in thy_records)


def test_near_a_keep_out_no_trial_leaves_the_recorded_range():
    record = make_sines(share=0.02)
    low, high = (float(limit(record.signal("zn", Tap.CMD))) for limit in (np.min, np.max))
    guarded_robot = replace(ROBOT, keep_out=KeepOut(floor=0.0))
    for robot, inside in ((ROBOT, False), (guarded_robot, True)):
        trials = find_safe_tests(robot, "zn", [record], beyond_records=True)
        assert len(trials) >= 12
        trial_commands = [trial.record.signal("zn", Tap.CMD) for trial in trials]
        slack = 1e-9 * (high - low)
        are_inside = [
            command.min() >= low - slack and command.max() <= high + slack
            for command in trial_commands
        ]
        assert all(are_inside) is inside


@pytest.mark.parametrize("axis", ["x", "thx", "zn"])
@pytest.mark.parametrize("beyond_records", [False, True])
def test_every_trial_of_every_axis_may_be_played(axis, beyond_records):
    records = [make_sines(axes=(axis,), share=0.1 if "th" in axis else 0.02)]
    trials = find_safe_tests(ROBOT, axis, records, beyond_records=beyond_records)
    assert len(trials) >= 12
    assert all(dry_run(ROBOT, trial.record).allowed for trial in trials)
    assert max(trial.record.duration_s for trial in trials) <= 30.0


def test_an_axis_without_a_controller_has_no_trial():
    robot = load_robot("emps")
    uncontrolled = replace(robot, axes={"q": replace(robot.axes["q"], controller=None)})
    record = Record.from_signals(np.arange(100) / 1e3, {("q", Tap.CMD): np.ones(100)}, {"q": "m"})
    assert find_safe_tests(uncontrolled, "q", [record]) == []


def remove_limits(robot):
    axes = {
        name: replace(axis, max_speed=None, max_acceleration=None)
        for name, axis in robot.axes.items()
    }
    return replace(robot, axes=axes)


def make_record(axis, robot, kind, rate_hz):
    """Return 6 s of an axis that follows its command with a lag of 10 ms and some noise."""
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
    description = robot.axes[axis]
    command = sum(description.range) / 2.0 + 0.1 * description.span * wave
    measured = apply_lag(command, 0.01 * rate_hz)
    measured += 1e-5 * description.span * rng.standard_normal(rows)
    signals = {(axis, Tap.CMD): command, (axis, Tap.MEAS): measured}
    return Record.from_signals(time_s, signals, {axis: robot.unit(axis)})


def find_peak_rates(record, axis):
    """Return the greatest speed and acceleration between rows. The axis rests before and after."""
    step_s = np.diff(record.time_s)
    assert np.ptp(step_s) < 1e-9
    speed = np.diff(np.pad(record.signal(axis, Tap.CMD), 2, mode="edge")) / step_s.mean()
    return np.abs(speed).max(), np.abs(np.diff(speed)).max() / step_s.mean()


@pytest.mark.parametrize(
    ("kind", "name", "rate_hz"),
    [
        ("sine", "emps", 200.0),
        ("triangle", "picma", 200.0),
        ("staircase", "rotemina", 1000.0),
        ("random steps", "picma", 200.0),
        ("coarse sine", "emps", 200.0),
        ("multisine", "fsm", 1000.0),
    ],
)
def test_without_limits_no_trial_exceeds_the_records_and_all_start_and_end_at_rest(
    kind, name, rate_hz
):
    robot = remove_limits(load_robot(name))
    axis = "thx" if name == "rotemina" else next(iter(robot.axes))
    record = make_record(axis, robot, kind, rate_hz)
    command, step_s = record.signal(axis, Tap.CMD), 1.0 / rate_hz
    max_speed = np.abs(np.diff(command)).max() / step_s
    max_acceleration = np.abs(np.diff(command, 2)).max() / step_s**2
    trials = find_safe_tests(robot, axis, [record])
    assert len(trials) >= 12
    assert find_safe_tests(robot, axis, [record], beyond_records=True) == []
    for trial in trials:
        trial_command = trial.record.signal(axis, Tap.CMD)
        speed, acceleration = find_peak_rates(trial.record, axis)
        assert (
            command.min() - 1e-12
            <= trial_command.min()
            < trial_command.max()
            <= command.max() + 1e-12
        )
        assert speed <= max_speed * (1.0 + 1e-6)
        assert acceleration <= max_acceleration * (1.0 + 1e-6)


def test_a_step_counts_with_the_measured_speed_of_the_machine():
    robot = remove_limits(ROBOT)
    record = make_record("thx", robot, "staircase", 1000.0)
    measured_speed = np.abs(np.diff(record.signal("thx", Tap.MEAS))).max() * 1000.0
    commanded_speed = np.abs(np.diff(record.signal("thx", Tap.CMD))).max() * 1000.0
    max_trial_speed = max(
        find_peak_rates(trial.record, "thx")[0] for trial in find_safe_tests(robot, "thx", [record])
    )
    assert max_trial_speed <= measured_speed < 0.2 * commanded_speed


def test_an_axis_that_never_moved_in_the_records_is_not_moved():
    commands_at_rest = make_sines(share=0.0)
    assert find_safe_tests(remove_limits(ROBOT), "zn", [commands_at_rest]) == []
