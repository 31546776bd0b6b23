"""The ring buffer, and the live model."""

import numpy as np
import pytest

from rotemina.app.motion.device import LiveHistory
from rotemina.app.motion.model.live_model import LiveModel
from rotemina.drivers.contract import DeviceSamples
from rotemina.sim.plant import simulate_nominal_response
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")


def make_samples(first, count, axes=2):
    number = np.arange(first, first + count, dtype=float)
    table = np.tile(number[:, None], (1, axes))
    return DeviceSamples(number * 0.01, table, table + 0.5, table, np.full(count, -1))


def append_portions(history, *sizes):
    first = 0
    for size in sizes:
        portion = make_samples(first, size)
        history.append(portion, portion.command + 0.25)
        first += size
    return first


@pytest.mark.parametrize("sizes", [(1,), (10,), (9, 4), (3, 27, 5)])
def test_the_tail_is_the_latest_in_order_and_does_not_change(sizes):
    history = LiveHistory(("a", "b"), seconds=0.1, rate_hz=100.0)
    total = append_portions(history, *sizes)
    window = history.tail()
    append_portions(history, 10)
    number = np.arange(max(0, total - 10), total)
    np.testing.assert_array_equal(window.device_time_s, number * 0.01)
    np.testing.assert_array_equal(window.command[:, 1], number)
    np.testing.assert_array_equal(window.model[:, 0], number + 0.25)
    np.testing.assert_array_equal(window.measured[:, 0], number + 0.5)
    assert window.command.flags.c_contiguous
    assert not window.measured.flags.writeable


def test_a_tail_can_be_limited_by_length_and_a_new_connection_clears_it():
    history = LiveHistory(("a", "b"), seconds=1.0, rate_hz=100.0)
    append_portions(history, 60, 60)
    np.testing.assert_allclose(history.tail(0.05).device_time_s, np.arange(114, 120) * 0.01)
    assert len(history.tail(0.015)) == 2
    assert len(history.tail(100.0)) == 100
    history.clear()
    assert len(history.tail()) == len(history.tail(1.0)) == 0


def test_the_live_model_equals_the_nominal_response_for_any_portions():
    rng = np.random.default_rng(4)
    time_s = np.cumsum(rng.uniform(1e-3, 3e-3, 400))
    low, high = np.array([axis.range for axis in ROBOT.axes.values()]).T
    swing = 0.5 + 0.1 * np.sin(2 * np.pi * 3 * time_s)
    command = low + swing[:, None] * (high - low)
    record = Record.from_signals(
        time_s,
        {(name, Tap.CMD): command[:, i] for i, name in enumerate(ROBOT.axes)},
        {name: axis.unit for name, axis in ROBOT.axes.items()},
    )
    model = LiveModel(ROBOT)
    parts = []
    for section in np.split(np.arange(400), [1, 2, 60, 61, 200]):
        parts.append(model.predict(50.0 + time_s[section], command[section]))
    live_output = np.concatenate(parts)
    response = simulate_nominal_response(ROBOT, record)
    for column, (name, axis) in enumerate(ROBOT.axes.items()):
        modelled = response.signal(name, Tap.MEAS)
        # The difference comes from device time, whose rounding the live model smooths to 10 ps.
        np.testing.assert_allclose(live_output[:, column], modelled, rtol=0, atol=3e-8 * axis.span)


def test_every_motion_shows_model_and_measurement(harness):
    harness.session.jog("x", 1e-3)
    harness.step_until_idle()
    harness.step(0.5)
    window = harness.session.history.tail()
    assert window.axes == tuple(ROBOT.axes)
    travel = np.ptp(window.model[:, 0])
    assert travel == pytest.approx(1e-3, rel=0.01)
    assert np.abs(window.model[:, 0] - window.measured[:, 0]).max() < 2e-7
