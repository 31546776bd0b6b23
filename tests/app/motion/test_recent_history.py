"""The ring buffer, and the model that runs along."""

import numpy as np
import pytest

from rotemina.app.motion.live_model import LiveModel
from rotemina.app.motion.recent_history import LiveHistory
from rotemina.drivers.samples import Samples
from rotemina.sim.plant.response import nominal_response
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot

ROBOT = load_robot("rotemina")


def samples(first, count, axes=2):
    number = np.arange(first, first + count, dtype=float)
    table = np.tile(number[:, None], (1, axes))
    return Samples(number * 0.01, table, table + 0.5, table, np.full(count, -1))


def appended(history, *sizes):
    first = 0
    for size in sizes:
        part = samples(first, size)
        history.append(part, part.command + 0.25)
        first += size
    return first


@pytest.mark.parametrize("sizes", [(1,), (7, 3), (10,), (9, 4), (4, 4, 4, 4), (25,), (3, 27, 5)])
def test_the_tail_is_the_latest_in_order(sizes):
    history = LiveHistory(("a", "b"), seconds=0.1, rate_hz=100.0)
    total = appended(history, *sizes)
    window = history.tail()
    number = np.arange(max(0, total - 10), total)
    np.testing.assert_array_equal(window.device_time_s, number * 0.01)
    np.testing.assert_array_equal(window.command[:, 1], number)
    np.testing.assert_array_equal(window.model[:, 0], number + 0.25)
    np.testing.assert_array_equal(window.measured[:, 0], number + 0.5)
    assert window.command.flags.c_contiguous
    assert not window.measured.flags.writeable


def test_a_tail_may_be_cut_by_length():
    history = LiveHistory(("a", "b"), seconds=1.0, rate_hz=100.0)
    appended(history, 60, 60)
    np.testing.assert_allclose(history.tail(0.05).device_time_s, np.arange(114, 120) * 0.01)
    assert len(history.tail(0.015)) == 2
    assert len(history.tail(100.0)) == 100


def test_a_window_does_not_change_under_its_reader():
    history = LiveHistory(("a", "b"), seconds=0.1, rate_hz=100.0)
    appended(history, 10)
    window = history.tail()
    before = window.command.copy()
    appended(history, 10)
    np.testing.assert_array_equal(window.command, before)


def test_a_new_connection_starts_anew():
    history = LiveHistory(("a", "b"))
    appended(history, 10)
    history.clear()
    assert len(history.tail()) == 0
    assert len(history.tail(1.0)) == 0


def test_the_live_model_is_the_nominal_response_however_it_is_cut():
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
    for cut in np.split(np.arange(400), [1, 2, 60, 61, 200]):
        parts.append(model.answer(50.0 + time_s[cut], command[cut]))
    followed = np.concatenate(parts)
    response = nominal_response(ROBOT, record)
    for column, (name, axis) in enumerate(ROBOT.axes.items()):
        modelled = response.signal(name, Tap.MEAS)
        # What is left is device time, whose rounding the live model evens out to 10 ps.
        np.testing.assert_allclose(followed[:, column], modelled, rtol=0, atol=3e-8 * axis.span)


def test_every_motion_shows_model_and_measurement(stepped):
    stepped.session.jog("x", 1e-3)
    stepped.until_idle()
    stepped.step(0.5)
    window = stepped.session.history.tail()
    assert window.axes == tuple(ROBOT.axes)
    moved = np.ptp(window.model[:, 0])
    assert moved == pytest.approx(1e-3, rel=0.01)
    assert np.abs(window.model[:, 0] - window.measured[:, 0]).max() < 2e-7
