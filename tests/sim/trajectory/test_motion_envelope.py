"""The motion that records show: what machines did, not what sampling makes of it."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.trajectory.motion_envelope import MotionEnvelope

RATE_HZ = 1000.0
TIME_S = np.arange(4000) / RATE_HZ
SINE = 1e-3 * np.sin(2.0 * np.pi * TIME_S)  # 6.28 mm/s, 39.5 mm/s²
LEVELS = 1e-3 * np.repeat([0.0, 1.0, 2.0, 1.0], 1000)


def envelope(command, measured=None, noise=1e-7):
    signals = {("x", Tap.CMD): command}
    if measured is not None:
        error = noise * np.random.default_rng(0).standard_normal(len(command))
        signals["x", Tap.MEAS] = measured + error
    return MotionEnvelope.of([Record.from_signals(TIME_S, signals, {"x": "m"})]).axes["x"]


def smoothed(command, rows=200):
    """A machine that takes 200 rows for a step, at constant speed."""
    return np.convolve(np.pad(command, (rows - 1, 0), mode="edge"), np.ones(rows) / rows, "valid")


def test_a_smooth_motion_counts_as_it_was_commanded():
    found = envelope(SINE, SINE)
    assert (found.low, found.high) == pytest.approx((-1e-3, 1e-3))
    assert found.speed == pytest.approx(6.28e-3, rel=0.01)
    assert found.acceleration == pytest.approx(39.5e-3, rel=0.1)


def test_a_step_counts_as_fast_as_the_machine_made_it():
    assert envelope(LEVELS, smoothed(LEVELS)).speed == pytest.approx(1e-3 / 0.2, rel=0.1)


def test_a_step_that_nothing_measured_shows_no_speed():
    assert not envelope(LEVELS).has_motion


def test_rounding_of_a_command_is_no_speed_of_its_own():
    coarse = np.round(SINE / 5e-5) * 5e-5
    raw = np.abs(np.diff(coarse)).max() * RATE_HZ
    assert envelope(coarse, SINE).speed == pytest.approx(6.28e-3, rel=0.05)
    assert raw > 7.0 * 6.28e-3


def test_noise_and_dropouts_of_a_sensor_are_no_motion():
    dropped = smoothed(LEVELS).copy()
    dropped[[1500, 2500]] = 0.0
    assert envelope(LEVELS, dropped, noise=1e-6).speed == pytest.approx(5e-3, rel=0.1)


def test_the_stricter_of_records_and_robot_file_holds():
    robot = load_robot("rotemina")
    own = robot.axes["x"]
    record = Record.from_signals(TIME_S, {("x", Tap.CMD): SINE, ("x", Tap.MEAS): SINE}, {"x": "m"})
    found = MotionEnvelope.of([record])
    narrowed = found.narrow(robot).axes["x"]
    assert narrowed.max_speed == found.axes["x"].speed < own.max_speed
    slower = replace(robot, axes={**robot.axes, "x": replace(own, max_speed=1e-3)})
    assert found.narrow(slower).axes["x"].max_speed == 1e-3
