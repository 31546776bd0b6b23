"""Readings that show that an axis is not at its command, and readings that show nothing."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.app.motion.device.position_trust import PositionWatch
from rotemina.drivers.contract import DeviceSamples
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")
AXES = tuple(ROBOT.axes)
ZN = AXES.index("zn")
REST = np.array([0.5 * sum(axis.range) for axis in ROBOT.axes.values()])


def make_samples(time_s, **errors):
    """Return samples at rest in mid-range, with these errors (n,) of some axes."""
    command = np.tile(REST, (len(time_s), 1))
    measured = command.copy()
    for axis, error in errors.items():
        measured[:, AXES.index(axis)] += error
    none = np.full(command.shape, np.nan)
    return DeviceSamples(time_s, command, measured, none, np.full(len(time_s), -1))


def judge_portions(portions):
    """Judge portions of samples; return the locks and alarms."""
    watch = PositionWatch(ROBOT)
    verdicts = [watch.judge(portion) for portion in portions]
    return [verdict.lock_reason for verdict in verdicts if verdict.lock_reason], [
        alarm for verdict in verdicts for alarm in verdict.alarms
    ]


def judge_errors(error, *, axis="zn", portions=1):
    """Judge readings (n,) at rest in mid-range with this error of one axis."""
    return judge_portions(
        make_samples(section / 1000.0, **{axis: error[section]})
        for section in np.array_split(np.arange(len(error)), portions)
    )


@pytest.mark.parametrize("portions", [1, 7, 60])
def test_a_bound_is_exceeded_only_after_50_ms_beyond_it(portions):
    bound = ROBOT.axes["zn"].following_limit
    assert bound == pytest.approx(0.35 * 65e-6)
    error = np.zeros(200)
    error[100:150] = 1.01 * bound
    assert judge_errors(error, portions=portions) == ([], [])
    error[100:152] = 1.01 * bound
    (lock, *_), _ = judge_errors(error[:152], portions=portions)
    assert lock.startswith("axis zn reads 22.9775 µm away from its command; at most 22.75 µm")


def test_outliers_of_any_size_and_number_are_ignored():
    error = np.zeros(2000)
    error[::3] = 1.0
    error[1::3] = -1.0
    assert judge_errors(error, axis="x") == ([], [])


def judge_excess(excess):
    """Judge readings ``excess`` (n,) above the range of nano Z, which is at its end."""

    def make_portions():
        for section in np.array_split(np.arange(len(excess)), 10):
            samples = make_samples(section / 1000.0, zn=0.5 * 65e-6 + excess[section])
            command = samples.command.copy()
            command[:, ZN] = 65e-6
            yield replace(samples, command=command)

    return judge_portions(make_portions())


def test_a_reading_beyond_the_range_by_more_than_noise_alarms_once_per_excess():
    excess = np.full(600, 0.2e-6)
    excess[300:400] = -0.1e-6
    alarm = "axis zn reads 200 nm beyond its range"
    assert judge_excess(excess) == ([], [alarm, alarm])
    assert judge_excess(np.full(600, 5e-8)) == ([], [])  # 6 sigma plus one step are 80 nm


def test_a_reading_far_beyond_the_range_locks():
    locks, alarms = judge_excess(np.full(100, 23e-6))
    assert locks[0] == "axis zn reads 23 µm beyond its range; at most 22.75 µm is permitted"
    assert alarms == []
