"""Readings that tell that an axis is not where it was sent, and those that tell nothing."""

from itertools import product

import numpy as np
import pytest

from rotemina.app.motion.position_trust import PositionWatch
from rotemina.app.motion.state import Faulted
from rotemina.drivers.samples import DeviceState, Samples
from rotemina.sim.effects.attachment import Attached
from rotemina.sim.effects.registry import effect_ids
from rotemina.sim.errors import InputError
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect

ROBOT = load_robot("rotemina")
AXES = tuple(ROBOT.axes)
X, ZN = AXES.index("x"), AXES.index("zn")
REST = np.array([0.5 * sum(axis.range) for axis in ROBOT.axes.values()])


def samples(time_s, **read):
    """Samples at rest in mid-range, where some axes read so much (n,) elsewhere."""
    command = np.tile(REST, (len(time_s), 1))
    measured = command.copy()
    for axis, error in read.items():
        measured[:, AXES.index(axis)] += error
    none = np.full(command.shape, np.nan)
    return Samples(time_s, command, measured, none, np.full(len(time_s), -1))


def judged(error, *, axis="zn", portions=1, rate_hz=1000.0):
    """Judge readings (n,), cut into portions; return all that is said."""
    watch, time_s = PositionWatch(ROBOT), np.arange(len(error)) / rate_hz
    told = []
    for part in np.array_split(np.arange(len(error)), portions):
        told.append(watch.judge(samples(time_s[part], **{axis: error[part]})))
    return [one.lock for one in told if one.lock], [each for one in told for each in one.alarms]


@pytest.mark.parametrize("portions", [1, 7, 60])
def test_a_bound_is_exceeded_only_where_every_sample_is_beyond_it_for_50_ms(portions):
    bound = ROBOT.axes["zn"].following
    assert bound == pytest.approx(0.35 * 65e-6)
    error = np.zeros(200)
    error[100:150] = 1.01 * bound
    assert judged(error, portions=portions) == ([], [])
    error[100:152] = 1.01 * bound
    (lock, *_), _ = judged(error[:152], portions=portions)
    assert lock.startswith("axis zn reads 22.9775 µm away from its command; at most 22.75 µm")


def test_outliers_say_nothing_however_large_and_many():
    error = np.zeros(2000)
    error[::3] = 1.0
    error[1::3] = -1.0
    assert judged(error, axis="x") == ([], [])


def beyond_the_range(much):
    """Judge readings that are ``much`` (n,) above the range of nano Z, which is sent to its end."""
    watch, told = PositionWatch(ROBOT), []
    for part in np.array_split(np.arange(len(much)), 10):
        seen = samples(part / 1000.0, zn=0.5 * 65e-6 + much[part])
        command = seen.command.copy()
        command[:, ZN] = 65e-6
        told.append(
            watch.judge(
                Samples(seen.device_time_s, command, seen.measured, seen.inputs, seen.playback_row)
            )
        )
    return [one.lock for one in told if one.lock], [each for one in told for each in one.alarms]


def test_a_reading_beyond_the_range_by_more_than_its_noise_alarms_once_until_it_is_back():
    much = np.full(600, 0.2e-6)
    much[300:400] = -0.1e-6
    alarm = "axis zn reads 200 nm beyond its range"
    assert beyond_the_range(much) == ([], [alarm, alarm])
    assert beyond_the_range(np.full(600, 5e-8)) == ([], [])  # 6 sigma and a step are 80 nm


def test_a_reading_far_beyond_the_range_locks():
    locks, alarms = beyond_the_range(np.full(100, 23e-6))
    assert locks[0] == "axis zn reads 23 µm beyond its range; at most 22.75 µm is permitted"
    assert alarms == []


def follow(stepped, seconds):
    return stepped.step(0.02, round(seconds / 0.02))


def test_an_axis_that_does_not_follow_is_stopped_and_locked_until_somebody_confirms(
    stepped, monkeypatch
):
    read, off = stepped.driver._read, {"by": 4e-3}

    def elsewhere():
        found = read()
        measured = found.measured.copy()
        measured[:, X] -= off["by"]
        return Samples(
            found.device_time_s, found.command, measured, found.inputs, found.playback_row
        )

    stepped.session.go_to({"x": 0.03})
    follow(stepped, 0.1)
    monkeypatch.setattr(stepped.driver, "_read", elsewhere)
    state = stepped.until(DeviceState.IDLE)
    state = follow(stepped, 0.2)
    assert state.command["x"] < 0.03
    assert "axis x reads 4.0" in state.locked
    assert "home, or confirm it" in state.locked
    assert len(stepped.told(Faulted)) == 1
    with pytest.raises(InputError, match="axis x reads"):
        stepped.session.go_to({"x": 0.03})
    stepped.session.confirm_position()  # what is wrong is wrong still
    state = follow(stepped, 0.2)
    assert "axis x reads" in state.locked
    off["by"] = 0.0
    follow(stepped, 0.1)
    stepped.session.confirm_position()
    follow(stepped, 0.1)
    stepped.session.go_to({"x": 0.03})
    assert stepped.until_idle().command["x"] == 0.03


def test_a_wrong_reading_that_lasts_for_a_moment_locks_nothing(stepped, monkeypatch):
    read = stepped.driver._read
    stepped.session.go_to({"x": 0.03})
    follow(stepped, 0.1)
    clock = stepped.clock
    until_s = clock() + 0.04

    def elsewhere():
        found = read()
        if clock() > until_s:
            return found
        measured = found.measured.copy()
        measured[:, X] -= 0.04
        return Samples(
            found.device_time_s, found.command, measured, found.inputs, found.playback_row
        )

    monkeypatch.setattr(stepped.driver, "_read", elsewhere)
    assert stepped.until_idle().command["x"] == 0.03
    assert stepped.told(Faulted) == []


def typical():
    """Each effect once, on the first axis that can have it, at its typical size."""
    for name in effect_ids():
        for axis, source in product(("zn", "x"), (None, "thx")):
            effect = AxisEffect(axis=axis, id=name, from_axis=source)
            try:
                Attached.of(ROBOT, effect)
            except InputError:
                continue
            yield effect
            break


def test_every_effect_is_tried():
    assert [effect.id for effect in typical()] == list(effect_ids())


@pytest.mark.parametrize("effect", list(typical()), ids=lambda effect: effect.id)
def test_no_effect_of_typical_size_locks_motion(make_stepped, effect):
    stepped = make_stepped()
    stepped.session.service.set_effects([effect])
    follow(stepped, 0.1)
    for share in (0.2, 0.8):
        targets = {name: axis.range[0] + share * axis.span for name, axis in ROBOT.axes.items()}
        stepped.session.go_to({"x": targets["x"], "thx": targets["thx"], "zn": targets["zn"]})
        stepped.until_idle()
    assert stepped.told(Faulted) == []
    assert stepped.session.snapshot().locked is None
