"""Calibration of sensors with known errors, and its notes about errors that it cannot find."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.calibration import (
    SensorLag,
    calibrate_sensor,
    compare_with_laser,
    join_laser_record,
)
from rotemina.sim.calibration.interpolation import find_period
from rotemina.sim.calibration.regression_columns import SensorRun
from rotemina.sim.errors import SensorCalibrationError
from rotemina.sim.records import Record, Tap


def _calibrate(robot, record, axis, **options):
    return calibrate_sensor(robot, [compare_with_laser(record, axis, robot)], **options)


def _get_figure(calibration, name):
    return next(figure for figure in calibration.figures if figure.name == name)


def _replace_signals(record, **signals):
    """Return the record with these signals of zn, by tap."""
    columns = {tuple(channel): record.signal(*channel) for channel in record.columns}
    columns |= {("zn", Tap(tap)): signal for tap, signal in signals.items()}
    columns = {channel: signal for channel, signal in columns.items() if signal is not None}
    return Record.from_signals(record.time_s, columns, record.units, record.metadata)


@pytest.fixture(scope="module")
def gain_record(simulate_calibration):
    return simulate_calibration("zn", ("sensor_gain", None, {"error": 0.02}))


def test_gain_error_is_found_within_its_interval(robot, gain_record):
    calibration = _calibrate(robot, gain_record, "zn")
    gain = _get_figure(calibration, "gain error")
    assert abs(gain.value - 0.02) < 2.0 * gain.half_width < 1e-4
    assert calibration.refusal is None
    assert calibration.after_rms < 1.15 * robot.axes["zn"].sensor.noise_floor
    assert calibration.before_rms > 10.0 * calibration.after_rms
    assert calibration.notes == ()


def test_nonlinearity_is_found_as_the_bend_between_the_ends(robot, simulate_calibration):
    record = simulate_calibration("zn", ("sensor_nonlinearity", None, {"bow": 5e-7, "cubic": 0.0}))
    calibration = _calibrate(robot, record, "zn")
    bend = _get_figure(calibration, "nonlinearity")
    assert abs(bend.value - 5e-7) < 2.0 * bend.half_width < 1e-8
    assert _get_figure(calibration, "gain error").value == pytest.approx(0.0, abs=5e-5)


def test_lag_is_found(robot, simulate_calibration):
    lag_s = 1e-3
    record = simulate_calibration(
        "zn", ("sensor_lag", "first_order", {"time_constant": lag_s}), rate_hz=1e3
    )
    calibration = _calibrate(robot, record, "zn")
    lag = _get_figure(calibration, "lag, time constant")
    assert calibration.model.lag is SensorLag.FIRST_ORDER
    assert abs(lag.value - lag_s) < 1.5 * lag.half_width < 0.05 * lag_s
    assert calibration.after_rms < 0.5 * calibration.before_rms


def test_the_period_of_an_encoder_is_found_from_slow_sections():
    rng = np.random.default_rng(4)
    creep = np.concatenate([np.linspace(0.0, 2e-4, 600), np.linspace(2e-4, 0.0, 600)])
    targets = [5e-3, 5.8e-3, 1.05e-2, 5e-2]
    sections = [
        np.concatenate([np.linspace(0.0, target, 300), target + creep]) for target in targets
    ]
    position = np.concatenate(sections)
    phase = 2.0 * np.pi * position / 20e-6
    error = 1.5e-7 * np.sin(phase) + 8e-8 * np.cos(2.0 * phase) + rng.normal(0, 4e-8, len(phase))
    run = SensorRun(position + error, position, 1e-3)
    assert find_period([run], [error]) == pytest.approx(20e-6, rel=2e-6)
    assert find_period([run], [rng.normal(0.0, 4e-8, len(phase))]) == 0.0


def test_drift_is_noted_but_not_calibrated(robot, simulate_calibration):
    record = simulate_calibration("zn", ("sensor_drift", "random_walk", {"rate": 5e-8}), runs=4)
    calibration = _calibrate(robot, record, "zn")
    assert any("drifts" in note for note in calibration.notes)
    assert calibration.after_rms > 0.5 * calibration.before_rms


def test_a_healthy_sensor_gets_no_calibration(robot, simulate_calibration):
    calibration = _calibrate(robot, simulate_calibration("zn"), "zn")
    assert calibration.refusal is not None
    assert "not better" in calibration.refusal
    assert not any("drifts" in note for note in calibration.notes)


def test_hysteresis_of_a_sensor_is_found(robot, simulate_calibration):
    clean = simulate_calibration("zn")
    reference = clean.signal("zn", Tap.REF)
    radius, play = 0.3e-6, np.empty(len(reference))
    state = reference[0]
    for row, position in enumerate(reference.tolist()):
        state = play[row] = max(position - radius, min(position + radius, state))
    noise = np.random.default_rng(5).normal(0.0, 1.2e-8, len(reference))
    calibration = _calibrate(robot, _replace_signals(clean, meas=play + noise), "zn")
    width = _get_figure(calibration, "hysteresis")
    # The reading lags behind the axis by a stop of radius r, so the loop is −2r wide.
    assert width.value == pytest.approx(-2.0 * radius, rel=0.03)
    # At a reversal the reading stands still over 2r, so it does not show where the axis is.
    assert calibration.after_rms < 0.3 * calibration.before_rms


@pytest.mark.slow
def test_encoder_interpolation_is_found_over_the_whole_range(robot, simulate_calibration):
    parameters = {"period": 20e-6, "sine": 1.5e-7, "second_cosine": 8e-8, "second_sine": 0.0}
    record = simulate_calibration(
        "x", ("encoder_interpolation", None, parameters), targets=5, rate_hz=1e3
    )
    calibration = _calibrate(robot, record, "x")
    assert calibration.model.period == pytest.approx(20e-6, rel=1e-6)
    sine, cosine, second_sine, second_cosine = calibration.model.harmonics
    assert sine == pytest.approx(1.5e-7, abs=1e-8)
    assert second_cosine == pytest.approx(8e-8, abs=1e-8)
    assert max(abs(cosine), abs(second_sine)) < 1e-8
    assert calibration.after_rms < 1.1 * robot.axes["x"].sensor.noise_floor
    # The ISO 230-2 figures of the reading before and after show it, too.
    assert calibration.reading_before.accuracy > 3.0 * calibration.reading_after.accuracy
    assert calibration.reached.accuracy < calibration.reading_before.accuracy


def test_the_zero_of_the_laser_may_differ_from_that_of_the_axis(robot, gain_record):
    shifted = _replace_signals(gain_record, ref=gain_record.signal("zn", Tap.REF) + 3e-6)
    calibration = _calibrate(robot, shifted, "zn", absolute=False)
    assert _get_figure(calibration, "offset").value == pytest.approx(-3e-6 * 1.02, rel=1e-3)
    middle = 0.5 * sum(calibration.travel)
    assert calibration.model.offset + calibration.model.gain_error * middle == pytest.approx(
        0.0, abs=1e-12
    )


def test_a_short_loss_of_the_laser_is_noted_and_a_long_one_refused(robot, gain_record):
    reference = np.array(gain_record.signal("zn", Tap.REF))
    reference[1500:1800] = reference[1500]
    record = _replace_signals(gain_record, ref=reference)
    calibration = _calibrate(robot, record, "zn")
    assert any(
        note.startswith("the laser was lost from 3.000 s to 3.5") for note in calibration.notes
    )
    assert _get_figure(calibration, "gain error").value == pytest.approx(0.02, abs=1e-4)
    reference[3000:10000] = 0.0
    with pytest.raises(SensorCalibrationError, match="70 % are needed"):
        compare_with_laser(_replace_signals(gain_record, ref=reference), "zn", robot)


def test_records_that_cannot_be_compared_are_refused(robot, gain_record):
    with pytest.raises(SensorCalibrationError, match=r"no column zn\.ref"):
        compare_with_laser(_replace_signals(gain_record, ref=None), "zn", robot)
    with pytest.raises(SensorCalibrationError, match="the robot has x, y"):
        compare_with_laser(gain_record, "q", robot)
    with pytest.raises(SensorCalibrationError, match="record has zn"):
        compare_with_laser(gain_record, "x", robot)
    with pytest.raises(SensorCalibrationError, match="at least 500"):
        compare_with_laser(gain_record.select_rows(slice(0, 400)), "zn", robot)
    reference, reading = (
        3e-5 + 0.05 * gain_record.signal("zn", tap) for tap in (Tap.REF, Tap.MEAS)
    )
    small_travel = _replace_signals(gain_record, ref=reference, meas=reading)
    with pytest.raises(SensorCalibrationError, match="% of its range"):
        compare_with_laser(small_travel, "zn", robot)


def test_a_gap_in_the_rows_is_listed(robot, gain_record):
    remaining_rows = np.r_[0:2500, 2700 : len(gain_record.time_s)]
    record = replace(
        gain_record,
        time_s=gain_record.time_s[remaining_rows],
        values=gain_record.values[remaining_rows],
    )
    assert compare_with_laser(record, "zn", robot).losses == ("no rows from 4.998 s to 5.400 s",)


def test_a_laser_record_with_another_clock_is_joined(robot, gain_record):
    shift_s, rate = 1.234, 50e-6
    laser_time_s = np.arange(0.0, gain_record.duration_s + 3.0, 2e-3)
    axis_time_s = (laser_time_s - shift_s) / (1.0 + rate)
    laser_reading = np.interp(axis_time_s, gain_record.time_s, gain_record.signal("zn", Tap.REF))
    laser = Record.from_signals(laser_time_s + 77.0, {("zn", Tap.REF): laser_reading}, {"zn": "m"})
    joined = join_laser_record(_replace_signals(gain_record, ref=None), laser, "zn")
    assert float(joined.metadata["laser_shift_s"]) == pytest.approx(shift_s, abs=2e-5)
    assert float(joined.metadata["laser_rate"]) == pytest.approx(rate, abs=2e-6)
    calibration = _calibrate(robot, joined, "zn", has_common_clock=False)
    assert _get_figure(calibration, "gain error").value == pytest.approx(0.02, abs=1e-4)
    other = Record.from_signals(
        laser_time_s, {("zn", Tap.REF): 3e-5 + 1e-5 * np.sin(9.0 * laser_time_s)}, {"zn": "m"}
    )
    with pytest.raises(SensorCalibrationError, match="does not match"):
        join_laser_record(gain_record, other, "zn")
