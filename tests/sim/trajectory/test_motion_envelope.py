"""The motion of machines in records, without artefacts of sampling."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.records import Record, Tap
from rotemina.sim.robot_files import load_robot
from rotemina.sim.trajectory import MotionEnvelope

RATE_HZ = 1000.0
TIME_S = np.arange(4000) / RATE_HZ
SINE = 1e-3 * np.sin(2.0 * np.pi * TIME_S)  # 6.28 mm/s, 39.5 mm/s²
LEVELS = 1e-3 * np.repeat([0.0, 1.0, 2.0, 1.0], 1000)


def compute_envelope(command, measured=None, noise=1e-7):
    signals = {("x", Tap.CMD): command}
    if measured is not None:
        error = noise * np.random.default_rng(0).standard_normal(len(command))
        signals["x", Tap.MEAS] = measured + error
    return MotionEnvelope.of([Record.from_signals(TIME_S, signals, {"x": "m"})]).axes["x"]


def smooth_steps(command, rows=200):
    """Return the motion of a machine that moves for ``rows`` rows at constant speed per step."""
    return np.convolve(np.pad(command, (rows - 1, 0), mode="edge"), np.ones(rows) / rows, "valid")


def test_a_smooth_motion_has_the_speed_of_its_command():
    envelope = compute_envelope(SINE, SINE)
    assert (envelope.low, envelope.high) == pytest.approx((-1e-3, 1e-3))
    assert envelope.speed == pytest.approx(6.28e-3, rel=0.01)
    assert envelope.acceleration == pytest.approx(39.5e-3, rel=0.1)


def test_a_step_has_the_speed_of_the_measured_motion():
    assert compute_envelope(LEVELS, smooth_steps(LEVELS)).speed == pytest.approx(
        1e-3 / 0.2, rel=0.1
    )


def test_a_step_without_measurement_has_no_speed():
    assert not compute_envelope(LEVELS).has_motion


def test_rounding_of_a_command_does_not_count_as_speed():
    rounded = np.round(SINE / 5e-5) * 5e-5
    speed_of_rounding = np.abs(np.diff(rounded)).max() * RATE_HZ
    assert compute_envelope(rounded, SINE).speed == pytest.approx(6.28e-3, rel=0.05)
    assert speed_of_rounding > 7.0 * 6.28e-3


def test_noise_and_dropouts_of_a_sensor_do_not_count_as_motion():
    with_dropouts = smooth_steps(LEVELS).copy()
    with_dropouts[[1500, 2500]] = 0.0
    assert compute_envelope(LEVELS, with_dropouts, noise=1e-6).speed == pytest.approx(5e-3, rel=0.1)


def test_the_stricter_limit_of_records_and_robot_file_applies():
    robot = load_robot("rotemina")
    axis = robot.axes["x"]
    record = Record.from_signals(TIME_S, {("x", Tap.CMD): SINE, ("x", Tap.MEAS): SINE}, {"x": "m"})
    envelope = MotionEnvelope.of([record])
    narrowed = envelope.narrow(robot).axes["x"]
    assert narrowed.max_speed == envelope.axes["x"].speed < axis.max_speed
    slow_robot = replace(robot, axes={**robot.axes, "x": replace(axis, max_speed=1e-3)})
    assert envelope.narrow(slow_robot).axes["x"].max_speed == 1e-3
