"""Readings that show that an axis is not at its command, and readings that show nothing."""

from itertools import product

import numpy as np
import pytest

from rotemina.app.motion.device.position_trust import PositionWatch
from rotemina.app.motion.state import FaultRaised
from rotemina.drivers.contract import DeviceSamples, DeviceState
from rotemina.sim.effects import AttachedEffect, list_effect_ids
from rotemina.sim.errors import InputError
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")
AXES = tuple(ROBOT.axes)
X, ZN = AXES.index("x"), AXES.index("zn")
REST = np.array([0.5 * sum(axis.range) for axis in ROBOT.axes.values()])


def make_samples(time_s, **errors):
    """Return samples at rest in mid-range, with these errors (n,) of some axes."""
    command = np.tile(REST, (len(time_s), 1))
    measured = command.copy()
    for axis, error in errors.items():
        measured[:, AXES.index(axis)] += error
    none = np.full(command.shape, np.nan)
    return DeviceSamples(time_s, command, measured, none, np.full(len(time_s), -1))


def judge_errors(error, *, axis="zn", portions=1, rate_hz=1000.0):
    """Judge readings (n,) in portions; return the locks and alarms."""
    watch, time_s = PositionWatch(ROBOT), np.arange(len(error)) / rate_hz
    verdicts = []
    for section in np.array_split(np.arange(len(error)), portions):
        verdicts.append(watch.judge(make_samples(time_s[section], **{axis: error[section]})))
    return [verdict.lock_reason for verdict in verdicts if verdict.lock_reason], [
        alarm for verdict in verdicts for alarm in verdict.alarms
    ]


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
    watch, verdicts = PositionWatch(ROBOT), []
    for section in np.array_split(np.arange(len(excess)), 10):
        samples = make_samples(section / 1000.0, zn=0.5 * 65e-6 + excess[section])
        command = samples.command.copy()
        command[:, ZN] = 65e-6
        verdicts.append(
            watch.judge(
                DeviceSamples(
                    samples.device_time_s,
                    command,
                    samples.measured,
                    samples.inputs,
                    samples.playback_row,
                )
            )
        )
    return [verdict.lock_reason for verdict in verdicts if verdict.lock_reason], [
        alarm for verdict in verdicts for alarm in verdict.alarms
    ]


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


def step_for(harness, seconds):
    return harness.step(0.02, round(seconds / 0.02))


def test_an_axis_that_does_not_follow_is_locked_until_confirmed(harness, monkeypatch):
    original_read, error = harness.driver._read, {"by": 4e-3}

    def read_with_error():
        samples = original_read()
        measured = samples.measured.copy()
        measured[:, X] -= error["by"]
        return DeviceSamples(
            samples.device_time_s, samples.command, measured, samples.inputs, samples.playback_row
        )

    harness.session.go_to({"x": 0.03})
    step_for(harness, 0.1)
    monkeypatch.setattr(harness.driver, "_read", read_with_error)
    state = harness.step_until(DeviceState.IDLE)
    state = step_for(harness, 0.2)
    assert state.command["x"] < 0.03
    assert "axis x reads 4.0" in state.lock_reason
    assert "home, or confirm it" in state.lock_reason
    assert len(harness.list_events(FaultRaised)) == 1
    with pytest.raises(InputError, match="axis x reads"):
        harness.session.go_to({"x": 0.03})
    harness.session.confirm_position()  # the error is still there
    state = step_for(harness, 0.2)
    assert "axis x reads" in state.lock_reason
    error["by"] = 0.0
    step_for(harness, 0.1)
    harness.session.confirm_position()
    step_for(harness, 0.1)
    harness.session.go_to({"x": 0.03})
    assert harness.step_until_idle().command["x"] == 0.03


def test_a_brief_wrong_reading_locks_nothing(harness, monkeypatch):
    original_read = harness.driver._read
    harness.session.go_to({"x": 0.03})
    step_for(harness, 0.1)
    clock = harness.clock
    until_s = clock() + 0.04

    def read_with_error():
        samples = original_read()
        if clock() > until_s:
            return samples
        measured = samples.measured.copy()
        measured[:, X] -= 0.04
        return DeviceSamples(
            samples.device_time_s, samples.command, measured, samples.inputs, samples.playback_row
        )

    monkeypatch.setattr(harness.driver, "_read", read_with_error)
    assert harness.step_until_idle().command["x"] == 0.03
    assert harness.list_events(FaultRaised) == []


def make_typical_effects():
    """Yield each effect once, at its typical size, on the first axis that can have it."""
    for name in list_effect_ids():
        for axis, source in product(("zn", "x"), (None, "thx")):
            effect = AxisEffect(axis=axis, id=name, from_axis=source)
            try:
                AttachedEffect.of(ROBOT, effect)
            except InputError:
                continue
            yield effect
            break


def test_every_effect_is_tested():
    assert [effect.id for effect in make_typical_effects()] == list(list_effect_ids())


@pytest.mark.parametrize("effect", list(make_typical_effects()), ids=lambda effect: effect.id)
def test_no_effect_of_typical_size_locks_motion(make_harness, effect):
    harness = make_harness()
    harness.session.service.set_effects([effect])
    step_for(harness, 0.1)
    for share in (0.2, 0.8):
        targets = {name: axis.range[0] + share * axis.span for name, axis in ROBOT.axes.items()}
        harness.session.go_to({"x": targets["x"], "thx": targets["thx"], "zn": targets["zn"]})
        harness.step_until_idle()
    assert harness.list_events(FaultRaised) == []
    assert harness.session.snapshot().lock_reason is None
